//! The edge length of the mesh, and the limit on triangles.

use super::Params;
use crate::sewing::shapes::Shapes;
use toile_garment::dart::DartKind;
use toile_garment::{Diagnostic, Garment};
use toile_stage_api::StageError;

/// Edge length when nothing is asked.
pub const DEFAULT: f64 = 12e-3;
/// More triangles than this are refused before any work.
const MOST: f64 = 5e6;

/// Edge length for the parameters.
pub fn edge_length(params: &Params, garment: &Garment, shapes: &Shapes) -> Result<f64, StageError> {
    let area = cloth_area(garment, shapes);
    let wrong =
        |message: String, hint: &str| Err(StageError::parameter(Diagnostic::error("edge-length", message).hint(hint)));
    let h = match (params.edge_length, params.triangles) {
        (Some(_), Some(_)) => {
            return wrong("edge_length and triangles are both given".to_owned(), "give one of them");
        }
        (Some(length), None) => length.0,
        (None, Some(0)) => return wrong("triangles cannot be 0".to_owned(), "e.g. triangles = 2200"),
        (None, Some(n)) => (4.0 * area / (3_f64.sqrt() * f64::from(n))).sqrt(),
        (None, None) => DEFAULT,
    };
    if !(h.is_finite() && h > 0.0 && params.angle.0.is_finite()) {
        return wrong(format!("the edge length {} mm cannot be", h * 1e3), "e.g. edge_length = \"12 mm\"");
    }
    let triangles = 4.0 * area / (3_f64.sqrt() * h * h);
    let edges: f64 = shapes.iter().flat_map(|s| &s.rings).map(|r| r.total() / h).sum();
    if triangles > MOST || edges > MOST {
        return Err(StageError::Limit(format!(
            "an edge length of {:.4} mm makes about {:.1e} triangles, over the limit of {MOST:.0e}; use a longer edge_length",
            h * 1e3,
            triangles.max(edges)
        )));
    }
    let widest = shapes.iter().filter_map(|s| s.rings.first()).map(|r| 0.5 * r.total()).fold(0.0, f64::max);
    if h > widest {
        return wrong(
            format!(
                "the edge length {:.1} mm is longer than half the outline of every piece ({:.1} mm)",
                h * 1e3,
                widest * 1e3
            ),
            "use a shorter edge_length, e.g. \"12 mm\"",
        );
    }
    Ok(h)
}

/// Refuses too many edges on lines.
pub fn check_total(edges: usize) -> Result<(), StageError> {
    if edges as f64 > MOST {
        return Err(StageError::Limit(format!(
            "the lines of the pieces alone need {edges} edges; use a longer edge_length"
        )));
    }
    Ok(())
}

/// Area of all pieces without intakes and cutouts.
fn cloth_area(garment: &Garment, shapes: &Shapes) -> f64 {
    let area = |points: &[toile_garment::Vec2]| super::lines::signed_area(points).abs();
    garment
        .pieces
        .iter()
        .zip(shapes)
        .map(|(piece, shape)| {
            let rings = shape.rings.iter().enumerate();
            let rings: f64 = rings.map(|(k, r)| if k == 0 { area(&r.points) } else { -area(&r.points) }).sum();
            let fish: f64 = piece
                .darts
                .iter()
                .filter(|d| d.kind == DartKind::FishEye)
                .map(|d| area(&d.legs[0].iter().chain(d.legs[1].iter().rev()).copied().collect::<Vec<_>>()))
                .sum();
            (rings - fish).max(0.0)
        })
        .sum()
}
