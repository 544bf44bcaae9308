//! The cases, one file per family.

mod bias;
mod bracket;
mod buckling;
mod cantilever;
mod catenary;
mod cones;
mod frame;
mod friction;
mod hanging;
mod kes;
pub mod not_yet;
mod off_axis;
mod sewn;
mod sleeve;
mod surface;

use crate::case::Case;

/// All cases, in the order of the table.
pub fn all() -> Vec<Case> {
    let mut list = Vec::new();
    list.extend(kes::cases());
    list.extend(hanging::cases());
    list.extend(catenary::cases());
    list.extend(off_axis::cases());
    list.extend(frame::cases());
    list.extend(bias::cases());
    list.extend(cantilever::cases());
    list.extend(friction::cases());
    list.extend(sleeve::cases());
    list.extend(cones::cases());
    list.extend(sewn::cases());
    list.extend(buckling::cases());
    list
}
