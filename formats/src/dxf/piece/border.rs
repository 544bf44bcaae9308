//! The outline among the lines of layer 1.

use super::codes;
use super::{Desk, loops, mm};
use crate::codes::OUTLINE_CROSSES_ITSELF;
use crate::dxf::chain::{self, Chained, Path};
use crate::dxf::contact::{self, Contact};
use crate::dxf::geom::{self, Crossing};
use crate::dxf::ledger::Verdict;
use crate::dxf::limits;
use crate::dxf::outline::{Node, Outline};
use crate::dxf::sheet::Sheet;
use toile_garment::outline::PointKind;
use toile_garment::{Code, Diagnostic, Vec2};

/// An open line longer than this share of the outline means that the outline itself is open.
const STRAY: f64 = 0.5;
/// Shorter spikes without width that stand out of an outline are strokes of notches, mm.
const SPIKE: f64 = 10.0;

/// The largest closed line of a dense copy.
pub(super) fn closed_copy(runs: Vec<Path>, gap: f64) -> Option<Outline> {
    let largest = chain::chain(runs, gap).closed.into_iter().max_by(|a, b| {
        let area = |p: &Path| geom::area(&p.positions()).abs();
        area(a).total_cmp(&area(b))
    });
    largest.map(Outline::new)
}

/// Closed lines of layer 11, and what stays open.
pub(super) fn cutouts(runs: Vec<Path>, desk: &mut Desk<'_>) -> Vec<Path> {
    let Chained { mut closed, open, doubled, .. } = chain::chain(runs, desk.rules.tolerances.gap);
    note_doubled(&doubled, desk);
    closed.extend(open);
    closed.sort_by_key(|p| p.line);
    closed
}

/// The outline among the lines of layer 1, and closed lines inside it.
pub(super) fn boundary(block: &str, line: u64, sheet: &Sheet, desk: &mut Desk<'_>) -> Option<(Path, Vec<Path>)> {
    let Chained { mut closed, mut open, gaps, doubled } =
        chain::chain(sheet.boundary.clone(), desk.rules.tolerances.gap);
    if !doubled.is_empty() {
        note_doubled(&doubled, desk);
        let text = format!("{} line(s) of the outline of block `{block}` stand there twice; read once", doubled.len());
        desk.say(Diagnostic::info(codes::OUTLINE_DOUBLED, text), block, "1", line);
    }
    if closed.is_empty() {
        close_at_fold(&mut open, &mut closed, sheet);
    }
    for gap in gaps {
        let text =
            format!("the outline of block `{block}` has a gap of {:.2} mm at {}; it was closed", gap.width, mm(gap.at));
        desk.say(Diagnostic::warning(codes::OUTLINE_GAP_CLOSED, text), block, "1", line);
    }
    let area = |p: &Path| geom::area(&p.positions()).abs();
    closed.sort_by(|a, b| area(b).total_cmp(&area(a)));
    let longest_open = open.iter().map(|p| geom::length(&p.positions(), false)).fold(0.0, f64::max);
    let main_length = closed.first().map_or(0.0, |p| geom::length(&p.positions(), true));
    if closed.is_empty() || longest_open > STRAY * main_length {
        say_open(block, line, &open, desk);
        return None;
    }
    refuse_strays(block, &open, desk);
    let mut closed = closed.into_iter();
    let main = closed.next()?;
    let inner = inner_lines(block, &main, closed, desk);
    Some((main, inner))
}

/// Tells that the outline is open, or not there at all.
fn say_open(block: &str, line: u64, open: &[Path], desk: &mut Desk<'_>) {
    for path in open {
        let (a, b) = (path.points[0].0, path.points[path.points.len() - 1].0);
        let text = format!(
            "the outline of block `{block}` is open: {:.2} mm are missing between {} and {}",
            (a - b).norm(),
            mm(b),
            mm(a)
        );
        let finding = Diagnostic::error(codes::OUTLINE_OPEN, text).hint(format!(
            "close it in the pattern; gaps up to {} mm are closed with a note",
            desk.rules.tolerances.gap
        ));
        desk.say(finding, block, "1", path.line);
    }
    if open.is_empty() {
        let text = format!("block `{block}` has lines on layer 1 but no outline");
        desk.say(Diagnostic::error(codes::OUTLINE_MISSING, text), block, "1", line);
    }
}

