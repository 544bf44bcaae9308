//! Rest without time: the minimum of one energy, by quasi-Newton descents that a lagged Cholesky factor preconditions.
//!
//! [`driver`] holds the one loop, [`descent`] its state, [`mechanisms`] the rules that act in it.

pub(crate) mod assembled_hessian;
pub(crate) mod block;
pub(crate) mod decrement_bound;
pub(crate) mod descent;
pub(crate) mod drape;
pub(crate) mod driver;
pub(crate) mod factorization;
pub(crate) mod lbfgs;
pub(crate) mod line_search;
pub(crate) mod mechanism;
pub(crate) mod mechanisms;
pub(crate) mod objective;
pub(crate) mod preconditioner;
pub(crate) mod regularization;
pub(crate) mod report;
pub(crate) mod speculation;
pub(crate) mod strain_limit_phase;
pub(crate) mod task;
#[cfg(test)]
pub(crate) mod test_sheets;
pub(crate) mod tuning;

pub(crate) use drape::drape;
pub(crate) use report::effects;
