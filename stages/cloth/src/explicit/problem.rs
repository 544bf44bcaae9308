//! The dynamic system of the paper (equation 1): model, contact, sewing, limits and held vertices together.
//!
//! The integrator sees only this.

use crate::collision::body::Body;
use crate::contact::parameters::contact_parameters;
use crate::energy::model::model;
use crate::energy::{Energy, elastic};
use crate::explicit::contact::PenaltyContact;
use crate::explicit::contact::stiffness::ContactStiffness;
use crate::explicit::friction;
use crate::explicit::over_elongation::OverElongation;
use crate::explicit::sewing_force::SewingForces;
use crate::explicit::tuning::{
    EXPLICIT_CONTACT_STIFFNESS, HELD_VERTEX_DISTANCE, HELD_VERTEX_SPEED, MASS_SCALING, MASS_SCALING_STIFFNESS_RATIO,
};
use crate::prepare::start::Start;
use crate::scene::measures::{held, masses};
use crate::scene::topology::Topology;
use crate::{ClothError, Scene, Settings, Switch, Vec3};

/// Time step of cloth without any stiffness, s.
const STEP_WITHOUT_STIFFNESS: f64 = 1e-2;

/// Masses of the vertices.
pub(crate) struct Masses {
    /// Mass of the cloth, kg; 0 for vertices without a triangle.
    pub cloth: Vec<f64>,
    /// Inertia of a vertex, kg: its mass, or more where mass is scaled.
    inertia: Vec<f64>,
    /// Inverse of the inertia, 1/kg; 0 for held vertices.
    pub inverse: Vec<f64>,
    /// Number of vertices whose inertia is more than their mass, so that they do not rule the step.
    pub scaled: usize,
}

/// Damping of the motion.
pub(crate) struct Damping {
    /// Mass-proportional rate C_d/m of equation 7, 1/s.
    pub rate: f64,
    /// Stiffness-proportional damping time, in time steps.
    pub stiffness_steps: f64,
}

/// The dynamic system.
pub(crate) struct Problem {
    pub energies: Vec<Box<dyn Energy>>,
    pub contact: Option<PenaltyContact>,
    pub has_friction: bool,
    pub sewing: SewingForces,
    pub over_elongation: Option<OverElongation>,
    pub masses: Masses,
    pub damping: Damping,
    /// Start positions, freed of the body, m.
    pub start: Vec<Vec3>,
    /// Vertices moved to free the start, and the largest move, m.
    pub repaired: (usize, f64),
    /// Held vertices and their places, m.
    pins: Vec<(u32, Vec3)>,
    /// Work array: row sums of the stiffness, N/m.
    stiffness_rows: Vec<f64>,
}

impl Problem {
    /// Checks a scene and builds its system. Stitches pull only where `pulls`.
    ///
    /// # Errors
    /// An unusable scene or setting, or a start that crosses.
    pub fn new(scene: &Scene, s: &Settings, pulls: bool) -> Result<Self, ClothError> {
        let Start { topology, positions, body, own, repaired, .. } = Start::new(scene, s)?;
        let mut problem = Self::without_contact(scene, s, pulls, &topology, positions, repaired);
        problem.add_contact(scene, s, topology, body, own);
        Ok(problem)
    }

    /// Builds everything but contact, without any check.
    fn without_contact(
        scene: &Scene,
        s: &Settings,
        pulls: bool,
        topology: &Topology,
        start: Vec<Vec3>,
        repaired: (usize, f64),
    ) -> Self {
        let cloth = masses(scene);
        let energies = model(scene, s, topology, &cloth);
        let mut stiffness_rows = vec![0.0; start.len()];
        for e in &energies {
            e.add_stiffness(&start, &mut stiffness_rows);
        }
        let pins = held(scene);
        let masses = Masses::new(cloth, &stiffness_rows, s.explicit.mass_scaling, &pins);
        let sewing = SewingForces::new(scene, s, &stiffness_rows, &masses.inertia, pulls);
        Self {
            energies,
            contact: None,
            has_friction: false,
            sewing,
            over_elongation: if s.effects.strain_limit == Switch::Off {
                None
            } else {
                OverElongation::new(scene, s.explicit.correction)
            },
            masses,
            damping: Damping { rate: s.explicit.damping, stiffness_steps: s.explicit.stiffness_damping },
            start,
            repaired,
            pins,
            stiffness_rows,
        }
    }

    /// Builds contact as the switches say.
    fn add_contact(&mut self, scene: &Scene, s: &Settings, topology: Topology, body: Option<Body>, own: bool) {
        if body.is_none() && !own {
            return;
        }
        let dt = s.explicit.step_fraction.min(1.0) * self.stable_step(&self.start.clone());
        let frame = contact_parameters(scene, s, topology, &self.masses.inverse, body.is_some(), own);
        self.has_friction = s.effects.friction != Switch::Off && frame.friction.iter().any(|m| *m > 0.0);
        let stiffness = if s.explicit.contact_stiffness > 0.0 {
            ContactStiffness::Fixed(s.explicit.contact_stiffness)
        } else {
            ContactStiffness::PerMass(EXPLICIT_CONTACT_STIFFNESS.get() / (dt * dt))
        };
        self.contact = Some(PenaltyContact::new(&self.start, frame, body, stiffness, s.explicit.penalty));
    }

