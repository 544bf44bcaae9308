//! Rest without time: the least of one energy (docs/static.md), by descents whose metric is a lagged Cholesky factor.

pub(crate) mod decrement_bound;
pub(crate) mod descent;
pub(crate) mod drape;
pub(crate) mod hessian_choice;
pub(crate) mod lbfgs;
pub(crate) mod line_search;
pub(crate) mod negative_curvature;
pub(crate) mod objective;
pub(crate) mod pinned_targets;
pub(crate) mod preconditioner;
pub(crate) mod report;
pub(crate) mod speculative_steps;
pub(crate) mod strain_limit_homotopy;
#[cfg(test)]
pub(crate) mod test_sheets;
pub(crate) mod tuning;

pub(crate) use drape::drape;
pub(crate) use report::effects;
