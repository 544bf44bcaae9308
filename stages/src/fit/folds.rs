//! Folds of a free edge: the hollows between its outline and the taut line around it.

use super::{Hem, Surface};
use crate::body::section::hull;
use std::collections::BTreeMap;
use toile_garment::{Vec2, Vec3};

/// A hollow that is less deep is no fold, m: a tenth of a deep one, and more than an edge of a mesh cuts off.
const LEAST_DEPTH: f64 = 5e-3;

/// Depths of the folds of a free edge that runs around, the deepest first, m. The edge is looked at along the axis around which
/// it runs. Hem and fronts of an open garment are one edge, of which this says little.
#[must_use]
pub fn folds(surface: &Surface, hem: &Hem) -> Vec<f64> {
    let Some(ring) = ring(surface, hem) else { return Vec::new() };
    let flat = flattened(&ring);
    let taut = taut(&flat);
    let mut depths: Vec<f64> = (0..taut.len())
        .map(|k| hollow(&flat, taut[k], taut[(k + 1) % taut.len()]))
        .filter(|depth| *depth >= LEAST_DEPTH)
        .collect();
    depths.sort_by(|a, b| b.total_cmp(a));
    depths
}

/// The places of a free edge in their order around; `None` where it is no single ring.
fn ring(surface: &Surface, hem: &Hem) -> Option<Vec<Vec3>> {
    let ends = |(t, k): &(usize, usize)| [0, 1].map(|end| surface.triangles[*t][(k + end) % 3]);
    let next: BTreeMap<u32, u32> = hem.edges.iter().map(|e| ends(e).into()).collect();
    let first = *next.keys().next()?;
    let mut all = vec![first];
    while let Some(to) = next.get(all.last()?).filter(|to| **to != first && all.len() < next.len()) {
        all.push(*to);
    }
    let is_whole = all.len() == hem.edges.len() && next.get(all.last()?) == Some(&first);
    is_whole.then(|| all.iter().map(|v| surface.points[*v as usize]).collect())
}

/// A ring seen along the axis around which it runs.
fn flattened(ring: &[Vec3]) -> Vec<Vec2> {
    let around = |k: usize| ring[k].cross(&ring[(k + 1) % ring.len()]);
    let axis = (0..ring.len()).map(around).sum::<Vec3>().try_normalize(0.0).unwrap_or_else(Vec3::y);
    let side = if axis.x.abs() < 0.7 { Vec3::x() } else { Vec3::z() };
    let u = (side - axis * axis.dot(&side)).normalize();
    let v = axis.cross(&u);
    ring.iter().map(|p| Vec2::new(p.dot(&u), p.dot(&v))).collect()
}

/// Numbers of the corners of the taut line around some places, in the order of the places.
fn taut(flat: &[Vec2]) -> Vec<usize> {
    let corners = hull(flat.to_vec());
    (0..flat.len()).filter(|k| corners.contains(&flat[*k])).collect()
}

/// Depth of the outline between two corners of the taut line that follow each other.
fn hollow(flat: &[Vec2], from: usize, to: usize) -> f64 {
    let along = flat[to] - flat[from];
    let length = libm::hypot(along.y, along.x).max(f64::MIN_POSITIVE);
    let between = (1..flat.len()).map(|step| (from + step) % flat.len()).take_while(|k| *k != to);
    between.map(|k| along.perp(&(flat[k] - flat[from])).abs() / length).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::tube;
    use super::*;

    /// A tube whose lower hem has so many waves, leaning against the vertical.
    fn waved(waves: f64, height: f64, lean: f64) -> Vec<f64> {
        let mut surface = tube(360, 4, 0.3, 0.7);
        for p in &mut surface.points {
            let out = 1.0 + height / 0.3 * (1.0 - p.y / 0.7) * libm::cos(waves * libm::atan2(p.z, p.x));
            (p.x, p.z) = (1.4 * p.x * out, p.z * out);
            p.y += lean * p.x;
        }
        folds(&surface, &surface.hems()[0])
    }

    #[test]
    fn waves_of_a_hem_are_its_folds() {
        for lean in [0.0, 0.8] {
            let deep = waved(5.0, 0.04, lean);
            assert_eq!(deep.len(), 5, "{deep:?}");
            assert!(deep[0] > 0.04 && deep[4] > 0.03 && deep.is_sorted_by(|a, b| a >= b), "{deep:?}");
        }
        assert!(waved(5.0, 0.0, 0.0).is_empty(), "an oval has none");
        assert!(waved(9.0, 0.001, 0.0).is_empty(), "ripples are none");
    }
}
