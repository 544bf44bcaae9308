//! Pieces that a first garment does without: alternatives, and small pieces of which no sure seam is found.

use super::pattern::Source;
use toile_garment::Piece;
use toile_stages::proposal::{Proposal, ProposedSeam, Run};
use toile_stages::roles::{Part, Role, roles_of_names};

/// A piece is small if its area is a smaller share of all that is sewn. This limit and the next were set on 37 public
/// files: `docs/lab/2026-11-27-seam-proposals.md`.
const SMALL: f64 = 0.03;
/// A small piece is sewn if seams to larger ones that are at least as sure make this share of its outline. A placket that
/// hangs by its short end has 8 % (GMX1016): the slit that it belongs to is not cut.
const SURE: f64 = 0.65;
const HELD_SHARE: f64 = 0.15;

/// Names of the pieces without a seam, and of the trimmings that hang on doubtful seams alone. Names that say nothing
/// make no piece a trimming.
pub fn unsewn(source: &Source, proposal: &Proposal, is_anonymous: bool) -> [Vec<String>; 2] {
    let pieces = &source.garment.pieces;
    let roles = roles_of_names(pieces);
    let is_in = |p: &&Piece| proposal.layout.panels.iter().any(|panel| panel.piece == p.id.index());
    let sewn: Vec<&Piece> = pieces.iter().filter(is_in).collect();
    let area = |p: &Piece| p.outline.signed_area().abs();
    let least = SMALL * sewn.iter().map(|p| area(p)).sum::<f64>();
    let is_large = |p: usize| area(&pieces[p]) >= least;
    let held = |s: &ProposedSeam, p: usize| {
        let has = |runs: &[Run]| runs.iter().any(|r| r.piece == p);
        let others = |runs: &[Run]| runs.iter().any(|r| is_large(r.piece));
        let sides = [(has(&s.a) && others(&s.b), s.length_a), (has(&s.b) && others(&s.a), s.length_b)];
        let is_sure = s.confidence >= SURE;
        sides.iter().find(|(is_held, _)| is_sure && *is_held).map_or(0.0, |(_, length)| *length)
    };
    let perimeter = |p: usize| proposal.layout.panels.iter().find(|l| l.piece == p).map_or(0.0, |l| l.perimeter);
    let has_seam = |p: usize| proposal.seams.iter().any(|s| s.a.iter().chain(&s.b).any(|r| r.piece == p));
    let length_held = |p: usize| proposal.seams.iter().map(|s| held(s, p)).sum::<f64>();
    let is_held = |p: usize| is_large(p) || length_held(p) > HELD_SHARE * perimeter(p);
    let names = |holds: &dyn Fn(usize) -> bool| -> Vec<String> {
        sewn.iter().filter(|p| holds(p.id.index())).map(|p| p.name.clone()).collect()
    };
    let doubtful = names(&|p| !is_anonymous && is_trimming(&roles[p]) && has_seam(p) && !is_held(p));
    let alone = names(&|p| !has_seam(p));
    [alone, doubtful]
}

/// Does a garment drape much the same without such a piece? A small yoke is the facing of a slit.
fn is_trimming(role: &Role) -> bool {
    use Part::{BeltLoop, Facing, Placket, Pocket, Yoke};
    role.part.is_none_or(|part| matches!(part, BeltLoop | Facing | Placket | Pocket | Yoke))
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::outline::{LinePoint, PieceLine, PointKind};
    use toile_garment::{Garment, PieceId, Vec2};
    use toile_stages::proposal::atoms::{Layout, Panel};

    fn rectangle(id: usize, name: &str, width: f64, height: f64) -> Piece {
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        let points = corners.iter().map(|(x, y)| LinePoint { at: Vec2::new(*x, *y), kind: PointKind::Turn });
        let outline = PieceLine { points: points.collect(), closed: true, ..PieceLine::default() };
        Piece { id: PieceId::from(id), name: name.to_owned(), outline, ..Piece::default() }
    }

    /// A front, and a placket of 30 × 155 mm that is sewn to it along a length, surely.
    fn doubtful(length: f64) -> Vec<String> {
        let pieces = vec![rectangle(0, "front", 0.6, 0.7), rectangle(1, "placket", 0.03, 0.155)];
        let panel = |p: &Piece, perimeter: f64| Panel {
            piece: p.id.index(),
            atoms: 0..0,
            warp: Vec2::y(),
            perimeter,
            slenderness: 0.2,
        };
        let panels = vec![panel(&pieces[0], 2.6), panel(&pieces[1], 0.37)];
        let run = |piece: usize| Run {
            piece,
            ends: [Vec2::zeros(); 2],
            forward: true,
            points: Vec::new(),
            edges: Vec::new(),
        };
        let seam = ProposedSeam {
            name: "placket".to_owned(),
            a: vec![run(0)],
            b: vec![run(1)],
            fold_over: false,
            length_a: length,
            length_b: length,
            confidence: 0.97,
            atoms: Vec::new(),
            instead: Vec::new(),
        };
        let layout = Layout { panels, atoms: Vec::new() };
        let proposal = Proposal { seams: vec![seam], layout, ..Proposal::default() };
        let source = Source { garment: Garment { pieces, ..Garment::default() }, ..Source::default() };
        let [_, doubtful] = unsewn(&source, &proposal, false);
        doubtful
    }

    #[test]
    fn a_placket_that_hangs_by_its_short_end_is_left_out() {
        assert_eq!(doubtful(0.030), ["placket"]);
        assert!(doubtful(0.155).is_empty());
    }
}
