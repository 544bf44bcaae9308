//! Measures of a scene that every solver needs: masses, areas, weights, lengths, and the gaps of its stitches.

use crate::scene::EARTH;
use crate::scene::topology::Topology;
use crate::{Element, Scene, Vec3};

/// Mass of the cloth at every vertex, kg.
pub(crate) fn masses(scene: &Scene) -> Vec<f64> {
    lumped(scene, |t| scene.materials[t.material as usize].areal_mass * t.area().abs() / 3.0)
}

/// Rest area of the cloth at every vertex, m².
pub(crate) fn areas(scene: &Scene) -> Vec<f64> {
    lumped(scene, |t| t.area().abs() / 3.0)
}

/// Sums at the vertices of a `share` that every triangle gives to each of its corners.
fn lumped(scene: &Scene, share: impl Fn(&Element) -> f64) -> Vec<f64> {
    let mut sum = vec![0.0; scene.positions.len()];
    for t in &scene.triangles {
        let m = share(t);
        for v in t.vertices {
            sum[v as usize] += m;
        }
    }
    sum
}

/// Held vertices and their places, each vertex once, ascending.
pub(crate) fn held(scene: &Scene) -> Vec<(u32, Vec3)> {
    let mut pins: Vec<(u32, Vec3)> = scene.pins.iter().map(|p| (p.vertex, p.at)).collect();
    pins.sort_by_key(|p| p.0);
    pins.dedup_by_key(|p| p.0);
    pins
}

/// A gravity, or the Earth's where there is none, m/s².
pub(crate) fn or_earth(gravity: f64) -> f64 {
    if gravity > 0.0 { gravity } else { EARTH }
}

/// Mean weight of a vertex, N; under the earth's gravity where the scene has none.
pub(crate) fn mean_weight(mass: &[f64], gravity: f64) -> f64 {
    let (sum, n) = mass.iter().filter(|m| **m > 0.0).fold((0.0, 0.0), |(s, n), m| (s + m, n + 1.0));
    if n > 0.0 { sum / n * or_earth(gravity) } else { 0.0 }
}

/// Side of a square of as much cloth as the largest part has, m. Other parts do not count, so that they change nothing.
pub(crate) fn side(scene: &Scene, topology: &Topology) -> f64 {
    let part = topology.components(scene.positions.len());
    let mut areas = vec![0.0; part.len()];
    scene.triangles.iter().for_each(|t| areas[part[t.vertices[0] as usize] as usize] += t.area().abs());
    areas.iter().fold(0.0f64, |a, b| a.max(*b)).sqrt()
}

/// Gaps of all stitches, m, largest first.
pub(crate) fn gaps(scene: &Scene, x: &[Vec3]) -> Vec<(u32, f64)> {
    let mut gaps: Vec<(u32, f64)> =
        (0u32..).zip(&scene.stitches).map(|(i, s)| (i, (x[s[0] as usize] - x[s[1] as usize]).norm())).collect();
    gaps.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    gaps
}

/// Most open stitches that an outcome lists.
pub(crate) const OPEN_STITCHES_MOST: usize = 20;

/// The widest of these gaps that are not closed, as an outcome lists them.
pub(crate) fn open_stitches(gaps: Vec<(u32, f64)>, closed_distance: f64) -> Vec<(u32, f64)> {
    gaps.into_iter().filter(|g| g.1 > closed_distance).take(OPEN_STITCHES_MOST).collect()
}

/// Mean rest length of the triangles' sides, m.
pub(crate) fn mean_edge(scene: &Scene) -> f64 {
    let sum: f64 = scene.triangles.iter().map(|t| (0..3).map(|k| t.rest_length(k)).sum::<f64>()).sum();
    sum / (3.0 * scene.triangles.len().max(1) as f64)
}
