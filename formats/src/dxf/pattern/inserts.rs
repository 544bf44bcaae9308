//! The INSERTs of ENTITIES.

use super::is_model_space;
use crate::dxf::findings::Findings;
use crate::dxf::ledger::{Ledger, Verdict};
use crate::dxf::model::{Block, Drawing, Shape};
use std::collections::BTreeMap;
use toile_garment::Diagnostic;

/// Looks at the INSERTs of ENTITIES; tells for each block whether it is inserted mirrored.
pub(super) fn inserts(
    drawing: &Drawing,
    blocks: &[Block],
    by_name: &BTreeMap<String, Vec<usize>>,
    findings: &mut Findings,
    ledger: &mut Ledger,
) -> Vec<bool> {
    let mut mirrored = vec![false; blocks.len()];
    let mut used: BTreeMap<&str, usize> = BTreeMap::new();
    for entity in &drawing.entities {
        let Shape::Insert { block, scale, rotation, .. } = &entity.shape else { continue };
        let place = findings.place_in(block, Some(&entity.layer), entity.line);
        let Some(named) = by_name.get(block) else {
            let text = format!("an INSERT names block `{block}`, which is not in the file");
            findings.push(Diagnostic::warning("block-missing", text).at(place));
            ledger.note(entity.id, Verdict::Refused, "INSERT of a block that is missing");
            continue;
        };
        let turn = used.entry(block.as_str()).or_insert(0);
        let index = named[(*turn).min(named.len() - 1)];
        *turn += 1;
        let sizes = [scale[0].abs(), scale[1].abs()];
        if sizes.iter().any(|s| (s - 1.0).abs() > 1e-6) || libm::fmod(rotation.abs(), 360.0) > 1e-6 {
            let text = format!(
                "block `{block}` is inserted with scale {} × {} and turned by {rotation}°; the piece was read as drawn in its block",
                scale[0], scale[1]
            );
            findings.push(Diagnostic::warning("insert-transformed", text).at(place.clone()));
        }
        if scale[0] * scale[1] < 0.0 {
            mirrored[index] = true;
            let text = format!("block `{block}` is inserted mirrored; the piece was mirrored");
            findings.push(Diagnostic::warning("insert-mirrored", text).at(place));
            ledger.note(entity.id, Verdict::Interpreted, "mirrored INSERT: the piece is mirrored");
        } else {
            ledger.note(entity.id, Verdict::Accepted, "INSERT of a piece");
        }
    }
    for (name, list) in by_name {
        if list.len() > 1 && !is_model_space(name) {
            let text = format!("{} blocks are called `{name}`; all were read", list.len());
            let place = findings.place_in(name, None, blocks[list[1]].line);
            findings.push(Diagnostic::warning("block-name-repeats", text).at(place));
        }
    }
    mirrored
}
