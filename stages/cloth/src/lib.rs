//! The cloth solver on plain arrays: energies, integrators, contact, effects.
//!
//! It knows no garment and no file. A [`Scene`] of positions, rest triangles, stitches, pins and a body goes in. An
//! [`Outcome`] with new positions comes out. [`sew`] closes the stitches, and [`weld()`] makes sewn vertices one.
//! [`drape`] settles the cloth, and [`animate()`] moves it in time. [`certify`] checks a result afresh.
//!
//! SI units throughout (m, kg, s, N); tension, stretch and shear stiffness per metre of width (N/m), bending in N·m.

// What only a left out effect asks stays where it is.
#![cfg_attr(
    not(all(feature = "self-contact", feature = "bending-hysteresis", feature = "pressure")),
    allow(dead_code, unused_imports)
)]

pub mod certificate;
mod collision;
mod contact;
mod dynamics;
mod effects;
mod energy;
pub mod error;
pub mod experiment;
mod explicit;
mod hierarchy;
#[doc(hidden)]
pub mod kernels;
mod linear;
mod optimize;
mod prepare;
mod report;
pub mod scene;
mod sewing;
mod solve;
mod tuning;

pub use certificate::{Figures, Tightest, certify};
pub use dynamics::{Dynamics, Frame, Motion, Trip};
pub use effects::{EFFECTS, Effect, Facts};
pub use energy::elastic_band::band_state;
pub use energy::fold_line::fold_angles;
pub use error::{ClothError, Place, SceneFault};
pub use hierarchy::perturb::shaken;
pub use prepare::initial_feasibility::free_pieces::{PieceMove, free_pieces};
pub use report::outcome::{EffectReport, Outcome, Reaction, StopReason};
pub use report::watch::{Silent, Watch};
pub use scene::bending::Bending;
pub use scene::contact_filter::ContactFilter;
pub use scene::curve::Curve;
pub use scene::elements::{Element, Elements};
pub use scene::lines::{Band, FoldLine};
pub use scene::settings::{
    ContactPenalty, Effects, ElongationCorrection, Equilibrium, ExplicitSteps, Integrator, Model, Settings, Stitches,
    Switch,
};
pub use scene::shared_body::{BodyMesh, SharedBody};
pub use scene::weld::{Welded, weld};
pub use scene::{Load, Material, Pin, Scene};
pub use sewing::joining::joinable_stitches;
pub use solve::{animate, drape, setting_faults, sew, sew_in_order};

/// A point or vector in the world, metres.
pub type Vec3 = nalgebra::Vector3<f64>;

/// Values at three places; written out because mapping an array is not always inlined in the hot loops.
#[inline]
pub(crate) fn pick3(x: &[Vec3], i: &[u32; 3]) -> [Vec3; 3] {
    [x[i[0] as usize], x[i[1] as usize], x[i[2] as usize]]
}

/// Unit normal of a triangle; `None` where it has no area.
#[inline]
pub(crate) fn unit_normal([a, b, c]: [Vec3; 3]) -> Option<Vec3> {
    (b - a).cross(&(c - a)).try_normalize(0.0)
}

/// Values at four places.
#[inline]
pub(crate) fn pick4(x: &[Vec3], i: &[u32; 4]) -> [Vec3; 4] {
    [x[i[0] as usize], x[i[1] as usize], x[i[2] as usize], x[i[3] as usize]]
}

/// Length of the longest vector; 0 for none.
pub(crate) fn longest(v: &[Vec3]) -> f64 {
    v.iter().map(|d| d.norm_squared()).fold(0.0, f64::max).sqrt()
}

/// Longest way from one place to its other.
pub(crate) fn farthest(from: &[Vec3], to: &[Vec3]) -> f64 {
    from.iter().zip(to).map(|(p, q)| (p - q).norm_squared()).fold(0.0, f64::max).sqrt()
}

/// The power of two at or below a number; 1 where there is none.
pub(crate) fn power_of_two(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    let power = f64::from_bits(x.to_bits() & EXPONENT);
    if power > 0.0 && power.is_finite() { power } else { 1.0 }
}
