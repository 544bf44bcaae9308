//! Cutouts that cannot be cut: open, crossing themselves or the outline, outside the piece, on each other.

use super::codes;
use crate::dxf::chain::Path;
use crate::dxf::contact::{self, Contact};
use crate::dxf::desk::Desk;
use crate::dxf::geom::{self, Crossing};
use crate::dxf::piece::{DrawnPiece, mm};
use toile_garment::{Code, Diagnostic, Vec2};

/// A cutout may touch the outline within this, mm.
const NEAR: f64 = 0.5;
/// Most pairs of a vertex and an edge looked at in one piece.
const TESTS: usize = 50_000_000;

pub(super) fn check(piece: &DrawnPiece, desk: &mut Desk<'_>) {
    let leg = |p: &&Path| !piece.darts.iter().any(|d| d.ids.iter().any(|id| p.ids.contains(id)));
    let cutouts: Vec<(&Path, Vec<Vec2>)> =
        piece.inside.cutouts.iter().filter(leg).map(|p| (p, p.positions())).collect();
    if cutouts.is_empty() {
        return;
    }
    let outline = piece.boundary.positions();
    let tries = (TESTS / (outline.len() * cutouts.len()).max(1)).clamp(4, 200);
    let mut say = |path: &Path, code: Code, what: String| {
        let text = format!(
            "the cutout of `{}` at {} {what}; it was kept as drawn",
            piece.label(),
            path.points.first().map_or_else(String::new, |p| mm(p.0))
        );
        let hint = "correct the line on layer 11 in the pattern program";
        desk.say(Diagnostic::warning(code, text).hint(hint), &piece.block, "11", path.line);
    };
    for (path, points) in &cutouts {
        if let Some((code, what)) = fault(path, points, &outline, tries) {
            say(path, code, what);
        }
    }
    for (one, two) in overlapping(&cutouts) {
        let at = cutouts[two].1.first().map_or_else(String::new, |p| mm(*p));
        say(cutouts[one].0, codes::CUTOUTS_OVERLAP, format!("overlaps the one at {at}"));
    }
}

fn fault(path: &Path, points: &[Vec2], outline: &[Vec2], tries: usize) -> Option<(Code, String)> {
    if !path.closed {
        let gap = points.first().zip(points.last()).map_or(0.0, |(a, b)| (a - b).norm());
        return Some((codes::CUTOUT_OPEN, format!("is open by {gap:.1} mm")));
    }
    let crosses = match geom::crossing(points) {
        Crossing::At(_, _, p) => Some(p),
        _ => contact::contacts(points).into_iter().find_map(|c| match c {
            Contact::Crosses(p) => Some(p),
            Contact::Touches(_) => None,
        }),
    };
    if let Some(p) = crosses {
        return Some((codes::CUTOUT_CROSSES_ITSELF, format!("crosses itself at {}", mm(p))));
    }
    let sample = |line: &[Vec2]| line.iter().copied().step_by(line.len() / tries + 1).collect::<Vec<_>>();
    let ours = sample(&with_middles(points));
    let distance = |p: &Vec2| geom::distance(*p, outline, true);
    if ours.iter().all(|p| distance(p) <= NEAR) && geom::area(points).abs() > 0.9 * geom::area(outline).abs() {
        return Some((codes::CUTOUT_OUTSIDE, "is the outline itself: nothing would be left of the piece".into()));
    }
    let outside = ours.iter().filter(|p| !geom::inside(**p, outline) && distance(p) > NEAR).count();
    let swallowed = || {
        let (lo, hi) = geom::bounds(points.iter().copied()).unwrap_or_default();
        let near = |p: &&Vec2| p.x > lo.x && p.y > lo.y && p.x < hi.x && p.y < hi.y;
        let mut within = outline.iter().filter(near).take(tries);
        within.any(|p| geom::inside(*p, points) && geom::distance(*p, points, true) > NEAR)
    };
    if outside == ours.len() {
        Some((codes::CUTOUT_OUTSIDE, "lies outside the piece".into()))
    } else if outside > 0 || swallowed() {
        Some((codes::CUTOUT_OUTSIDE, "crosses the outline".into()))
    } else {
        None
    }
}

/// The vertices of a closed line and the middles of its edges.
fn with_middles(points: &[Vec2]) -> Vec<Vec2> {
    let n = points.len();
    (0..n).flat_map(|i| [points[i], (points[i] + points[(i + 1) % n]) * 0.5]).collect()
}

/// Pairs of closed cutouts of which one has a vertex or the middle of an edge inside the other, at most eight.
fn overlapping(cutouts: &[(&Path, Vec<Vec2>)]) -> Vec<(usize, usize)> {
    let mut boxes: Vec<(usize, Vec2, Vec2)> = cutouts
        .iter()
        .enumerate()
        .filter(|(_, (path, _))| path.closed)
        .filter_map(|(i, (_, points))| geom::bounds(points.iter().copied()).map(|(lo, hi)| (i, lo, hi)))
        .collect();
    boxes.sort_by(|a, b| a.1.x.total_cmp(&b.1.x).then(a.0.cmp(&b.0)));
    let within = |a: usize, b: usize| {
        let line = &cutouts[b].1;
        let points = with_middles(&cutouts[a].1);
        points
            .iter()
            .step_by(points.len() / 100 + 1)
            .any(|p| geom::inside(*p, line) && geom::distance(*p, line, true) > NEAR)
    };
    let mut out = Vec::new();
    let mut looks = 0_usize;
    for (k, (i, _, hi)) in boxes.iter().enumerate() {
        for (j, lo, top) in boxes[k + 1..].iter().take_while(|b| b.1.x < hi.x) {
            looks += 1;
            if out.len() >= 8 || looks > 200_000 {
                return out;
            }
            let apart = lo.y >= hi.y || boxes[k].1.y >= top.y;
            if !apart && (within(*i, *j) || within(*j, *i)) {
                out.push((*i.min(j), *i.max(j)));
            }
        }
    }
    out
}
