//! Title blocks of flat drawings: upright rectangles round texts of the sheet, alone or as the cells of a table.

use super::codes;
use super::flat::TOUCH;
use super::frames::Line;
use crate::dxf::chain::{Chained, Path};
use crate::dxf::geom;
use crate::dxf::ledger::Verdict;
use crate::dxf::sheet::{Note, Sheet, Sorter};
use crate::dxf::texts;
use toile_garment::{Diagnostic, Vec2};

/// Most rectangles that are looked at.
const RECTANGLES: usize = 200;

/// The parts of a title block.
#[derive(Default)]
struct Block {
    /// Numbers of its rectangles among the closed lines.
    cells: Vec<usize>,
    /// Texts in it.
    texts: Vec<String>,
    /// Those of them that speak of the sheet.
    titles: usize,
    /// Lines across it, and rectangles in it.
    dividers: usize,
    /// Does anything in it belong to a piece?
    is_piece: bool,
}

impl Block {
    /// Texts that speak of the sheet, two of them or one in a table, and nothing of a piece.
    fn is_title(&self) -> bool {
        let is_table = self.cells.len() > 1 || self.dividers > 0;
        !self.is_piece && (self.titles >= 2 || self.titles == 1 && is_table)
    }

    fn is_doubtful(&self) -> bool {
        !self.is_piece && self.texts.len() >= 2
    }
}

/// Takes title blocks out of the closed lines, with all that lies in them. They, and rectangles that may be some, are told.
pub(super) fn leave_out(chained: &mut Chained, all: &Sheet, sorter: &mut Sorter<'_>) {
    let lines: Vec<Line<'_>> = chained.closed.iter().map(Line::new).collect();
    let blocks: Vec<Block> = groups(&lines).into_iter().map(|cells| look(cells, &lines, &chained.open, all)).collect();
    let titles: Vec<&Block> = blocks.iter().filter(|b| b.is_title()).collect();
    let cells: Vec<&Line<'_>> = titles.iter().flat_map(|b| &b.cells).map(|i| &lines[*i]).collect();
    let in_title = |p: &Path| {
        let middle = p.points[p.points.len() / 2].0;
        cells.iter().any(|cell| is_in(cell, middle) && is_in(cell, p.points[0].0))
    };
    // A drawing is no title block alone.
    if chained.closed.iter().all(in_title) {
        return;
    }
    for block in blocks.iter().filter(|b| !b.is_title() && b.is_doubtful()) {
        say_doubt(block, &lines, sorter);
    }
    for block in &titles {
        say_title(block, &lines, sorter);
    }
    let keep = |list: &[Path]| list.iter().map(|p| !in_title(p)).collect::<Vec<bool>>();
    let kept = [keep(&chained.closed), keep(&chained.open)];
    for (list, kept) in [&mut chained.closed, &mut chained.open].into_iter().zip(kept) {
        for path in list.iter().zip(&kept).filter(|(_, kept)| !**kept).map(|(p, _)| p) {
            path.ids.iter().for_each(|id| sorter.ledger.overrule(*id, Verdict::Refused, "title block"));
        }
        let mut kept = kept.into_iter();
        list.retain(|_| kept.next().unwrap_or(true));
    }
}

fn is_in(cell: &Line<'_>, p: Vec2) -> bool {
    geom::inside(p, &cell.points) || geom::distance(p, &cell.points, true) <= TOUCH
}

