use super::*;
use crate::{Effects, Integrator, Material, Switch};

fn facts() -> Facts {
    Facts::new(&[], &Settings::default(), "cloth".into(), None)
}

#[test]
fn names_stand_once_and_every_page_is_there() {
    for (k, effect) in EFFECTS.iter().enumerate() {
        assert!(EFFECTS[..k].iter().all(|e| e.name != effect.name), "{}", effect.name);
        let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(effect.page);
        assert!(page.is_file(), "{} has no page {}", effect.name, page.display());
        assert!(effect.feature.is_some() || effect.is_built, "{} can be left out by no feature", effect.name);
    }
}

#[test]
fn an_effect_is_on_by_its_rule_or_off_by_its_switch() {
    let s = Settings::default();
    assert!(SELF_CONTACT.is_on(&facts(), &s) && !BODY_CONTACT.is_on(&facts(), &s));
    assert!(!FRICTION.is_on(&facts(), &s) && FRICTION.is_on(&Facts { friction: 0.3, ..facts() }, &s));
    assert!(STRAIN_LIMIT.is_on(&Facts { strain_limit: 0.1, ..facts() }, &s) && !STRAIN_LIMIT.is_on(&facts(), &s));
    let off = Settings { effects: Effects { self_contact: Switch::Off, ..s.effects }, ..s };
    assert!(!SELF_CONTACT.is_on(&facts(), &off), "switched off");
    assert!(!FRICTION.is_on(&Facts { friction: 0.3, ..facts() }, &off), "nothing touches");
}

#[test]
fn friction_in_bending_is_on_where_it_is_felt_or_asked_for() {
    let s = Settings::default();
    let on = |share: f64, s: &Settings| BENDING_HYSTERESIS.is_on(&Facts { bend_friction: share, ..facts() }, s);
    assert!(on(0.06, &s) && !on(0.04, &s));
    let asked = Settings { effects: Effects { bending_hysteresis: Switch::On, ..s.effects }, ..s.clone() };
    assert!(on(0.04, &asked) && !on(0.0, &asked) && BENDING_HYSTERESIS.is_wanted(&facts(), &asked));
    assert!(!on(0.06, &Settings { integrator: Integrator::CentralDifference, ..s }));
}

#[test]
fn measured_curves_are_told_where_there_are_any() {
    let curves = |curves: usize| Facts { curves, ..facts() };
    let effect = measured_curves::EFFECT;
    let s = Settings::default();
    assert!(!effect.is_on(&curves(0), &s) && effect.is_on(&curves(3), &s) && !effect.is_told(false));
    assert_eq!(effect.evidence(&curves(3), &s), "3 curves");
}

#[test]
fn facts_are_the_extremes_of_the_fabrics() {
    let cloth = crate::energy::tests::fabric();
    let other = Material { friction: 0.7, strain_limit: [0.2, 0.05, f64::INFINITY], ..cloth.clone() };
    let facts = Facts::new(&[cloth, other], &Settings::default(), String::new(), None);
    assert_eq!((facts.friction, facts.strain_limit), (0.7, 0.05));
}
