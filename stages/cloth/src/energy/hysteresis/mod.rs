//! Friction between the yarns of bent cloth: a moment HB per width against every change of curvature
//! (docs/hysteresis.md).
//!
//! It acts along warp and weft, beside the elastic moment of `bending.rs`. A spring holds the curvature of a triangle
//! until its moment reaches HB, and then slides along (return mapping), as for the friction of contacts.

#[cfg(feature = "bending-hysteresis")]
pub(crate) mod held;
#[cfg(not(feature = "bending-hysteresis"))]
#[path = "held_absent.rs"]
pub(crate) mod held;
