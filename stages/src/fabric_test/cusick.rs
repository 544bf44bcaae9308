//! Cusick's drape test (BS 5058, ISO 9073-9): a disc of cloth lies on a disc of 18 cm and hangs over its edge; parallel
//! light from above casts its shadow.
//!
//! Drape coefficient = (shadow − disc) / (specimen − disc), areas. The specimen measures 30 cm; one whose coefficient
//! is below 30 % is tested again with 24 cm, one above 85 % with 36 cm.
//!
//! Which of the cloth's many states of rest is read: `fall.rs`. Beside laboratories: `drape.md`.

use super::codes;
use super::fall::{Fallen, deepest};
use super::nodes::{Node, nodes};
use super::shadow::{RAYS, shadow};
use super::{Direction, within};
use std::f64::consts::{PI, TAU};
use toile_garment::Diagnostic;
use toile_garment::fabric::Fabric;
use toile_garment::units::Length;
use toile_stage_api::{StageContext, StageError};

/// Radius of the disc, m.
pub const DISC: f64 = 0.09;
/// Diameters of specimens for limp, usual and stiff cloth, m.
pub const SPECIMENS: [f64; 3] = [0.24, 0.30, 0.36];
/// Drape coefficients below and above which another specimen is due.
const USUAL: [f64; 2] = [0.30, 0.85];
/// Rise of a node over its valleys, as a share of the specimen's diameter.
const NODE: f64 = 0.01;

/// How to do the test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CusickParams {
    /// Diameter of the specimen, m: one of [`SPECIMENS`].
    pub specimen: f64,
    /// Edge of the mesh, m.
    pub edge: f64,
    /// Which repeat: each starts with its folds in other places.
    pub repeat: u32,
}

impl Default for CusickParams {
    fn default() -> Self {
        Self { specimen: SPECIMENS[1], edge: 4e-3, repeat: 0 }
    }
}

impl CusickParams {
    /// Coarsest edge, m: five cells from the disc to the hem.
    pub(super) fn coarsest(&self) -> f64 {
        0.2 * (0.5 * self.specimen - DISC)
    }
}

/// The readings.
#[derive(Clone, Debug)]
pub struct Cusick {
    /// The settings of the test.
    pub params: CusickParams,
    /// (shadow − disc) / (specimen − disc).
    pub drape_coefficient: f64,
    /// Shadow with the disc, m².
    pub shadow_area: f64,
    /// Outer radius of the shadow on rays at even angles, m: from the weft's direction counter-clockwise, seen from
    /// above with the warp upwards.
    pub outline: Vec<f64>,
    /// Folds.
    pub nodes: Vec<Node>,
    /// Lowest point of the hem under the disc, m.
    pub drop_max: f64,
    /// Mean depth of the hem under the disc, m.
    pub drop_mean: f64,
    /// Elastic energy and that of the weight, flat cloth 0, J.
    pub energy: f64,
    /// Triangles of the mesh.
    pub triangles: usize,
}

impl Cusick {
    /// Largest radius of the shadow, m.
    #[must_use]
    pub fn radius_max(&self) -> f64 {
        self.outline.iter().copied().fold(0.0, f64::max)
    }

    /// Least radius of the shadow, m.
    #[must_use]
    pub fn radius_min(&self) -> f64 {
        self.outline.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Mean radius of the shadow, m.
    #[must_use]
    pub fn radius_mean(&self) -> f64 {
        self.outline.iter().sum::<f64>() / self.outline.len().max(1) as f64
    }

    /// Half the way from the mean valley to the mean peak of the nodes, m; 0 without nodes.
    #[must_use]
    pub fn node_amplitude(&self) -> f64 {
        let n = self.nodes.len().max(1) as f64;
        self.nodes.iter().map(|node| node.peak - node.valley).sum::<f64>() / (2.0 * n)
    }

    /// Angle of every node from the weft's direction, rad.
    pub fn node_angles(&self) -> impl Iterator<Item = f64> + '_ {
        self.nodes.iter().map(|node| TAU * node.ray as f64 / RAYS as f64)
    }
}

/// Does the test once.
///
/// # Errors
/// An option out of range, a fabric without bending stiffness, no rest, or a stop on request.
pub fn cusick(fabric: &Fabric, params: &CusickParams, cx: &mut StageContext<'_>) -> Result<Cusick, StageError> {
    within::<Length>("the edge", params.edge, 1.5e-3..=params.coarsest())?;
    super::needs_bending(fabric, &Direction::ALL)?;
    let read = read(params, &deepest(fabric, params, cx)?);
    advise(&read, cx);
    Ok(read)
}

pub(super) fn read(params: &CusickParams, fallen: &Fallen) -> Cusick {
    let (at, triangles) = (&fallen.rest.at, &fallen.cloth.triangles);
    let shadow = shadow(at, triangles, DISC);
    let areas = [DISC, 0.5 * params.specimen].map(|r| PI * r * r);
    Cusick {
        params: *params,
        drape_coefficient: (shadow.area - areas[0]) / (areas[1] - areas[0]),
        shadow_area: shadow.area,
        nodes: nodes(&shadow.outline, NODE * params.specimen),
        outline: shadow.outline,
        drop_max: at.iter().map(|p| -p.y).fold(0.0, f64::max),
        drop_mean: hem_drop(params, fallen),
        energy: fallen.rest.energy,
        triangles: triangles.len(),
    }
}

/// Mean depth of the vertices on the rim.
fn hem_drop(params: &CusickParams, fallen: &Fallen) -> f64 {
    let is_hem = |p: [f64; 2]| libm::hypot(p[0], p[1]) > 0.5 * params.specimen - 1e-6;
    let hem = fallen.cloth.pick(is_hem);
    hem.iter().map(|v| -fallen.rest.at[*v as usize].y).sum::<f64>() / hem.len().max(1) as f64
}

/// The standard's rule of repeats: the next smaller specimen for limp cloth, the next larger one for stiff cloth.
pub(super) fn advise(read: &Cusick, cx: &mut StageContext<'_>) {
    let percent = 100.0 * read.drape_coefficient;
    let smaller = SPECIMENS.into_iter().rfind(|s| *s < read.params.specimen);
    let larger = SPECIMENS.into_iter().find(|s| *s > read.params.specimen);
    let (code, words, next) = if read.drape_coefficient < USUAL[0] {
        (codes::SPECIMEN_TOO_LARGE, "below 30 %: the cloth is too limp", smaller)
    } else if read.drape_coefficient > USUAL[1] {
        (codes::SPECIMEN_TOO_SMALL, "above 85 %: the cloth is too stiff", larger)
    } else {
        return;
    };
    let Some(next) = next else { return };
    let message = format!("the drape coefficient is {percent:.1} %, {words} for this specimen");
    let hint = format!("repeat with --specimen \"{:.0} cm\"", 100.0 * next);
    cx.report.push(Diagnostic::warning(code, message).hint(hint));
}
