//! How far apart a garment comes to rest from starts that nobody could tell apart.
//!
//! Folded cloth has many rests, and which one it finds can hang on the last digit of its start. A figure that differs
//! between them says nothing of the garment.

use super::{DrapeParams, RESTS_APART, SETTING_OUT_OF_RANGE};
use crate::solve::Follow;
use toile_cloth::{ClothError, Outcome, Scene, Settings};
use toile_garment::garment::Rests;
use toile_garment::{Diagnostic, Garment, Vec3};
use toile_stage_api::StageContext;

/// Largest move of a start along each axis, m.
const SHAKE: f64 = 1e-6;
/// Most repeats.
const MOST: u32 = 20;

/// More repeats than make sense.
pub(super) fn fault(params: &DrapeParams) -> Option<Diagnostic> {
    let text = format!("`repeats` is {}; write a whole number from 0 to {MOST}", params.repeats);
    (params.repeats > MOST).then(|| Diagnostic::error(SETTING_OUT_OF_RANGE, text))
}

/// Drapes again from shaken starts and measures every vertex against the first rest.
pub(super) fn measure(
    scene: &Scene,
    settings: &Settings,
    first: &Outcome,
    repeats: u32,
    cx: &mut StageContext<'_>,
) -> Result<Option<Rests>, ClothError> {
    let mut apart: Vec<f64> = Vec::new();
    let mut settled = 0;
    for draw in 1..=repeats {
        let start = toile_cloth::shaken(scene, SHAKE, draw);
        let again = toile_cloth::drape(&start, settings, &mut Follow::new(cx))?;
        settled += u32::from(again.settled);
        apart.extend(again.positions.iter().zip(&first.positions).map(|(p, q): (&Vec3, &Vec3)| (p - q).norm() * 1e3));
    }
    apart.sort_by(f64::total_cmp);
    let Some(largest) = apart.last().copied() else { return Ok(None) };
    let share = |numerator: usize| apart[(apart.len() - 1) * numerator / 100];
    Ok(Some(Rests {
        repeats,
        settled,
        shake_mm: SHAKE * 1e3,
        apart_median_mm: share(50),
        apart_p95_mm: share(95),
        apart_max_mm: largest,
    }))
}

/// The note on what was measured.
pub(super) fn finding(rests: &Rests) -> Diagnostic {
    let message = format!(
        "{} more drapes, each from a start moved by up to 1 µm, end {:.2} mm from the first in the middle of all vertices, \
         {:.1} mm at 95 % and {:.1} mm at most",
        rests.repeats, rests.apart_median_mm, rests.apart_p95_mm, rests.apart_max_mm
    );
    Diagnostic::info(RESTS_APART, message).hint("compare with others only what differs by clearly more")
}

/// The advice for a scene that calls for repeats: nothing holds its cloth, so where it ends is up to its folds.
pub(super) fn advice(params: &DrapeParams, garment: &Garment) -> Option<String> {
    let held = !garment.plan.attachments.is_empty() || !garment.pins.is_empty();
    let calls = !held && params.repeats == 0 && garment.body.is_some();
    calls.then(|| {
        "nothing holds this cloth on the body, so it may come to rest in more than one way; --repeats 4 measures how far \
         apart its rests lie"
            .to_owned()
    })
}