/// Leaves out open lines beside the outline, and tells it.
fn refuse_strays(block: &str, open: &[Path], desk: &mut Desk<'_>) {
    for path in open {
        let text = format!(
            "an open line on layer 1 of block `{block}` at {} is no part of the outline; it was left out",
            mm(path.points[0].0)
        );
        for id in &path.ids {
            desk.overrule(*id, Verdict::Refused, "open line on layer 1 beside the outline");
        }
        desk.say(Diagnostic::warning(codes::OUTLINE_STRAY_LINE, text), block, "1", path.line);
    }
}

/// Further closed lines on layer 1: those inside the outline are cutouts, the others are left out.
fn inner_lines(block: &str, main: &Path, others: impl Iterator<Item = Path>, desk: &mut Desk<'_>) -> Vec<Path> {
    let polygon = main.positions();
    let mut inner = Vec::new();
    for path in others {
        let inside = path.points.iter().all(|p| geom::inside(p.0, &polygon));
        let (what, verdict) =
            if inside { ("read as a cutout", Verdict::Interpreted) } else { ("left out", Verdict::Refused) };
        let text =
            format!("block `{block}` has a second closed line on layer 1 at {}; it was {what}", mm(path.points[0].0));
        for id in &path.ids {
            desk.overrule(*id, verdict, "second closed line on layer 1");
        }
        desk.say(Diagnostic::warning(codes::OUTLINE_SECOND, text), block, "1", path.line);
        if inside {
            inner.push(path);
        }
    }
    inner
}

/// The ledger's word on lines that repeat others.
pub(super) fn note_doubled(ids: &[u32], desk: &mut Desk<'_>) {
    for id in ids {
        desk.overrule(*id, Verdict::Interpreted, "repeats another line: read once");
    }
}

/// The outline of a half piece may be open at its fold: the mirror line closes it.
fn close_at_fold(open: &mut Vec<Path>, closed: &mut Vec<Path>, sheet: &Sheet) {
    let [path] = open.as_slice() else { return };
    let ends = [path.points[0].0, path.points[path.points.len() - 1].0];
    let on = |ends: &[Vec2; 2]| {
        let [a, b] = *ends;
        [path.points[0].0, path.points[path.points.len() - 1].0].iter().all(|p| geom::point_segment(*p, a, b).0 <= 1.0)
    };
    if path.points.len() >= 3 && (ends[0] - ends[1]).norm() > 5.0 && sheet.axes.mirror.iter().any(|m| on(&m.ends)) {
        closed.extend(open.pop().map(|path| Path { closed: true, ..path }));
    }
}

