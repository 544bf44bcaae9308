//! The one place where model, contact, sewing, limits and effects meet. An integrator sees only this.

use crate::collision::body::Body;
use crate::contact::parameters::contact_parameters;
use crate::energy::model::model;
use crate::energy::{Energy, elastic};
use crate::explicit::contact::Contact;
use crate::explicit::friction;
use crate::explicit::sewing::Sewing;
use crate::explicit::strain_limit::StrainLimit;
use crate::prepare::start::Start;
use crate::scene::measures::{held, masses};
use crate::scene::topology::Topology;
use crate::{ClothError, Scene, Settings, Switch, Vec3};

/// Contact stiffness in units of mass / step².
const CONTACT_RATE: f64 = 0.15;
/// A vertex stiffer per mass than this many times the median gets inertia.
const UNEVEN: f64 = 2.0;
/// Speed at which a held vertex is led to its place, m/s.
const LEAD: f64 = 1.0;

/// What the solver works on.
pub(crate) struct Problem {
    pub energies: Vec<Box<dyn Energy>>,
    pub contact: Option<Contact>,
    pub sewing: Sewing,
    pub limit: Option<StrainLimit>,
    pub friction: bool,
    /// kg, of the cloth itself.
    pub mass: Vec<f64>,
    /// 1/kg, of the inertia; 0 for held vertices.
    pub inverse_mass: Vec<f64>,
    pub damping: f64,
    pub stiffness_damping: f64,
    /// Vertices that got inertia so that they do not rule the step.
    pub evened: usize,
    pub repaired: (usize, f64),
    /// Start positions, freed of the body.
    pub start: Vec<Vec3>,
    pins: Vec<(u32, Vec3)>,
    loose: Vec<bool>,
    rows: Vec<f64>,
    inertia: Vec<f64>,
}

impl Problem {
    /// Checks and builds. `sewing`: do stitches pull?
    pub fn new(scene: &Scene, s: &Settings, pulls: bool) -> Result<Self, ClothError> {
        let Start { topology, positions, body, own, repaired, .. } = Start::new(scene, s)?;
        let mut problem = Self::bare(scene, s, pulls, &topology, positions, repaired);
        problem.add_contact(scene, s, topology, body, own);
        Ok(problem)
    }

    /// Everything but contact, without any check.
    fn bare(
        scene: &Scene,
        s: &Settings,
        pulls: bool,
        topology: &Topology,
        start: Vec<Vec3>,
        repaired: (usize, f64),
    ) -> Self {
        let n = start.len();
        let mass = masses(scene);
        let energies = model(scene, s, topology, &mass);
        let mut rows = vec![0.0; n];
        for e in &energies {
            e.add_stiffness(&start, &mut rows);
        }
        let (inertia, evened) = inertia(&mass, &rows, s.even_inertia);
        let mut inverse_mass: Vec<f64> = inertia.iter().map(|m| if *m > 0.0 { 1.0 / m } else { 0.0 }).collect();
        let pins = held(scene);
        for p in &pins {
            inverse_mass[p.0 as usize] = 0.0;
        }
        let sewing = Sewing::new(scene, s, &rows, &inertia, pulls);
        Self {
            energies,
            contact: None,
            sewing,
            limit: if s.effects.strain_limit == Switch::Off { None } else { StrainLimit::new(scene) },
            friction: false,
            loose: mass.iter().map(|m| *m == 0.0).collect(),
            mass,
            inverse_mass,
            damping: s.damping,
            stiffness_damping: s.stiffness_damping,
            evened,
            repaired,
            start,
            pins,
            rows,
            inertia,
        }
    }

    /// Builds contact as the switches say.
    fn add_contact(&mut self, scene: &Scene, s: &Settings, topology: Topology, body: Option<Body>, own: bool) {
        if body.is_none() && !own {
            return;
        }
        let dt = s.step_fraction.min(1.0) * self.stable_step(&self.start.clone());
        let frame = contact_parameters(scene, s, topology, &self.inverse_mass, body.is_some(), own);
        self.friction = s.effects.friction != Switch::Off && frame.friction.iter().any(|m| *m > 0.0);
        self.contact = Some(Contact::new(&self.start, frame, body, [CONTACT_RATE / (dt * dt), s.contact_stiffness]));
    }

