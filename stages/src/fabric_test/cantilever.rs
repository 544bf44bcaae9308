//! The cantilever test (BS 3356, ASTM D1388, FAST-2): a strip is pushed over an edge until its tip meets a plane that
//! slopes by 41.5°. Half the overhang is the bending length c, and `B = σ g c³` the flexural rigidity.
//!
//! Two rows are held; the hinge over the second bends over half a cell on each side of it, so the edge lies half a cell
//! behind that row.

use super::codes;
use super::direction::{Direction, bending_length};
use super::mesh::{Flat, ROW, strip};
use super::rig::Rig;
use super::{GRAVITY, needs_bending, within};
use crate::solve::material;
use toile_garment::fabric::Fabric;
use toile_garment::units::Length;
use toile_garment::{Diagnostic, Vec3};
use toile_stage_api::{StageContext, StageError};

/// Slope of the plane, degrees: there `cos(θ/2)/(8 tan θ) = 1/8`, nearly, so that c is half the overhang.
pub const SLOPE: f64 = 41.5;
/// Width of the strip, m.
pub const WIDTH: f64 = 0.025;
/// Fewest rows of the overhang, and how many it gets if nothing is asked.
const FEWEST: f64 = 8.0;
const ROWS: f64 = 24.0;
/// Most edges along the overhang then.
const MOST: f64 = 200.0;
/// Longest edge if nothing is asked, m.
const EDGE: f64 = 2e-3;
/// Slope within which the tip is on the plane, rad.
const CLOSE: f64 = 5e-4;
/// Where the yarns rub, strips hang a little differently each time, as in the laboratory.
const CLOSE_RUBBING: f64 = 0.01;
/// How often the tip is sought.
const TRIES: usize = 12;

/// Share of the bending length by which a strip may differ from the file: what laboratories differ by.
const DIFFERS: f64 = 0.05;

/// How to do the test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CantileverParams {
    /// Along which yarns the strip is cut.
    pub direction: Direction,
    /// Edge of the mesh, m; `None`: 2 mm, or as fine as the overhang needs.
    pub edge: Option<f64>,
}

/// The reading.
#[derive(Clone, Debug)]
pub struct Cantilever {
    /// The settings of the test.
    pub direction: Direction,
    /// Edge of the mesh, m.
    pub edge: f64,
    /// Overhang at which the chord slopes by 41.5°, m.
    pub overhang: f64,
    /// c, m.
    pub bending_length: f64,
    /// σ g c³, N·m.
    pub rigidity: f64,
    /// The rigidity by the fabric's numbers, N·m, and whether that number is in the file or estimated.
    pub expected: (f64, bool),
    /// Does friction act in its bending?
    pub rubs: bool,
    /// The bending was measured as a curve, so that no single rigidity of the file stands for it.
    pub curved: bool,
    /// The strip's middle line from the edge to the tip: along and down, m.
    pub profile: Vec<[f64; 2]>,
}

/// Does the test in one direction.
///
/// # Errors
/// An option out of range, a fabric without bending stiffness, no rest, or a stop on request.
pub fn cantilever(
    fabric: &Fabric,
    params: &CantileverParams,
    cx: &mut StageContext<'_>,
) -> Result<Cantilever, StageError> {
    needs_bending(fabric, &[params.direction])?;
    let expected = params.direction.bending(fabric);
    let likely = 2.0 * bending_length(expected, fabric.areal_mass);
    let edge = params.edge.unwrap_or_else(|| EDGE.min(likely / (ROWS * ROW)).max(likely / MOST));
    within::<Length>("the edge", edge, 5e-5..=likely / (FEWEST * ROW))?;
    let sheet = Sheet { fabric, direction: params.direction, edge, rows: (likely / (edge * ROW)).round() };
    let (overhang, profile) = sheet.overhang(likely, cx)?;
    let c = 0.5 * overhang;
    Ok(Cantilever {
        direction: params.direction,
        edge,
        overhang,
        bending_length: c,
        rigidity: fabric.areal_mass * GRAVITY * c * c * c,
        expected: (expected, params.direction.is_given(fabric)),
        rubs: fabric.bend_friction() > 0.0,
        curved: params.direction.is_curved(fabric),
        profile,
    })
}

