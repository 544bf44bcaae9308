//! The `regular` mesher: lattice, constrained Delaunay triangulation, smoothing.

use super::cdt::{CdtError, Spade, Triangulator};
use super::check::sharp_vertices;
use super::edge_use::triangles_at;
use super::lattice;
use super::layout::Layout;
use super::region;
use super::repair::repair;
use super::smooth;
use toile_garment::Vec2;

const CENTROID_PASSES: usize = 3;
const ANGLE_PASSES: usize = 4;

/// Points (fixed ones first) and cloth triangles.
pub type Filled = (Vec<Vec2>, Vec<[u32; 3]>);

/// Why a layout could not be filled.
#[derive(Clone, Debug, PartialEq)]
pub enum FillError {
    /// Edges that cross others, as vertex pairs.
    Conflicts(Vec<[u32; 2]>),
    /// The cloth touches itself at one of these edges.
    Touches(Vec<[u32; 2]>),
    /// Points that coincide.
    Points,
}

impl From<CdtError> for FillError {
    fn from(e: CdtError) -> Self {
        match e {
            CdtError::Conflicts(c) => Self::Conflicts(c),
            CdtError::Points => Self::Points,
        }
    }
}

/// Fills a layout. `rows` is the unit direction of the lattice's rows.
///
/// # Errors
/// When lines cross or touch.
pub fn fill(layout: &Layout, edges: &[[u32; 2]], h: f64, rows: Vec2) -> Result<Filled, FillError> {
    let boundary = layout.segments(super::curve::CurveKind::bounds_cloth);
    let lines = layout.segments(|_| true);
    let mut points = layout.points.clone();
    // Lines alone first: a crossing is found before the lattice is laid.
    cloth(&points, edges, layout)?;
    points.extend(lattice::hexagonal(&boundary, &lines, h, rows, middle(&layout.points)));
    let triangles = cloth(&points, edges, layout)?;
    let fixed = layout.points.len();
    let again = |points: &[Vec2]| cloth(points, edges, layout);
    let mesh = smoothed(fixed, (points, triangles), CENTROID_PASSES, ANGLE_PASSES, again)?;
    Ok(repair(edges, fixed, &sharp_vertices(layout), mesh))
}

/// Moves the vertices after the first `fixed`, and asks for the triangles again after every pass.
///
/// # Errors
/// Those of `triangulate`.
pub fn smoothed(
    fixed: usize,
    (mut points, mut triangles): Filled,
    centroids: usize,
    angles: usize,
    triangulate: impl Fn(&[Vec2]) -> Result<Vec<[u32; 3]>, FillError>,
) -> Result<Filled, FillError> {
    for pass in 0..centroids + angles {
        if points.len() == fixed {
            break;
        }
        if pass < centroids {
            smooth::centroids(&mut points, &triangles, fixed);
        } else {
            smooth::widen_angles(&mut points, &triangles, fixed);
        }
        triangles = triangulate(&points)?;
    }
    Ok((points, triangles))
}

/// Cloth triangles of points and edges.
pub fn cloth(points: &[Vec2], edges: &[[u32; 2]], layout: &Layout) -> Result<Vec<[u32; 3]>, FillError> {
    let hull = Spade.triangulate(points, edges)?;
    let missing = missing(&hull, edges);
    if !missing.is_empty() {
        return Err(FillError::Conflicts(missing));
    }
    region::cloth(points, &hull, layout).map_err(FillError::Touches)
}

/// Edges that are no edge of any triangle.
pub fn missing(triangles: &[[u32; 3]], edges: &[[u32; 2]]) -> Vec<[u32; 2]> {
    let counts = triangles_at(triangles, edges);
    edges.iter().zip(counts).filter(|(_, count)| *count == 0).map(|(edge, _)| *edge).collect()
}

/// Middle of the bounding box; the origin where there is no point.
pub fn middle(points: &[Vec2]) -> Vec2 {
    let first = points.first().copied().unwrap_or_default();
    let (mut low, mut high) = (first, first);
    for p in points {
        low = low.inf(p);
        high = high.sup(p);
    }
    (low + high) * 0.5
}
