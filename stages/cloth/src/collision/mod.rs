//! Collision detection: which primitives are near, and how far they may move. The only user of parry3d.

pub(crate) mod body;
pub(crate) mod body_candidates;
pub(crate) mod body_motion;
pub(crate) mod broad_phase;
pub(crate) mod crossings;
pub(crate) mod culling;
pub(crate) mod moving_body;
pub(crate) mod narrow_phase;
pub(crate) mod plane_contact;
#[cfg(feature = "self-contact")]
pub(crate) mod self_candidates;
#[cfg(not(feature = "self-contact"))]
#[path = "self_candidates_absent.rs"]
pub(crate) mod self_candidates;
pub(crate) mod tuning;
