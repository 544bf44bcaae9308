//! The forecast of `import-mesh`: the mesh is there already, and is measured.

use toile_garment::Garment;
use toile_stage_api::MeshSize;

/// Size of the mesh in the garment; `None` where there is none.
pub(super) fn measure(garment: &Garment) -> Option<MeshSize> {
    let meshes = || garment.pieces.iter().filter_map(|p| p.mesh.as_ref());
    let triangles: usize = meshes().map(|m| m.triangles.len()).sum();
    let area: f64 = meshes()
        .flat_map(|m| (0..m.triangles.len()).filter_map(|t| m.rest_triangle(t)))
        .map(|[a, b, c]| 0.5 * (b - a).perp(&(c - a)).abs())
        .sum();
    let triangles = triangles as f64;
    // A triangle of edge h covers √3/4 h².
    (triangles > 0.0).then(|| MeshSize { triangles, edge: (area / (0.25 * 3_f64.sqrt() * triangles)).sqrt() })
}
