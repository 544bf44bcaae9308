//! Advice to a pattern maker about a piece that cannot lie flat.

use toile_garment::flat::FlatPiece;
use toile_garment::mesh::PieceMesh;
use toile_garment::{Piece, Vec2};

/// Curvature that adds up to less than this is none, degrees.
const NO_CURVATURE: f64 = 0.5;
/// Widest single dart or slash that is advised, degrees. A wider one is drawn as a seam.
const WIDEST_ALONE: f64 = 30.0;

/// The cure: where, and how many millimetres at which edge.
pub fn cure(piece: &Piece, mesh: &PieceMesh, flat: &FlatPiece) -> String {
    let degrees = flat.curvature.to_degrees();
    let Some((place, edge, way)) = worst(piece, mesh, flat) else {
        return "a seam across the piece would cure it".to_owned();
    };
    let at = format!("({:.0}, {:.0}) mm", 1e3 * place.x, 1e3 * place.y);
    let width = 2e3 * way * libm::tan(0.5 * degrees.abs().min(90.0).to_radians());
    if degrees.abs() < NO_CURVATURE {
        format!("the strain is largest at {at}; a seam from there to {edge} would cure it, a dart would not")
    } else if degrees > WIDEST_ALONE {
        let count = (degrees / WIDEST_ALONE).ceil();
        format!(
            "{count:.0} darts of {:.0} degrees each with their apexes near {at}, or a seam through that place, would cure it",
            degrees / count
        )
    } else if degrees < -WIDEST_ALONE {
        format!(
            "that is too much to spread at one place: draw a seam through {at}, where the strain is largest, and flare \
             both its sides, or gather the cloth into it"
        )
    } else if degrees > 0.0 {
        format!("a dart from {edge} with its apex near {at}, {width:.0} mm wide at the edge, would cure it")
    } else {
        format!(
            "slash from {edge} to {at} and spread it by {width:.0} mm at the edge (or set a godet of that width in)"
        )
    }
}

/// The place of the largest strain, the edge next to it in words, and the way between them, metres.
fn worst(piece: &Piece, mesh: &PieceMesh, flat: &FlatPiece) -> Option<(Vec2, String, f64)> {
    let strain = |k: &usize| {
        let [warp, weft] = [&flat.flat_strain.warp, &flat.flat_strain.weft].map(|m| m.get(*k).copied().unwrap_or(0.0));
        warp.abs().max(weft.abs())
    };
    let k = (0..mesh.triangles.len()).max_by(|a, b| strain(a).total_cmp(&strain(b)))?;
    let corners = mesh.triangles[k].map(|v| mesh.rest[v as usize]);
    let place = (corners[0] + corners[1] + corners[2]) / 3.0;
    let points = piece.outline.positions();
    let n = points.len();
    let away = |edge: &toile_garment::outline::OutlineEdge| {
        let (from, to) = (edge.from as usize, edge.to as usize);
        let steps = if n == 0 { 0 } else { (to + n - from) % n };
        (0..=steps).map(|s| (points[(from + s) % n] - place).norm()).fold(f64::INFINITY, f64::min)
    };
    let edge = piece.edges.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let name = edge.name.as_ref().map_or_else(|| format!("edge {}", edge.index), |n| format!("`{n}`"));
    Some((place, name, away(edge)))
}
