//! Apexes drawn as two vertices side by side: made one before darts are looked for.

use super::codes;
use super::legs_test::wedge_test;
use super::thresholds::{
    COUNT_OF_BLUNT_APEXES, DISTANCE_OF_COPY_VERTEX, DISTANCE_OF_VERTEX_MARK, SHARE_OF_BLUNT_APEX, TURN_OF_APEX,
    TURN_OF_LEG_END, VERTICES_OF_BLUNT_OUTLINE, WIDTH_OF_BLUNT_APEX,
};
use super::wedge::walk;
use crate::dxf::chain::JOIN;
use crate::dxf::desk::Desk;
use crate::dxf::geom;
use crate::dxf::outline::{Node, Outline};
use crate::dxf::piece::{DrawnPiece, mm};
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Vec2};

impl DrawnPiece {
    /// Makes one vertex of every blunt apex, on the outlines and their dense copies.
    pub(in crate::dxf) fn join_blunt_apexes(&mut self, desk: &mut Desk<'_>) {
        let mut all = join(&mut self.boundary);
        if let Some(copy) = &mut self.unfinished.dense {
            join_copy(copy, &all);
        }
        if let Some(sew) = &mut self.sew {
            let joined = join(sew);
            if let Some(copy) = &mut self.unfinished.dense_sew {
                join_copy(copy, &joined);
            }
            all.extend(joined);
        }
        let rules = self.texts.rules.iter_mut().map(|r| &mut r.at);
        for p in self.points.turn_list.iter_mut().chain(rules) {
            carry(p, &all);
        }
        for one in all.iter().filter(|j| j.width() > JOIN) {
            let text = format!(
                "the apex at {} of `{}` is drawn blunt, {:.2} mm wide; it was read as one point",
                mm(one.apex),
                self.label(),
                one.width()
            );
            desk.say(Diagnostic::info(codes::DART_APEX_BLUNT, text), &self.block, "1", self.boundary.line);
        }
    }
}

/// A corner point or a grade rule at one of the two vertices goes with them.
fn carry(p: &mut Vec2, joined: &[Joined]) {
    for one in joined {
        if one.ends.iter().any(|e| (e - *p).norm() <= DISTANCE_OF_VERTEX_MARK) {
            *p = one.apex;
        }
    }
}

/// An apex that was made of two vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Joined {
    /// The two vertices.
    ends: [Vec2; 2],
    /// Their middle, which now stands for them.
    apex: Vec2,
}

impl Joined {
    /// How far the two vertices lay apart, mm.
    fn width(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }
}

/// Joins the blunt apexes of an outline whose kinds are known.
fn join(outline: &mut Outline) -> Vec<Joined> {
    let mut joined = Vec::new();
    let mut i = 0;
    while i < outline.drawn.len() && joined.len() < COUNT_OF_BLUNT_APEXES {
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
fn join_copy(copy: &mut Outline, joined: &[Joined]) {
    for one in joined {
        let n = copy.drawn.len();
        let near = |k: usize, p: Vec2| (copy.drawn[k % n].at - p).norm() <= DISTANCE_OF_COPY_VERTEX;
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
    if n < VERTICES_OF_BLUNT_OUTLINE || (b - a).norm() > WIDTH_OF_BLUNT_APEX {
        return None;
    }
    let apex = (a + b) * 0.5;
    let [first, second] = [geom::turn(before, a, b), geom::turn(a, b, after)].map(f64::to_degrees);
    let alone = |turn: f64, other: f64| turn <= -TURN_OF_APEX && other.abs() <= TURN_OF_LEG_END;
    let reflex = geom::turn(before, apex, after).to_degrees() <= -TURN_OF_APEX;
    if !reflex || alone(first, second) || alone(second, first) {
        return None;
    }
    let ends = [walk(nodes, i, false)?, walk(nodes, (i + 1) % n, true)?].map(|leg| at(leg[leg.len() - 1]));
    let wide = (b - a).norm() <= SHARE_OF_BLUNT_APEX * (ends[1] - ends[0]).norm();
    (wide && wedge_test(apex, ends[0], ends[1]).is_ok()).then_some(apex)
}

fn replace(outline: &mut Outline, i: usize, apex: Vec2) -> Joined {
    let next = (i + 1) % outline.drawn.len();
    let ends = [outline.drawn[i].at, outline.drawn[next].at];
    outline.drawn[i] = Node { at: apex, kind: PointKind::Turn, drawn: true };
    outline.drawn.remove(next);
    Joined { ends, apex }
}
