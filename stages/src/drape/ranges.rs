//! Parameters of a drape in their ranges.

use super::{DrapeParams, SETTING_OUT_OF_RANGE, repeats};
use crate::solve::ranges;
use toile_garment::Diagnostic;
use toile_stage_api::StageError;

/// Refuses values that make no sense.
pub(super) fn check(params: &DrapeParams) -> Result<(), StageError> {
    let limits = params.limits.iter().filter(|(_, gate)| gate.is_nan() || **gate < 0.0).map(|(figure, gate)| {
        let message = format!("`limits.{}` is {gate}, and no figure of the certificate is below 0", figure.name());
        Diagnostic::error(SETTING_OUT_OF_RANGE, message).hint("a limit is the most that is allowed")
    });
    let faults: Vec<_> =
        ranges::gravity(params.gravity).into_iter().chain(repeats::fault(params)).chain(limits).collect();
    if faults.is_empty() { Ok(()) } else { Err(StageError::Parameter(faults)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drape::GatedFigure;
    use toile_garment::units::Acceleration;

    #[test]
    fn all_values_out_of_range_are_told_at_once() {
        let told = |params: DrapeParams| check(&params).err().map_or(String::new(), |e| e.to_string());
        assert_eq!(told(DrapeParams::default()), "");
        let gated = |gate| [(GatedFigure::StrainMax, gate)].into_iter().collect();
        let all = told(DrapeParams {
            gravity: Acceleration(-9.81),
            repeats: 21,
            limits: gated(-3.0),
            ..DrapeParams::default()
        });
        let words = ["`gravity` is -9.81", "`repeats` is 21", "`limits.strain_max` is -3"];
        assert!(words.iter().all(|w| all.contains(w)), "{all}");
        assert!(told(DrapeParams { limits: gated(f64::NAN), ..DrapeParams::default() }).contains("strain_max"));
        // Millimetres that were taken for metres.
        assert!(told(DrapeParams { gravity: Acceleration(9810.0), ..DrapeParams::default() }).contains("0 to 5000"));
    }
}
