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
    let key = gather(model, &cone(key, KEY), Light::OneWay);
    around.iter().cloned().zip(key).map(|(around, key)| Open { around, key }).collect()
}

/// Shares of the light around that arrive at the two sides of every vertex.
#[must_use]
pub fn around(model: &Model) -> Vec<[Vec<f64>; 2]> {
    gather(model, &half_sphere(AROUND / 2), Light::BothWays)
}

/// Directions spread evenly over the upper half of the sphere, unit.
fn half_sphere(count: usize) -> Vec<Vec3> {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    (0..count)
        .map(|k| {
            let y = 1.0 - (k as f64 + 0.5) / count as f64;
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

/// Where light comes from along a direction.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Light {
    /// From its end.
    OneWay,
    /// From both its ends.
    BothWays,
}

/// Light that arrived, and all light that would arrive with nothing in its way.
type Share = [f64; 2];

fn add(share: &mut Share, weight: f64, arrives: bool) {
    share[0] += if arrives { weight } else { 0.0 };
    share[1] += weight;
}

/// Shares of light along some directions that arrive at the two sides of every vertex.
fn gather(model: &Model, directions: &[Vec3], light: Light) -> Vec<[Vec<f64>; 2]> {
    let none = |s: &Surface| [vec![[0.0; 2]; s.positions.len()], vec![[0.0; 2]; s.positions.len()]];
    let mut sums: Vec<[Vec<Share>; 2]> = model.surfaces.iter().map(none).collect();
    for direction in directions {
        let Some(map) = DepthMap::new(model, *direction) else { continue };
        for ((surface, at), sum) in model.surfaces.iter().zip(&map.places).zip(&mut sums) {
            for (i, (at, normal)) in at.iter().zip(&surface.normals).enumerate() {
                let facing = normal.dot(direction);
                let lit = usize::from(facing < 0.0);
                let out = if lit == 0 { *normal } else { -normal };
                add(&mut sum[lit][i], facing.abs(), map.sees(at, &out, 1.0));
                if light == Light::BothWays {
                    add(&mut sum[1 - lit][i], facing.abs(), map.sees(at, &-out, -1.0));
                }
            }
        }
    }
    let share = |[got, all]: Share| if all > 0.0 { got / all } else { 1.0 };
    sums.into_iter().map(|sides| sides.map(|side| side.into_iter().map(share).collect())).collect()
}

/// How far the surfaces reach along a direction, to both sides.
struct DepthMap {
    axes: [Vec3; 3],
    /// Size of a pixel, m.
    step: f64,
    /// Places of the vertices of every surface: pixels across and down, and depth in m.
    places: Vec<Vec<[f64; 3]>>,
    /// Largest and least depth in each pixel, m.
    depth: Vec<[f32; 2]>,
}

impl DepthMap {
    fn new(model: &Model, direction: Vec3) -> Option<Self> {
        let helper = if direction.y.abs() < 0.9 { Vec3::y() } else { Vec3::x() };
        let across = helper.cross(&direction).normalize();
        let axes = [across, direction.cross(&across), direction];
        let project = |p: &Vec3| [p.dot(&axes[0]), p.dot(&axes[1]), p.dot(&axes[2])];
        let mut places: Vec<Vec<[f64; 3]>> =
            model.surfaces.iter().map(|s| s.positions.iter().map(project).collect()).collect();
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for at in places.iter().flatten() {
            for k in 0..2 {
                low[k] = if at[k] < low[k] { at[k] } else { low[k] };
                high[k] = if at[k] > high[k] { at[k] } else { high[k] };
            }
        }
        let wide = if high[0] - low[0] > high[1] - low[1] { high[0] - low[0] } else { high[1] - low[1] };
        if !(wide > 0.0 && wide.is_finite()) {
            return None;
        }
        let step = wide / (SIDE - 2) as f64;
        for at in places.iter_mut().flatten() {
            (0..2).for_each(|k| at[k] = (at[k] - low[k]) / step + 1.0);
        }
        let mut map = Self { axes, step, places, depth: vec![[f32::NEG_INFINITY, f32::INFINITY]; SIDE * SIDE] };
        map.draw(model);
        Some(map)
    }

    fn draw(&mut self, model: &Model) {
        let depth = &mut self.depth;
        for (surface, at) in model.surfaces.iter().zip(&self.places) {
            for t in &surface.triangles {
                super::raster::cover(t.map(|i| at[i as usize]), [0, SIDE as i64], SIDE as i64, |x, y, _, z| {
                    let [most, least] = &mut depth[y * SIDE + x];
                    let z = z as f32;
                    *most = if z > *most { z } else { *most };
                    *least = if z < *least { z } else { *least };
                });
            }
        }
    }

    /// Is nothing in front of a point, seen a little off its surface? `way` is 1 for a look from the end of the direction
    /// and -1 for one from its start.
    fn sees(&self, at: &[f64; 3], out: &Vec3, way: f64) -> bool {
        let moved = |k: usize| at[k] + 1.3 * out.dot(&self.axes[k]);
        let cell = |v: f64| (v as usize).min(SIDE - 1);
        let [most, least] = self.depth[cell(moved(1)) * SIDE + cell(moved(0))].map(f64::from);
        let front = if way > 0.0 { most } else { -least };
        way * (at[2] + 1.3 * self.step * out.dot(&self.axes[2])) + 0.8 * self.step >= front
    }
}
