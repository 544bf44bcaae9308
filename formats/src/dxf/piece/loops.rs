//! Small loops of a closed line: where it crosses itself beside a corner and comes back, the loop is cut off.
//!
//! Programs that offset or grade a line leave such loops where the line is shorter than the offset.

use super::codes;
use super::{Desk, mm};
use crate::dxf::geom::{self, Crossing};
use crate::dxf::outline::{Node, Outline};
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Vec2};

/// Most loops of one line that are cut off.
const LOOPS_PER_LINE: usize = 64;
/// A loop encloses at most this share of what the line encloses.
const SHARE_OF_LOOP: f64 = 0.05;

/// A loop that was cut off: where the line crosses itself, and its larger side, mm.
struct Loop {
    at: Vec2,
    side: f64,
}

/// Cuts off loops up to `most` mm across and says each; tells whether the line then crosses itself no more. A line that
/// still does is left as it was.
pub(super) fn cut_off(block: &str, what: (&str, &str), outline: &mut Outline, most: f64, desk: &mut Desk<'_>) -> bool {
    let mut nodes = outline.drawn.clone();
    let mut loops = Vec::new();
    loop {
        let positions: Vec<Vec2> = nodes.iter().map(|n| n.at).collect();
        match geom::crossing(&positions) {
            Crossing::None => break,
            Crossing::At(j, i, p) if loops.len() < LOOPS_PER_LINE => match without_loop(&nodes, [j, i], p, most) {
                Some((rest, side)) => {
                    nodes = rest;
                    loops.push(Loop { at: p, side });
                }
                None => return false,
            },
            _ => return false,
        }
    }
    let (line, layer) = what;
    for Loop { at, side } in &loops {
        let text = format!(
            "the {line} of block `{block}` makes a loop of {side:.1} mm at {}; the loop was cut off where the line crosses itself",
            mm(*at)
        );
        let hint = format!("correct the corner there; loops up to {most} mm are cut off with a warning");
        let finding = Diagnostic::warning(codes::OUTLINE_LOOP_CUT_OFF, text).hint(hint);
        desk.say(finding, block, layer, outline.line);
    }
    if !loops.is_empty() {
        outline.drawn = nodes;
        outline.as_drawn();
    }
    true
}

/// The closed line without the smaller loop between segments `j` and `i`, which cross at `p`, and the larger side of
/// the loop. `None` where that is no small loop.
fn without_loop(nodes: &[Node], [j, i]: [usize; 2], p: Vec2, most: f64) -> Option<(Vec<Node>, f64)> {
    // The vertices between the two, and those before and after them.
    let between = nodes[j + 1..=i].to_vec();
    let others: Vec<Node> = nodes[..=j].iter().chain(&nodes[i + 1..]).copied().collect();
    let side = |part: &[Node]| {
        let (lo, hi) = geom::bounds(part.iter().map(|n| n.at).chain([p])).unwrap_or_default();
        (hi.x - lo.x).max(hi.y - lo.y)
    };
    let inner = side(&between) <= side(&others);
    let (small, mut rest) = if inner { (between, others) } else { (others, between) };
    let across = side(&small);
    let area = |part: &[Node]| {
        let line: Vec<Vec2> = part.iter().map(|n| n.at).chain([p]).collect();
        geom::area(&line).abs()
    };
    if across > most || area(&small) > SHARE_OF_LOOP * area(&rest) {
        return None;
    }
    rest.insert(if inner { j + 1 } else { 0 }, Node { at: p, kind: PointKind::Turn, drawn: true });
    Some((rest, across))
}
