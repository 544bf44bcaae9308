//! The mechanisms of descents: one file for each rule, or for each group of small rules of one kind.

pub(crate) mod contact_refresh;
pub(crate) mod factor_reuse;
pub(crate) mod gap_update;
pub(crate) mod negative_curvature;
pub(crate) mod pinned_targets;
pub(crate) mod regularization_schedule;
pub(crate) mod rest;
pub(crate) mod speculative_steps;
pub(crate) mod strain_limit_homotopy;
pub(crate) mod surrogate_hessian;
