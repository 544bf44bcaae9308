//! Culling: cloth that surely does not meet itself, and features of a body that nothing can touch.

pub(crate) mod convex_features;
pub(crate) mod coplanar_faces;
#[cfg(feature = "self-contact")]
pub(crate) mod normal_cone;
