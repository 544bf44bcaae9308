//! The certificate: figures counted afresh, each with its limit.

use super::{DrapeParams, GatedFigure};
use std::collections::BTreeMap;
use toile_cloth::{Figures, Outcome};
use toile_garment::garment::Certificate;
use toile_garment::seam::{Seam, SeamKind};
use toile_garment::{Garment, Vec3};

/// Strain at the gate over the fabric's limit. The solver's limit is a steep wall: cloth comes to rest a little beyond it.
/// Garments that fit end at 1.005 of it at most. A strapless dress on the hips, too tight there, ends at 1.07.
const STRAIN_MARGIN: f64 = 1.05;

/// Sinking of a garment's top that still is no sliding down, mm. It is chosen: of nine garments that nothing holds a hooded
/// one sinks most, by 17 mm.
const SLIP_MOST_MM: f64 = 100.0;

/// Default gates. The gate of the largest strain follows from the fabric.
const GATES: [(GatedFigure, f64); 8] = [
    (GatedFigure::SlipMm, SLIP_MOST_MM),
    (GatedFigure::StrainOverLimit, STRAIN_MARGIN),
    (GatedFigure::ResidualRel, 0.1),
    (GatedFigure::SeamGapMaxMm, 0.1),
    (GatedFigure::DartGapMaxMm, 0.1),
    (GatedFigure::SelfCrossings, 0.0),
    (GatedFigure::BodyCrossings, 0.0),
    (GatedFigure::PenetrationMaxMm, 0.0),
];

/// Puts figures and limits together. `rest`: places of the vertices, per piece, m.
#[must_use]
pub fn certificate(
    garment: &Garment,
    params: &DrapeParams,
    outcome: &Outcome,
    figures: &Figures,
    rest: &[Vec<Vec3>],
    slip: f64,
) -> Certificate {
    let mut gates = BTreeMap::from(GATES);
    let strain_gate = STRAIN_MARGIN * strain_limit(garment);
    gates.insert(GatedFigure::StrainMax, strain_gate);
    gates.extend(&params.limits);
    let mut certificate = Certificate {
        passed: false,
        settled: outcome.settled,
        residual_rel: outcome.residual_rel,
        energy_j: figures.energy,
        strain_p95: figures.strain_p95,
        strain_max: figures.strain_max,
        strain_over_limit: figures.strain_over_limit,
        strain_gate,
        slip_mm: slip * 1e3,
        unheld: Vec::new(),
        // Sewn vertices are one vertex now; a stitch that sewing could not close is open.
        seam_gap_max_mm: gap(garment, rest, false),
        dart_gap_max_mm: gap(garment, rest, true),
        self_crossings: figures.self_crossings as u64,
        body_crossings: figures.body_crossings as u64,
        penetration_max_mm: figures.penetration_max * 1e3,
        limits: gates.iter().map(|(figure, gate)| (figure.name().to_owned(), *gate)).collect(),
        bands: Vec::new(),
        folds: Vec::new(),
        rests: None,
    };
    certificate.passed = certificate.settled && within(&certificate);
    certificate
}

/// The widest stitch of the seams, or of the darts, mm.
fn gap(garment: &Garment, rest: &[Vec<Vec3>], darts: bool) -> f64 {
    let is_meant = |s: &Seam| matches!(s.kind, SeamKind::Dart { .. }) == darts;
    garment.widest_gap(rest, is_meant).map_or(0.0, |(_, gap)| gap * 1e3)
}

/// The largest strain any fabric of the garment is used at.
fn strain_limit(garment: &Garment) -> f64 {
    garment.fabrics.values().map(|f| f.strain_limit_warp.max(f.strain_limit_weft)).fold(0.0, f64::max)
}

/// Is every figure within its gate? A figure that is no number never passes.
fn within(c: &Certificate) -> bool {
    GatedFigure::ALL.iter().all(|figure| c.limits.get(figure.name()).is_none_or(|gate| figure.of(c) <= *gate))
}
