//! A piece with all that the flattening needs of it.

use super::codes;
use super::metric::edges2;
use nalgebra::{Matrix2, Matrix3};
use toile_garment::mesh::PieceMesh;
use toile_garment::{Diagnostic, Garment, Piece, Vec2, Vec3};
use toile_stage_api::StageError;

/// Determinant of a covariance, as a share of its size, below which a shape lies in a plane.
const FLAT: f64 = 1e-9;

/// A piece, its mesh and its surfaces.
pub struct Source<'a> {
    /// The piece.
    pub piece: &'a Piece,
    /// Its mesh.
    pub mesh: &'a PieceMesh,
    /// Where its vertices are in 3D.
    pub surface: &'a [Vec3],
    /// Where they were before an edit.
    pub before: &'a [Vec3],
    /// First vertex of the piece in the sheet.
    pub offset: u32,
}

impl Source<'_> {
    /// Edge vectors of the stored triangles.
    pub fn stored(&self) -> Vec<Matrix2<f64>> {
        self.mesh.triangles.iter().map(|t| edges2(&self.mesh.rest, *t)).collect()
    }

    /// The positions of this piece among those of the sheet.
    pub fn part<'x>(&self, x: &'x [Vec2]) -> &'x [Vec2] {
        let from = self.offset as usize;
        &x[from..from + self.mesh.rest.len()]
    }
}

/// Did an edit turn the shape into its mirror image? The covariance of all places before and after it tells.
pub fn is_mirrored(sources: &[Source<'_>]) -> bool {
    let pairs = || sources.iter().flat_map(|s| s.before.iter().zip(s.surface));
    let count = pairs().count().max(1) as f64;
    let [before, now] = pairs().fold([Vec3::zeros(); 2], |[b, n], (p, q)| [b + p / count, n + q / count]);
    let covariance: Matrix3<f64> = pairs().map(|(p, q)| (p - before) * (q - now).transpose()).sum();
    // A shape in one plane has no handedness.
    let size = covariance.norm() / 3f64.sqrt();
    covariance.determinant() < -FLAT * size * size * size
}

/// How many times as large an edit made the shape.
pub fn scale(sources: &[Source<'_>]) -> f64 {
    let side = |at: &[Vec3], t: &[u32; 3]| (at[t[1] as usize] - at[t[0] as usize]).norm();
    let (mut before, mut now) = (0.0, 0.0);
    for s in sources {
        for t in &s.mesh.triangles {
            (before, now) = (before + side(s.before, t), now + side(s.surface, t));
        }
    }
    if before > 0.0 { now / before } else { 1.0 }
}

/// The pieces of a garment that can be flattened.
///
/// # Errors
/// When the garment has no mesh or drape, or their vertices differ.
pub fn sources(garment: &Garment) -> Result<Vec<Source<'_>>, StageError> {
    let missing = |what: &str| {
        StageError::input(
            Diagnostic::error(
                codes::FLATTEN_NOTHING,
                format!("the garment has no {what}; there is nothing to flatten"),
            )
            .hint("run `triangulate` and `drape` first, or give a GLB that toile wrote"),
        )
    };
    let drape = garment.drape.as_ref().ok_or_else(|| missing("drape"))?;
    let before = garment.drape_before_edit.as_ref().unwrap_or(drape);
    let mut out = Vec::new();
    let mut offset = 0u32;
    for (i, piece) in garment.pieces.iter().enumerate() {
        let mesh = piece.mesh.as_ref().ok_or_else(|| missing("mesh"))?;
        let n = mesh.rest.len();
        let shape = |s: &'_ toile_garment::garment::Shape| s.positions.get(i).is_some_and(|p| p.len() == n);
        let inside = mesh.triangles.iter().flatten().all(|v| (*v as usize) < n);
        if !shape(drape) || !shape(before) || !inside {
            return Err(StageError::input(Diagnostic::error(
                codes::FLATTEN_VERTICES_DIFFER,
                format!("piece `{}`: mesh, drape and the shape before the edit differ in their vertices", piece.name),
            )));
        }
        out.push(Source { piece, mesh, surface: &drape.positions[i], before: &before.positions[i], offset });
        let count = u32::try_from(n).ok().and_then(|n| offset.checked_add(n));
        offset = count.ok_or_else(|| StageError::Limit("more than 4,294,967,295 vertices".into()))?;
    }
    Ok(out)
}

/// A triangle that cannot be flattened, with its place.
pub fn bad_triangle(source: &Source<'_>, k: usize, what: &str) -> StageError {
    let at =
        source.mesh.triangles.get(k).and_then(|t| source.mesh.rest.get(t[0] as usize)).copied().unwrap_or_default();
    let place = format!("{:.2}, {:.2} mm", 1e3 * at.x, 1e3 * at.y);
    StageError::input(
        Diagnostic::error(
            codes::FLATTEN_BAD_TRIANGLE,
            format!("piece `{}`: triangle {k} at ({place}) {what}", source.piece.name),
        )
        .at(source.piece.source.clone())
        .hint("mesh the piece afresh, or take the edit back at this place"),
    )
}
