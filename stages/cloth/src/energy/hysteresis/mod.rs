//! Friction between the yarns of bent cloth (docs/hysteresis.md): a moment HB per width against every change of curvature
//! along warp and weft, beside the elastic one of flexion.rs. A spring holds the curvature of a triangle where it is until
//! its moment reaches HB, then slides along; what slid is taken over, as for the friction of contacts.

#[cfg(feature = "bending-hysteresis")]
pub(crate) mod held;
#[cfg(not(feature = "bending-hysteresis"))]
#[path = "held_absent.rs"]
pub(crate) mod held;
