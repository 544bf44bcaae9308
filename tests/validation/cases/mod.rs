//! The cases, one file per family.

mod bias;
mod bracket;
mod buckling;
mod cantilever;
mod catenary;
mod cones;
mod damped;
mod fall;
mod frame;
mod friction;
mod hanging;
mod kes;
mod lattice;
mod leapfrog;
mod off_axis;
mod penalty;
mod pressure;
mod ring;
mod sewn;
mod sleeve;
mod slide;
mod surface;
mod swing;

use crate::case::Case;

/// All cases, in the order of the table.
pub fn all() -> Vec<Case> {
    let mut list = Vec::new();
    list.extend(kes::cases());
    list.extend(hanging::cases());
    list.extend(catenary::cases());
    list.extend(off_axis::cases());
    list.extend(frame::cases());
    list.extend(lattice::cases());
    list.extend(bias::cases());
    list.extend(cantilever::cases());
    list.extend(friction::cases());
    list.extend(pressure::cases());
    list.extend(sleeve::cases());
    list.extend(cones::cases());
    list.extend(sewn::cases());
    list.extend(buckling::cases());
    list.extend(swing::cases());
    list.extend(ring::cases());
    list.extend(damped::cases());
    list.extend(leapfrog::cases());
    list.extend(fall::cases());
    list.extend(penalty::cases());
    list.extend(slide::cases());
    list
}
