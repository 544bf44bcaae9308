//! Lengths of lines of the cloth, at rest and as it is worn: along a seam, and along a straight line on a piece.

use toile_garment::mesh::PieceMesh;
use toile_garment::{Vec2, Vec3};

/// A length of the cloth, metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lengths {
    /// At rest, as the pattern has it.
    pub rest: f64,
    /// Along the worn cloth.
    pub worn: f64,
}

impl std::ops::AddAssign for Lengths {
    fn add_assign(&mut self, other: Self) {
        self.rest += other.rest;
        self.worn += other.worn;
    }
}

/// The cloth of a piece: its mesh, and where each vertex is worn.
#[derive(Clone, Copy)]
pub struct Cloth<'a> {
    /// Mesh at rest.
    pub mesh: &'a PieceMesh,
    /// Worn positions, metres.
    pub worn: &'a [Vec3],
}

impl Cloth<'_> {
    /// Length of an edge of the mesh.
    #[must_use]
    pub fn edge(&self, [a, b]: [u32; 2]) -> Option<Lengths> {
        let rest = |v: u32| self.mesh.rest.get(v as usize);
        let worn = |v: u32| self.worn.get(v as usize);
        Some(Lengths { rest: (rest(b)? - rest(a)?).norm(), worn: (worn(b)? - worn(a)?).norm() })
    }

    /// Length of the cloth along the straight line through a point of the piece. `None` where the line meets no cloth.
    #[must_use]
    pub fn line(&self, through: Vec2, along: Vec2) -> Option<Lengths> {
        let mut sum = Lengths::default();
        for (t, triangle) in self.mesh.triangles.iter().enumerate() {
            let drawn = triangle.map(|v| self.mesh.rest.get(v as usize).copied().unwrap_or(through));
            let side = drawn.map(|p| along.perp(&(p - through)));
            let mut cuts = (0..3).filter(|k| (side[*k] < 0.0) != (side[(*k + 1) % 3] < 0.0)).map(|k| {
                let share = side[k] / (side[k] - side[(k + 1) % 3]);
                (k, share)
            });
            let (Some(from), Some(to)) = (cuts.next(), cuts.next()) else { continue };
            let rest = self.mesh.rest_triangle(t)?;
            let worn = triangle.map(|v| self.worn.get(v as usize).copied().unwrap_or_else(Vec3::zeros));
            let flat = |(k, share): (usize, f64)| rest[k].lerp(&rest[(k + 1) % 3], share);
            let high = |(k, share): (usize, f64)| worn[k].lerp(&worn[(k + 1) % 3], share);
            sum += Lengths { rest: (flat(to) - flat(from)).norm(), worn: (high(to) - high(from)).norm() };
        }
        (sum.rest > 0.0).then_some(sum)
    }

    /// The middle of the piece by its area, in the coordinates it is drawn in.
    #[must_use]
    pub fn middle(&self) -> Option<Vec2> {
        let mut sum = (Vec2::zeros(), 0.0);
        for triangle in &self.mesh.triangles {
            let [a, b, c] = triangle.map(|v| self.mesh.rest.get(v as usize).copied().unwrap_or_else(Vec2::zeros));
            let area = 0.5 * (b - a).perp(&(c - a)).abs();
            sum = (sum.0 + (a + b + c) * (area / 3.0), sum.1 + area);
        }
        (sum.1 > 0.0).then(|| sum.0 / sum.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_vertices_and_along_edges_is_measured_once() {
        let rest: Vec<Vec2> = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.0, 0.1]].map(Vec2::from).to_vec();
        let worn: Vec<Vec3> = rest.iter().map(|p| Vec3::new(1.1 * p.x, 0.9 * p.y, 0.3)).collect();
        let mesh = PieceMesh { rest, triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() };
        let cloth = Cloth { mesh: &mesh, worn: &worn };
        assert_eq!(cloth.middle().map(|p| (p - Vec2::new(0.1, 0.05)).norm() < 1e-12), Some(true));
        let near = |found: Option<Lengths>, rest: f64, worn: f64| {
            let l = found.expect("cloth");
            assert!((l.rest - rest).abs() < 1e-12 && (l.worn - worn).abs() < 1e-12, "{l:?}");
        };
        near(cloth.line(Vec2::new(0.1, 0.05), Vec2::x()), 0.2, 0.22);
        near(cloth.line(Vec2::new(0.1, 0.05), Vec2::y()), 0.1, 0.09);
        near(cloth.line(Vec2::zeros(), Vec2::new(2.0, 1.0)), 0.05_f64.sqrt(), libm::hypot(0.22, 0.09));
        assert_eq!(cloth.line(Vec2::new(0.1, 0.2), Vec2::x()), None);
        near(cloth.edge([1, 2]), 0.1, 0.09);
    }
}
