//! The figures of the certificate that may have a gate.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toile_garment::garment::Certificate;

/// A figure of the certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GatedFigure {
    /// Largest force that is not balanced, as a share of the weight.
    ResidualRel,
    /// Strain that 95 of 100 triangles stay below.
    StrainP95,
    /// Largest strain.
    StrainMax,
    /// Largest strain over the limit of its fabric.
    StrainOverLimit,
    /// Sinking of the garment's top, mm.
    SlipMm,
    /// Widest stitch of the seams, mm.
    SeamGapMaxMm,
    /// Widest stitch of the darts, mm.
    DartGapMaxMm,
    /// Pairs of cloth that cross.
    SelfCrossings,
    /// Pairs of cloth and body that cross.
    BodyCrossings,
    /// Deepest vertex in the body, mm.
    PenetrationMaxMm,
}

impl GatedFigure {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::ResidualRel,
        Self::StrainP95,
        Self::StrainMax,
        Self::StrainOverLimit,
        Self::SlipMm,
        Self::SeamGapMaxMm,
        Self::DartGapMaxMm,
        Self::SelfCrossings,
        Self::BodyCrossings,
        Self::PenetrationMaxMm,
    ];

    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ResidualRel => "residual_rel",
            Self::StrainP95 => "strain_p95",
            Self::StrainMax => "strain_max",
            Self::StrainOverLimit => "strain_over_limit",
            Self::SlipMm => "slip_mm",
            Self::SeamGapMaxMm => "seam_gap_max_mm",
            Self::DartGapMaxMm => "dart_gap_max_mm",
            Self::SelfCrossings => "self_crossings",
            Self::BodyCrossings => "body_crossings",
            Self::PenetrationMaxMm => "penetration_max_mm",
        }
    }

    /// Its value in a certificate.
    #[must_use]
    pub fn of(self, certificate: &Certificate) -> f64 {
        match self {
            Self::ResidualRel => certificate.residual_rel,
            Self::StrainP95 => certificate.strain_p95,
            Self::StrainMax => certificate.strain_max,
            Self::StrainOverLimit => certificate.strain_over_limit,
            Self::SlipMm => certificate.slip_mm,
            Self::SeamGapMaxMm => certificate.seam_gap_max_mm,
            Self::DartGapMaxMm => certificate.dart_gap_max_mm,
            Self::SelfCrossings => certificate.self_crossings as f64,
            Self::BodyCrossings => certificate.body_crossings as f64,
            Self::PenetrationMaxMm => certificate.penetration_max_mm,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_files_and_no_other_is_a_figure() {
        for figure in GatedFigure::ALL {
            assert_eq!(serde_json::to_value(figure).unwrap(), figure.name());
        }
        let told = serde_json::from_str::<GatedFigure>("\"strainmax\"").unwrap_err().to_string();
        assert!(told.contains("strain_max"), "{told}");
    }
}
