//! Where in the garment the solver failed.

use super::failure;
use toile_cloth::ClothError;
use toile_garment::{Diagnostic, Garment, Piece, Vec3};
use toile_stage_api::StageError;

/// The solver's failure, told with the piece and the place; `at`: positions of the pieces' vertices at the start.
#[must_use]
pub fn failure_in(error: ClothError, garment: &Garment, at: &[Vec<Vec3>]) -> StageError {
    let place = match &error {
        ClothError::StartCrosses { place, .. } | ClothError::Caught { place, .. } => place.at,
        _ => return failure(error),
    };
    match (failure(error), nearest(garment, at, &place)) {
        (StageError::Input(findings), Some(piece)) => {
            StageError::Input(findings.into_iter().map(|f| named(f, piece)).collect())
        }
        (other, _) => other,
    }
}

fn named(finding: Diagnostic, piece: &Piece) -> Diagnostic {
    let message = format!("piece `{}`: {}", piece.name, finding.message);
    Diagnostic { message, source: finding.source.or_else(|| piece.source.clone()), ..finding }
}

/// The piece whose vertex is nearest to a place.
fn nearest<'a>(garment: &'a Garment, at: &[Vec<Vec3>], place: &Vec3) -> Option<&'a Piece> {
    let distance =
        |vertices: &Vec<Vec3>| vertices.iter().map(|p| (p - place).norm_squared()).fold(f64::INFINITY, f64::min);
    let pieces = garment.pieces.iter().zip(at);
    pieces.min_by(|p, q| distance(p.1).total_cmp(&distance(q.1))).map(|(piece, _)| piece)
}
