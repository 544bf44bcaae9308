//! Sparse symmetric systems of 3 × 3 blocks, one per pair of neighbouring vertices, and their Cholesky factors.

mod dense;
mod dissect;
pub(crate) mod factor;
pub(crate) mod hessian;
mod sweep;
mod symbolic;
