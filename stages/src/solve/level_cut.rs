//! A piece of cloth in a level plane.

use toile_garment::Vec3;
use toile_garment::mesh::PieceMesh;

/// The lines in which the triangles of a piece are cut by the level plane at a height, each with its ends, m, and its length
/// in the cloth at rest, m. `at`: positions of the vertices, m.
pub fn level_cut(mesh: &PieceMesh, at: &[Vec3], height: f64) -> impl Iterator<Item = ([Vec3; 2], f64)> {
    mesh.triangles.iter().enumerate().filter_map(move |(i, t)| {
        let (place, rest) = (t.map(|v| at[v as usize]), mesh.rest_triangle(i)?);
        let mut ends = (0..3).filter_map(|k| {
            let (p, q) = (place[k], place[(k + 1) % 3]);
            let share = (height - p.y) / (q.y - p.y);
            ((p.y < height) != (q.y < height)).then(|| (p.lerp(&q, share), rest[k].lerp(&rest[(k + 1) % 3], share)))
        });
        let (from, to) = (ends.next()?, ends.next()?);
        Some(([from.0, to.0], (to.1 - from.1).norm()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::Vec2;

    #[test]
    fn a_square_is_cut_along_its_width_whatever_it_is_stretched_to() {
        let rest = vec![Vec2::new(0.0, 0.0), Vec2::new(0.3, 0.0), Vec2::new(0.3, 0.3), Vec2::new(0.0, 0.3)];
        let at: Vec<Vec3> = rest.iter().map(|p| Vec3::new(1.5 * p.x, p.y, 0.1)).collect();
        let mesh = PieceMesh { rest, triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() };
        let cut: Vec<_> = level_cut(&mesh, &at, 0.1).collect();
        assert_eq!(cut.len(), 2);
        assert!((cut.iter().map(|(_, length)| length).sum::<f64>() - 0.3).abs() < 1e-12);
        let now: f64 = cut.iter().map(|([p, q], _)| (q - p).norm()).sum();
        assert!((now - 0.45).abs() < 1e-12, "{now}");
        assert_eq!(level_cut(&mesh, &at, 0.5).count(), 0);
    }
}
