//! The report of a descent.

use crate::contact::barrier::statistics::ContactStatistics;
use crate::effects::{
    self, BENDING_HYSTERESIS, BODY_CONTACT, Effect, FRICTION, PRESSURE, SELF_CONTACT, STRAIN_LIMIT, effect,
};
use crate::energy::strain_limit::locks_from;
use crate::optimize::descent::Descent;
use crate::report::cost::Work;
use crate::scene::measures::{gaps, open_stitches};
use crate::{EffectReport, Material, Model, Outcome, Reaction, Scene, StopReason, Switch};

/// Takes the places.
pub(crate) fn outcome(d: &mut Descent<'_>, scene: &Scene, stop_reason: StopReason) -> Outcome {
    let gaps = gaps(scene, &d.x);
    let forces = d.objective().forces();
    let reactions =
        d.objective().unknowns.pins.iter().map(|(v, _)| Reaction { vertex: *v, force: -forces[*v as usize] }).collect();
    Outcome {
        steps: d.steps,
        seconds: 0.0,
        settled: stop_reason == StopReason::Settled,
        stop_reason,
        energy: d.objective().elastic(&d.x),
        speed_max: 0.0,
        residual_rel: d.newton.residual,
        seam_gap_max: gaps.first().map_or(0.0, |g| g.1),
        open_stitches: open_stitches(gaps, d.settings.stitches.closed_distance),
        effects: effects(d, scene),
        reactions,
        repaired: d.start.repaired,
        joined: 0,
        positions: std::mem::take(&mut d.x),
    }
}

pub(crate) fn effects(d: &Descent<'_>, scene: &Scene) -> Vec<EffectReport> {
    let (objective, terms) = (d.objective(), &d.objective().terms);
    let costs = terms.barrier.as_ref().map_or(objective.costs, |b| objective.costs.join(&b.statistics.costs));
    let costing = |e: EffectReport, work: Option<Work>| {
        let cpu_seconds = work.filter(|_| e.on).map_or(0.0, |w| costs.of(w));
        EffectReport { cpu_seconds, ..e }
    };
    let mut list = vec![costing(cloth(d, scene), Some(Work::Cloth)), costing(descent(d), Some(Work::Descent))];
    list.extend(terms.stitches.is_some().then(|| {
        let words = "threads pull every stitched pair".into();
        costing(effect("sewing", true, "stitches are to be closed".into(), words), Some(Work::Sewing))
    }));
    let table = effects::reports(scene, d.settings, |e| shown(e, d, scene));
    list.extend(table.into_iter().map(|(e, work)| costing(e, work)));
    list
}

/// Whether the descent had an effect, and what it showed.
fn shown(effect: &Effect, d: &Descent<'_>, scene: &Scene) -> Option<(bool, String)> {
    Some(match effect.name {
        name if name == SELF_CONTACT.name => self_contact(d),
        name if name == BODY_CONTACT.name => body_contact(d),
        name if name == FRICTION.name => friction(d),
        name if name == STRAIN_LIMIT.name => strain_limit(d, scene),
        name if name == BENDING_HYSTERESIS.name => bending_hysteresis(d, scene),
        name if name == PRESSURE.name => pressure(d),
        _ => return None,
    })
}

fn pressure(d: &Descent<'_>) -> (bool, String) {
    d.objective().terms.pressure.as_ref().map_or((false, String::new()), |p| (true, p.words()))
}

fn cloth(d: &Descent<'_>, scene: &Scene) -> EffectReport {
    let evidence = format!("{} triangles, forces taken {} times", scene.triangles.len(), d.objective().evaluations);
    effect("cloth", true, "always: stretch, shear, bending, weight".into(), evidence)
}

fn descent(d: &Descent<'_>) -> EffectReport {
    let evidence = format!("{} steps, {} factors of {} unknowns", d.steps, d.factorisations(), 3 * d.f.len());
    effect("descent", true, "always: metric, its factor, directions".into(), evidence)
}