/// A strip whose rows get longer with the overhang, so that the slope depends smoothly on it.
struct Sheet<'a> {
    fabric: &'a Fabric,
    direction: Direction,
    edge: f64,
    rows: f64,
}

impl Sheet<'_> {
    /// The overhang that meets the plane, by the secant rule on its logarithm, and how the strip hangs there.
    fn overhang(&self, likely: f64, cx: &mut StageContext<'_>) -> Result<(f64, Vec<[f64; 2]>), StageError> {
        let (mut a, mut b) = (libm::log(likely), libm::log(1.04 * likely));
        let (mut fa, _) = self.slope(libm::exp(a), cx)?;
        let close = if self.fabric.bend_friction() > 0.0 { CLOSE_RUBBING } else { CLOSE };
        for _ in 0..TRIES {
            let (fb, profile) = self.slope(libm::exp(b), cx)?;
            if fb.abs() < close {
                return Ok((libm::exp(b), profile));
            }
            // Not a pure elastica: a step is never longer than a quarter.
            let step = if fb == fa { 0.1 } else { (-fb * (b - a) / (fb - fa)).clamp(-0.25, 0.25) };
            (a, fa) = (b, fb);
            b += step;
        }
        Err(StageError::Unstable(format!(
            "no overhang of the {} strip was found at which its tip meets the plane; try another --edge",
            self.direction.word()
        )))
    }

    /// How much steeper than the plane the chord of an overhang is, rad, and its middle line.
    fn slope(&self, overhang: f64, cx: &mut StageContext<'_>) -> Result<(f64, Vec<[f64; 2]>), StageError> {
        let cell = overhang / (self.rows + 0.5);
        let length = overhang + 1.5 * cell;
        let columns = (WIDTH / self.edge).round().max(4.0) as usize;
        // The edge lies half a cell behind the second held row.
        let cloth = strip([WIDTH, length], columns, self.rows as usize + 2).cut_along(self.direction.cut());
        let edge = 1.5 * cell;
        let start = cloth.place(|[x, y]| Vec3::new(y - edge, 0.0, x - 0.5 * WIDTH));
        let held = cloth.pick(|p| p[1] < 2.0 * cell + 1e-9);
        let held = held.into_iter().map(|v| (v, start[v as usize])).collect();
        let rig = Rig { cloth: &cloth, material: material(self.fabric), start, held, heavy: true, folds: false };
        let rest = rig.settle(cx)?;
        let profile = profile(&cloth, &rest.at, edge);
        let tip = profile[profile.len() - 1];
        Ok((libm::atan2(tip[1], tip[0]) - SLOPE.to_radians(), profile))
    }
}

/// Means over the rows beyond the edge.
fn profile(cloth: &Flat, at: &[Vec3], edge: f64) -> Vec<[f64; 2]> {
    let mut line = vec![[0.0, 0.0]];
    let free: Vec<u32> = cloth.pick(|p| p[1] > edge);
    for row in free.chunk_by(|a, b| cloth.at[*a as usize][1] == cloth.at[*b as usize][1]) {
        let sum = row.iter().map(|v| at[*v as usize]).sum::<Vec3>() / row.len() as f64;
        line.push([sum.x, -sum.y]);
    }
    line
}

/// Says where the strip does not show what the file says.
pub fn compare(read: &Cantilever, cx: &mut StageContext<'_>) {
    let (said, given) = read.expected;
    let off = libm::cbrt(read.rigidity / said) - 1.0;
    if given && !read.curved && off.abs() > DIFFERS {
        let message = format!(
            "the bending length of the {} strip differs by {:+.1} % from the fabric file's",
            read.direction.word(),
            100.0 * off
        );
        let hint = if read.rubs {
            "the friction 2HB holds the strip up beside its rigidity; where the rigidity comes from a cantilever and \
             holds that friction already, leave 2HB out"
        } else {
            "repeat with a shorter --edge; what stays is how garments of this fabric will bend"
        };
        cx.report.push(Diagnostic::warning(codes::BENDING_DIFFERS_FROM_FILE, message).hint(hint));
    }
}
