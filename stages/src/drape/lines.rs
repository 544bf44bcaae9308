//! Elastic bands and pressed folds as they came to rest.

use super::{ELASTIC_AT_REST, FOLD_OPEN};
use crate::solve::{Layout, lines, scene};
use std::f64::consts::PI;
use toile_garment::garment::{BandAtRest, Certificate, FoldAtRest};
use toile_garment::{Diagnostic, Garment, Vec3};

/// Share of its pressed angle below which a fold counts as open somewhere.
const OPEN: f64 = 0.5;

/// Cloth that is sewn flat onto itself lies folded by half a turn, and the sign of that angle says nothing. So it is from
/// this far below half a turn on, rad.
const FLAT_ONTO_ITSELF: f64 = 0.01;

/// The bands of a garment whose vertices are at `now`, m.
pub(super) fn bands(garment: &Garment, layout: &Layout, now: &[Vec<Vec3>]) -> Vec<BandAtRest> {
    let x = layout.join(now);
    let state = |b| {
        let band = lines::band(b, layout);
        let (length, tension) = toile_cloth::band_state(&band, &x);
        let unstretched_mm = band.rest_length() * 1e3;
        BandAtRest { name: b.name.clone(), unstretched_mm, length_mm: length * 1e3, tension_n: tension }
    };
    garment.bands.iter().map(state).collect()
}

/// The pressed folds of a garment whose vertices are at `now`, m.
pub(super) fn folds(garment: &Garment, layout: &Layout, now: &[Vec<Vec3>]) -> Vec<FoldAtRest> {
    let x = layout.join(now);
    let Ok(scene) = scene(garment, layout, x.clone(), Vec3::zeros()) else { return Vec::new() };
    let names = garment.pieces.iter().flat_map(|p| p.folds.iter().map(move |f| format!("{} {}", p.name, f.name)));
    let state = |(name, fold): (String, &toile_cloth::FoldLine)| {
        let lies = |a: f64| if PI - a.abs() < FLAT_ONTO_ITSELF { a.abs().copysign(fold.angle) } else { a };
        let angles: Vec<[f64; 2]> =
            toile_cloth::fold_angles(&scene, fold, &x).into_iter().map(|[a, length]| [lies(a), length]).collect();
        let length: f64 = angles.iter().map(|a| a[1]).sum();
        let mean = angles.iter().map(|a| a[0] * a[1]).sum::<f64>() / length.max(1e-9);
        let least = angles.iter().map(|a| a[0] / fold.angle).fold(f64::INFINITY, f64::min);
        FoldAtRest {
            name,
            pressed_deg: fold.angle.to_degrees(),
            mean_deg: mean.to_degrees(),
            least_share: if angles.is_empty() { 0.0 } else { least },
        }
    };
    names.zip(&scene.folds).map(state).collect()
}

/// Findings on the bands of a certificate, and on its folds that lie open.
pub(super) fn findings(certificate: &Certificate) -> Vec<Diagnostic> {
    let band = |b: &BandAtRest| {
        let message = format!(
            "elastic `{}`: {:.0} mm long before it is stretched, {:.0} mm on the garment, tension {:.2} N",
            b.name, b.unstretched_mm, b.length_mm, b.tension_n
        );
        Diagnostic::info(ELASTIC_AT_REST, message)
    };
    let fold = |f: &FoldAtRest| {
        let message = format!(
            "fold `{}`: pressed to {:.0}°, it lies at {:.0}° in the mean and opens to {:.0} % of its angle",
            f.name,
            f.pressed_deg,
            f.mean_deg,
            f.least_share * 1e2
        );
        Diagnostic::warning(FOLD_OPEN, message).hint("give it more room, or sew it down further")
    };
    let open = certificate.folds.iter().filter(|f| f.least_share < OPEN).map(fold);
    certificate.bands.iter().map(band).chain(open).collect()
}
