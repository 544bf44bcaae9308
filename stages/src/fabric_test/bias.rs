//! Bias extension: a strip cut at 45° is pulled by its ends; its yarns turn towards the pull, so it gives way by shear.
//!
//! The shear angle is read in the middle, where yarns are free of both clamps. Beside it stands that of yarns that keep
//! their lengths: `γ = 90° − 2 acos((D + d)/(√2 D))`, D = length − width. FAST-3 reads the extension at 5 gf/cm (EB5)
//! and takes G = 123/EB5 N/m (EB5 in %), as if all of the strip sheared alike. Beside the clamps it does not. With
//! yarns that keep their lengths a strip twice as long as wide is 1.5 times as stiff. So G after FAST comes out up to
//! 1.5 times too large. The strip is kept flat: wrinkles at large shear are not shown.

use super::mesh::{Flat, crossed_strip};
use super::rig::{Rest, Rig};
use super::within;
use crate::solve::material;
use std::f64::consts::{FRAC_PI_2, SQRT_2};
use toile_cloth::Material;
use toile_garment::Vec3;
use toile_garment::fabric::Fabric;
use toile_garment::units::{Length, Share};
use toile_stage_api::{StageContext, StageError};

/// Length between the clamps and width, m.
pub const LENGTH: f64 = 0.2;
/// Width of the strip, m.
pub const WIDTH: f64 = 0.1;
/// Tension at which FAST-3 reads, N/m: 5 gf/cm.
pub const FAST: f64 = 5.0 * 0.980_665;
/// Readings up to the largest extension.
const STEPS: u32 = 10;
/// Tension over its goal at which EB5 counts as found, and how often it is sought.
const CLOSE: f64 = 1e-3;
const TRIES: usize = 12;
/// Radius of the middle in which the shear angle is read, over the width.
const MIDDLE: f64 = 0.2;

/// How to do the test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BiasParams {
    /// Edge of the mesh, m.
    pub edge: f64,
    /// Largest extension over the length.
    pub extension: f64,
}

impl Default for BiasParams {
    fn default() -> Self {
        Self { edge: 4e-3, extension: 0.1 }
    }
}

/// One line of the test sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BiasReading {
    /// Over the length.
    pub extension: f64,
    /// N.
    pub force: f64,
    /// Shear angle in the middle, rad.
    pub shear_angle: f64,
    /// That of yarns that keep their lengths, rad.
    pub shear_angle_rigid: f64,
    /// Least width over the first width.
    pub waist: f64,
}

/// The reading.
#[derive(Clone, Debug)]
pub struct Bias {
    /// The settings of the test.
    pub params: BiasParams,
    /// From rest to the largest extension.
    pub readings: Vec<BiasReading>,
    /// Extension at 5 gf/cm.
    pub eb5: f64,
    /// G after FAST: 1.23/EB5, N/m per rad.
    pub shear_fast: f64,
    /// G of the fabric, N/m per rad.
    pub shear: f64,
    /// The strip's outline at the largest extension, in the plane of the test (across, along), m.
    pub outline: Vec<[f64; 2]>,
}

/// Does the test.
///
/// # Errors
/// An option out of range, no rest, or a stop on request.
pub fn bias(fabric: &Fabric, params: &BiasParams, cx: &mut StageContext<'_>) -> Result<Bias, StageError> {
    within::<Length>("the edge", params.edge, 1e-3..=0.1 * WIDTH)?;
    within::<Share>("the extension", params.extension, 0.005..=0.3)?;
    let mut pulled = Pulled::new(fabric, params.edge);
    let mut readings = vec![BiasReading { waist: 1.0, ..BiasReading::ZERO }];
    for k in 1..=STEPS {
        readings.push(pulled.to(params.extension * f64::from(k) / f64::from(STEPS), cx)?);
    }
    let outline = pulled.outline();
    let eb5 = eb5(fabric, params.edge, cx)?;
    Ok(Bias { params: *params, readings, eb5, shear_fast: 0.25 * FAST / eb5, shear: fabric.shear, outline })
}

/// The extension at which the strip pulls with 5 gf/cm, by the secant rule from what shear alone would give.
fn eb5(fabric: &Fabric, edge: f64, cx: &mut StageContext<'_>) -> Result<f64, StageError> {
    let mut pulled = Pulled::new(fabric, edge);
    let (mut a, mut fa) = (0.0, -1.0);
    let mut b: f64 = (0.25 * FAST / fabric.shear).clamp(1e-4, 0.3);
    for _ in 0..TRIES {
        let fb = pulled.to(b, cx)?.force / (FAST * WIDTH) - 1.0;
        if fb.abs() < CLOSE {
            return Ok(b);
        }
        let next = b - fb * (b - a) / (fb - fa);
        (a, fa) = (b, fb);
        b = if next.is_finite() { next.clamp(0.25 * b, 3.0 * b).min(1.0) } else { 0.5 * b };
    }
    Err(StageError::Unstable("no extension was found at which the bias strip pulls with 5 gf/cm".to_owned()))
}

