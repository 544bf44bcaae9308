//! ATTRIBs behind an INSERT in ENTITIES: what they say is said of the piece that is inserted.

use super::inserts::Turns;
use crate::dxf::ledger::{Ledger, Verdict};
use crate::dxf::model::{Block, Drawing, Entity, Shape};
use std::collections::BTreeMap;

/// Gives the attributes of the first INSERT of every block to the block. The value of an INSERT goes before the one
/// that the block itself has under this name. Attributes that say nothing new are noted, all others stay where they
/// are.
pub(super) fn give(
    drawing: &mut Drawing,
    blocks: &mut [Block],
    by_name: &BTreeMap<String, Vec<usize>>,
    ledger: &mut Ledger,
) {
    let mut turns = Turns::default();
    let mut given: BTreeMap<usize, BTreeMap<String, String>> = BTreeMap::new();
    let mut owner: Option<(usize, bool)> = None;
    let mut left = Vec::with_capacity(drawing.entities.len());
    for entity in std::mem::take(&mut drawing.entities) {
        match &entity.shape {
            Shape::Insert { block, .. } => {
                owner = by_name.get(block).map(|named| turns.next(block, named));
            }
            Shape::Attribute { tag, value, .. } if !value.is_empty() => {
                if let Some((index, first)) = owner {
                    let told = given.entry(index).or_default();
                    if told.get(tag) == Some(value) {
                        ledger.note(entity.id, Verdict::Interpreted, "attribute of an INSERT that says nothing new");
                        continue;
                    }
                    if first {
                        told.insert(tag.clone(), value.clone());
                        put(&mut blocks[index], entity, ledger);
                        continue;
                    }
                }
            }
            Shape::Attribute { .. } => {}
            _ => owner = None,
        }
        left.push(entity);
    }
    drawing.entities = left;
}

/// Into the block, or in place of the value that it has under the same name.
fn put(block: &mut Block, attribute: Entity, ledger: &mut Ledger) {
    let Shape::Attribute { tag: wanted, value: new, .. } = &attribute.shape else { return };
    let named = block.entities.iter_mut().find_map(|e| match &mut e.shape {
        Shape::Attribute { tag, value, .. } if tag == wanted => Some(value),
        _ => None,
    });
    match named {
        Some(value) => {
            value.clone_from(new);
            ledger.note(attribute.id, Verdict::Interpreted, "attribute of an INSERT: goes before that of its block");
        }
        None => block.entities.push(attribute),
    }
}
