//! Girths of a surface: along the cloth, and as a measuring tape around it shows them.

use super::surface::Surface;
use crate::body::hull;
use toile_garment::Vec2;

/// Length of the cloth around at a height, along every fold, metres; 0 where the height cuts no cloth.
#[must_use]
pub fn along(surface: &Surface, height: f64) -> f64 {
    cuts(surface, height).map(|[a, b]| (b - a).norm()).sum()
}

/// Length of a tape laid around the cloth at a height, which bridges folds, metres; 0 where the height cuts no cloth.
#[must_use]
pub fn tape(surface: &Surface, height: f64) -> f64 {
    let hull = hull(cuts(surface, height).flatten().collect());
    (0..hull.len()).map(|i| (hull[(i + 1) % hull.len()] - hull[i]).norm()).sum()
}

/// The segments in which a height cuts the triangles, seen from above.
fn cuts(surface: &Surface, height: f64) -> impl Iterator<Item = [Vec2; 2]> {
    (0..surface.triangles.len()).filter_map(move |triangle| {
        let corners = surface.corners(triangle);
        let mut ends = [(0, 1), (1, 2), (2, 0)].into_iter().filter_map(|(a, b)| {
            let (a, b) = (corners[a], corners[b]);
            let t = (height - a.y) / (b.y - a.y);
            ((a.y < height) != (b.y < height)).then(|| Vec2::new(a.x + t * (b.x - a.x), a.z + t * (b.z - a.z)))
        });
        Some([ends.next()?, ends.next()?])
    })
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::tube;
    use super::*;

    #[test]
    fn a_tape_lies_around_a_tube() {
        let around = tube(720, 4, 0.15, 1.0);
        for girth in [tape(&around, 0.4), along(&around, 0.4)] {
            assert!((girth - std::f64::consts::TAU * 0.15).abs() < 1e-5, "{girth}");
        }
        assert_eq!((tape(&around, 1.5), along(&around, 1.5)), (0.0, 0.0));
    }

    #[test]
    fn a_tape_bridges_a_hollow() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.2], [0.0, 1.0]].map(Vec2::from);
        let around = hull(square.to_vec());
        assert_eq!(around.len(), 4);
        assert!(!around.contains(&Vec2::new(1.0, 0.2)));
    }
}
