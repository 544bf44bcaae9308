//! The figures a pattern maker reads, from original, flat and surface positions.

use super::align::{Rigid, angle_between};
use super::features::{Chain, ChainPair, Features};
use super::metric::{edges2, edges3};
use nalgebra::{Matrix2, Matrix3x2};
use toile_garment::flat::{DartChange, LengthChange, StrainMap};
use toile_garment::{Vec2, Vec3};

/// A third of the area of its triangles for every vertex.
#[must_use]
pub fn vertex_areas(rest: &[Vec2], triangles: &[[u32; 3]]) -> Vec<f64> {
    let mut out = vec![0.0; rest.len()];
    for t in triangles {
        let third = edges2(rest, *t).determinant().abs() / 6.0;
        for v in t {
            out[*v as usize] += third;
        }
    }
    out
}

/// Area of triangles in the plane, m².
#[must_use]
pub fn area2(p: &[Vec2], triangles: &[[u32; 3]]) -> f64 {
    triangles.iter().map(|t| 0.5 * edges2(p, *t).determinant()).sum()
}

/// Area of triangles in space, m².
#[must_use]
pub fn area3(p: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    triangles
        .iter()
        .map(|t| {
            let e = edges3(p, *t);
            0.5 * e.column(0).cross(&e.column(1)).norm()
        })
        .sum()
}

/// Length of a chain in the plane.
#[must_use]
pub fn length2(p: &[Vec2], chain: &[u32]) -> f64 {
    chain.windows(2).map(|w| (p[w[1] as usize] - p[w[0] as usize]).norm()).sum()
}

fn length3(p: &[Vec3], chain: &[u32]) -> f64 {
    chain.windows(2).map(|w| (p[w[1] as usize] - p[w[0] as usize]).norm()).sum()
}

/// Lengths of all edges, as long as they are drawn.
#[must_use]
pub fn lengths(features: &Features, rest: &[Vec2], flat: &[Vec2], surface: &[Vec3]) -> Vec<LengthChange> {
    let change = |edge: &Chain| LengthChange {
        name: edge.name.clone(),
        original: edge.scale * length2(rest, &edge.vertices),
        flat: edge.scale * length2(flat, &edge.vertices),
        surface: edge.scale * length3(surface, &edge.vertices),
    };
    features.edges.iter().map(change).collect()
}

/// Angle, width and legs of a dart before and after.
#[must_use]
pub fn dart(legs: &ChainPair, rest: &[Vec2], flat: &[Vec2]) -> DartChange {
    let [a, b] = legs.scale;
    DartChange {
        name: legs.name.clone(),
        angle: [opening(legs, rest), opening(legs, flat)],
        width: [mouth(legs, rest), mouth(legs, flat)],
        legs: [
            a * length2(rest, &legs.a),
            b * length2(rest, &legs.b),
            a * length2(flat, &legs.a),
            b * length2(flat, &legs.b),
        ],
    }
}

fn ends(p: &[Vec2], chain: &[u32]) -> Option<(Vec2, Vec2)> {
    Some((p[*chain.first()? as usize], p[*chain.last()? as usize]))
}

fn opening(legs: &ChainPair, p: &[Vec2]) -> f64 {
    match (ends(p, &legs.a), ends(p, &legs.b)) {
        (Some((a, apex_a)), Some((b, apex_b))) => angle_between(a - apex_a, b - apex_b).abs(),
        _ => 0.0,
    }
}

fn mouth(legs: &ChainPair, p: &[Vec2]) -> f64 {
    match (ends(p, &legs.a), ends(p, &legs.b)) {
        (Some((a, _)), Some((b, _))) => (b - a).norm(),
        _ => 0.0,
    }
}

/// Turn of the grain line inside the piece: its direction after the best fit of the whole piece, radians.
#[must_use]
pub fn grain_shift(features: &Features, rest: &[Vec2], flat: &[Vec2], weight: &[f64]) -> f64 {
    let Some([a, b]) = features.grain.map(|g| g.map(|v| v as usize)) else { return 0.0 };
    let fit = Rigid::best(flat, rest, weight);
    angle_between(rest[b] - rest[a], fit.apply(flat[b]) - fit.apply(flat[a]))
}

/// Strain along warp and weft and shear of every triangle, from a piece in the plane to the surface.
#[must_use]
pub fn strain(plane: &[Vec2], surface: &[Vec3], triangles: &[[u32; 3]], warp: Vec2) -> StrainMap {
    let weft = Vec2::new(-warp.y, warp.x);
    let mut map = StrainMap::default();
    for t in triangles {
        let f: Matrix3x2<f64> = match edges2(plane, *t).try_inverse() {
            Some(inverse) => edges3(surface, *t) * inverse,
            None => Matrix3x2::zeros(),
        };
        let (along, across) = (f * warp, f * weft);
        let lengths = along.norm() * across.norm();
        map.warp.push(along.norm() - 1.0);
        map.weft.push(across.norm() - 1.0);
        map.shear.push(if lengths > 0.0 { libm::asin((along.dot(&across) / lengths).clamp(-1.0, 1.0)) } else { 0.0 });
    }
    map
}

/// Angle defect summed over inner vertices, radians, of triangles given by their edge vectors.
#[must_use]
pub fn enclosed_defect(vertices: usize, triangles: &[[u32; 3]], target: &[Matrix2<f64>]) -> f64 {
    let mut angle = vec![0.0; vertices];
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (t, e) in triangles.iter().zip(target) {
        let p = [Vec2::zeros(), e.column(0).into_owned(), e.column(1).into_owned()];
        for k in 0..3 {
            let (here, next, last) = (p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
            angle[t[k] as usize] += angle_between(next - here, last - here).abs();
            let (a, b) = (t[k], t[(k + 1) % 3]);
            sides.push([a.min(b), a.max(b)]);
        }
    }
    let mut inner: Vec<bool> = angle.iter().map(|a| *a > 0.0).collect();
    sides.sort_unstable();
    for side in sides.chunk_by(|a, b| a == b).filter(|c| c.len() == 1) {
        for v in side[0] {
            inner[v as usize] = false;
        }
    }
    angle.iter().zip(&inner).filter(|(_, inner)| **inner).map(|(a, _)| std::f64::consts::TAU - a).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_point_has_the_defect_of_the_missing_wedge() {
        // Five equilateral triangles round a vertex: 60 degrees are missing.
        let triangles: Vec<[u32; 3]> = (0..5).map(|k| [0, 1 + k, 1 + (k + 1) % 5]).collect();
        let e = Matrix2::new(1.0, 0.5, 0.0, 0.75f64.sqrt());
        let defect = enclosed_defect(6, &triangles, &[e; 5]);
        assert!((defect - std::f64::consts::PI / 3.0).abs() < 1e-14);
    }

    #[test]
    fn strain_is_measured_along_the_grain() {
        let rest = [Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];
        let surface = [Vec3::zeros(), Vec3::new(1.05, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.98)];
        let map = strain(&rest, &surface, &[[0, 1, 2]], Vec2::new(0.0, 1.0));
        assert!((map.warp[0] + 0.02).abs() < 1e-15 && (map.weft[0] - 0.05).abs() < 1e-15);
        assert!(map.shear[0].abs() < 1e-15);
    }
}