/// An outline must have an area, a sane size and no crossing. Where only vertices drawn twice, a little apart, tangle
/// it, they are made one.
pub(super) fn check_shape(block: &str, outline: &mut Outline, desk: &mut Desk<'_>) -> Option<()> {
    let line = outline.line;
    let fail = |desk: &mut Desk<'_>, code: Code, text: String, hint: &str| {
        desk.say(Diagnostic::error(code, text).hint(hint), block, "1", line);
        None
    };
    let mut points = outline.positions();
    if points.len() > limits::OUTLINE_POINTS {
        let text = format!("the outline of block `{block}` has more than {} points", limits::OUTLINE_POINTS);
        return fail(desk, codes::OUTLINE_TOO_LONG, text, "export it with a coarser curve tolerance");
    }
    let (lo, hi) = geom::bounds(points.iter().copied())?;
    let extent = (hi.x - lo.x).max(hi.y - lo.y);
    if extent > limits::PIECE_EXTENT_MM {
        let text = format!("the outline of block `{block}` is {:.0} m long", extent / 1000.0);
        return fail(desk, codes::OUTLINE_TOO_LARGE, text, "check the unit of the file");
    }
    let mut crossing = geom::crossing(&points);
    if matches!(crossing, Crossing::At(..))
        && (untangle(block, outline, desk)
            || loops::cut_off(block, ("outline", "1"), outline, desk.rules.tolerances.loops, desk))
    {
        (points, crossing) = (outline.positions(), Crossing::None);
    }
    match crossing {
        Crossing::None if points.len() >= 3 && geom::area(&points).abs() >= 1.0 => {
            check_contacts(block, line, &points, desk)
        }
        Crossing::None => {
            let text = format!("the outline of block `{block}` at {} encloses no area", mm(points[0]));
            fail(desk, codes::OUTLINE_WITHOUT_AREA, text, "draw a closed outline on layer 1")
        }
        Crossing::TooMany => {
            let text = format!("the outline of block `{block}` is too entangled to check");
            fail(desk, codes::OUTLINE_TOO_ENTANGLED, text, "simplify it")
        }
        Crossing::At(_, _, p) => {
            let text = format!("the outline of block `{block}` intersects itself at {}", mm(p));
            fail(desk, OUTLINE_CROSSES_ITSELF, text, "correct the outline there")
        }
    }
}

/// An outline may touch itself, with a warning, but go through itself nowhere.
fn check_contacts(block: &str, line: u64, points: &[Vec2], desk: &mut Desk<'_>) -> Option<()> {
    for contact in contact::contacts(points) {
        match contact {
            Contact::Crosses(p) => {
                let text = format!("the outline of block `{block}` intersects itself at its vertex {}", mm(p));
                let finding = Diagnostic::error(OUTLINE_CROSSES_ITSELF, text).hint("correct the outline there");
                desk.say(finding, block, "1", line);
                return None;
            }
            Contact::Touches(p) => {
                let text = format!("the outline of block `{block}` touches itself at {}; it was read as drawn", mm(p));
                let hint = "draw the parts as pieces of their own, or leave a gap between the lines";
                desk.say(Diagnostic::warning(codes::OUTLINE_TOUCHES_ITSELF, text).hint(hint), block, "1", line);
            }
        }
    }
    for (tip, length) in contact::outward_spikes(points, SPIKE) {
        let text = format!(
            "a spike without width, {length:.1} mm long, stands out of the outline of block `{block}` at {}; it was read as drawn",
            mm(tip)
        );
        let hint = "take the spike out of the outline in the pattern program";
        desk.say(Diagnostic::warning(codes::OUTLINE_SPIKE, text).hint(hint), block, "1", line);
    }
    Some(())
}

/// Leaves out vertices that repeat the one before, when the outline then crosses itself no more; says whether it does.
fn untangle(block: &str, outline: &mut Outline, desk: &mut Desk<'_>) -> bool {
    let mut nodes: Vec<Node> = Vec::with_capacity(outline.drawn.len());
    for node in &outline.drawn {
        match nodes.last_mut() {
            Some(last) if (last.at - node.at).norm() <= chain::JOIN => {
                if node.kind == PointKind::Turn {
                    last.kind = PointKind::Turn;
                }
            }
            _ => nodes.push(*node),
        }
    }
    let positions: Vec<Vec2> = nodes.iter().map(|n| n.at).collect();
    if geom::crossing(&positions) != Crossing::None {
        return false;
    }
    let text = format!(
        "{} vertices of the outline of block `{block}` stand within {} mm of the one before; left out",
        outline.drawn.len() - nodes.len(),
        chain::JOIN
    );
    desk.say(Diagnostic::info(codes::OUTLINE_VERTICES_DOUBLED, text), block, "1", outline.line);
    outline.drawn = nodes;
    outline.as_drawn();
    true
}
