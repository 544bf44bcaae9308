//! The findings of the flattening, in words.

use super::dart_strain::Reason;
use super::solve::Flattened;
use super::{advice, codes};
use toile_garment::flat::{FlatMetric, FlatPiece};
use toile_garment::mesh::PieceMesh;
use toile_garment::seam::Seam;
use toile_garment::{Diagnostic, Garment, Piece, Report, Vec2};

/// Mean strain up to which a piece is eased in without a change. It was chosen: a skirt widened by 8 mm a side has 0.1 %.
const EASED_IN: f64 = 2e-3;

/// Which lengths were asked for, and what that proves.
pub fn metric(garment: &Garment, metric: FlatMetric, report: &mut Report) {
    report.push(match metric {
        FlatMetric::Unedited => Diagnostic::info(
            codes::FLATTEN_UNEDITED,
            "the drape was not edited: its strain is elastic and stays in the cloth, so the stored pieces come back by construction",
        )
        .hint("edit the 3D shape first, or flatten the worn lengths: `--metric surface` (metric = \"surface\")"),
        FlatMetric::Carried => Diagnostic::info(
            codes::FLATTEN_CARRIED,
            "flattened on the stored lengths changed by the 3D edit; the strain the drape had before stays in the cloth",
        ),
        FlatMetric::Surface => Diagnostic::info(
            codes::FLATTEN_SURFACE,
            "flattened on the lengths of the 3D surface: strain of the worn cloth becomes size of the pieces",
        ),
    });
    if let Some(drape) = garment.drape.as_ref().filter(|d| !d.welded) {
        let widest = garment.widest_gap(&drape.positions, |_| true);
        let which = widest.map_or_else(
            || "seams are not closed".to_owned(),
            |(seam, gap)| format!("seam `{}` stands open by {:.1} mm", seam.name, 1e3 * gap),
        );
        let what = format!("in the 3D shape {which}: edges that are sewn to each other may differ");
        let hint = if garment.drape_before_edit.is_some() {
            "an edit drew its sides apart: move the vertices of both sides alike in the editor"
        } else {
            "run `drape` until its certificate passes"
        };
        report.push(Diagnostic::warning(codes::FLATTEN_OPEN_SEAMS, what).hint(hint));
    }
}

/// The shape is so many times as large as before.
pub fn scaled(by: f64) -> Diagnostic {
    let what = format!("the edited shape is {by:.4} times as large as the drape: the editor took another unit");
    Diagnostic::error(codes::FLATTEN_SCALED, what).hint("save it in metres, as a GLB is, and without a scale")
}

/// The edit mirrored the whole shape.
pub fn mirrored() -> Diagnostic {
    let what = "the edited shape is the mirror image of the drape: its lengths do not tell so, and the pieces are not mirrored";
    Diagnostic::warning(codes::FLATTEN_MIRRORED, what)
        .hint("undo the mirroring in the editor, and turn the pieces over where you cut them")
}

/// One side of a seam was edited and the other was not.
pub fn one_sided(seam: &Seam) -> Diagnostic {
    let what = format!("the edit changed only one side of seam `{}`: its sides are not held equal there", seam.name);
    Diagnostic::warning(codes::FLATTEN_ONE_SIDED, what)
        .hint("edit both pieces alike, or ease the difference in the pattern")
}

/// Lines that were held, and lines that were let go, with what would have become of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Held {
    /// Edges held straight, with the bow they would have, metres.
    pub straight: Vec<(String, f64)>,
    /// Edges that were straight and are let go, with their bow, metres.
    pub curved: Vec<(String, f64)>,
    /// Right angles that were held, with the turn they would have, degrees.
    pub right: Vec<f64>,
    /// Right angles that are let go, with their turn, degrees.
    pub turned: Vec<f64>,
}

