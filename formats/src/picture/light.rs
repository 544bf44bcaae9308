//! How open every vertex is to the light around it, and to the key light: depth maps from many directions.

use super::model::{Model, Surface};
use std::f64::consts::PI;
use toile_garment::Vec3;

/// Side of a depth map, pixels. Finer maps see smaller folds and take longer.
const SIDE: usize = 320;

/// Directions from which the light around comes.
const AROUND: usize = 64;

/// Directions of the key light, which is as wide as a large window.
const KEY: usize = 9;

/// Half the angle under which the key light is seen, radians.
const KEY_WIDTH: f64 = 0.22;

/// Per vertex and side (right, wrong): shares of light that arrive, 0 to 1.
pub struct Open {
    /// The light around, weighted by the cosine.
    pub around: [Vec<f64>; 2],
    /// The key light.
    pub key: [Vec<f64>; 2],
}

/// Adds the key light to the light around. `key` points to it, unit.
#[must_use]
pub fn look(model: &Model, around: &[[Vec<f64>; 2]], key: Vec3) -> Vec<Open> {
    let key = gather(model, &cone(key, KEY));
    around.iter().cloned().zip(key).map(|(around, key)| Open { around, key }).collect()
}

/// Shares of the light around that arrive at the two sides of every vertex.
#[must_use]
pub fn around(model: &Model) -> Vec<[Vec<f64>; 2]> {
    gather(model, &sphere(AROUND))
}

/// Directions spread evenly over the sphere, unit.
fn sphere(count: usize) -> Vec<Vec3> {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    (0..count)
        .map(|k| {
            let y = 1.0 - (2 * k + 1) as f64 / count as f64;
            let r = (1.0 - y * y).sqrt();
            let (s, c) = libm::sincos(golden * k as f64);
            Vec3::new(r * c, y, r * s)
        })
        .collect()
}

/// Directions around an axis, unit.
fn cone(axis: Vec3, count: usize) -> Vec<Vec3> {
    let across = axis.cross(&if axis.x.abs() < 0.8 { Vec3::x() } else { Vec3::y() }).normalize();
    let beside = axis.cross(&across);
    let direction = |k: usize| {
        let (s, c) = libm::sincos(PI * (3.0 - 5.0_f64.sqrt()) * k as f64);
        let r = KEY_WIDTH * ((k as f64 + 0.5) / count as f64).sqrt();
        (axis + (across * c + beside * s) * r).normalize()
    };
    (0..count).map(direction).collect()
}

/// Shares of light from some directions that arrive at the two sides of every vertex.
fn gather(model: &Model, directions: &[Vec3]) -> Vec<[Vec<f64>; 2]> {
    let zero = |s: &Surface| [vec![[0.0; 2]; s.positions.len()], vec![[0.0; 2]; s.positions.len()]];
    let mut sums: Vec<[Vec<[f64; 2]>; 2]> = model.surfaces.iter().map(zero).collect();
    for direction in directions {
        let Some(map) = DepthMap::new(model, *direction) else { continue };
        for (surface, sum) in model.surfaces.iter().zip(&mut sums) {
            for (i, (p, n)) in surface.positions.iter().zip(&surface.normals).enumerate() {
                let facing = n.dot(direction);
                let side = usize::from(facing < 0.0);
                let out = if side == 0 { *n } else { -*n };
                let weight = facing.abs();
                let [got, all] = &mut sum[side][i];
                *all += weight;
                *got += if map.sees(p, &out) { weight } else { 0.0 };
            }
        }
    }
    let share = |[got, all]: [f64; 2]| if all > 0.0 { got / all } else { 1.0 };
    sums.into_iter().map(|sides| sides.map(|side| side.into_iter().map(share).collect())).collect()
}

/// How far the surfaces reach towards a direction.
struct DepthMap {
    axes: [Vec3; 3],
    low: [f64; 2],
    step: f64,
    depth: Vec<f64>,
}

impl DepthMap {
    fn new(model: &Model, direction: Vec3) -> Option<Self> {
        let helper = if direction.y.abs() < 0.9 { Vec3::y() } else { Vec3::x() };
        let across = helper.cross(&direction).normalize();
        let axes = [across, direction.cross(&across), direction];
        let far = [f64::INFINITY; 2];
        let (mut low, mut high) = (far, far.map(|x| -x));
        for p in model.surfaces.iter().flat_map(|s| &s.positions) {
            for k in 0..2 {
                let x = p.dot(&axes[k]);
                low[k] = if x < low[k] { x } else { low[k] };
                high[k] = if x > high[k] { x } else { high[k] };
            }
        }
        let wide = if high[0] - low[0] > high[1] - low[1] { high[0] - low[0] } else { high[1] - low[1] };
        if !(wide > 0.0 && wide.is_finite()) {
            return None;
        }
        let step = wide / (SIDE - 2) as f64;
        let low = low.map(|x| x - step);
        let mut map = Self { axes, low, step, depth: vec![f64::NEG_INFINITY; SIDE * SIDE] };
        for surface in &model.surfaces {
            let at: Vec<[f64; 3]> = surface.positions.iter().map(|p| map.place(p)).collect();
            surface.triangles.iter().for_each(|t| map.draw(t.map(|i| at[i as usize])));
        }
        Some(map)
    }

    fn place(&self, p: &Vec3) -> [f64; 3] {
        let [x, y] = [0, 1].map(|k| (p.dot(&self.axes[k]) - self.low[k]) / self.step);
        [x, y, p.dot(&self.axes[2])]
    }

    fn draw(&mut self, corners: [[f64; 3]; 3]) {
        let depth = &mut self.depth;
        super::raster::cover(corners, [0, SIDE as i64], SIDE as i64, |x, y, _, z| {
            let cell = &mut depth[y * SIDE + x];
            if z > *cell {
                *cell = z;
            }
        });
    }

    /// Is nothing in front of a point, seen a little off its surface?
    fn sees(&self, p: &Vec3, out: &Vec3) -> bool {
        let [x, y, z] = self.place(&(p + out * (1.3 * self.step)));
        let cell = |v: f64| (v as usize).min(SIDE - 1);
        z + 0.8 * self.step >= self.depth[cell(y) * SIDE + cell(x)]
    }
}