    /// Largest stable step of the elastic forces as the cloth stands, s.
    pub fn stable_step(&mut self, x: &[Vec3]) -> f64 {
        self.stiffness_rows.fill(0.0);
        for e in &self.energies {
            e.add_stiffness(x, &mut self.stiffness_rows);
        }
        let rows = self.stiffness_rows.iter().zip(&self.masses.inertia);
        let rate = rows.filter(|(_, m)| **m > 0.0).map(|(k, m)| k / m).fold(0.0, f64::max);
        if rate > 0.0 { 2.0 / rate.sqrt() } else { STEP_WITHOUT_STIFFNESS }
    }

    /// Sets `f` to the sum of all forces at `x`, N (right-hand side of equation 1).
    pub fn forces(&mut self, x: &[Vec3], f: &mut [Vec3]) {
        f.fill(Vec3::zeros());
        for e in &self.energies {
            e.add_forces(x, f);
        }
        self.sewing.add_forces(x, f);
        if let Some(c) = &mut self.contact {
            c.add_forces(x, f);
        }
    }

    /// Applies friction, joined vertices and held vertices to the velocities.
    pub fn constrain_velocities(&mut self, v: &mut [Vec3], x: &[Vec3], dt: f64) {
        self.sewing.share_velocity(v, &self.masses.inverse);
        if let Some(c) = &mut self.contact {
            c.stop_approach(v, dt);
            if self.has_friction {
                c.tally.slipped += friction::apply(&c.pairs, &self.masses.inverse, dt, v);
            }
            self.sewing.share_velocity(v, &self.masses.inverse);
        }
        let speed = HELD_VERTEX_SPEED.get();
        for (i, at) in &self.pins {
            let d = at - x[*i as usize];
            let l = d.norm();
            v[*i as usize] = if l > speed * dt { d * (speed / l) } else { d / dt };
        }
    }

    /// Applies joined pairs, the elongation limit, and last the guard that nothing crosses, to the positions.
    pub fn constrain_positions(&mut self, x: &[Vec3], next: &mut [Vec3], v: &mut [Vec3], dt: f64) {
        self.sewing.close_joined(next, &self.masses.inverse);
        if let Some(l) = &mut self.over_elongation {
            l.apply(next, v, &self.masses.inverse, dt);
        }
        if let Some(c) = &mut self.contact {
            c.hold_in_balls(x, next, v, dt);
        }
    }

    /// Elastic energy at `x`, J.
    pub fn elastic(&self, x: &[Vec3]) -> f64 {
        elastic(&self.energies, x)
    }

    /// Elastic, weight and contact energy at `x`, J.
    pub fn potential(&self, x: &[Vec3]) -> f64 {
        self.energies.iter().map(|e| e.energy(x)).sum::<f64>() + self.contact.as_ref().map_or(0.0, |c| c.energy(x))
    }

    /// Kinetic energy of the vertices that are not held, J.
    pub fn kinetic(&self, v: &[Vec3]) -> f64 {
        let moving = self.masses.inverse.iter().zip(v).filter(|(w, _)| **w > 0.0);
        0.5 * moving.map(|(w, v)| v.norm_squared() / w).sum::<f64>()
    }

    /// Returns `true` for a vertex that is free to move and has mass.
    pub fn is_free(&self, i: usize) -> bool {
        self.masses.inverse[i] > 0.0 && self.masses.cloth[i] != 0.0
    }

    /// Returns `true` if all held vertices are where they should be.
    pub fn are_pins_placed(&self, x: &[Vec3]) -> bool {
        let distance = HELD_VERTEX_DISTANCE.get();
        self.pins.iter().all(|(i, at)| (at - x[*i as usize]).norm() <= distance)
    }

    /// Held vertices and their places, m.
    pub fn pins(&self) -> &[(u32, Vec3)] {
        &self.pins
    }
}

impl Masses {
    /// Masses of a cloth; with `scaling`, small stiff triangles get inertia.
    fn new(cloth: Vec<f64>, stiffness_rows: &[f64], scaling: bool, pins: &[(u32, Vec3)]) -> Self {
        let (inertia, scaled) =
            if scaling && MASS_SCALING.is_on() { scaled(&cloth, stiffness_rows) } else { (cloth.clone(), 0) };
        let mut inverse: Vec<f64> = inertia.iter().map(|m| if *m > 0.0 { 1.0 / m } else { 0.0 }).collect();
        for p in pins {
            inverse[p.0 as usize] = 0.0;
        }
        Self { cloth, inertia, inverse, scaled }
    }
}

/// Inertia of the vertices and the number of those that got more than their mass, where small triangles would rule
/// the step. The rest shape does not depend on inertia.
fn scaled(mass: &[f64], stiffness_rows: &[f64]) -> (Vec<f64>, usize) {
    let with_mass = mass.iter().zip(stiffness_rows).filter(|(m, _)| **m > 0.0);
    let mut rates: Vec<f64> = with_mass.map(|(m, k)| k / m).collect();
    rates.sort_by(f64::total_cmp);
    let most = MASS_SCALING_STIFFNESS_RATIO.get() * rates.get(rates.len() / 2).copied().unwrap_or(0.0);
    if most <= 0.0 {
        return (mass.to_vec(), 0);
    }
    let mut count = 0;
    let inertia = mass.iter().zip(stiffness_rows).map(|(m, k)| {
        if *m > 0.0 && k / m > most {
            count += 1;
            k / most
        } else {
            *m
        }
    });
    (inertia.collect(), count)
}
