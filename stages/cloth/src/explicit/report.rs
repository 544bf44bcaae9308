//! The report of a run: the balance of forces, and for every effect if it was on, by which rule, on what evidence.

use crate::effects::{self, BENDING_HYSTERESIS, BODY_CONTACT, Effect, FRICTION, SELF_CONTACT, STRAIN_LIMIT, effect};
use crate::explicit::problem::Problem;
use crate::scene::measures::mean_weight;
use crate::{Curve, EffectReport, Reaction, Scene, Settings, Vec3};

/// Forces at rest.
pub(crate) struct Balance {
    /// Largest net force on a free vertex over the mean weight of a vertex.
    pub residual_rel: f64,
    /// Forces of the held vertices on what holds them.
    pub reactions: Vec<Reaction>,
}

/// Balance of the forces on cloth at rest at `x`.
///
/// A net force is the part of elastic forces and weight that the constraints (contact, friction, joined pairs,
/// elongation limit) leave over to set a free vertex moving.
pub(crate) fn balance(problem: &mut Problem, x: &[Vec3], gravity: f64, dt: f64) -> Balance {
    let n = x.len();
    let mut f = vec![Vec3::zeros(); n];
    problem.forces(x, &mut f);
    let reactions = problem.pins().iter().map(|(i, _)| Reaction { vertex: *i, force: -f[*i as usize] }).collect();
    let mut v: Vec<Vec3> = f.iter().zip(&problem.masses.inverse).map(|(f, w)| f * (dt * w)).collect();
    problem.constrain_velocities(&mut v, x, dt);
    let mut next: Vec<Vec3> = x.iter().zip(&v).map(|(x, v)| x + v * dt).collect();
    let inverse_mass = problem.masses.inverse.clone();
    if let Some(limit) = &mut problem.over_elongation {
        limit.settle(x, &mut next, &mut v, &inverse_mass, dt);
    }
    let net = |i: usize| v[i].norm() / (dt * problem.masses.inverse[i]);
    let most = (0..n).filter(|i| problem.is_free(*i)).map(net).fold(0.0, f64::max);
    let weight = mean_weight(&problem.masses.cloth, gravity);
    Balance { residual_rel: if weight > 0.0 { most / weight } else { 0.0 }, reactions }
}

/// Reports of all effects of a run.
pub(crate) fn effects(problem: &Problem, scene: &Scene, s: &Settings) -> Vec<EffectReport> {
    let table = effects::reports(scene, s, |e| shown(e, problem, scene));
    // Explicit steps do not count the time of each effect.
    let mut list: Vec<EffectReport> = table.into_iter().map(|(report, _)| report).collect();
    list.push(softened_stretch(scene, s));
    list.push(effect(
        "even-inertia",
        problem.masses.scaled > 0,
        "a vertex is more than twice as stiff per mass as the median".into(),
        format!("{} vertices got inertia (no weight)", problem.masses.scaled),
    ));
    list
}

/// State of an effect in the run, and the evidence for it; `None` for an effect without a place in this scheme.
fn shown(effect: &Effect, problem: &Problem, scene: &Scene) -> Option<(bool, String)> {
    Some(match effect.name {
        name if name == SELF_CONTACT.name => self_contact(problem),
        name if name == BODY_CONTACT.name => body_contact(problem, scene),
        name if name == FRICTION.name => friction(problem, scene),
        name if name == STRAIN_LIMIT.name => strain_limit(problem, scene),
        name if name == BENDING_HYSTERESIS.name => (false, "not simulated by explicit steps".into()),
        _ => return None,
    })
}

fn self_contact(problem: &Problem) -> (bool, String) {
    let on = problem.contact.as_ref().is_some_and(|c| c.frame().has_self_contact);
    let evidence = match &problem.contact {
        Some(c) if on => {
            let t = c.tally;
            format!(
                "up to {} pairs near each other; distances measured {} times, lists made {} times, {} moves held back",
                t.own_most, t.measures, t.lists, t.held_back
            )
        }
        _ => "cloth may pass through cloth".into(),
    };
    (on, evidence)
}

fn body_contact(problem: &Problem, scene: &Scene) -> (bool, String) {
    let body = problem.contact.as_ref().and_then(|c| c.body().map(|b| (c, b)));
    let evidence = match (&body, &scene.body) {
        (Some((c, b)), _) => format!(
            "{} body triangles, up to {} contacts, nearest {:.3} mm, {} vertices freed at the start by up to {:.1} mm",
            b.topology.faces.len(),
            c.tally.body_most,
            c.tally.body_nearest * 1e3,
            problem.repaired.0,
            problem.repaired.1 * 1e3
        ),
        (None, None) => "the scene has no body".into(),
        (None, Some(_)) => "cloth may pass through the body".into(),
    };
    (body.is_some(), evidence)
}

fn friction(problem: &Problem, scene: &Scene) -> (bool, String) {
    let most = scene.materials.iter().map(|m| m.friction).fold(0.0, f64::max);
    let slipped = problem.contact.as_ref().map_or(0, |c| c.tally.slipped);
    let evidence = if problem.has_friction {
        format!("coefficient up to {most}; {slipped} slips of a contact in a step, all other contacts stuck")
    } else if most > 0.0 {
        "no contact, or switched off".into()
    } else {
        "all coefficients are 0".into()
    };
    (problem.has_friction, evidence)
}

fn strain_limit(problem: &Problem, scene: &Scene) -> (bool, String) {
    let evidence = match &problem.over_elongation {
        Some(l) if l.most_near_limit > 0 => {
            format!("up to {} {} near their limit, {} corrections", l.most_near_limit, l.what, l.corrected)
        }
        Some(l) => format!("none of the {} came near its limit", l.what),
        None if scene.materials.iter().all(|m| m.strain_limit.iter().all(|l| l.is_infinite())) => {
            "no fabric has a limit".into()
        }
        None => "switched off".into(),
    };
    (problem.over_elongation.is_some(), evidence)
}

/// Report of stretch curves that were used softer than measured, with the strain that this adds.
fn softened_stretch(scene: &Scene, s: &Settings) -> EffectReport {
    let initial_stiffness = |c: &Curve| c.tangent(0.0);
    let rest =
        scene.materials.iter().map(|m| initial_stiffness(&m.warp).max(initial_stiffness(&m.weft))).fold(0.0, f64::max);
    let on = rest > s.explicit.stiffness_cap;
    let evidence = if on {
        format!(
            "stiffest curve starts at {rest:.0} N/m, used {:.0} N/m: a tension of 10 N/m adds {:.2} % strain",
            s.explicit.stiffness_cap,
            100.0 * (10.0 / s.explicit.stiffness_cap - 10.0 / rest)
        )
    } else {
        format!("stiffest curve starts at {rest:.0} N/m, the cap is {:.0} N/m", s.explicit.stiffness_cap)
    };
    effect("softened-stretch", on, "a stretch curve is steeper than the stiffness cap".into(), evidence)
}
