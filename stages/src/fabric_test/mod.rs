//! The laboratory's tests of a fabric, done on the solver: the numbers of a fabric file go in, the numbers that the
//! laboratory would read come out.
//!
//! - [`cusick`]: how much of its shadow a disc of cloth keeps when it hangs over a smaller disc (BS 5058, ISO 9073-9).
//! - [`cantilever`]: how far a strip can be pushed over an edge (BS 3356, ASTM D1388, FAST-2).
//! - [`bias`]: how a strip cut at 45° gives way (bias extension, FAST-3, EB5).
//! - [`frame`]: the force that shearing needs when the yarns keep their lengths (picture frame).
//!
//! Every test makes its own even mesh (`mesh.rs`), is held by a rig (`rig.rs`), and is read as the instrument reads it.
//! Pictures of the results: [`picture`]. Lengths are metres, angles radians, forces newtons.

pub mod bias;
pub mod cantilever;
pub(crate) mod codes;
pub mod cusick;
pub mod direction;
mod fall;
pub mod frame;
#[cfg(test)]
mod laboratory;
mod mesh;
mod nodes;
pub mod picture;
mod rig;
#[cfg(test)]
mod sectors;
mod shadow;
#[cfg(test)]
mod tests;

pub use bias::{Bias, BiasParams};
pub use cantilever::{Cantilever, CantileverParams};
pub use cusick::{Cusick, CusickParams};
pub use direction::Direction;
pub use frame::{Frame, FrameParams};

use crate::codes::SETTING_OUT_OF_RANGE;
use direction::bending_length;
use toile_garment::Diagnostic;
use toile_garment::fabric::Fabric;
use toile_garment::units::{Dimension, tidy};
use toile_stage_api::StageError;

/// Shortest bending length that is tested, m: as in fabric files.
const LIMPEST: f64 = 1e-3;
/// m/s², as in fabric files and in `drape`.
const GRAVITY: f64 = toile_cloth::scene::EARTH;

/// Refuses an option outside its range, both in the first unit of `D`.
fn within<D: Dimension>(name: &str, value: f64, range: std::ops::RangeInclusive<f64>) -> Result<(), StageError> {
    if range.contains(&value) {
        return Ok(());
    }
    let (unit, factor) = D::UNITS[0];
    let shown = |x: f64| format!("{} {unit}", tidy(x / factor));
    // Bounds in another unit have many digits.
    let rounded = |x: f64| if (x / factor).abs() < 0.01 { x } else { (1e3 * x / factor).round() * factor * 1e-3 };
    let [low, high] = [range.start(), range.end()].map(|x| shown(rounded(*x)));
    let message = format!("{name} is {}; allowed is {low} to {high}", shown(value));
    Err(StageError::parameter(Diagnostic::error(SETTING_OUT_OF_RANGE, message).hint("choose a value inside the range")))
}

/// Refuses a fabric that hardly stands out at all: its figure would be that of the mesh.
fn needs_bending(fabric: &Fabric, directions: &[Direction]) -> Result<(), StageError> {
    let length = |d: &Direction| bending_length(d.bending(fabric), fabric.areal_mass);
    let Some(limp) = directions.iter().find(|d| length(d) < LIMPEST) else { return Ok(()) };
    let message = format!(
        "fabric `{}` has a bending length of {:.2} mm along the {}; at least {} mm can be tested",
        fabric.name,
        1e3 * length(limp),
        limp.word(),
        1e3 * LIMPEST
    );
    let hint = "give bending_warp and bending_weft, or FAST's bending lengths, in the fabric file";
    Err(StageError::input(Diagnostic::error(codes::FABRIC_WITHOUT_BENDING, message).hint(hint)))
}
