//! A flat drawing: no block is a piece, so the closed lines of ENTITIES are.
//!
//! Plot frames round pieces and title blocks are left out. Open lines belong to the piece they lie in or touch: short ones
//! at its outline are strokes of notches.

use super::codes;
use super::frames;
use super::sheets::{self, Draft};
use super::titles;
use crate::dxf::chain::{self, Path};
use crate::dxf::codes::PIECES_FROM_ENTITIES;
use crate::dxf::geom;
use crate::dxf::layers::{Layers, Role};
use crate::dxf::ledger::Verdict;
use crate::dxf::limits;
use crate::dxf::model::{Drawing, Entity, Shape};
use crate::dxf::sheet::{Drill, Mark, Note, STROKE, Sheet, Sorter, Stroke};
use crate::dxf::tolerances::Tolerances;
use toile_garment::{Diagnostic, Vec2};

/// A line this near to an outline touches it, mm.
pub(super) const TOUCH: f64 = 0.5;
/// An open line is an outline with a gap only if the gap is no larger share of its length than this …
const GAP: f64 = 0.25;
/// … and it is at least this long, mm.
const OUTLINE: f64 = 100.0;

/// A piece of a flat drawing.
struct Outer {
    polygon: Vec<Vec2>,
    sheet: Sheet,
    line: u64,
}

impl Outer {
    fn new(path: Path) -> Self {
        let (polygon, line) = (path.positions(), path.line);
        Self { polygon, sheet: Sheet { boundary: vec![path], ..Sheet::default() }, line }
    }

    fn holds(&self, p: Vec2) -> bool {
        geom::inside(p, &self.polygon) || geom::distance(p, &self.polygon, true) <= TOUCH
    }
}

/// The outermost closed lines in ENTITIES as pieces.
pub(super) fn flat(drawing: &Drawing, sorter: &mut Sorter<'_>, tolerances: &Tolerances) -> Vec<Draft> {
    let all = sorter.loose(as_outlines(drawing, sorter.layers).iter());
    let mut chained = chain::chain(all.boundary.clone(), tolerances.gap);
    let area = |p: &Path| geom::area(&p.positions()).abs();
    chained.closed.sort_by(|a, b| area(b).total_cmp(&area(a)));
    frames::leave_out(&mut chained.closed, sorter);
    titles::leave_out(&mut chained, &all, sorter);
    let mut outer: Vec<Outer> = Vec::new();
    for path in chained.closed.into_iter().take(limits::PIECES + 1) {
        match outer.iter().position(|o| geom::inside(path.points[0].0, &o.polygon)) {
            Some(i) => outer[i].sheet.internal.push(path),
            None => outer.push(Outer::new(path)),
        }
    }
    let homeless: Vec<Path> = chained.open.into_iter().filter_map(|p| take_open(p, &mut outer, sorter)).collect();
    let (outlines, stray): (Vec<Path>, Vec<Path>) = homeless.into_iter().partition(is_open_outline);
    outer.extend(outlines.into_iter().map(Outer::new));
    if outer.is_empty() {
        return Vec::new();
    }
    say_stray(&stray, sorter);
    let place = sorter.findings.place(1);
    let text = format!("no block holds an outline; {} closed line(s) of ENTITIES were read as pieces", outer.len());
    sorter.findings.push(Diagnostic::warning(PIECES_FROM_ENTITIES, text).at(place));
    let beside = |n: &&Note| !outer.iter().any(|o| o.holds(n.at));
    sheets::say_texts(all.notes.iter().filter(beside).map(|n| (n.text.as_str(), 1)), sorter);
    share_out(all, &mut outer);
    outer.sort_by_key(|o| o.line);
    let draft = |(i, o): (usize, Outer)| Draft {
        block: format!("PIECE_{}", i + 1),
        line: o.line,
        sheet: o.sheet,
        faults: Vec::new(),
    };
    outer.into_iter().enumerate().map(draft).collect()
}

