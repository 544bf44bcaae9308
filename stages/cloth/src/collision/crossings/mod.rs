//! Exact counting of intersecting triangles (Shewchuk's adaptive predicates).

pub(crate) mod count;
pub(crate) mod pair;
