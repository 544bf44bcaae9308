//! Which blocks are pieces; the closed lines of ENTITIES where no block is one.

use super::codes;
use super::inserts::{InsertRule, Inserted};
use super::is_model_space;
use crate::dxf::chain::{self, Path};
use crate::dxf::codes::PIECES_FROM_ENTITIES;
use crate::dxf::geom;
use crate::dxf::layers::{Layers, Role};
use crate::dxf::ledger::Verdict;
use crate::dxf::limits;
use crate::dxf::model::{Block, Drawing, Entity, Shape};
use crate::dxf::sheet::{Drill, Mark, Note, Sheet, Sorter, Stroke};
use crate::dxf::texts;
use crate::dxf::tolerances::Tolerances;
use std::collections::BTreeMap;
use toile_garment::{Diagnostic, Vec2};

/// One sheet for every piece: name, line, sheet.
pub(super) fn sheets(
    drawing: &Drawing,
    blocks: &[Block],
    sorter: &mut Sorter<'_>,
    inserted: &[Inserted],
    rule: InsertRule,
    tolerances: &Tolerances,
) -> Vec<(String, u64, Sheet)> {
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
        let mut sheet = sorter.block(i, &how.placings(block, rule));
        sheet.inserted = (how.plain + how.mirrored > 1).then_some([how.plain, how.mirrored]);
        if !sheet.boundary.is_empty() {
            out.push((block.name.clone(), block.line, sheet));
        } else if !block.entities.is_empty() {
            let text = format!("block `{}` has no outline on layer 1; it is no piece", block.name);
            let place = sorter.findings.place_in(&block.name, None, block.line);
            sorter.findings.push(Diagnostic::warning(codes::BLOCK_WITHOUT_OUTLINE, text).at(place));
        }
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
    loose_marks(drawing, sorter);
    out
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

/// No block is a piece: the outermost closed lines in ENTITIES are.
fn flat(drawing: &Drawing, sorter: &mut Sorter<'_>, tolerances: &Tolerances) -> Vec<(String, u64, Sheet)> {
    let on_one =
        drawing.entities.iter().any(|e| sorter.layers.role(&e.layer) == Role::Boundary && !e.shape.extent().is_empty());
    // On plain drawings every line may be an outline; with layer 1 in use only those on it.
    let as_boundary = Layers::new(&BTreeMap::new());
    let relabelled: Vec<Entity> = drawing
        .entities
        .iter()
        .filter(|e| !matches!(e.shape, Shape::Insert { .. }))
        .map(|e| {
            let mut e = e.clone();
            if !on_one && !e.shape.extent().is_empty() && as_boundary.role(&e.layer) == Role::Unknown {
                e.layer = "1".into();
            }
            e
        })
        .collect();
    let all = sorter.loose(relabelled.iter());
    let chained = chain::chain(all.boundary.clone(), tolerances.gap);
    let mut loops = chained.closed;
    let area = |p: &Path| geom::area(&p.positions()).abs();
    loops.sort_by(|a, b| area(b).total_cmp(&area(a)));
    let mut outer: Vec<(Vec<Vec2>, Sheet, u64)> = Vec::new();
    for path in loops.into_iter().take(limits::PIECES + 1).chain(chained.open) {
        let home = outer.iter().position(|(polygon, ..)| geom::inside(path.points[0].0, polygon));
        match home {
            Some(i) => outer[i].1.internal.push(path),
            None => {
                let line = path.line;
                let polygon = path.positions();
                let sheet = Sheet { boundary: vec![path], ..Sheet::default() };
                outer.push((polygon, sheet, line));
            }
        }
    }
    if outer.is_empty() {
        return Vec::new();
    }
    let place = sorter.findings.place(1);
    let text = format!("no block holds an outline; {} closed line(s) of ENTITIES were read as pieces", outer.len());
    sorter.findings.push(Diagnostic::warning(PIECES_FROM_ENTITIES, text).at(place));
    share_out(all, &mut outer);
    outer.sort_by_key(|o| o.2);
    outer.into_iter().enumerate().map(|(i, (_, sheet, line))| (format!("PIECE_{}", i + 1), line, sheet)).collect()
}

fn share_out(all: Sheet, outer: &mut [(Vec<Vec2>, Sheet, u64)]) {
    let home = |p: Vec2, outer: &[(Vec<Vec2>, Sheet, u64)]| {
        outer.iter().position(|(polygon, ..)| geom::inside(p, polygon) || geom::distance(p, polygon, true) <= 0.5)
    };
    macro_rules! share {
        ($($field:ident by $at:expr),+) => {$(
            for item in all.$field {
                let at: Vec2 = $at(&item);
                if let Some(i) = home(at, outer) {
                    outer[i].1.$field.push(item);
                }
            }
        )+};
    }
    let first = |p: &Path| p.points.first().map_or(Vec2::zeros(), |p| p.0);
    let start = |s: &Stroke| (s.ends[0] + s.ends[1]) * 0.5;
    share!(
        stripes by |s: &(String, Path)| first(&s.1), dense by first, sew by first, dense_sew by first, internal by first, cutouts by first,
        turn by |p: &Vec2| *p, curve by |p: &Vec2| *p, marks by |m: &Mark| m.at,
        notch_strokes by start, reference by start, mirror by start, grain by start, drills by |d: &Drill| d.at,
        notes by |n: &Note| n.at
    );
}
