//! Roles and places of the pieces, told from the proposed seams.

use super::pattern::Source;
use toile_garment::Piece;
use toile_garment::body::Body;
use toile_stages::arrange::{Arrangement, Given, arrange};
use toile_stages::proposal::{Proposal, ProposedSeam, Run};
use toile_stages::roles::{Join, PiecePoint, Role, roles, seam_names};

/// Distance of pairs of points along a seam, metres.
const STEP: f64 = 0.02;
/// Pairs of points along a seam, at least.
const LEAST: usize = 9;

/// Roles and places of all pieces.
pub struct Dressed {
    /// Roles, in the order of the pieces.
    pub roles: Vec<Role>,
    /// Places.
    pub arrangement: Arrangement,
    /// The proposed seams as points that meet.
    pub joins: Vec<Join>,
    /// Names of the proposed seams in a workroom; `None` where that is not known.
    pub seam_names: Vec<Option<String>>,
}

/// Dresses a body with a proposed garment.
pub fn dress(source: &Source, proposal: &Proposal, body: Option<&Body>, is_anonymous: bool) -> Dressed {
    let nameless =
        |p: &Piece| Piece { name: format!("P{}", p.id.index() + 1), category: None, annotation: None, ..p.clone() };
    let pieces: Vec<Piece> =
        if is_anonymous { source.garment.pieces.iter().map(nameless).collect() } else { source.garment.pieces.clone() };
    let joins: Vec<Join> = proposal.seams.iter().map(join).collect();
    let roles = roles(&pieces, &joins);
    let arrangement = arrange(&pieces, &roles, &joins, body, Given::nothing(pieces.len()));
    let on_body = |p: PiecePoint| Some(arrangement.places.get(p.piece)?.as_ref()?.sheet.at(p.at));
    let seam_names = seam_names(&roles, &joins, on_body);
    Dressed { roles, arrangement, joins, seam_names }
}

/// A seam as pairs of points that meet.
fn join(seam: &ProposedSeam) -> Join {
    let length = 0.5 * (seam.length_a + seam.length_b);
    let count = LEAST.max((length / STEP).ceil() as usize);
    let pair = |k: usize| {
        let share = (k as f64 + 0.5) / count as f64;
        Some([at(&seam.a, share * seam.length_a)?, at(&seam.b, share * seam.length_b)?])
    };
    Join { name: seam.name.clone(), pairs: (0..count).filter_map(pair).collect(), length }
}

/// The point of a side at a distance from its start.
fn at(runs: &[Run], mut way: f64) -> Option<PiecePoint> {
    for run in runs {
        for w in run.points.windows(2) {
            let length = (w[1] - w[0]).norm();
            if way <= length && length > 0.0 {
                return Some(PiecePoint {
                    piece: run.piece,
                    at: w[0] + (w[1] - w[0]) * (way / length),
                    is_inside: false,
                });
            }
            way -= length;
        }
    }
    let last = runs.last()?;
    Some(PiecePoint { piece: last.piece, at: *last.points.last()?, is_inside: false })
}