/// On plain drawings every line may be an outline; with layer 1 in use only those on it.
fn as_outlines(drawing: &Drawing, layers: &Layers) -> Vec<Entity> {
    let lines = |e: &Entity| !e.shape.extent().is_empty();
    let on_one = drawing.entities.iter().any(|e| layers.role(&e.layer) == Role::Boundary && lines(e));
    let relabelled = |e: &Entity| {
        let mut e = e.clone();
        if !on_one && lines(&e) && layers.is_without_word(&e.layer) {
            e.layer = "1".into();
        }
        e
    };
    drawing.entities.iter().filter(|e| !matches!(e.shape, Shape::Insert { .. })).map(relabelled).collect()
}

/// Gives an open line to the piece it lies in or touches; gives it back where there is none.
fn take_open(path: Path, outer: &mut [Outer], sorter: &mut Sorter<'_>) -> Option<Path> {
    let n = path.points.len();
    let at = [path.points[0].0, path.points[n / 2].0, path.points[n - 1].0];
    let Some(home) = outer.iter_mut().find(|o| at.iter().any(|p| o.holds(*p))) else { return Some(path) };
    let positions = path.positions();
    let at_outline = [at[0], at[2]].iter().any(|p| geom::distance(*p, &home.polygon, true) <= TOUCH);
    if n == 2 && at_outline && geom::length(&positions, false) <= STROKE {
        for id in &path.ids {
            sorter.ledger.overrule(*id, Verdict::Interpreted, "short line at an outline: stroke of a notch");
        }
        home.sheet.notch_strokes.push(Stroke { id: path.ids[0], line: path.line, ends: [at[0], at[2]] });
    } else {
        home.sheet.internal.push(path);
    }
    None
}

/// Is an open line an outline that misses its start?
fn is_open_outline(path: &Path) -> bool {
    let positions = path.positions();
    let gap = (positions[0] - positions[positions.len() - 1]).norm();
    let length = geom::length(&positions, false);
    positions.len() >= 3 && length >= OUTLINE && gap <= GAP * length
}

/// Says which open lines belong to no piece.
fn say_stray(stray: &[Path], sorter: &mut Sorter<'_>) {
    let Some(first) = stray.first() else { return };
    for id in stray.iter().flat_map(|p| &p.ids) {
        sorter.ledger.overrule(*id, Verdict::Refused, "open line that belongs to no piece");
    }
    let text = format!("{} open line(s) lie in no piece and touch none; they were left out", stray.len());
    let place = sorter.findings.place(first.line);
    sorter.findings.push(Diagnostic::warning(codes::ENTITIES_LEFT_OUT, text).at(place));
}

/// Everything but outlines goes to the piece it lies in.
fn share_out(all: Sheet, outer: &mut [Outer]) {
    let home = |p: Vec2, outer: &[Outer]| outer.iter().position(|o| o.holds(p));
    macro_rules! share {
        ($($($field:ident).+ by $at:expr),+) => {$(
            for item in all.$($field).+ {
                let at: Vec2 = $at(&item);
                if let Some(i) = home(at, outer) {
                    outer[i].sheet.$($field).+.push(item);
                }
            }
        )+};
    }
    let first = |p: &Path| p.points.first().map_or(Vec2::zeros(), |p| p.0);
    let start = |s: &Stroke| (s.ends[0] + s.ends[1]) * 0.5;
    share!(
        stripes by |s: &(String, Path)| first(&s.1), dense_other by |s: &(String, Path)| first(&s.1),
        dense by first, sew by first, dense_sew by first, internal by first, cutouts by first,
        turn by |p: &Vec2| *p, curve by |p: &Vec2| *p, marks by |m: &Mark| m.at,
        notch_strokes by start, axes.reference by start, axes.mirror by start, axes.grain by start,
        drills by |d: &Drill| d.at,
        notes by |n: &Note| n.at
    );
}
