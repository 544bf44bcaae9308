//! The effects that only motion has, as far as the parameters tell.

use super::AnimateParams;
use toile_garment::garment::EffectRecord;

/// Inertia, resistance of the air, and a body that moves.
pub(super) fn effects(params: &AnimateParams) -> [EffectRecord; 3] {
    let dynamics = params.dynamics();
    let body = params.body.as_ref();
    let steps = format!("steps of {:.3} ms at most", dynamics.step * 1e3);
    let drag = format!("{} kg/m³ against the square of the speed across the cloth", dynamics.drag);
    let frames = body
        .map_or_else(|| "no `body` is given: it stands still".to_owned(), |b| format!("frames of `{}`", b.display()));
    [
        ("inertia", true, "the cloth moves in time", steps),
        ("air", dynamics.drag > 0.0, "a drag above 0", drag),
        ("moving-body", body.is_some(), "the body has frames", frames),
    ]
    .map(|(name, on, rule, evidence)| EffectRecord {
        name: name.to_owned(),
        on,
        rule: rule.to_owned(),
        evidence,
        cpu_seconds: 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plan_tells_of_air_and_body_as_they_are_asked_for() {
        let on = |toml: &str| effects(&toml::from_str(toml).expect("parameters")).map(|e| e.on);
        assert_eq!(on(""), [true, true, false]);
        assert_eq!(on("air = \"off\"\nbody = \"walk-000.obj\""), [true, false, true]);
    }
}