/// Names, each with its change in mm.
fn each(changes: &[(String, f64)]) -> String {
    let named: Vec<String> = changes.iter().map(|(name, by)| format!("`{name}` by {:.2} mm", 1e3 * by)).collect();
    named.join(", ")
}

/// Tells what was held of the outline of a piece, and what was let go.
pub fn held(piece: &Piece, held: &Held, report: &mut Report) {
    let largest = |of: &[f64]| of.iter().map(|x| x.abs()).fold(0.0, f64::max);
    if !held.straight.is_empty() {
        let what = format!("piece `{}`: held straight what would bow: {}", piece.name, each(&held.straight));
        report.push(
            Diagnostic::info(codes::FLATTEN_HELD, what)
                .at(piece.source.clone())
                .hint("leave `straight` out of `--lock` (`lock` in a pipeline) to let it bow"),
        );
    }
    if !held.right.is_empty() {
        let what = format!(
            "piece `{}`: {} right angles were held, which would turn by {:.2} degrees at most",
            piece.name,
            held.right.len(),
            largest(&held.right)
        );
        report.push(
            Diagnostic::info(codes::FLATTEN_HELD, what)
                .at(piece.source.clone())
                .hint("leave `right-angles` out of `--lock` (`lock` in a pipeline) to let them turn"),
        );
    }
    if !held.curved.is_empty() {
        let what = format!("piece `{}`: straight edges became curves: {}", piece.name, each(&held.curved));
        report.push(
            Diagnostic::warning(codes::FLATTEN_LET_GO, what)
                .at(piece.source.clone())
                .hint("the shape asks for it; a dart or seam nearby would keep the edge straight"),
        );
    }
    if !held.turned.is_empty() {
        let what = format!(
            "piece `{}`: {} right angles turned, by {:.1} degrees at most",
            piece.name,
            held.turned.len(),
            largest(&held.turned)
        );
        report.push(
            Diagnostic::warning(codes::FLATTEN_LET_GO, what)
                .at(piece.source.clone())
                .hint("the shape asks for it; true the corner against its seam partner"),
        );
    }
}

/// Pleats that would have become deeper or shallower, with the largest change of their width, metres.
pub fn held_pleats(piece: &Piece, held: &[(String, f64)], report: &mut Report) {
    if held.is_empty() {
        return;
    }
    let what = format!("piece `{}`: held in width what would change: {}", piece.name, each(held));
    report.push(
        Diagnostic::info(codes::FLATTEN_HELD, what)
            .at(piece.source.clone())
            .hint("leave `pleats` out of `--lock` (`lock` in a pipeline) to let them change"),
    );
}

/// A dart that the strain of the cloth, or an edit, would have changed.
pub fn held_dart(piece: &Piece, name: &str, [stored, free]: [f64; 2], kept: f64, reason: Reason) -> Diagnostic {
    let [stored, free, kept] = [stored, free, kept].map(|l| 1e3 * l);
    let place = format!("piece `{}`, dart `{name}`", piece.name);
    let what = match reason {
        Reason::Locked => {
            format!("{place}: its intake was held at {kept:.2} mm; without the lock it would be {free:.2} mm")
        }
        Reason::Untouched => format!(
            "{place}: the edit did not touch it, so its intake was held at {kept:.2} mm; the strain of the edit elsewhere \
             would make it {free:.2} mm"
        ),
        Reason::Strain => format!(
            "{place}: the worn surface alone gives {free:.2} mm of intake, which is the strain of the cloth; the shape \
             asks for {kept:.2} mm (stored {stored:.2} mm), and that is what the dart has"
        ),
        Reason::Overlap(by) => {
            let what = format!(
                "{place}: the shape asks for less than no intake, so that its legs would overlap by {:.2} mm; it was held \
                 open, with an intake of {kept:.2} mm (stored {stored:.2} mm)",
                1e3 * by
            );
            return Diagnostic::warning(codes::FLATTEN_DART_OVERLAPS, what)
                .at(piece.source.clone())
                .hint("leave the dart out of the pattern, and take the rest in at a seam nearby");
        }
    };
    Diagnostic::info(codes::FLATTEN_DART_KEPT, what).at(piece.source.clone())
}

