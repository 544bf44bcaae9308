//! Parameters that this motion has no use for: each is told.

use super::{AnimateParams, SteppingName};
use crate::drape::act_elsewhere;
use toile_garment::Diagnostic;

/// A warning for each parameter that is set and acts with another time stepping only.
pub(super) fn settings(params: &AnimateParams) -> Vec<Diagnostic> {
    let default = AnimateParams::default();
    if params.integrator == SteppingName::Implicit {
        let set = [("contact_stiffness", params.contact_stiffness.is_some()), ("fixed_step", params.fixed_step)];
        return act_elsewhere(&set, &["central-difference", "leapfrog"]);
    }
    act_elsewhere(&[("accuracy", params.accuracy != default.accuracy)], &["implicit"])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drape::AccuracyName;
    use toile_garment::units::LineForce;

    #[test]
    fn settings_of_another_stepping_are_told() {
        let told =
            |params: &AnimateParams| -> Vec<String> { settings(params).into_iter().map(|f| f.message).collect() };
        let stiff = AnimateParams {
            contact_stiffness: Some(LineForce(5.0)),
            fixed_step: true,
            accuracy: AccuracyName::Fine,
            ..AnimateParams::default()
        };
        let found = told(&stiff);
        assert!(found.len() == 2 && found[0].starts_with("with.contact_stiffness does nothing"), "{found:?}");
        let explicit = AnimateParams { integrator: SteppingName::Leapfrog, ..stiff };
        let found = told(&explicit);
        assert!(found.len() == 1 && found[0].starts_with("with.accuracy does nothing"), "{found:?}");
        assert!(told(&AnimateParams::default()).is_empty());
    }

    #[test]
    fn a_motion_without_a_frame_is_refused() {
        let of = |frames| super::super::check(&AnimateParams { frames, ..AnimateParams::default() });
        assert!(of(Some(0)).is_err() && of(Some(1)).is_ok() && of(None).is_ok());
    }
}
