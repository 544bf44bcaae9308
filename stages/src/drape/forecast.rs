//! The effects that a drape will have, each with rule and evidence, as far as files and parameters tell.

use super::{DrapeParams, IntegratorName, SwitchName};
use crate::solve::material;
use toile_cloth::HYSTERESIS_FELT;
use toile_garment::Garment;
use toile_garment::fabric::Fabric;
use toile_garment::garment::EffectRecord;
use toile_stage_api::{Forecast, MeshSize};

/// The effects of a drape with these parameters.
pub(super) fn effects(params: &DrapeParams, forecast: &Forecast) -> Vec<EffectRecord> {
    let (switches, garment) = (&params.effects, &forecast.garment);
    let body = effect("body-contact", switches.body_contact, "the scene has a body", of_body(garment));
    let own = effect(
        "self-contact",
        switches.self_contact,
        "cloth that moves freely can meet itself",
        of_cloth(garment, forecast.mesh),
    );
    let touches = own.on || body.on;
    let friction =
        effect("friction", switches.friction, "contact and a coefficient above 0", of_friction(garment, touches));
    let limit = effect("strain-limit", switches.strain_limit, "a fabric has a limit", of_limits(garment));
    let switch = switches.bending_hysteresis;
    let evidence = of_bending(params, switch, garment);
    let bending = effect("bending-hysteresis", switch, toile_cloth::HYSTERESIS_RULE, evidence);
    let mut list = vec![own, body, friction, limit, bending];
    list.extend(pressure(params));
    list
}

/// Only where one is given.
fn pressure(params: &DrapeParams) -> Option<EffectRecord> {
    let p = params.pressure.filter(|p| p.0 != 0.0)?;
    Some(effect("pressure", SwitchName::Auto, "a pressure is given", (true, p.to_string())))
}

/// Does the scene call for it, and what says so.
type Evidence = (bool, String);

/// Nothing is simulated that the scene has no use for, whatever was asked.
fn effect(name: &str, switch: SwitchName, rule: &str, (called_for, evidence): Evidence) -> EffectRecord {
    let rule = match switch {
        SwitchName::Auto => rule.to_owned(),
        SwitchName::On => format!("asked for with effects.{name} = \"on\"; used where {rule}"),
        SwitchName::Off => format!("switched off with effects.{name} = \"off\""),
    };
    let on = switch != SwitchName::Off && called_for;
    let refused = if on && !toile_cloth::is_built(name) { "; not in this build: the run will be refused" } else { "" };
    EffectRecord { name: name.to_owned(), on, rule, evidence: evidence + refused, cpu_seconds: 0.0 }
}

fn of_cloth(garment: &Garment, mesh: Option<MeshSize>) -> Evidence {
    let pieces = garment.pieces.len();
    let size = mesh.map_or_else(String::new, |m| {
        format!(", about {:.0} triangles with edges of about {:.1} mm", m.triangles, m.edge * 1e3)
    });
    (true, format!("{pieces} {}{size}", if pieces == 1 { "piece" } else { "pieces" }))
}

fn of_body(garment: &Garment) -> Evidence {
    match garment.body.as_ref().filter(|b| !b.triangles.is_empty()) {
        Some(body) => (true, format!("body `{}` with {} triangles", body.name, body.triangles.len())),
        None => (false, "no stage gives a body".to_owned()),
    }
}

fn of_friction(garment: &Garment, touches: bool) -> Evidence {
    let most = garment.fabrics.values().map(|f| f.friction).fold(0.0, f64::max);
    if touches {
        (most > 0.0, format!("largest coefficient of the fabrics {most}"))
    } else {
        (false, "no contact is simulated".to_owned())
    }
}

fn of_bending(params: &DrapeParams, switch: SwitchName, garment: &Garment) -> Evidence {
    if params.integrator == IntegratorName::CentralDifference {
        return (false, "central differences do not simulate it".to_owned());
    }
    let least = if switch == SwitchName::On { f64::MIN_POSITIVE } else { HYSTERESIS_FELT };
    let most = garment.fabrics.values().map(|f| material(f).bend_friction_share()).fold(0.0, f64::max);
    (most >= least, format!("largest of the fabrics {most:.2}"))
}

fn of_limits(garment: &Garment) -> Evidence {
    let limits = |f: &Fabric| [Some(f.strain_limit_warp), Some(f.strain_limit_weft), f.strain_limit_bias];
    let least = garment.fabrics.values().flat_map(limits).flatten().fold(f64::INFINITY, f64::min);
    if least.is_finite() {
        (true, format!("smallest limit of the fabrics {:.1} %", least * 100.0))
    } else {
        (false, "no fabric has a limit".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drape::EffectsParam;

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
