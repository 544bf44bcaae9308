//! The findings of the flattening, in words.

use super::codes;
use toile_garment::flat::{FlatMetric, FlatPiece};
use toile_garment::seam::Seam;
use toile_garment::{Diagnostic, Garment, Piece, Report};

/// Which lengths were asked for, and what that proves.
pub fn metric(garment: &Garment, metric: FlatMetric, report: &mut Report) {
    report.push(match metric {
        FlatMetric::Unedited => Diagnostic::info(
            codes::FLATTEN_UNEDITED,
            "the drape was not edited: its strain is elastic and stays in the cloth, so the stored pieces come back by construction",
        )
        .hint("use metric = \"surface\" to flatten the worn lengths, or edit the 3D shape first"),
        FlatMetric::Carried => Diagnostic::info(
            codes::FLATTEN_CARRIED,
            "flattened on the stored lengths changed by the 3D edit; the strain the drape had before stays in the cloth",
        ),
        FlatMetric::Surface => Diagnostic::info(
            codes::FLATTEN_SURFACE,
            "flattened on the lengths of the 3D surface: strain of the worn cloth becomes size of the pieces",
        ),
    });
    if garment.drape.as_ref().is_some_and(|d| !d.welded) {
        report.push(
            Diagnostic::warning(
                codes::FLATTEN_OPEN_SEAMS,
                "the 3D shape has seams that are not closed; sewn edges may differ",
            )
            .hint("run `drape` until its certificate passes"),
        );
    }
}

/// One side of a seam was edited and the other was not.
pub fn one_sided(seam: &Seam) -> Diagnostic {
    let what = format!("the edit changed only one side of seam `{}`: its sides are not held equal there", seam.name);
    Diagnostic::warning(codes::FLATTEN_ONE_SIDED, what)
        .hint("edit both pieces alike, or ease the difference in the pattern")
}

/// Names the dart that would cure a piece whose curvature forces more strain than the limit.
pub fn developable(piece: &Piece, flat: &FlatPiece, limit: f64, report: &mut Report) {
    let [mean, largest] = flat.forced_strain;
    if largest <= limit {
        return;
    }
    let degrees = flat.curvature.to_degrees();
    let cure = if degrees.abs() < 0.5 {
        "its curvature adds up to nothing: a seam across the piece would cure it better than a dart".to_owned()
    } else if degrees > 0.0 {
        format!("a dart (or darts together) of {degrees:.1} degrees, its apex in the bulge, would cure it")
    } else {
        format!("a godet or a slit spread by {:.1} degrees would cure it", -degrees)
    };
    report.push(
        Diagnostic::warning(
            codes::PIECE_NOT_DEVELOPABLE,
            format!(
                "piece `{}` encloses {degrees:.1} degrees of curvature: no flat piece avoids {:.2} % strain (mean {:.2} %)",
                piece.name,
                100.0 * largest,
                100.0 * mean
            ),
        )
        .at(piece.source.clone())
        .hint(cure),
    );
}
