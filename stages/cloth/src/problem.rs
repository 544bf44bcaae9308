//! The one place where model, contact, sewing, limits and effects meet. An integrator sees only this.

use crate::collide::body::Body;
use crate::collide::contact::{Contact, Frame};
use crate::collide::friction;
use crate::energy::coupled::Coupled;
use crate::energy::flexion::Flexion;
use crate::energy::shear::Shear;
use crate::energy::structural::Structural;
use crate::energy::weight::Weight;
use crate::energy::{Energy, elastic};
use crate::limit::StrainLimit;
use crate::scene::EARTH;
use crate::sewing::{Sewing, mean_edge};
use crate::start::Start;
use crate::topology::Topology;
use crate::{ClothError, Element, Model, Scene, Settings, Switch, Vec3};

/// Stiffness of contacts times gap over what the cloth presses with, so that similar scenes stay similar: about 2e5 N/m³ in
/// a skirt of 0.2 kg/m² and 1 kN/m with a gap of 1.25 mm, which 300 Pa then close by half.
const PRESS: f64 = 8.0;
/// Its largest slope in the metric of a descent over the same pressure times gap: 1e5 N/m in that skirt. Beyond it single
/// precision loses the cloth behind the contact.
const STEEPEST: f64 = 2e6;

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
        let frame = frame(scene, s, topology, &self.inverse_mass, body.is_some(), own);
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

/// Mass of the cloth at every vertex, kg.
pub(crate) fn masses(scene: &Scene) -> Vec<f64> {
    lumped(scene, |t| scene.materials[t.material as usize].areal_mass * t.area().abs() / 3.0)
}

/// Rest area of the cloth at every vertex, m².
pub(crate) fn areas(scene: &Scene) -> Vec<f64> {
    lumped(scene, |t| t.area().abs() / 3.0)
}

/// What every triangle gives to each of its corners, summed at the vertices.
fn lumped(scene: &Scene, share: impl Fn(&Element) -> f64) -> Vec<f64> {
    let mut sum = vec![0.0; scene.positions.len()];
    for t in &scene.triangles {
        let m = share(t);
        for v in t.vertices {
            sum[v as usize] += m;
        }
    }
    sum
}

/// Held vertices and their places, each vertex once, ascending.
pub(crate) fn held(scene: &Scene) -> Vec<(u32, Vec3)> {
    let mut pins: Vec<(u32, Vec3)> = scene.pins.iter().map(|p| (p.vertex, p.at)).collect();
    pins.sort_by_key(|p| p.0);
    pins.dedup_by_key(|p| p.0);
    pins
}

/// A gravity, or the Earth's where there is none, m/s².
pub(crate) fn or_earth(gravity: f64) -> f64 {
    if gravity > 0.0 { gravity } else { EARTH }
}

/// Mean weight of a vertex, N; under the earth's gravity where the scene has none.
pub(crate) fn mean_weight(mass: &[f64], gravity: f64) -> f64 {
    let (sum, n) = mass.iter().filter(|m| **m > 0.0).fold((0.0, 0.0), |(s, n), m| (s + m, n + 1.0));
    if n > 0.0 { sum / n * or_earth(gravity) } else { 0.0 }
}

/// The energies of a model, and the weight.
pub(crate) fn model(scene: &Scene, s: &Settings, topology: &Topology, mass: &[f64]) -> Vec<Box<dyn Energy>> {
    let mut list: Vec<Box<dyn Energy>> = match s.model {
        Model::Springs => {
            vec![Box::new(Structural::new(scene, topology, s)), Box::new(Shear::new(scene, topology))]
        }
        Model::Coupled => vec![Box::new(Coupled::new(scene, s))],
    };
    list.push(Box::new(Flexion::new(scene, topology)));
    list.push(Box::new(Weight::new(scene, mass, s.gravity_scale)));
    list
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

/// What cloth presses with, Pa: the geometric mean of its weight on its area (the Earth's where there is no gravity) and of
/// its stretch stiffness (at 1 %) over the size of the scene's largest part; of the heaviest and stiffest cloth, so that no order
/// counts.
fn pressure(scene: &Scene, s: &Settings, topology: &Topology) -> f64 {
    let heaviest = scene.triangles.iter().map(|t| scene.materials[t.material as usize].areal_mass).fold(0.0, f64::max);
    let gravity = scene.gravity.norm() * s.gravity_scale.abs();
    let weight = heaviest * or_earth(gravity);
    (weight * stretch(scene) / side(scene, topology)).sqrt()
}

/// Stretch stiffness at 1 % of the stiffest cloth, N/m.
fn stretch(scene: &Scene) -> f64 {
    let used = scene.triangles.iter().map(|t| &scene.materials[t.material as usize]);
    used.map(|m| m.warp.tangent(0.01).max(m.weft.tangent(0.01))).fold(0.0, f64::max)
}

/// Side of a square of as much cloth as the largest part has, m. Other parts do not count, so that they change nothing.
pub(crate) fn side(scene: &Scene, topology: &Topology) -> f64 {
    let part = topology.components(scene.positions.len());
    let mut areas = vec![0.0; part.len()];
    scene.triangles.iter().for_each(|t| areas[part[t.vertices[0] as usize] as usize] += t.area().abs());
    areas.iter().fold(0.0f64, |a, b| a.max(*b)).sqrt()
}

pub(crate) fn frame(
    scene: &Scene,
    s: &Settings,
    topology: Topology,
    inverse_mass: &[f64],
    body: bool,
    own: bool,
) -> Frame {
    let n = scene.positions.len();
    let (mut thickness, mut friction) = (vec![0.0f64; n], vec![0.0f64; n]);
    let mut least = vec![f64::INFINITY; n];
    for t in &scene.triangles {
        let m = &scene.materials[t.material as usize];
        let altitude = t.altitude();
        for v in t.vertices.map(|v| v as usize) {
            thickness[v] = thickness[v].max(m.thickness);
            friction[v] = friction[v].max(m.friction);
            least[v] = least[v].min(altitude);
        }
    }
    let layer = |i: usize| f64::from(scene.layers.get(i).copied().unwrap_or(0).max(0));
    // Thicker than the mesh is fine, it would push a flat sheet apart from itself.
    let own_gap: Vec<f64> =
        (0..n).map(|i| if own { s.self_gap.max(thickness[i]).min(0.3 * least[i]) } else { 0.0 }).collect();
    let body_gap = |i: usize| s.body_gap + 0.5 * thickness[i] + layer(i) * s.self_gap.max(thickness[i]);
    let body_gap: Vec<f64> = (0..n).map(|i| if body { body_gap(i) } else { 0.0 }).collect();
    let gap = body_gap.iter().chain(&own_gap).fold(0.0f64, |a, b| a.max(*b));
    let pressure = pressure(scene, s, &topology);
    Frame {
        press: PRESS * pressure / gap,
        steepest: STEEPEST * pressure * gap,
        groups: crate::weld::groups(n, &scene.stitches),
        body_gap,
        own_gap,
        friction,
        inverse_mass: inverse_mass.to_vec(),
        edge: mean_edge(scene),
        own,
        topology,
    }
}
