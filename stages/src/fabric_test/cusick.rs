//! Cusick's drape test (BS 5058, ISO 9073-9): a disc of cloth lies on a disc of 18 cm and hangs over its edge; parallel
//! light from above casts its shadow.
//!
//! Drape coefficient = (shadow − disc) / (specimen − disc), areas. The specimen measures 30 cm; one whose coefficient is
//! below 30 % is tested again with 24 cm, one above 85 % with 36 cm.
//!
//! The cloth on the disc is held flat. A hinge over the last held circle bends over half a cell on each side of it, so the
//! edge of the disc lies half a cell within that circle.

use super::mesh::{Flat, ROW, ring};
use super::nodes::{Node, nodes};
use super::rig::Rig;
use super::shadow::{RAYS, Shadow, shadow};
use super::{Direction, within};
use crate::solve::material;
use std::f64::consts::{PI, TAU};
use toile_garment::fabric::Fabric;
use toile_garment::units::Length;
use toile_garment::{Diagnostic, Vec3};
use toile_stage_api::{StageContext, StageError};

/// Radius of the disc, m.
pub const DISC: f64 = 0.09;
/// Diameters of specimens for limp, usual and stiff cloth, m.
pub const SPECIMENS: [f64; 3] = [0.24, 0.30, 0.36];
/// Drape coefficients below and above which another specimen is due.
const USUAL: [f64; 2] = [0.30, 0.85];
/// Rise of a node over its valleys, as a share of the specimen's diameter.
const NODE: f64 = 0.01;
/// Ripple of the flat start at the hem, m: the folds must begin somewhere, and the same on every mesh.
const RIPPLE: f64 = 5e-4;

/// How to do the test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CusickParams {
    /// Diameter of the specimen, m: one of [`SPECIMENS`].
    pub specimen: f64,
    /// Edge of the mesh, m.
    pub edge: f64,
    /// Which repeat: each starts from other ripples.
    pub repeat: u32,
}

impl Default for CusickParams {
    fn default() -> Self {
        Self { specimen: SPECIMENS[1], edge: 4e-3, repeat: 0 }
    }
}

/// What is read.
#[derive(Clone, Debug)]
pub struct Cusick {
    /// As asked.
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
    let specimen = 0.5 * params.specimen;
    within::<Length>("the edge", params.edge, 1.5e-3..=0.2 * (specimen - DISC))?;
    super::needs_bending(fabric, &Direction::ALL)?;
    let (cloth, held) = mesh(specimen, params.edge);
    let start = cloth.place(|p| start(p, specimen, params.repeat));
    let pins = cloth.pick(|p| libm::hypot(p[0], p[1]) < held).into_iter().map(|v| (v, start[v as usize])).collect();
    let rig = Rig { cloth: &cloth, material: material(fabric), start, held: pins, heavy: true, folds: true };
    let rest = rig.settle(cx)?;
    let read = read(params, &cloth, &rest.at, &shadow(&rest.at, &cloth.triangles, DISC));
    advise(&read, cx);
    Ok(read)
}

/// Circles from half a cell within the disc's edge to the hem, and the radius up to which vertices are held.
fn mesh(specimen: f64, edge: f64) -> (Flat, f64) {
    let free = (specimen - DISC) / (edge * ROW);
    let count = (free + 0.5).round().max(2.0) as u32;
    let cell = (specimen - DISC) / (f64::from(count) - 0.5);
    let radii: Vec<f64> = (0..=count).map(|k| DISC + (f64::from(k) - 0.5) * cell).collect();
    (ring(&radii, edge), DISC + cell)
}

/// Flat, with ripples of two to nine waves that grow towards the hem.
fn start([x, y]: [f64; 2], specimen: f64, repeat: u32) -> Vec3 {
    let (r, angle) = (libm::hypot(x, y), libm::atan2(y, x));
    let out = ((r - DISC) / (specimen - DISC)).max(0.0);
    // The golden angle spreads the phases of waves and repeats evenly, without chance.
    let phase = |n: u32| 2.399_963_229_728_653 * f64::from(n + 8 * repeat) * f64::from(n);
    let ripple: f64 = (2..=9).map(|n| libm::cos(f64::from(n) * angle + phase(n))).sum();
    Vec3::new(x, if r > DISC { RIPPLE * out * out * ripple } else { 0.0 }, -y)
}

fn read(params: &CusickParams, cloth: &Flat, at: &[Vec3], shadow: &Shadow) -> Cusick {
    let areas = [DISC, 0.5 * params.specimen].map(|r| PI * r * r);
    Cusick {
        params: *params,
        drape_coefficient: (shadow.area - areas[0]) / (areas[1] - areas[0]),
        shadow_area: shadow.area,
        nodes: nodes(&shadow.outline, NODE * params.specimen),
        outline: shadow.outline.clone(),
        drop_max: at.iter().map(|p| -p.y).fold(0.0, f64::max),
        triangles: cloth.triangles.len(),
    }
}

/// The standard's rule of repeats: the next smaller specimen for limp cloth, the next larger one for stiff cloth.
pub(super) fn advise(read: &Cusick, cx: &mut StageContext<'_>) {
    let percent = 100.0 * read.drape_coefficient;
    let smaller = SPECIMENS.into_iter().rfind(|s| *s < read.params.specimen);
    let larger = SPECIMENS.into_iter().find(|s| *s > read.params.specimen);
    let (code, words, next) = if read.drape_coefficient < USUAL[0] {
        ("specimen-too-large", "below 30 %: the cloth is too limp", smaller)
    } else if read.drape_coefficient > USUAL[1] {
        ("specimen-too-small", "above 85 %: the cloth is too stiff", larger)
    } else {
        return;
    };
    let Some(next) = next else { return };
    let message = format!("the drape coefficient is {percent:.1} %, {words} for this specimen");
    let hint = format!("repeat with --specimen \"{:.0} cm\"", 100.0 * next);
    cx.report.push(Diagnostic::warning(code, message).hint(hint));
}