fn tally(d: &Descent<'_>) -> ContactStatistics {
    d.objective().terms.barrier.as_ref().map_or_else(ContactStatistics::default, |b| b.statistics)
}

/// In how many looks at the cloth an effect did something.
fn active(looks: u64, of: u64) -> String {
    if looks == 0 { "never active: not needed".into() } else { format!("active in {looks} of {of} looks") }
}

fn self_contact(d: &Descent<'_>) -> (bool, String) {
    let on = d.objective().terms.barrier.as_ref().is_some_and(|b| b.parameters.has_self_contact);
    let t = tally(d);
    let evidence = if on {
        let (lists, limited) = (t.lists, t.shortened_steps);
        let active = active(t.evaluations_with_self_contact, t.evaluations);
        let ahead = format!("{} blocks without a look, {} of them taken back", t.deferred_blocks, t.rolled_back_blocks);
        format!(
            "{active}; up to {} near pairs, lists made {lists} times, {limited} steps shortened; {ahead}",
            t.most_self_contacts
        )
    } else {
        "cloth may pass through cloth".into()
    };
    (on, evidence)
}

fn body_contact(d: &Descent<'_>) -> (bool, String) {
    let body = d.objective().terms.barrier.as_ref().and_then(|b| b.body.as_ref());
    let t = tally(d);
    let evidence = match (body, d.settings.effects.body_contact) {
        (Some(_), _) if t.smallest_body_distance.is_finite() => {
            let active = active(t.evaluations_with_body_contact, t.evaluations);
            format!(
                "{active}; up to {} contacts, nearest {:.3} mm",
                t.most_body_contacts,
                t.smallest_body_distance * 1e3
            )
        }
        (Some(_), _) => active(t.evaluations_with_body_contact, t.evaluations),
        (None, Switch::Off) => "cloth may pass through a body".into(),
        (None, _) => "the scene has no body".into(),
    };
    (body.is_some(), evidence)
}

fn friction(d: &Descent<'_>) -> (bool, String) {
    let evidence = match &d.objective().terms.friction {
        None => "no contact, or no coefficient above 0".into(),
        Some(s) if s.most_contacts == 0 => active(0, 0),
        Some(s) => format!("up to {} contacts rub, {} slid at the last look", s.most_contacts, s.sliding),
    };
    (d.objective().terms.friction.is_some(), evidence)
}

fn strain_limit(d: &Descent<'_>, scene: &Scene) -> (bool, String) {
    let least = scene.materials.iter().flat_map(|m| m.strain_limit).fold(f64::INFINITY, f64::min);
    let limited = least.is_finite();
    let on = limited && d.settings.effects.strain_limit != Switch::Off;
    let bias = scene.materials.iter().any(|m| m.strain_limit[2].is_finite());
    let springs = if bias && d.settings.model == Model::Springs { "; springs along edges lock on no bias" } else { "" };
    let evidence = match (on, limited) {
        (true, _) => {
            let from = 1e2 * locks_from(least);
            format!("the stretch curves lock from {from:.2} % strain, at no cost of their own{springs}")
        }
        (false, true) => "switched off".into(),
        (false, false) => "no fabric has a limit".into(),
    };
    (on, evidence)
}

fn bending_hysteresis(d: &Descent<'_>, scene: &Scene) -> (bool, String) {
    let switch = d.settings.effects.bending_hysteresis;
    let share = scene.materials.iter().map(Material::bend_friction_share).fold(0.0, f64::max);
    let part = format!("HB c/B is at most {share:.2}");
    let evidence = match (&d.objective().terms.hysteresis, share > 0.0) {
        (Some(h), _) => format!("{part}; {} of {} holds slid at the last look", h.slip(), h.len()),
        (None, false) => "no fabric has friction in bending".into(),
        (None, true) if switch == Switch::Off => "switched off".into(),
        (None, true) => format!("{part}: the drape coefficient would change by less than a point"),
    };
    (d.objective().terms.hysteresis.is_some(), evidence)
}
