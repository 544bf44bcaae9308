//! The paper's scheme whole: explicit central differences with its own contact, friction, sewing and strain limit.

pub(crate) mod central_difference;
pub(crate) mod contact;
pub(crate) mod friction;
pub(crate) mod motion;
pub(crate) mod problem;
pub(crate) mod report;
pub(crate) mod run;
pub(crate) mod sewing;
pub(crate) mod strain_limit;
