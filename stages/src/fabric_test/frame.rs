//! The picture frame: cloth in a frame of four hinged sides along its yarns, pulled at a corner. The yarns keep their
//! lengths, so all that is felt is shear.
//!
//! A frame of side a at the shear angle γ has the diagonal `D = 2 a cos(π/4 − γ/2)`. The force F along it comes from
//! the frame's work: `F dD = Σ R·dx` over the held vertices. Two figures of shear per length are in use. Laboratories
//! give `F/(2 a cos φ)` with φ = π/4 − γ/2. The other is `τ = F sin φ/a`: its work over γ is the energy per area of
//! cloth, so τ = G γ for a constant G. They are equal at γ = 0.

use super::mesh::{Flat, ROW, strip};
use super::rig::Rig;
use super::within;
use crate::solve::material;
use std::f64::consts::FRAC_PI_4;
use toile_garment::Vec3;
use toile_garment::fabric::Fabric;
use toile_garment::units::{Angle, Length};
use toile_stage_api::{StageContext, StageError};

/// Side of the frame, m.
pub const SIDE: f64 = 0.1;
/// Readings up to the largest angle.
const STEPS: u32 = 8;

/// How to do the test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameParams {
    /// Edge of the mesh, m.
    pub edge: f64,
    /// Largest shear angle, rad.
    pub angle: f64,
}

impl Default for FrameParams {
    fn default() -> Self {
        Self { edge: 4e-3, angle: 40.0_f64.to_radians() }
    }
}

/// One line of the test sheet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameReading {
    /// rad.
    pub shear_angle: f64,
    /// Along the diagonal, N.
    pub force: f64,
    /// F/(2 a cos φ), N/m.
    pub shear_force: f64,
    /// F sin φ/a, N/m.
    pub shear_stress: f64,
}

/// The reading.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The settings of the test.
    pub params: FrameParams,
    /// From rest to the largest angle.
    pub readings: Vec<FrameReading>,
    /// G of the fabric, N/m per rad.
    pub shear: f64,
}

impl Frame {
    /// Secant stiffness over the whole way, N/m per rad.
    #[must_use]
    pub fn shear_secant(&self) -> f64 {
        self.readings.last().map_or(0.0, |r| r.shear_stress / r.shear_angle)
    }
}

/// Does the test.
///
/// # Errors
/// An option out of range, no rest, or a stop on request.
pub fn frame(fabric: &Fabric, params: &FrameParams, cx: &mut StageContext<'_>) -> Result<Frame, StageError> {
    within::<Length>("the edge", params.edge, 1e-3..=0.1 * SIDE)?;
    within::<Angle>("the angle", params.angle, 0.01..=60.0_f64.to_radians())?;
    let columns = (SIDE / params.edge).round() as usize;
    let cloth = strip([SIDE, SIDE], columns, (SIDE / (params.edge * ROW)).round() as usize);
    let on = |x: f64| x.abs() < 1e-9 || (x - SIDE).abs() < 1e-9;
    let rim = cloth.pick(|[x, y]| on(x) || on(y));
    // Flat cloth does not bend.
    let material = material(fabric).limp();
    let mut at = cloth.place(|p| place(p, 0.0));
    let mut readings = vec![FrameReading::default()];
    for k in 1..=STEPS {
        let angle = params.angle * f64::from(k) / f64::from(STEPS);
        let held = rim.iter().map(|v| (*v, place(cloth.at[*v as usize], angle))).collect();
        let rig = Rig { cloth: &cloth, material: material.clone(), start: at, held, heavy: false, folds: false };
        let rest = rig.settle(cx)?;
        readings.push(read(&cloth, angle, |v| rest.forces.get(&v).copied().unwrap_or_default(), &rim));
        at = rest.at;
    }
    Ok(Frame { params: *params, readings, shear: fabric.shear_secant(params.angle) })
}

/// Where the frame takes a place of the cloth.
fn place([x, y]: [f64; 2], angle: f64) -> Vec3 {
    let half = FRAC_PI_4 - 0.5 * angle;
    Vec3::new((x - y) * libm::sin(half), 0.0, -(x + y) * libm::cos(half))
}

fn read(cloth: &Flat, angle: f64, force_on: impl Fn(u32) -> Vec3, rim: &[u32]) -> FrameReading {
    let half = FRAC_PI_4 - 0.5 * angle;
    let (sine, cosine) = (libm::sin(half), libm::cos(half));
    // dx/dγ of the frame, exactly.
    let moved = |[x, y]: [f64; 2]| Vec3::new(-0.5 * (x - y) * cosine, 0.0, -0.5 * (x + y) * sine);
    let work: f64 = rim.iter().map(|v| force_on(*v).dot(&moved(cloth.at[*v as usize]))).sum();
    let force = work / (SIDE * sine);
    FrameReading {
        shear_angle: angle,
        force,
        shear_force: force / (2.0 * SIDE * cosine),
        shear_stress: force * sine / SIDE,
    }
}
