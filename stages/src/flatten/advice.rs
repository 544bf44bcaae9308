//! Advice to a pattern maker about a piece that cannot lie flat.

use toile_garment::flat::FlatPiece;
use toile_garment::mesh::PieceMesh;
use toile_garment::{Piece, Vec2};

/// Curvature that adds up to less than this is none, degrees.
const NO_CURVATURE: f64 = 0.5;
/// Widest single dart or slash that is advised, degrees. A wider one is drawn as a seam.
const WIDEST_ALONE: f64 = 30.0;

/// Narrowest dart or slash that is advised, mm. A narrower one cannot be cut.
const NARROWEST: f64 = 1.0;
/// A place this near to an edge lies beside it: nothing can be cut from the edge to there, metres.
const BESIDE: f64 = 5e-3;

/// The curvature that a piece encloses, degrees; 0 where it adds up to none.
pub fn enclosed(flat: &FlatPiece) -> f64 {
    let degrees = flat.curvature.to_degrees();
    if degrees.abs() < NO_CURVATURE { 0.0 } else { degrees }
}

/// The cure: where, and how many millimetres at which edge.
pub fn cure(piece: &Piece, mesh: &PieceMesh, flat: &FlatPiece) -> String {
    let degrees = enclosed(flat);
    let Some((place, edge, way)) = worst(piece, mesh, flat) else {
        return "a seam across the piece would cure it".to_owned();
    };
    let at = format!("({:.0}, {:.0}) mm", 1e3 * place.x, 1e3 * place.y);
    let width = 2e3 * way * libm::tan(0.5 * degrees.abs().min(90.0).to_radians());
    if degrees > WIDEST_ALONE {
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
    } else if way < BESIDE {
        format!(
            "the strain is largest at {at}, beside {edge}: ease the cloth in there, or spread the edit over more of it"
        )
    } else if degrees == 0.0 {
        format!("the strain is largest at {at}; a seam from there to {edge} would cure it, a dart would not")
    } else if width < NARROWEST {
        format!(
            "the strain is largest at {at}; a dart from {edge} would be narrower than {NARROWEST:.0} mm there, so ease \
             the cloth in"
        )
    } else if degrees > 0.0 {
        format!("a dart from {edge} with its apex near {at}, {width:.0} mm wide at the edge, would cure it")
    } else {
        format!(
            "slash from {edge} to {at} and spread it by {width:.0} mm at the edge (or set a godet of that width in)"
        )
    }
}

/// Distance of a point from the straight line between two others.
fn to_side(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let d = b - a;
    let t = ((p - a).dot(&d) / d.norm_squared().max(1e-24)).clamp(0.0, 1.0);
    (a + d * t - p).norm()
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
        let at = |s: usize| points[(from + s) % n];
        (0..steps).map(|s| to_side(place, at(s), at(s + 1))).fold(f64::INFINITY, f64::min)
    };
    let edge = piece.edges.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let label = edge.name.clone().unwrap_or_else(|| edge.index.to_string());
    let name = format!("`{}.{label}`", piece.name);
    Some((place, name, away(edge)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::piece;
    use toile_garment::flat::StrainMap;

    /// A square of 100 mm whose triangle of the largest strain is this far from its lower edge.
    fn cure_of(degrees: f64, way: f64) -> String {
        let square = piece(0, "sheet", &[(0.0, 0.0, 't'), (100.0, 0.0, 't'), (100.0, 100.0, 't'), (0.0, 100.0, 't')]);
        let rest = [(0.05, way), (0.051, way), (0.05, way)].map(|(x, y)| Vec2::new(x, y)).to_vec();
        let mesh = PieceMesh { rest, triangles: vec![[0, 1, 2]], ..PieceMesh::default() };
        let flat = FlatPiece {
            piece: toile_garment::PieceId(0),
            positions: Vec::new(),
            area: [0.0; 3],
            edges: Vec::new(),
            darts: Vec::new(),
            grain_shift: 0.0,
            drape_strain: StrainMap::default(),
            flat_strain: StrainMap::default(),
            rounds: 0,
            last_motion: 0.0,
            curvature: degrees.to_radians(),
            forced_strain: [0.0; 2],
        };
        cure(&square, &mesh, &flat)
    }

    #[test]
    fn nothing_is_advised_that_cannot_be_cut() {
        assert!(cure_of(-4.7, 0.001).contains("beside `sheet.0`"), "{}", cure_of(-4.7, 0.001));
        assert!(cure_of(-0.4, 0.001).contains("beside `sheet.0`"));
        assert!(cure_of(0.6, 0.05).contains("narrower than 1 mm"), "{}", cure_of(0.6, 0.05));
        assert!(cure_of(-0.04, 0.05).contains("a seam from there"));
        assert!(cure_of(10.0, 0.05).contains("9 mm wide"), "{}", cure_of(10.0, 0.05));
        assert!(cure_of(-10.0, 0.05).contains("spread it by 9 mm"));
    }
}
