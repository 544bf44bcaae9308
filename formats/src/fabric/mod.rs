//! The fabric file: what was measured on a cloth, each number with unit, method and source.
//!
//! # Form
//!
//! A TOML file. Quantities are texts with a unit (`"500 N/m"`); pure ratios (`friction`, `poisson`, `lt_warp`) are
//! plain numbers. Every quantity may instead be a table that says where it comes from: `emt_warp = { value = "3.5 %",
//! method = "KES-FB1", source = "own laboratory, 2024" }`. Otherwise the `method` and `source` of its table hold, then
//! those of the file.
//!
//! ```toml
//! name = "cotton shirting"
//! source = "typical values"
//! areal_mass = "115 g/m2"            # 1 g/m2 to 10 kg/m2
//!
//! thickness = "0.28 mm"
//! friction = 0.4                     # cloth on body and on itself
//!
//! strain_limit_warp = "3.5 %"        # default: EMT; else 5 %, or E100 if larger
//! strain_limit_bias = "6 %"          # at 45° to warp and weft; default: none
//! rest_curvature_warp = "30 1/m"     # how unloaded cloth curls, above 0 where its right side is hollow; default: flat
//!
//! [kes]                              # Kawabata: strain at 500 gf/cm and linearity
//! method = "KES-F"
//! emt_warp = "3.5 %"
//! lt_warp = 0.80
//!
//! emt_weft = "8 %"
//! lt_weft = 0.80
//! shear = "45 N/m/rad"               # G, or "0.8 gf/cm/deg"
//!
//! bending_warp = "8 uN.m"            # B, or "0.08 gf.cm2/cm"
//! bending_weft = "5 uN.m"
//! bending_hysteresis = "0.4 mN"      # 2HB, optional; bending lengths of [fast] hold that friction already
//! ```
//!
//! Other tables for the same properties; tables may be mixed as long as no property is given twice:
//!
//! - `[linear]` `stretch_warp`, `stretch_weft` (N/m: slope of tension in a strip test, the sides free), `poisson`,
//!   `shear` (N/m per rad), `bending` or `bending_warp`, `bending_weft`, `bending_bias` (N·m).
//! - `[isotropic]` `stretch` (N/m: Young's modulus times thickness), `poisson`, `bending`; the shear stiffness is
//!   `stretch / (2 (1 + poisson))`.
//! - `[fast]` `e5_…`, `e20_…`, `e100_…` (strain at 5, 20, 100 gf/cm, `_warp` and `_weft`), `eb5` (bias strain at 5
//!   gf/cm). The shear stiffness is G = 1.23 / eb5 N/m. `bending_…` or `bending_length_…` (B = areal mass · g · c³).
//! - `[curve]` `warp = [["0 %", "0 N/m"], ["1 %", "20 N/m"], …]` and `weft`: measured samples, both columns rising.
//!   `shear_force = [["0.5 deg", "2 N/m"], …]` in place of `shear`. `bending_moment_warp = [["50 1/m", "0.6 mN"], …]` and
//!   `bending_moment_weft` in place of `bending_warp` and `bending_weft`. They may stand beside another table.
//!
//! - `[springs]` `yarn`, `bias` (N/m), beside one of the others. They are the constants of the springs of `model =
//!   "springs"`: of edges within 22.5° of warp or weft, and of all others. Without the table they follow from the laws.
//!   All else of a drape goes by the laws.
//!
//! - `[look]` `weave` (`plain`, `basket`, `twill`, `warp-twill`, `satin`, `crepe`, `jersey`, `pile`, `cord`), `color`
//!   (`#rrggbb`), `ends_per_cm`, `picks_per_cm`, `sheen`, `roughness`: what bitmaps of the cloth are drawn from.
//!
//! `poisson`, `shear` and the bending keys may stand in any table of laws.
//!
//! # Poisson's ratio
//!
//! `poisson` is what a strip test along the warp shows at small strain: contraction along the weft over extension along
//! the warp (ν12; without it 0). A strip along the weft then contracts by `poisson · E_weft / E_warp`. The laws of
//! `[linear]`, `[isotropic]`, `[fast]` and `[curve]` are taken as such strip tests, with free sides. The fabric's laws
//! hold the width, so they are stiffer by `1 / (1 − ν12 ν21)` at rest. A strip of that fabric gives the file's numbers
//! back. KES-F pulls a sample four times as wide as long, which hardly gets narrower: its laws are taken as they are.

mod build;
pub(crate) mod codes;
mod curve;
mod fields;
pub mod kes;
mod look;
mod poisson;
mod reader;
mod schema;
#[cfg(test)]
mod tests;

pub use schema::schema;
use toile_garment::Diagnostic;
use toile_garment::fabric::Fabric;

/// Reads a fabric file. `file` is its name for messages.
///
/// # Errors
/// All mistakes at once, each with line, column, allowed range and remedy.
pub fn read(text: &str, file: &str) -> Result<Fabric, Vec<Diagnostic>> {
    let mut entries = reader::read(text, file)?;
    let fabric = build::fabric(&mut entries);
    match fabric {
        Some(fabric) if entries.findings.is_empty() => Ok(fabric),
        _ => Err(entries.findings),
    }
}
