//! Stitches: the k-th edge of one side to the k-th of the other.

use super::codes;
use crate::codes::SEAM_TO_ITSELF;
use toile_garment::seam::{SeamSide, Stitch};
use toile_garment::{Diagnostic, MeshVertex, PieceId};

/// Why two sides cannot be stitched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StitchError {
    /// The sides have different numbers of edges.
    Counts(usize, usize),
    /// A whole stretch would be sewn to itself.
    Itself,
}

impl StitchError {
    /// The mistake as a finding.
    pub fn finding(self, seam: &str) -> Diagnostic {
        match self {
            Self::Counts(a, b) => Diagnostic::error(
                codes::SEAM_COUNTS_DIFFER,
                format!("seam `{seam}`: the mesh has {a} edges on one side and {b} on the other"),
            )
            .hint("mesh the pieces again with the sewing file they are sewn with"),
            Self::Itself => {
                Diagnostic::error(SEAM_TO_ITSELF, format!("seam `{seam}` would stitch vertices to themselves"))
                    .hint("the two sides must be different stretches of outline")
            }
        }
    }
}

/// Edges of a side in sewing order.
fn edges(side: &SeamSide) -> Vec<[MeshVertex; 2]> {
    let of = |piece: PieceId, vertex: u32| MeshVertex { piece, vertex };
    side.runs.iter().flat_map(|r| r.vertices.windows(2).map(|w| [of(r.piece, w[0]), of(r.piece, w[1])])).collect()
}

/// Pairs of vertices in sewing order. Where one side passes a dart's mouth or goes on to another piece, its two
/// vertices there both meet the one of the other side. A vertex that both sides share (an apex, the end of a fold-over)
/// needs no stitch.
pub fn stitches(a: &SeamSide, b: &SeamSide) -> Result<Vec<Stitch>, StitchError> {
    let (x, y) = (edges(a), edges(b));
    if x.len() != y.len() {
        return Err(StitchError::Counts(x.len(), y.len()));
    }
    let mut out: Vec<Stitch> = Vec::with_capacity(x.len() + 1);
    for (p, q) in x.iter().zip(&y) {
        if p[0] == q[0] && p[1] == q[1] {
            return Err(StitchError::Itself);
        }
        for k in 0..2 {
            let stitch = Stitch { a: p[k], b: q[k] };
            if stitch.a != stitch.b && out.last() != Some(&stitch) {
                out.push(stitch);
            }
        }
    }
    if out.is_empty() { Err(StitchError::Itself) } else { Ok(out) }
}

/// One pair.
pub fn pair(piece: PieceId, a: u32, b: u32) -> Vec<Stitch> {
    let of = |vertex| MeshVertex { piece, vertex };
    if a == b { Vec::new() } else { vec![Stitch { a: of(a), b: of(b) }] }
}
