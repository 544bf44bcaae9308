//! Apexes drawn as two vertices side by side: made one before darts are looked for.

use super::{BLUNT, LEG_END, walk, wedge_test};
use crate::dxf::geom;
use crate::dxf::outline::{Node, Outline};
use toile_garment::Vec2;
use toile_garment::outline::PointKind;

/// The two vertices lie apart at most this share of the mouth: else they are the bottom of a slit or a box.
const OF_MOUTH: f64 = 0.25;
/// Most apexes that are joined in one outline.
const MOST: usize = 500;
/// Vertices of a dense copy are those of the outline within this, mm.
const MATCH: f64 = 0.1;

/// An apex that was made of two vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joined {
    /// The two vertices.
    pub ends: [Vec2; 2],
    /// Their middle, which now stands for them.
    pub apex: Vec2,
}

impl Joined {
    /// How far the two vertices lay apart, mm.
    #[must_use]
    pub fn width(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }
}

/// Joins the blunt apexes of an outline whose kinds are known.
pub fn join(outline: &mut Outline) -> Vec<Joined> {
    let mut joined = Vec::new();
    let mut i = 0;
    while i < outline.drawn.len() && joined.len() < MOST {
        match blunt(&outline.drawn, i) {
            // The next vertex may lie as near.
            Some(apex) => joined.push(replace(outline, i, apex)),
            None => i += 1,
        }
    }
    if !joined.is_empty() {
        outline.as_drawn();
    }
    joined
}

/// Joins the same vertices on the dense copy of the outline.
pub fn join_copy(copy: &mut Outline, joined: &[Joined]) {
    for one in joined {
        let n = copy.drawn.len();
        let near = |k: usize, p: Vec2| (copy.drawn[k % n].at - p).norm() <= MATCH;
        let is_pair = |i: &usize| near(*i, one.ends[0]) && near(i + 1, one.ends[1]);
        if let Some(i) = (0..n).filter(|_| n > 3).find(is_pair) {
            replace(copy, i, one.apex);
        }
    }
}

/// The middle of two vertices in a row when they make the apex of a wedge together and neither does so alone.
fn blunt(nodes: &[Node], i: usize) -> Option<Vec2> {
    let n = nodes.len();
    let at = |k: usize| nodes[k % n].at;
    let (before, a, b, after) = (at(i + n - 1), at(i), at(i + 1), at(i + 2));
    if n < 6 || (b - a).norm() > BLUNT {
        return None;
    }
    let apex = (a + b) * 0.5;
    let [first, second] = [geom::turn(before, a, b), geom::turn(a, b, after)].map(f64::to_degrees);
    let alone = |turn: f64, other: f64| turn <= -90.0 && other.abs() <= LEG_END;
    let reflex = geom::turn(before, apex, after).to_degrees() <= -90.0;
    if !reflex || alone(first, second) || alone(second, first) {
        return None;
    }
    let ends = [walk(nodes, i, false)?, walk(nodes, (i + 1) % n, true)?].map(|leg| at(leg[leg.len() - 1]));
    let wide = (b - a).norm() <= OF_MOUTH * (ends[1] - ends[0]).norm();
    (wide && wedge_test(apex, ends[0], ends[1], *super::ANGLE.start()).is_ok()).then_some(apex)
}

fn replace(outline: &mut Outline, i: usize, apex: Vec2) -> Joined {
    let next = (i + 1) % outline.drawn.len();
    let ends = [outline.drawn[i].at, outline.drawn[next].at];
    outline.drawn[i] = Node { at: apex, kind: PointKind::Turn, drawn: true };
    outline.drawn.remove(next);
    Joined { ends, apex }
}
