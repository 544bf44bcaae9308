//! Friction between the yarns of bent cloth (docs/hysteresis.md): a moment HB per width against every change of curvature
//! along warp and weft, beside the elastic one of flexion.rs. A spring holds the curvature of a triangle where it is until
//! its moment reaches HB, then slides along; what slid is taken over, as for the friction of contacts.

#[cfg(feature = "bending-hysteresis")]
pub(crate) mod held;
#[cfg(not(feature = "bending-hysteresis"))]
#[path = "held_absent.rs"]
pub(crate) mod held;

use crate::{Scene, Settings, Switch};

/// Coercive curvature HB/B times bending length from which the drape coefficient of a cloth changes by a point.
pub const FELT: f64 = 0.05;
/// The rule by which it is simulated, in words.
pub const RULE: &str = "HB/B times bending length is 0.05 or more";

/// Is it simulated?
pub(crate) fn called_for(scene: &Scene, s: &Settings) -> bool {
    match s.effects.bending_hysteresis {
        Switch::Off => false,
        Switch::On => true,
        Switch::Auto => scene.materials.iter().any(|m| m.bend_friction_share() >= FELT),
    }
}
