//! Where in the garment the solver failed.

use super::codes;
use super::failure;
use super::watch::MESH_ANEW;
use crate::body::where_on;
use toile_cloth::ClothError;
use toile_garment::{Diagnostic, Garment, Piece, Vec3};
use toile_stage_api::StageError;

/// The solver's failure, told with the piece and the place; `at`: positions of the pieces' vertices at the start.
#[must_use]
pub fn failure_in(error: ClothError, garment: &Garment, at: &[Vec<Vec3>]) -> StageError {
    let place = match &error {
        ClothError::StartCrosses { place, .. } | ClothError::Caught { place, .. } => place.at,
        ClothError::Unstable { .. } => return narrow(garment, at).unwrap_or_else(|| failure(error)),
        _ => return failure(error),
    };
    match (failure(error), nearest(garment, at, &place)) {
        (StageError::Input(findings), Some(piece)) => {
            let told = |f: Diagnostic| {
                let mut finding = named(f, piece);
                finding.message.push_str(&on_body(garment, place));
                finding
            };
            StageError::Input(findings.into_iter().map(told).collect())
        }
        (other, _) => other,
    }
}

/// Words that follow the coordinates of a place, such as `, at the left front, 40 mm above the waist`; empty without a body.
#[must_use]
pub fn on_body(garment: &Garment, at: Vec3) -> String {
    let words = garment.body.as_ref().and_then(|body| where_on::words(body, at));
    words.map_or_else(String::new, |words| format!(", {words}"))
}

/// A triangle so narrow that single precision loses it beside the others: height over longest edge.
const NARROW: f64 = 2e-3;

/// Where the numbers broke because of the mesh: its narrowest triangle.
fn narrow(garment: &Garment, at: &[Vec<Vec3>]) -> Option<StageError> {
    let shapes = garment.pieces.iter().zip(at).flat_map(|(piece, at)| {
        let mesh = piece.mesh.as_ref();
        let triangles = mesh.into_iter().flat_map(|m| m.triangles.iter().enumerate().map(move |(i, t)| (m, i, t)));
        triangles.filter_map(move |(m, i, t)| {
            let [a, b, c] = m.rest_triangle(i)?;
            let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
            let height = (b - a).perp(&(c - a)).abs() / longest;
            let middle = t.iter().map(|v| at[*v as usize]).sum::<Vec3>() * (1e3 / 3.0);
            Some((height / longest, longest, piece, middle))
        })
    });
    let (aspect, longest, piece, p) = shapes.min_by(|s, t| s.0.total_cmp(&t.0)).filter(|s| s.0 < NARROW)?;
    let message = format!(
        "piece `{}`: a triangle of {:.3} mm by {:.6} mm is too narrow to be solved beside the others, near ({:.0}, {:.0}, {:.0}) mm",
        piece.name,
        longest * 1e3,
        aspect * longest * 1e3,
        p.x,
        p.y,
        p.z
    );
    let finding = Diagnostic::error(codes::FLAT_TRIANGLE, message).at(piece.source.clone());
    Some(StageError::input(finding.hint(MESH_ANEW)))
}

fn named(mut finding: Diagnostic, piece: &Piece) -> Diagnostic {
    finding.message = format!("piece `{}`: {}", piece.name, finding.message);
    let place = finding.source.take().or_else(|| piece.source.clone());
    finding.at(place)
}

/// The piece whose vertex is nearest to a place; `at`: positions of the pieces' vertices.
#[must_use]
pub fn nearest<'a>(garment: &'a Garment, at: &[Vec<Vec3>], place: &Vec3) -> Option<&'a Piece> {
    let distance =
        |vertices: &Vec<Vec3>| vertices.iter().map(|p| (p - place).norm_squared()).fold(f64::INFINITY, f64::min);
    let pieces = garment.pieces.iter().zip(at);
    pieces.min_by(|p, q| distance(p.1).total_cmp(&distance(q.1))).map(|(piece, _)| piece)
}
