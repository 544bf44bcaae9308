//! Sparse symmetric systems of 3 × 3 blocks, one per pair of neighbouring vertices, and their Cholesky factors.

mod dense;
mod dissect;
mod eliminate;
pub(crate) mod factor;
mod halves;
pub(crate) mod hessian;
mod pages;
mod substitute;
mod sweep;
mod symbolic;
