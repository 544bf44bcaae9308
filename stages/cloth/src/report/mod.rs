//! Progress, cost and outcome of a run.

pub(crate) mod cost;
pub mod outcome;
pub mod watch;
