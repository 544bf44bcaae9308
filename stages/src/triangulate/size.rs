//! The edge length of the mesh, and the limit on triangles.

use super::Params;
use super::codes;
use crate::sewing::shapes::Shapes;
use toile_garment::dart::DartKind;
use toile_garment::{Diagnostic, Garment};
use toile_stage_api::StageError;

/// Edge length when nothing is asked.
pub const DEFAULT: f64 = 12e-3;
/// More triangles than this are refused before any work.
const MOST: f64 = 5e6;

/// The largest piece of anything that is worn or sat on is between these, metres.
const PIECE: std::ops::RangeInclusive<f64> = 0.02..=3.5;
/// Usual size of the largest piece, m.
const USUAL: f64 = 0.8;
/// Mistaken units of a file, with the factor on the lengths.
const UNITS: [(&str, f64); 5] = [
    ("millimetres taken for metres", 1e-3),
    ("millimetres taken for inches", 1.0 / 25.4),
    ("millimetres taken for centimetres", 0.1),
    ("centimetres taken for millimetres", 10.0),
    ("metres taken for millimetres", 1e3),
];

/// Refuses patterns that nobody can wear: their unit is wrong.
pub fn check_pieces(garment: &Garment, shapes: &Shapes) -> Result<(), StageError> {
    let size = |s: &crate::sewing::shapes::PieceShape| {
        let points = s.rings.first().map_or(&[][..], |r| r.points.as_slice());
        let of = |k: usize| {
            let (low, high) =
                points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[k]), h.max(p[k])));
            high - low
        };
        of(0).max(of(1))
    };
    let sizes = garment.pieces.iter().zip(shapes.iter().map(size));
    let Some((piece, largest)) = sizes.max_by(|a, b| a.1.total_cmp(&b.1)) else { return Ok(()) };
    if PIECE.contains(&largest) {
        return Ok(());
    }
    let likely = likely_unit(largest).map_or_else(String::new, |words| format!("; it looks like {words}"));
    let (low, high) = (PIECE.start() * 1e3, PIECE.end() * 1e3);
    let message = format!(
        "piece `{}`, the largest, measures {:.3} mm; the largest piece of a garment has {low} to {high} mm",
        piece.name,
        largest * 1e3
    );
    let finding = Diagnostic::error(codes::PIECE_SIZE, message).at(piece.source.clone());
    Err(StageError::input(finding.hint(format!("say the pattern's unit{likely}"))))
}

/// The mistake of units that makes the largest piece nearest to a usual one; nothing where none does.
fn likely_unit(largest: f64) -> Option<&'static str> {
    let off = |f: f64| libm::log(largest * f / USUAL).abs();
    let likely = UNITS.iter().filter(|(_, f)| (0.2..=2.0).contains(&(largest * f)));
    likely.min_by(|a, b| off(a.1).total_cmp(&off(b.1))).map(|(words, _)| *words)
}

fn wrong<T>(message: String, hint: &str) -> Result<T, StageError> {
    Err(StageError::parameter(Diagnostic::error(codes::EDGE_LENGTH, message).hint(hint)))
}

/// Refuses parameters that make no mesh of any pieces.
pub fn check_asked(params: &Params) -> Result<(), StageError> {
    let cannot_be = |h: f64| !(h.is_finite() && h > 0.0);
    match (params.edge_length, params.triangles) {
        (Some(_), Some(_)) => wrong("edge_length and triangles are both given".to_owned(), "give one of them"),
        (None, Some(0)) => wrong("triangles cannot be 0".to_owned(), "e.g. triangles = 2200"),
        (Some(h), None) if cannot_be(h.0) => {
            wrong(format!("the edge length {} mm cannot be", h.0 * 1e3), "e.g. edge_length = \"12 mm\"")
        }
        _ => Ok(()),
    }
}

/// Edge length for the parameters.
pub fn edge_length(params: &Params, garment: &Garment, shapes: &Shapes) -> Result<f64, StageError> {
    check_asked(params)?;
    let area = cloth_area(garment, shapes);
    let by_number = |n: u32| (4.0 * area / (3_f64.sqrt() * f64::from(n))).sqrt();
    let h = params.edge_length.map(|h| h.0).or(params.triangles.map(by_number)).unwrap_or(DEFAULT);
    if !(h.is_finite() && h > 0.0 && params.angle.0.is_finite()) {
        return wrong(format!("the edge length {} mm cannot be", h * 1e3), "e.g. edge_length = \"12 mm\"");
    }
    let triangles = triangles(area, h);
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

/// Number of triangles with edges of length `h` that cover an area: each covers √3/4 h².
pub fn triangles(area: f64, h: f64) -> f64 {
    4.0 * area / (3_f64.sqrt() * h * h)
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
pub fn cloth_area(garment: &Garment, shapes: &Shapes) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::likely_unit;

    #[test]
    fn the_likeliest_mistake_of_units_is_named() {
        // A skirt of 866 mm, a T-shirt of 720 mm.
        assert_eq!(likely_unit(8.66), Some("millimetres taken for centimetres"));
        assert_eq!(likely_unit(0.72 * 25.4), Some("millimetres taken for inches"));
        assert_eq!(likely_unit(720.0), Some("millimetres taken for metres"));
        assert_eq!(likely_unit(0.72e-3), Some("metres taken for millimetres"));
        assert_eq!(likely_unit(1e9), None);
    }
}
