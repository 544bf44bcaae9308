//! Heights of the hem on the garment's own body and on the new one, on the four sides of the person.

use super::changes::lies_on_trunk;
use toile_garment::{Garment, Vec3};

/// Half of the angle in which a side is looked at from above, radians.
const SIDE_ANGLE: f64 = std::f64::consts::FRAC_PI_8;

/// The sides, each with its direction (x, z): a body looks along z, and its left is on the side of x.
const SIDES: [(&str, [f64; 2]); 4] =
    [("front", [0.0, 1.0]), ("left side", [1.0, 0.0]), ("back", [0.0, -1.0]), ("right side", [-1.0, 0.0])];

/// The lowest cloth on one side.
#[derive(Clone, Debug, PartialEq)]
pub struct Hem {
    /// Name of the side.
    pub side: &'static str,
    /// Height before and after, metres.
    pub height: [f64; 2],
}

impl Hem {
    /// The change in words, millimetres.
    #[must_use]
    pub fn words(&self) -> String {
        let [before, after] = self.height.map(|h| 1e3 * h);
        format!("{before:.0} → {after:.0} mm ({:+.0} mm)", after - before)
    }
}

/// The hem of a garment before and after.
#[must_use]
pub fn hems(own: &Garment, worn: &Garment) -> Vec<Hem> {
    let [before, after] = [own, worn].map(cloth_on_trunk);
    let height = |cloth: &[Vec3], to: [f64; 2]| {
        let n = cloth.len() as f64;
        let middle = cloth.iter().fold(Vec3::zeros(), |sum, p| sum + p) / n;
        let is_there = |p: &&Vec3| {
            let [x, z] = [p.x - middle.x, p.z - middle.z];
            x * to[0] + z * to[1] >= libm::hypot(x, z) * libm::cos(SIDE_ANGLE)
        };
        cloth.iter().filter(is_there).map(|p| p.y).min_by(f64::total_cmp)
    };
    let hem =
        |(side, to): (&'static str, [f64; 2])| Some(Hem { side, height: [height(&before, to)?, height(&after, to)?] });
    SIDES.into_iter().filter_map(hem).collect()
}

/// Places of all cloth that does not hang from an arm.
fn cloth_on_trunk(garment: &Garment) -> Vec<Vec3> {
    let (Some(drape), Some(body)) = (&garment.drape, &garment.body) else { return Vec::new() };
    drape.positions.iter().filter(|piece| lies_on_trunk(piece, body)).flatten().copied().collect()
}
