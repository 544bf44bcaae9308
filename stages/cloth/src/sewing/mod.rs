//! Sewing by the equilibrium solver: initial guess, stitch penalty with force continuation, and settling.

pub(crate) mod closing;
pub(crate) mod in_order;
pub(crate) mod initial_guess;
pub(crate) mod joining;
pub(crate) mod multilevel;
pub(crate) mod tuning;

pub(crate) use in_order::sew_in_order;
pub(crate) use multilevel::sew;
