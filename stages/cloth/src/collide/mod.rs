//! Contact: which parts are near, how far they may move, what pushes them apart. The only user of parry3d.

pub(crate) mod advance;
pub(crate) mod step_bound;
pub(crate) mod against;
pub(crate) mod barrier;
mod beside;
pub(crate) mod body;
#[cfg(feature = "self-contact")]
pub(crate) mod calm;
pub(crate) mod clear;
pub(crate) mod closest;
pub(crate) mod contact;
#[cfg(feature = "self-contact")]
mod drift;
mod far;
mod flat;
pub(crate) mod frame;
pub(crate) mod friction;
pub(crate) mod listed;
mod lists;
pub(crate) mod near;
pub(crate) mod pair_kind;
#[cfg(feature = "self-contact")]
pub(crate) mod own;
#[cfg(not(feature = "self-contact"))]
#[path = "own_absent.rs"]
pub(crate) mod own;
pub(crate) mod repair;
#[cfg(feature = "self-contact")]
mod search;
pub(crate) mod sheet;
mod sides;
pub(crate) mod stick;
mod tiles;
pub(crate) mod travel;
pub(crate) mod tree;
pub(crate) mod untangle;
