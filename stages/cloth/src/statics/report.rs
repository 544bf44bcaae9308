//! What a descent tells.

use super::descent::Descent;
use crate::energy::law::LOCKING;
use crate::report::{effect, switched};
use crate::sewing::gaps;
use crate::{EffectReport, Outcome, Reaction, Scene, StopReason, Switch};

pub(crate) fn outcome(d: Descent<'_>, scene: &Scene, stop_reason: StopReason) -> Outcome {
    let gaps = gaps(scene, &d.x);
    let forces = d.goal.forces();
    let reactions = d.goal.pins.iter().map(|(v, _)| Reaction { vertex: *v, force: -forces[*v as usize] }).collect();
    Outcome {
        steps: d.steps,
        seconds: 0.0,
        settled: stop_reason == StopReason::Settled,
        stop_reason,
        energy: d.goal.elastic(&d.x),
        speed_max: 0.0,
        residual_rel: d.residual,
        seam_gap_max: gaps.first().map_or(0.0, |g| g.1),
        open_stitches: gaps.into_iter().filter(|g| g.1 > d.settings.sewing_distance).take(20).collect(),
        effects: effects(&d, scene),
        reactions,
        repaired: d.repaired,
        positions: d.x,
    }
}

pub(crate) fn effects(d: &Descent<'_>, scene: &Scene) -> Vec<EffectReport> {
    let e = &d.settings.effects;
    let tally = d.goal.barrier.as_ref().map(|b| b.tally);
    let own = d.goal.barrier.as_ref().is_some_and(|b| b.frame.own);
    let body = d.goal.barrier.as_ref().is_some_and(|b| b.body.is_some());
    let limited = scene.materials.iter().any(|m| m.strain_limit.iter().any(|l| l.is_finite()));
    let told = |f: &dyn Fn(crate::collide::barrier::Tally) -> String| tally.map_or_else(String::new, f);
    vec![
        effect(
            "self-contact",
            own,
            switched(e.self_contact, "cloth that moves freely can meet itself"),
            told(&|t| {
                format!("up to {} near pairs; lists made {} times, {} steps shortened", t.own_most, t.lists, t.limited)
            }),
        ),
        effect(
            "body-contact",
            body,
            switched(e.body_contact, "the scene has a body"),
            told(&|t| format!("up to {} contacts, nearest {:.3} mm", t.body_most, t.nearest_body * 1e3)),
        ),
        effect(
            "friction",
            d.goal.stick.is_some(),
            switched(e.friction, "contact and a coefficient above 0"),
            d.goal.stick.as_ref().map_or_else(
                || "no contact, or no coefficient above 0".into(),
                |s| format!("up to {} contacts rub, {} slid at the last look", s.most, s.slid),
            ),
        ),
        effect(
            "strain-limit",
            limited && e.strain_limit != Switch::Off,
            switched(e.strain_limit, "a fabric has a limit"),
            format!("the stretch curves lock from {LOCKING} of the limit"),
        ),
    ]
}
