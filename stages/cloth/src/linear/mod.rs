//! Sparse symmetric systems of 3 × 3 blocks, one per pair of neighbouring vertices, and their Cholesky factors.

pub(crate) mod dense;
pub(crate) mod eliminate;
pub(crate) mod factor;
pub(crate) mod fork_join;
pub(crate) mod hessian;
pub(crate) mod huge_pages;
pub(crate) mod nested_dissection;
pub(crate) mod pattern;
pub(crate) mod separator_halves;
pub(crate) mod substitute;
pub(crate) mod supernode;
pub(crate) mod symbolic;
pub(crate) mod system;
pub(crate) mod triangular_solve;
pub(crate) mod tuning;