/// Upright rectangles that lie in no other line; those that touch each other together.
fn groups(lines: &[Line<'_>]) -> Vec<Vec<usize>> {
    let is_outer = |i: &usize| !(0..*i).any(|k| lines[k].holds(&lines[*i]));
    let rectangles = (0..lines.len()).filter(|i| lines[*i].is_upright_rectangle()).take(RECTANGLES);
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for at in rectangles.filter(is_outer) {
        let (touching, mut others): (Vec<_>, Vec<_>) =
            groups.into_iter().partition(|group: &Vec<usize>| group.iter().any(|i| lines[*i].touches(&lines[at])));
        others.push(touching.into_iter().flatten().chain([at]).collect());
        groups = others;
    }
    groups
}

/// All that lies in a group of rectangles.
fn look(cells: Vec<usize>, lines: &[Line<'_>], open: &[Path], all: &Sheet) -> Block {
    let holds = |p: Vec2| cells.iter().any(|i| is_in(&lines[*i], p));
    let mut block = Block::default();
    for note in all.notes.iter().filter(|n| holds(n.at) && !n.text.trim().is_empty()) {
        block.is_piece |= speaks_of_a_piece(note);
        block.titles += usize::from(speaks_of_the_sheet(&note.text));
        block.texts.push(note.text.clone());
    }
    let first = |p: &Path| p.points.first().is_some_and(|p| holds(p.0));
    let strokes = [&all.axes.reference, &all.axes.mirror, &all.axes.grain, &all.notch_strokes];
    block.is_piece |= strokes.into_iter().flatten().any(|s| holds(s.ends[0]))
        || all.marks.iter().any(|m| holds(m.at))
        || all.drills.iter().any(|d| holds(d.at))
        || all.sew.iter().chain(&all.cutouts).any(first);
    let within = |i: &usize| cells.iter().any(|c| c != i && lines[*c].holds(&lines[*i]));
    let has_text = |i: &usize| all.notes.iter().any(|n| is_in(&lines[*i], n.at));
    let inner = (0..lines.len()).filter(|i| lines[*i].is_upright_rectangle()).take(RECTANGLES);
    let inner = inner.filter(within).filter(has_text).count();
    let across = |p: &&Path| {
        let (from, to) = (p.points[0].0, p.points[p.points.len() - 1].0);
        let is_straight = p.points.len() == 2 && ((from.x - to.x).abs() <= TOUCH || (from.y - to.y).abs() <= TOUCH);
        let on_edge = |p: Vec2| cells.iter().any(|i| geom::distance(p, &lines[*i].points, true) <= TOUCH);
        is_straight && holds(from) && holds(to) && (on_edge(from) || on_edge(to))
    };
    block.dividers = inner + open.iter().filter(across).count();
    Block { cells, ..block }
}

/// Does a text name a piece, its size or its quantity?
fn speaks_of_a_piece(note: &Note) -> bool {
    let key = texts::key_value(&note.text).map(|(key, _)| key);
    let key = key.or_else(|| texts::without_colon(&note.text).map(|(key, _)| key.to_owned()));
    let is_of_piece = |key: &str| {
        matches!(
            key,
            "piece name" | "size" | "size name" | "quantity" | "material" | "fabric" | "category" | "annotation"
        )
    };
    key.is_some_and(|key| is_of_piece(texts::own_key(&key)))
}

/// Does a text begin with a word that stands in title blocks? Texts of the style in the words of the standards may stand
/// anywhere.
fn speaks_of_the_sheet(text: &str) -> bool {
    if texts::key_value(text).is_some_and(|(key, _)| texts::is_known(&key)) {
        return false;
    }
    const WORDS: [&str; 34] = [
        "style", "model", "modell", "date", "datum", "scale", "sheet", "page", "blatt", "drawn", "drawing", "author",
        "designer", "company", "firma", "client", "customer", "kunde", "season", "project", "title", "version",
        "revision", "rev", "units", "unit", "sample", "checked", "approved", "款号", "款式", "日期", "比例", "设计",
    ];
    let lower = text.trim().to_lowercase();
    let word: &str = lower.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
    WORDS.iter().any(|w| *w == word || !w.is_ascii() && lower.starts_with(w))
}

/// Low corner and size of some lines together.
fn extent(block: &Block, lines: &[Line<'_>]) -> (Vec2, Vec2) {
    let points = block.cells.iter().flat_map(|i| lines[*i].points.iter().copied());
    let (low, high) = geom::bounds(points).unwrap_or_default();
    (low, high - low)
}

fn say_title(block: &Block, lines: &[Line<'_>], sorter: &mut Sorter<'_>) {
    let (_, size) = extent(block, lines);
    let text = format!(
        "a rectangle of {:.0} × {:.0} mm round {} text(s), as `{}`, was taken for a title block and left out",
        size.x,
        size.y,
        block.texts.len(),
        block.texts.first().map_or("", |t| t.trim())
    );
    let hint = "if it is a piece, export every piece as a block of its own";
    let place = sorter.findings.place(lines[block.cells[0]].path.line);
    sorter.findings.push(Diagnostic::warning(codes::PLOT_FRAME_LEFT_OUT, text).at(place).hint(hint));
}

fn say_doubt(block: &Block, lines: &[Line<'_>], sorter: &mut Sorter<'_>) {
    let (low, size) = extent(block, lines);
    let text = format!(
        "a rectangle of {:.0} × {:.0} mm at ({:.0}, {:.0}) mm holds {} texts, as `{}`; it may be a title block, but was \
         read as a piece",
        size.x,
        size.y,
        low.x,
        low.y,
        block.texts.len(),
        block.texts.first().map_or("", |t| t.trim())
    );
    let hint = "if it is one, delete it from the file, or put it on a layer of its own and leave that out, as \
                layers = { \"TITLE\" = \"ignore\" }";
    let place = sorter.findings.place(lines[block.cells[0]].path.line);
    sorter.findings.push(Diagnostic::warning(codes::PLOT_FRAME_UNDECIDED, text).at(place).hint(hint));
}