impl BiasReading {
    const ZERO: Self = Self { extension: 0.0, force: 0.0, shear_angle: 0.0, shear_angle_rigid: 0.0, waist: 0.0 };
}

/// A strip between two clamps that move apart.
struct Pulled {
    cloth: Flat,
    material: Material,
    clamps: [Vec<u32>; 2],
    at: Vec<Vec3>,
    stretch: f64,
}

impl Pulled {
    fn new(fabric: &Fabric, edge: f64) -> Self {
        let cells = |side: f64| (side / edge).round() as usize;
        let cloth = crossed_strip([WIDTH, LENGTH], cells(WIDTH), cells(LENGTH)).cut_on_bias();
        let end = |y: f64| cloth.pick(|p| (p[1] - y).abs() < 1e-9);
        let clamps = [end(0.0), end(LENGTH)];
        let at = cloth.place(|[x, y]| Vec3::new(x - 0.5 * WIDTH, 0.0, -y));
        // Flat cloth does not bend.
        let material = material(fabric).limp();
        Self { cloth, material, clamps, at, stretch: 1.0 }
    }

    /// Pulls to an extension and reads.
    fn to(&mut self, extension: f64, cx: &mut StageContext<'_>) -> Result<BiasReading, StageError> {
        let (before, stretch) = (self.stretch, 1.0 + extension);
        let start: Vec<Vec3> = self.at.iter().map(|p| Vec3::new(p.x, p.y, p.z * stretch / before)).collect();
        let held = self.clamps.iter().flatten().map(|v| (*v, start[*v as usize])).collect();
        let material = self.material.clone();
        let rig = Rig { cloth: &self.cloth, material, start, held, heavy: false, folds: false };
        let Rest { at, forces, .. } = rig.settle(cx)?;
        (self.at, self.stretch) = (at, stretch);
        let force = |v: &u32| forces.get(v).map_or(0.0, |f| -f.z);
        Ok(BiasReading {
            extension,
            force: self.clamps[1].iter().map(force).sum(),
            shear_angle: self.shear(),
            shear_angle_rigid: rigid(extension),
            waist: self.waist(),
        })
    }

    /// Mean angle by which warp and weft left their right angle in the middle.
    fn shear(&self) -> f64 {
        let (mut sum, mut weight) = (0.0, 0.0);
        for t in &self.cloth.triangles {
            let middle = t.iter().fold([0.0; 2], |m, v| {
                let p = self.cloth.at[*v as usize];
                [m[0] + p[0] / 3.0, m[1] + p[1] / 3.0]
            });
            if libm::hypot(middle[0] - 0.5 * WIDTH, middle[1] - 0.5 * LENGTH) < MIDDLE * WIDTH {
                let area = self.cloth.area(t);
                sum += area * yarn_angle(&self.cloth, &self.at, t);
                weight += area;
            }
        }
        FRAC_PI_2 - sum / weight
    }

    fn waist(&self) -> f64 {
        let row = |sign: f64| {
            let edge = self.cloth.pick(|p| (p[0] - 0.5 * WIDTH - sign * 0.5 * WIDTH).abs() < 1e-9);
            edge.iter().map(|v| sign * self.at[*v as usize].x).fold(f64::INFINITY, f64::min)
        };
        (row(1.0) + row(-1.0)) / WIDTH
    }

    fn outline(&self) -> Vec<[f64; 2]> {
        let side = |x: f64| self.cloth.pick(|p| (p[0] - x).abs() < 1e-9);
        let back = side(0.0).into_iter().rev();
        side(WIDTH).into_iter().chain(back).map(|v| [self.at[v as usize].x, -self.at[v as usize].z]).collect()
    }
}

/// Angle between warp and weft in a triangle, rad.
fn yarn_angle(cloth: &Flat, at: &[Vec3], t: &[u32; 3]) -> f64 {
    let [a, b, c] = t.map(|v| cloth.rest[v as usize]);
    let [p, q, r] = t.map(|v| at[v as usize]);
    let (e, f) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let (weft, warp) = ((q - p) * f[1] - (r - p) * e[1], (r - p) * e[0] - (q - p) * f[0]);
    let angle = libm::atan2(weft.cross(&warp).norm(), weft.dot(&warp));
    // The yarn pair that closes is read, whichever the diagonal.
    angle.min(2.0 * FRAC_PI_2 - angle)
}

/// Shear angle of yarns that keep their lengths, rad; at most a right angle.
fn rigid(extension: f64) -> f64 {
    let free = LENGTH - WIDTH;
    FRAC_PI_2 - 2.0 * libm::acos(((free + extension * LENGTH) / (SQRT_2 * free)).min(1.0))
}
