//! The mesh vertices of a span.

use crate::sewing::resolve::Span;
use crate::sewing::shapes::PieceShape;
use toile_garment::mesh::{ChainKind, MeshChain};
use toile_garment::{Piece, Vec2};

/// A span's end and its mesh vertex are one place (0.01 mm).
const AT: f64 = 2.0 * crate::triangulate::ONE_PLACE;

/// Vertices of a span in sewing order; none when the mesh does not hold its ends.
pub fn run_vertices(piece: &Piece, shape: &PieceShape, span: &Span) -> Option<Vec<u32>> {
    let mesh = piece.mesh.as_ref()?;
    let ring = shape.rings.get(span.ring)?;
    let wanted = |c: &&MeshChain| match (span.ring, shape.seam_line(span.ring)) {
        (_, Some(line)) => c.kind == ChainKind::SeamLine && c.index as usize == line,
        (0, None) => c.kind == ChainKind::Outline,
        (k, None) => c.kind == ChainKind::Cutout && c.index as usize == k - 1,
    };
    let chain = &mesh.chains.iter().find(wanted)?.vertices;
    let find = |p: Vec2| {
        let distance = |i: &usize| mesh.rest.get(chain[*i] as usize).map_or(f64::INFINITY, |q| (q - p).norm());
        (0..chain.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).filter(|i| distance(i) < AT)
    };
    let (start, end) = (find(ring.at(span.from))?, find(ring.at(span.to))?);
    let n = chain.len();
    let mut out = vec![chain[start]];
    let mut at = start;
    loop {
        at = if span.forward { (at + 1) % n } else { (at + n - 1) % n };
        out.push(*chain.get(at)?);
        if at == end || out.len() > n {
            return (at == end).then_some(out);
        }
    }
}
