//! Plot frames of flat drawings: upright rectangles round the pieces.

use super::codes;
use super::flat::TOUCH;
use crate::dxf::chain::Path;
use crate::dxf::geom;
use crate::dxf::ledger::Verdict;
use crate::dxf::piece::is_moved_inwards;
use crate::dxf::sheet::Sorter;
use toile_garment::{Diagnostic, Vec2};

/// The pieces in a plot frame cover at least this share of it: pockets and buttonholes cover less of a piece.
const FULL: f64 = 0.3;
/// A frame in a frame covers at least this share of it.
const NEAR: f64 = 0.8;
/// A piece in a plot frame is at least this large, mm.
const PIECE: f64 = 30.0;
/// Most rectangles that are looked at.
const RECTANGLES: usize = 16;

/// The meaning of a closed line.
#[derive(Clone, Copy, PartialEq)]
enum Meaning {
    Frame,
    Piece,
    /// Nothing says which of them.
    Either,
}

/// A closed line with its polygon and its box.
pub(super) struct Line<'a> {
    pub path: &'a Path,
    pub points: Vec<Vec2>,
    low: Vec2,
    size: Vec2,
}

impl<'a> Line<'a> {
    pub fn new(path: &'a Path) -> Self {
        let points = path.positions();
        let (low, high) = geom::bounds(points.iter().copied()).unwrap_or_default();
        Self { path, points, low, size: high - low }
    }

    fn is_large(&self) -> bool {
        self.size.x.min(self.size.y) >= PIECE
    }

    pub fn is_upright_rectangle(&self) -> bool {
        let high = self.low + self.size;
        let on_edge = |p: &Vec2| {
            let (a, b) = (p - self.low, high - p);
            a.x.abs().min(a.y.abs()).min(b.x.abs()).min(b.y.abs()) <= TOUCH
        };
        self.points.iter().all(on_edge) && geom::area(&self.points).abs() >= 0.999 * self.size.x * self.size.y
    }

    pub fn holds(&self, other: &Line<'_>) -> bool {
        other.points.iter().all(|p| geom::inside(*p, &self.points))
    }

    /// Do the boxes of two lines touch or overlap?
    pub fn touches(&self, other: &Line<'_>) -> bool {
        let apart = |k: usize| {
            let (a, b) = (self.low[k] + self.size[k], other.low[k] + other.size[k]);
            self.low[k] > b + TOUCH || other.low[k] > a + TOUCH
        };
        !apart(0) && !apart(1)
    }

    fn area(&self) -> f64 {
        geom::area(&self.points).abs()
    }

    /// Share of this line that others cover.
    fn share(&self, others: &[&Line<'_>]) -> f64 {
        others.iter().map(|o| o.area()).sum::<f64>() / self.area().max(1e-9)
    }
}

/// The large lines among these, sorted by area, that lie in none of the others.
fn outermost<'a, 'b>(lines: impl Iterator<Item = &'b Line<'a>>) -> Vec<&'b Line<'a>> {
    let mut top: Vec<&Line<'_>> = Vec::new();
    for line in lines.filter(|l| l.is_large()) {
        if !top.iter().any(|t| line.points.first().is_some_and(|p| geom::inside(*p, &t.points))) {
            top.push(line);
        }
    }
    top
}

/// Tells the meaning of a line among all lines of the drawing, sorted by area. A frame of a frame is one. Lines outside
/// do not matter, unless there are more of them than inside: then it may be a piece beside other pieces.
fn meaning(at: usize, lines: &[Line<'_>]) -> Meaning {
    let Some(line) = lines.get(at).filter(|l| l.is_upright_rectangle()) else { return Meaning::Piece };
    let (within, outside): (Vec<usize>, Vec<usize>) =
        (0..lines.len()).filter(|i| *i != at).partition(|i| *i > at && line.holds(&lines[*i]));
    let top = outermost(within.iter().map(|i| &lines[*i]));
    if top.is_empty() {
        return Meaning::Piece;
    }
    let beside = outermost(outside.iter().map(|i| &lines[*i]).filter(|other| !other.holds(line)));
    let is_full = top.len() >= 2 && line.share(&top) >= FULL;
    let inner = within.iter().copied().find(|i| lines[*i].is_large());
    let inner = inner.filter(|_| top.len() == 1 && line.share(&top) >= NEAR);
    if inner.is_some_and(|i| meaning(i, lines) == Meaning::Frame) || is_full && top.len() > beside.len() {
        Meaning::Frame
    } else if is_full || beside.is_empty() && !has_sew_line(line, &top) {
        Meaning::Either
    } else {
        Meaning::Piece
    }
}

/// Is one of these lines the rectangle moved inwards by an allowance?
fn has_sew_line(line: &Line<'_>, inner: &[&Line<'_>]) -> bool {
    inner.iter().any(|i| is_moved_inwards(&line.points, i.path))
}

/// Takes plot frames out of the closed lines, which are sorted by area. Frames and doubtful rectangles are told.
pub(super) fn leave_out(loops: &mut Vec<Path>, sorter: &mut Sorter<'_>) {
    let lines: Vec<Line<'_>> = loops.iter().map(Line::new).collect();
    let rectangles = (0..lines.len()).filter(|i| lines[*i].is_large() && lines[*i].is_upright_rectangle());
    let mut is_frame = vec![false; lines.len()];
    for at in rectangles.take(RECTANGLES) {
        if (0..at).any(|i| !is_frame[i] && lines[i].holds(&lines[at])) {
            continue;
        }
        match meaning(at, &lines) {
            Meaning::Frame => {
                is_frame[at] = true;
                say_frame(&lines[at], sorter);
            }
            Meaning::Either => say_doubt(&lines[at], sorter),
            Meaning::Piece => {}
        }
    }
    let mut frames = is_frame.into_iter();
    loops.retain(|_| !frames.next().unwrap_or(false));
}

fn say_frame(frame: &Line<'_>, sorter: &mut Sorter<'_>) {
    for id in &frame.path.ids {
        sorter.ledger.overrule(*id, Verdict::Refused, "plot frame round the pieces");
    }
    let text = format!(
        "a rectangle of {:.0} × {:.0} mm round pieces was taken for a plot frame and left out",
        frame.size.x, frame.size.y
    );
    let hint = "if it is a piece with cutouts, export every piece as a block of its own";
    let place = sorter.findings.place(frame.path.line);
    sorter.findings.push(Diagnostic::warning(codes::PLOT_FRAME_LEFT_OUT, text).at(place).hint(hint));
}

fn say_doubt(line: &Line<'_>, sorter: &mut Sorter<'_>) {
    let text = format!(
        "a rectangle of {:.0} × {:.0} mm at ({:.0}, {:.0}) mm has other closed lines in it; it may be a plot frame, but \
         was read as a piece, and what lies in it as lines of this piece",
        line.size.x, line.size.y, line.low.x, line.low.y
    );
    let hint = "if it is a frame, delete it from the file, or put it on a layer of its own and leave that out, as \
                layers = { \"FRAME\" = \"ignore\" }; if it is a piece, export every piece as a block of its own";
    let place = sorter.findings.place(line.path.line);
    sorter.findings.push(Diagnostic::warning(codes::PLOT_FRAME_UNDECIDED, text).at(place).hint(hint));
}
