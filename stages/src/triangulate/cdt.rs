//! The constrained Delaunay triangulation, behind one small trait so that the library can be exchanged.

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};
use toile_garment::Vec2;

/// Why points and edges could not be triangulated.
#[derive(Clone, Debug, PartialEq)]
pub enum CdtError {
    /// These edges cross others.
    Conflicts(Vec<[u32; 2]>),
    /// Two points are one, or a coordinate is no number.
    Points,
}

/// Triangulates points so that the given edges are edges of the mesh.
pub trait Triangulator {
    /// Counter-clockwise triangles over the convex hull, in an order that depends on the input only.
    ///
    /// # Errors
    /// When edges cross or points coincide.
    fn triangulate(&self, points: &[Vec2], edges: &[[u32; 2]]) -> Result<Vec<[u32; 3]>, CdtError>;
}

/// The `spade` crate.
pub struct Spade;

impl Triangulator for Spade {
    fn triangulate(&self, points: &[Vec2], edges: &[[u32; 2]]) -> Result<Vec<[u32; 3]>, CdtError> {
        let vertices = points.iter().map(|p| spade::mitigate_underflow(Point2::new(p.x, p.y))).collect();
        let pairs = edges.iter().map(|e| e.map(|v| v as usize)).collect();
        let mut conflicts = Vec::new();
        let cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(vertices, pairs, |e| {
            conflicts.push(e.map(|v| u32::try_from(v).unwrap_or(u32::MAX)));
        })
        .map_err(|_| CdtError::Points)?;
        if cdt.num_vertices() != points.len() {
            return Err(CdtError::Points);
        }
        if !conflicts.is_empty() {
            conflicts.sort_unstable();
            return Err(CdtError::Conflicts(conflicts));
        }
        let mut triangles: Vec<[u32; 3]> = cdt
            .inner_faces()
            .map(|f| lowest_first(f.vertices().map(|v| u32::try_from(v.fix().index()).unwrap_or(u32::MAX))))
            .collect();
        triangles.sort_unstable();
        Ok(triangles)
    }
}

/// The same triangle, its lowest vertex first.
pub fn lowest_first(t: [u32; 3]) -> [u32; 3] {
    let [a, b, c] = t;
    if a < b && a < c {
        t
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
