//! Contact as an energy for the equilibrium solver: barrier, adaptive stiffness, gap update and lagged friction.

pub(crate) mod barrier;
pub(crate) mod lagged_friction;
pub(crate) mod list_validity;
pub(crate) mod parameters;
pub(crate) mod step_bound;
pub(crate) mod tuning;
