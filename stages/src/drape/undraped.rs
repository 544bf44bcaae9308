//! Garments whose seams stand wide open: they are not draped, since no drape can close them.

use super::NOT_DRAPED;
use toile_cloth::{Outcome, Scene, StopReason};
use toile_garment::garment::Shape;
use toile_garment::seam::Seam;
use toile_garment::units::Length;
use toile_garment::{Diagnostic, Garment};

/// A garment with a seam that stands open by more after sewing is not draped, m. Sewing ends with its full force, and no
/// drape closes what is over 5 mm (`JOINED_GAP_MOST`). With less than this the rest of the garment is worth seeing. Wrong
/// plans of shirts, trousers and dresses left 130 to 630 mm, and their drapes took 70 to 100 s in vain.
const OPEN_MOST: f64 = 0.05;

/// The seam that stands open widest after sewing, with its gap in metres, where it is too wide to be draped. `most` is what
/// the pipeline asks for.
pub fn wide_open<'a>(garment: &'a Garment, sewn: &Shape, most: Option<Length>) -> Option<(&'a Seam, f64)> {
    let most = most.map_or(OPEN_MOST, |most| most.0);
    garment.widest_gap(&sewn.positions, |_| true).filter(|(_, gap)| *gap > most)
}

/// The end of a drape that was not begun: all is where it was sewn.
pub fn outcome(scene: &Scene, gap: f64) -> Outcome {
    Outcome {
        positions: scene.positions.clone(),
        steps: 0,
        seconds: 0.0,
        settled: false,
        stop_reason: StopReason::SeamsOpen,
        energy: 0.0,
        speed_max: 0.0,
        // Nothing bears the weight of a vertex yet.
        residual_rel: 1.0,
        seam_gap_max: gap,
        open_stitches: Vec::new(),
        effects: Vec::new(),
        reactions: Vec::new(),
        repaired: (0, 0.0),
        joined: 0,
    }
}

/// A finding on a garment that was not draped.
pub fn finding(seam: &Seam, gap: f64) -> Diagnostic {
    let message = format!(
        "seam `{}` stands open by {:.0} mm, so the garment was not draped: it is shown as it was sewn",
        seam.name,
        gap * 1e3
    );
    let hint = format!(
        "correct the seams that `seam-open` names; with.open_seams = \"{:.0} mm\" of `drape` drapes it nevertheless",
        (gap * 1e2).ceil() * 10.0
    );
    Diagnostic::warning(NOT_DRAPED, message).at(seam.source.clone()).hint(hint)
}
