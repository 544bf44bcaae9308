//! The narrow phase: exact distances, candidate pairs and continuous detection.

pub(crate) mod candidates;
pub(crate) mod ccd;
pub(crate) mod distance;
pub(crate) mod pair_kind;
