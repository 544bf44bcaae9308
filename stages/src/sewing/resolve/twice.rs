//! Stretches of an outline that two seams sew.

use super::ResolvedSeam;
use super::side::Span;
use crate::sewing::codes;
use crate::sewing::shapes::Shapes;
use toile_garment::{Diagnostic, Garment, PieceId};

/// Stretches that two seams share over less than this meet at their ends, m.
const SHARED_LEAST: f64 = 5e-3;

/// A warning for every two seams that sew the same stretch of a piece to places of the same other piece.
///
/// To sew a stretch to two other pieces is usual: a pocket or a lining lies in the seam of two others.
pub fn sewn_twice(garment: &Garment, shapes: &Shapes, seams: &[ResolvedSeam]) -> Vec<Diagnostic> {
    let mut out = Vec::new();
    for (n, one) in seams.iter().enumerate() {
        for other in &seams[n + 1..] {
            if let Some((piece, length)) = shared(shapes, one, other)
                && partners(one, piece).any(|p| partners(other, piece).any(|q| p == q))
            {
                out.push(warning(garment, one, other, piece, length));
            }
        }
    }
    out
}

/// The pieces to which a seam sews a piece.
fn partners(seam: &ResolvedSeam, piece: PieceId) -> impl Iterator<Item = PieceId> + '_ {
    spans(seam).map(|s| s.piece).filter(move |p| *p != piece)
}

fn spans(seam: &ResolvedSeam) -> impl Iterator<Item = &Span> {
    seam.a.spans.iter().chain(&seam.b.spans)
}

/// The piece on which two seams share the most, and how much, m.
fn shared(shapes: &Shapes, one: &ResolvedSeam, other: &ResolvedSeam) -> Option<(PieceId, f64)> {
    let pairs = spans(one).flat_map(|a| spans(other).map(move |b| (a, b)));
    let common = pairs.filter(|(a, b)| a.piece == b.piece && a.ring == b.ring).filter_map(|(a, b)| {
        let ring = shapes.get(a.piece.index())?.rings.get(a.ring)?;
        let [start, other_start] = [a, b].map(|s| if s.forward { s.from } else { s.to });
        let ahead = ring.ahead(start, other_start);
        let after = (a.length - ahead).min(b.length).max(0.0);
        let before = (ahead + b.length - ring.total()).min(a.length).max(0.0);
        Some((a.piece, after + before))
    });
    common.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, length)| *length > SHARED_LEAST)
}

fn warning(garment: &Garment, one: &ResolvedSeam, other: &ResolvedSeam, piece: PieceId, length: f64) -> Diagnostic {
    let name = garment.pieces.get(piece.index()).map_or("", |p| p.name.as_str());
    let message =
        format!("seams `{}` and `{}` both sew the same {:.0} mm of `{name}`", one.name, other.name, length * 1e3);
    Diagnostic::warning(codes::SEWN_TWICE, message)
        .at(other.source.clone())
        .hint("remove the one that is wrong; where a folded edge is sewn from both sides, this is right")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sewing::resolve::{find, placed};
    use crate::sewing::shapes::shapes;
    use crate::testing::{piece, seam};
    use toile_garment::sewing::{EdgePlace, EdgeWay, RunSpec, SewingPlan};

    fn square(id: usize, name: &str) -> toile_garment::Piece {
        piece(id, name, &[(0.0, 0.0, 't'), (100.0, 0.0, 't'), (100.0, 100.0, 't'), (0.0, 100.0, 't')])
    }

    fn edge(piece: &str, edge: &str) -> Vec<RunSpec> {
        vec![RunSpec::Edge { piece: piece.into(), edge: edge.into() }]
    }

    fn part(piece: &str, edge: &str, ends: [f64; 2]) -> Vec<RunSpec> {
        let [from, to] = ends.map(|share| EdgePlace { way: EdgeWay::Share(share), from_end: false });
        vec![RunSpec::Part { piece: piece.into(), edge: edge.into(), from, to }]
    }

    fn warnings(seams: [(&str, Vec<RunSpec>, Vec<RunSpec>); 2]) -> Vec<Diagnostic> {
        let plan = SewingPlan {
            seams: seams.into_iter().map(|(name, a, b)| seam(name, a, b)).collect(),
            ..SewingPlan::default()
        };
        let pieces = ["A", "B", "C"].into_iter().enumerate().map(|(k, n)| square(k, n)).collect();
        let garment = Garment { pieces, plan, ..Garment::default() };
        let shapes = shapes(&garment).expect("shapes");
        sewn_twice(&garment, &shapes, &placed(find(&garment, &shapes)).expect("seams"))
    }

    #[test]
    fn an_edge_that_two_seams_sew_to_one_piece_is_told_with_both() {
        let found = warnings([("one", edge("A", "1"), edge("B", "3")), ("two", edge("B", "0"), edge("A", "1"))]);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].message, "seams `one` and `two` both sew the same 100 mm of `A`");
    }

    #[test]
    fn parts_that_meet_and_three_pieces_in_one_seam_are_right() {
        let half = |piece: &str, edge: &str, ends: [f64; 2]| part(piece, edge, ends);
        let one = ("one", half("A", "1", [0.0, 0.5]), half("B", "3", [0.5, 1.0]));
        let meet = warnings([one, ("two", half("A", "1", [0.5, 1.0]), half("B", "3", [0.0, 0.5]))]);
        assert!(meet.is_empty(), "{meet:?}");
        let lined = warnings([("one", edge("A", "1"), edge("B", "3")), ("two", edge("C", "0"), edge("A", "1"))]);
        assert!(lined.is_empty(), "{lined:?}");
    }
}
