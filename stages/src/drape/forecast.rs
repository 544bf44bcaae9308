//! The effects that a drape will have, each with rule and evidence, as far as files and parameters tell.

use super::DrapeParams;
use crate::solve::material;
use toile_cloth::{EFFECTS, Effect, Facts, Settings, Switch};
use toile_garment::garment::EffectRecord;
use toile_garment::units::tidy;
use toile_stage_api::Forecast;

/// Length of free edges, metres, from which cloth takes longer to fold: a fitted bodice has as much, a circle skirt three
/// times that.
const FREE_EDGES: f64 = 2.3;
/// The share of [`FREE_EDGES`] that a metre of gathered edge counts for.
const GATHERED_METRE: f64 = 1.4;
/// The power of that share with which the time grows.
const LOOSENESS_POWER: f64 = 2.4;

/// CPU seconds of a drape for 1000 triangles.
///
/// The time of a mesh grows with the power 1.5 of its triangles, as the sums of a factor of a sheet do. How loose the cloth
/// is counts as much. Evidence: `docs/lab/2026-12-01-forecasts-by-free-edges.md`.
pub(super) fn seconds(forecast: &Forecast) -> f64 {
    let thousands = forecast.mesh.map_or(0.0, |m| m.triangles * 1e-3);
    let loose = forecast.edges.map_or(1.0, |e| (e.free / FREE_EDGES + GATHERED_METRE * e.gathered).max(1.0));
    (0.028 + 0.001 * forecast.body_thousands()) * thousands.sqrt() * libm::pow(loose, LOOSENESS_POWER)
}

/// The effects of a drape with these parameters.
pub(super) fn effects(params: &DrapeParams, forecast: &Forecast) -> Vec<EffectRecord> {
    let settings = params.settings(1);
    let facts = facts(&settings, forecast);
    let record = |effect: &&Effect| {
        let on = effect.is_on(&facts, &settings);
        effect.is_told(on).then(|| record(effect, on, &facts, &settings))
    };
    EFFECTS.iter().filter_map(record).collect()
}

/// Facts of the scene to come, as the files tell them.
fn facts(settings: &Settings, forecast: &Forecast) -> Facts {
    let garment = &forecast.garment;
    let pieces = garment.pieces.len();
    let size = forecast.mesh.map_or_else(String::new, |m| {
        format!(", about {:.0} triangles with edges of about {:.1} mm", m.triangles, m.edge * 1e3)
    });
    let cloth = format!("{pieces} {}{size}", if pieces == 1 { "piece" } else { "pieces" });
    let body = garment.body.as_ref().filter(|b| !b.triangles.is_empty());
    let body = body.map(|b| format!("body `{}` with {} triangles", b.name, b.triangles.len()));
    let materials: Vec<_> = garment.fabrics.values().map(material).collect();
    let facts = Facts::new(&materials, settings, cloth, body);
    Facts { pressure: tidy(facts.pressure), ..facts }
}

/// Nothing is simulated that the scene has no use for, whatever was asked.
fn record(effect: &Effect, on: bool, facts: &Facts, settings: &Settings) -> EffectRecord {
    let (name, rule) = (effect.name, effect.rule);
    let rule = match effect.switch(settings) {
        Switch::Auto => rule.to_owned(),
        Switch::On => format!("asked for with effects.{name} = \"on\"; used where {rule}"),
        Switch::Off => format!("switched off with effects.{name} = \"off\""),
    };
    let refused = if on && !effect.is_built { "; not in this build: the run will be refused" } else { "" };
    let evidence = effect.evidence(facts, settings) + refused;
    EffectRecord { name: name.to_owned(), on, rule, evidence, cpu_seconds: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drape::{EffectsParam, IntegratorName, SwitchName};
    use toile_garment::Garment;
    use toile_garment::fabric::Fabric;

    fn of(params: &DrapeParams, garment: Garment) -> Vec<EffectRecord> {
        effects(params, &Forecast { garment, ..Forecast::default() })
    }

    #[test]
    fn a_scene_without_body_and_fabric_needs_no_contact_with_them() {
        let found = of(&DrapeParams::default(), Garment::default());
        let on: Vec<(&str, bool)> = found.iter().map(|e| (e.name.as_str(), e.on)).collect();
        assert_eq!(
            on,
            [
                ("self-contact", true),
                ("body-contact", false),
                ("friction", false),
                ("strain-limit", false),
                ("bending-hysteresis", false)
            ]
        );
    }

    #[test]
    fn a_switch_is_the_rule_where_it_is_set() {
        let effects = EffectsParam { self_contact: SwitchName::Off, ..EffectsParam::default() };
        let found = of(&DrapeParams { effects, ..DrapeParams::default() }, Garment::default());
        assert!(!found[0].on && found[0].rule.contains("effects.self-contact = \"off\""));
        assert_eq!(found[2].evidence, "no contact is simulated");
    }

    #[test]
    fn friction_in_bending_is_foreseen_as_the_drape_takes_it() {
        let fabric = |hysteresis: f64| Fabric {
            bend_hysteresis: Some(hysteresis),
            ..crate::testing::cloth(0.15, 3000.0, 40.0, [1e-5; 2])
        };
        let on = |params: &DrapeParams, hysteresis: f64| {
            let fabrics = [("cloth".to_owned(), fabric(hysteresis))].into_iter().collect();
            of(params, Garment { fabrics, ..Garment::default() })[4].on
        };
        let usual = DrapeParams::default();
        let effects = EffectsParam { bending_hysteresis: SwitchName::On, ..EffectsParam::default() };
        let asked = DrapeParams { effects, ..DrapeParams::default() };
        assert!(on(&usual, 1e-3) && !on(&usual, 1e-6), "by itself where it is felt");
        assert!(on(&asked, 1e-6) && !on(&asked, 0.0), "asked for: wherever there is any");
        let explicit = DrapeParams { integrator: IntegratorName::CentralDifference, ..DrapeParams::default() };
        assert!(!on(&explicit, 1e-3));
    }
}
