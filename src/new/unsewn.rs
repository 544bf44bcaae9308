//! Pieces that a first garment does without: alternatives, and small pieces of which no sure seam is found.

use super::pattern::Source;
use toile_garment::Piece;
use toile_stages::proposal::{Proposal, ProposedSeam, Run};
use toile_stages::roles::{Part, Role, roles_of_names};

/// A piece is small if its area is a smaller share of all that is sewn. This limit and the next were set on 37 public
/// files: `docs/lab/2026-11-27-seam-proposals.md`.
const SMALL: f64 = 0.03;
/// A small piece is sewn if a seam to a larger one is at least as sure.
const SURE: f64 = 0.65;

/// Names of the pieces without a seam, and of the trimmings that hang on doubtful seams alone. Names that say nothing
/// make no piece a trimming.
pub fn unsewn(source: &Source, proposal: &Proposal, is_anonymous: bool) -> [Vec<String>; 2] {
    let pieces = &source.garment.pieces;
    let roles = roles_of_names(pieces);
    let is_in = |p: &&Piece| proposal.layout.panels.iter().any(|panel| panel.piece == p.id.index());
    let sewn: Vec<&Piece> = pieces.iter().filter(is_in).collect();
    let area = |p: &Piece| p.outline.signed_area().abs();
    let least = SMALL * sewn.iter().map(|p| area(p)).sum::<f64>();
    // A binding is narrow, and as long as an opening.
    let is_large = |p: usize| area(&pieces[p]) >= least && roles[p].part != Some(Part::Binding);
    let holds = |s: &ProposedSeam, p: usize| {
        let has = |runs: &[Run]| runs.iter().any(|r| r.piece == p);
        let others = |runs: &[Run]| runs.iter().any(|r| is_large(r.piece));
        s.confidence >= SURE && (has(&s.a) && others(&s.b) || has(&s.b) && others(&s.a))
    };
    let has_seam = |p: usize| proposal.seams.iter().any(|s| s.a.iter().chain(&s.b).any(|r| r.piece == p));
    let is_held = |p: usize| is_large(p) || proposal.seams.iter().any(|s| holds(s, p));
    let names = |holds: &dyn Fn(usize) -> bool| -> Vec<String> {
        sewn.iter().filter(|p| holds(p.id.index())).map(|p| p.name.clone()).collect()
    };
    let doubtful = names(&|p| !is_anonymous && is_trimming(&roles[p]) && has_seam(p) && !is_held(p));
    let alone = names(&|p| !has_seam(p));
    [alone, doubtful]
}

/// Does a garment drape much the same without such a piece? A small yoke is the facing of a slit.
fn is_trimming(role: &Role) -> bool {
    use Part::{BeltLoop, Binding, Facing, Placket, Pocket, Yoke};
    role.part.is_none_or(|part| matches!(part, BeltLoop | Binding | Facing | Placket | Pocket | Yoke))
}
