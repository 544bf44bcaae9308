//! Which blocks are pieces.

use super::codes;
use super::flat::flat;
use super::inserts::{InsertRule, Inserted};
use super::is_model_space;
use super::layer_names::LayerNames;
use crate::dxf::layers::Role;
use crate::dxf::ledger::Verdict;
use crate::dxf::model::{Block, Drawing, Entity, Shape};
use crate::dxf::sheet::{Sheet, Sorter};
use crate::dxf::texts;
use crate::dxf::tolerances::Tolerances;
use toile_garment::Diagnostic;

/// A piece that is not made yet.
pub(super) struct Draft {
    /// Name of its block.
    pub block: String,
    /// Line of its block.
    pub line: u64,
    /// Its drawing.
    pub sheet: Sheet,
    /// Errors among its entities.
    pub faults: Vec<Diagnostic>,
}

/// One draft for every piece. Errors of the file that lie in the block of a piece become its own.
pub(super) fn sheets(
    drawing: &Drawing,
    blocks: &[Block],
    sorter: &mut Sorter<'_>,
    inserted: &[Inserted],
    rule: InsertRule,
    tolerances: &Tolerances,
) -> Vec<Draft> {
    let mut out = Vec::new();
    for (i, block) in blocks.iter().enumerate() {
        if is_model_space(&block.name) {
            for e in &block.entities {
                sorter.ledger.note(e.id, Verdict::Refused, "in the block of a drawing space");
            }
            continue;
        }
        let how = &inserted[i];
        if how.part || how.assembly {
            // What is on it is read where it is inserted; an assembly holds nothing but INSERTs of pieces.
            continue;
        }
        out.extend(draft(i, block, how, sorter, rule));
    }
    for e in &drawing.entities {
        match &e.shape {
            Shape::Text { value, .. } if texts::key_value(value).is_some() => {
                sorter.ledger.note(e.id, Verdict::Accepted, "style text");
            }
            Shape::Text { .. } if !out.is_empty() => {
                sorter.ledger.note(e.id, Verdict::Interpreted, "text outside the pieces, kept aside")
            }
            _ => {}
        }
    }
    if out.is_empty() {
        return flat(drawing, sorter, tolerances);
    }
    loose_lines(drawing, sorter);
    loose_marks(drawing, sorter);
    let texts = drawing.entities.iter().filter_map(|e| match &e.shape {
        Shape::Text { value, .. } => Some((value.as_str(), e.line)),
        _ => None,
    });
    say_texts(texts, sorter);
    out
}

/// Says which texts beside the pieces have no key, so that nothing is made of them.
pub(super) fn say_texts<'t>(texts: impl Iterator<Item = (&'t str, u64)>, sorter: &mut Sorter<'_>) {
    let is_plain = |text: &str| !text.trim().is_empty() && text.lines().all(|line| texts::key_value(line).is_none());
    let is_read = |text: &str| texts::without_colon(text).is_some();
    let plain: Vec<(&str, u64)> = texts.filter(|(text, _)| is_plain(text) && !is_read(text)).collect();
    let Some((first, line)) = plain.first() else { return };
    let text = format!(
        "{} text(s) lie in no piece and have no key, as `{}`; they were left out",
        plain.len(),
        first.lines().next().unwrap_or_default().trim()
    );
    let place = sorter.findings.place(*line);
    sorter.findings.push(Diagnostic::info(codes::ENTITIES_LEFT_OUT, text).at(place));
}

/// The draft of a block. A block with entities and no outline is told, and is no piece.
fn draft(i: usize, block: &Block, how: &Inserted, sorter: &mut Sorter<'_>, rule: InsertRule) -> Option<Draft> {
    let mut sheet = sorter.block(i, &how.placings(block, rule));
    sheet.inserted = (how.plain + how.mirrored > 1).then_some([how.plain, how.mirrored]);
    let within = |f: &Diagnostic| f.source.as_ref().and_then(|s| s.line).is_some_and(|l| block.holds(l));
    let faults = sorter.findings.take_errors(within);
    if !sheet.boundary.is_empty() || !faults.is_empty() {
        return Some(Draft { block: block.name.clone(), line: block.line, sheet, faults });
    }
    if !block.entities.is_empty() {
        let text = format!("block `{}` has no outline on layer 1; it is no piece", block.name);
        let place = sorter.findings.place_in(&block.name, None, block.line);
        let hint = LayerNames::of(block.entities.iter()).remedy();
        sorter.findings.push(Diagnostic::warning(codes::BLOCK_WITHOUT_OUTLINE, text).at(place).hint(hint));
    }
    None
}

/// Lines of ENTITIES belong to no piece.
fn loose_lines(drawing: &Drawing, sorter: &mut Sorter<'_>) {
    let loose = drawing.entities.iter().filter(|e| !e.shape.extent().is_empty());
    let mut count = 0_usize;
    for e in loose {
        count += 1;
        sorter.ledger.note(e.id, Verdict::Refused, "line outside any block");
    }
    if count > 0 {
        let text = format!("{count} line(s) stand in ENTITIES outside any block; they were left out");
        let place = sorter.findings.place(1);
        sorter.findings.push(Diagnostic::warning(codes::LINES_OUTSIDE_BLOCKS, text).at(place));
    }
}

/// Points and attributes of ENTITIES belong to no piece.
fn loose_marks(drawing: &Drawing, sorter: &mut Sorter<'_>) {
    for (code, what, wanted) in [
        (codes::LINES_OUTSIDE_BLOCKS, "point(s), as of notches and drill holes,", 0),
        (codes::ENTITIES_LEFT_OUT, "attribute(s) with a text", 1),
    ] {
        let is = |e: &&Entity| match &e.shape {
            Shape::Point { .. } => wanted == 0 && sorter.layers.role(&e.layer) != Role::Unknown,
            Shape::Attribute { value, .. } => wanted == 1 && !value.is_empty(),
            _ => false,
        };
        let found: Vec<&Entity> = drawing.entities.iter().filter(is).collect();
        let Some(first) = found.first() else { continue };
        for e in &found {
            sorter.ledger.note(e.id, Verdict::Refused, "point or attribute outside any block");
        }
        let text = format!("{} {what} stand in ENTITIES outside any block; they were left out", found.len());
        let place = sorter.findings.place(first.line);
        let hint = "put them into the block of their piece";
        sorter.findings.push(Diagnostic::warning(code, text).at(place).hint(hint));
    }
}