    /// Largest stable step of the elastic forces as the cloth stands, s.
    pub fn stable_step(&mut self, x: &[Vec3]) -> f64 {
        self.rows.fill(0.0);
        for e in &self.energies {
            e.add_stiffness(x, &mut self.rows);
        }
        let rate =
            self.rows.iter().zip(&self.inertia).filter(|(_, m)| **m > 0.0).map(|(k, m)| k / m).fold(0.0, f64::max);
        if rate > 0.0 { 2.0 / rate.sqrt() } else { 1e-2 }
    }

    /// Sum of all forces at `x`, N.
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

    /// Friction, joined vertices, held vertices.
    pub fn constrain_velocities(&mut self, v: &mut [Vec3], x: &[Vec3], dt: f64) {
        self.sewing.share_velocity(v, &self.inverse_mass);
        if let Some(c) = &mut self.contact {
            c.stop_approach(v, dt);
            if self.friction {
                c.tally.slipped += friction::apply(&c.pairs, &self.inverse_mass, dt, v);
            }
            self.sewing.share_velocity(v, &self.inverse_mass);
        }
        for (i, at) in &self.pins {
            let d = at - x[*i as usize];
            let l = d.norm();
            v[*i as usize] = if l > LEAD * dt { d * (LEAD / l) } else { d / dt };
        }
    }

    /// Joined pairs, elongation limit, and last the guard that nothing crosses.
    pub fn constrain_positions(&mut self, x: &[Vec3], next: &mut [Vec3], v: &mut [Vec3], dt: f64) {
        self.sewing.zip(next, &self.inverse_mass);
        if let Some(l) = &mut self.limit {
            l.apply(next, v, &self.inverse_mass, dt);
        }
        if let Some(c) = &mut self.contact {
            c.guard(x, next, v, dt);
        }
    }

    /// Elastic energy, J.
    pub fn elastic(&self, x: &[Vec3]) -> f64 {
        elastic(&self.energies, x)
    }

    /// Elastic, weight and contact energy, J.
    pub fn potential(&self, x: &[Vec3]) -> f64 {
        self.energies.iter().map(|e| e.energy(x)).sum::<f64>() + self.contact.as_ref().map_or(0.0, |c| c.energy(x))
    }

    /// J.
    pub fn kinetic(&self, v: &[Vec3]) -> f64 {
        0.5 * self.inverse_mass.iter().zip(v).filter(|(w, _)| **w > 0.0).map(|(w, v)| v.norm_squared() / w).sum::<f64>()
    }

    /// Free to move and with mass?
    pub fn free(&self, i: usize) -> bool {
        self.inverse_mass[i] > 0.0 && !self.loose[i]
    }

    /// Are all held vertices where they should be?
    pub fn pins_placed(&self, x: &[Vec3]) -> bool {
        self.pins.iter().all(|(i, at)| (at - x[*i as usize]).norm() <= 1e-6)
    }

    pub fn pins(&self) -> &[(u32, Vec3)] {
        &self.pins
    }
}

/// Inertia of the vertices: their mass, more where small triangles would rule the step. The rest shape does not
/// depend on it.
fn inertia(mass: &[f64], rows: &[f64], even: bool) -> (Vec<f64>, usize) {
    let mut rates: Vec<f64> = mass.iter().zip(rows).filter(|(m, _)| **m > 0.0).map(|(m, k)| k / m).collect();
    rates.sort_by(f64::total_cmp);
    let most = UNEVEN * rates.get(rates.len() / 2).copied().unwrap_or(0.0);
    if !even || most <= 0.0 {
        return (mass.to_vec(), 0);
    }
    let mut evened = 0;
    let inertia = mass.iter().zip(rows).map(|(m, k)| {
        if *m > 0.0 && k / m > most {
            evened += 1;
            k / most
        } else {
            *m
        }
    });
    (inertia.collect(), evened)
}