fn both((p, q): (&Piece, &Piece)) -> String {
    if p.id == q.id {
        format!("piece `{}` and its mirror image", p.name)
    } else {
        format!("pieces `{}` and `{}`", p.name, q.name)
    }
}

/// Two sides that were made one.
pub fn symmetric(pieces: (&Piece, &Piece), apart: f64) -> Diagnostic {
    let what = format!("{} differed by {:.3} mm at most and were made one", both(pieces), 1e3 * apart);
    Diagnostic::info(codes::FLATTEN_SYMMETRIC, what)
        .hint("keep both sides as they are with `--symmetry off` (symmetry = \"off\")")
}

/// The solve ended before it was at rest; what it had is what is written.
pub fn not_at_rest(solved: &Flattened, goal: f64) -> Diagnostic {
    let what = format!(
        "flattening was ended before it came to rest: after {} rounds a vertex still moved {:.1e} mm a round (goal \
         {:.0e} mm)",
        solved.rounds,
        1e3 * solved.last_motion,
        1e3 * goal
    );
    Diagnostic::warning(codes::FLATTEN_NOT_AT_REST, what)
        .hint("the pieces are the best that were found and none is flipped; look at them, or allow more `max_rounds`")
}

/// Two sides that differ too much to be one. `moves` is the difference of an edit that moved mirrored points, metres.
pub fn asymmetric(pieces: (&Piece, &Piece), apart: f64, moves: Option<f64>) -> Diagnostic {
    let why = match moves {
        Some(moves) => {
            format!("the edit was not symmetric: it moved mirrored points by up to {:.1} mm apart", 1e3 * moves)
        }
        None => "the shape is not symmetric".to_owned(),
    };
    let what = format!("{} differ by {:.1} mm: {why}", both(pieces), 1e3 * apart);
    Diagnostic::warning(codes::FLATTEN_ASYMMETRIC, what).hint(
        "edit both sides alike, make them one by `--symmetry always` (symmetry = \"always\"), or say \"off\" where the \
         difference is meant",
    )
}

/// Names what would cure a piece whose curvature forces more strain than the limit.
pub fn developable(piece: &Piece, mesh: &PieceMesh, flat: &FlatPiece, limit: f64, report: &mut Report) {
    let [mean, largest] = flat.forced_strain;
    if largest <= limit {
        return;
    }
    let curvature = match advice::enclosed(flat) {
        0.0 => "curvature that adds up to none".to_owned(),
        degrees => format!("{degrees:.1} degrees of curvature"),
    };
    let what = format!(
        "piece `{}` encloses {curvature}: laid flat, its cloth stretches or shrinks by up to {:.2} % (mean {:.2} %)",
        piece.name,
        100.0 * largest,
        100.0 * mean
    );
    let cure = advice::cure(piece, mesh, flat);
    // Cloth of little strain is eased in, and nobody cuts for it.
    let told = if mean > EASED_IN { Diagnostic::warning } else { Diagnostic::info };
    report.push(told(codes::PIECE_NOT_DEVELOPABLE, what).at(piece.source.clone()).hint(cure));
}

/// The outline of a piece goes through itself at these places of the flat piece.
pub fn overlapping(piece: &Piece, places: &[Vec2], report: &mut Report) {
    let Some(first) = places.first() else { return };
    let what = format!(
        "piece `{}`: its flat outline crosses itself at {} places, first at ({:.1}, {:.1}) mm, so that it cannot be cut",
        piece.name,
        places.len(),
        1e3 * first.x,
        1e3 * first.y
    );
    report.push(
        Diagnostic::warning(codes::FLATTEN_OVERLAP, what)
            .at(piece.source.clone())
            .hint("cut the piece apart along a line, or change the shape less"),
    );
}
