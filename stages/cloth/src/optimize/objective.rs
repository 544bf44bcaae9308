//! The energy that a descent lowers: cloth, weight, contact, friction of the last refresh, stitch penalty, inertia.

use crate::collision::body::Body;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::self_candidates::SelfCollision;
use crate::contact::barrier::Barrier;
use crate::contact::lagged_friction::LaggedFriction;
use crate::contact::parameters::{ContactParameters, contact_parameters};
use crate::effects::{BENDING_HYSTERESIS, Facts};
use crate::energy::hysteresis::held::Hysteresis;
use crate::energy::inertia::Inertia;
use crate::energy::model::model;
use crate::energy::pressure::Pressure;
use crate::energy::stitch_penalty::Seams;
use crate::energy::{Energy, elastic};
use crate::linear::hessian::FIXED;
use crate::linear::system::System;
use crate::optimize::assembled_hessian::AssembledHessians;
use crate::optimize::task::Task;
use crate::prepare::start::Start;
use crate::report::cost::{Costs, CpuTimer, Work};
use crate::scene::measures::{areas, held, masses};
use crate::{Scene, Settings, Switch, Vec3};

/// A held vertex this near its place is there, m.
pub(crate) const PIN_PLACED: f64 = 1e-6;

/// The terms of the energy.
pub(crate) struct Terms {
    /// Energies of the cloth itself, and its weight.
    pub cloth: Vec<Box<dyn Energy>>,
    pub barrier: Option<Barrier>,
    pub friction: Option<LaggedFriction>,
    pub hysteresis: Option<Hysteresis>,
    pub pressure: Option<Pressure>,
    /// The stitch penalty, while pieces are sewn.
    pub stitches: Option<Seams>,
    /// Inertia and damping of a stage of a time step; `None` at rest.
    pub inertia: Option<Inertia>,
}

/// The vertices, and which of them are unknowns.
pub(crate) struct Unknowns {
    /// Mass of every vertex, kg.
    pub mass: Vec<f64>,
    /// Mass of every unknown, kg.
    pub unknown_mass: Vec<f64>,
    /// Index of the unknown of every vertex, or [`FIXED`].
    pub index: Vec<u32>,
    /// Held vertices and their places, m.
    pub pins: Vec<(u32, Vec3)>,
}

/// Energy and forces of the cloth, its weight and its inertia at the last full evaluation.
#[derive(Default)]
struct ClothTerms {
    x: Vec<Vec3>,
    force: Vec<Vec3>,
    /// J.
    energy: f64,
    /// The elastic part of it, J.
    elastic: f64,
}

/// The energy of a descent as a function of the positions.
pub(crate) struct Objective {
    pub terms: Terms,
    pub unknowns: Unknowns,
    hessian: AssembledHessians,
    /// Mean rest length of an edge, m.
    pub edge: f64,
    /// Rounding of the energy that does not scale with the energy itself, J.
    pub noise: f64,
    /// Do all fabrics resist bending?
    pub resists_bending: bool,
    /// CPU time by effect. It is no part of any result; the costs of contact stand with the barrier.
    pub costs: Costs,
    pub evaluations: u64,
    force: Vec<Vec3>,
    cloth: ClothTerms,
}

impl Objective {
    /// The objective of a task, and the positions to start from.
    pub fn new(scene: &Scene, s: &Settings, start: Start, task: Task) -> (Self, Vec<Vec3>) {
        let Start { topology, positions, body, own, near, mut costs, .. } = start;
        let mass = masses(scene);
        let cloth = model(scene, s, &topology, &mass);
        let (pins, stitches) = pins_and_stitches(scene, &positions, task);
        let unknowns = Unknowns::new(mass, pins);
        let bends_back = BENDING_HYSTERESIS.is_wanted(&Facts::of_scene(scene, s), s);
        let hysteresis = bends_back.then(|| Hysteresis::new(scene, &topology)).flatten();
        let (index, n) = (&unknowns.index, unknowns.unknown_mass.len());
        let hessian = AssembledHessians::new(&cloth, stitches.as_ref(), hysteresis.is_some(), index, n);
        let frame = contact_parameters(scene, s, topology, &unknowns.mass, body.is_some(), own);
        let edge = frame.mean_edge;
        let meets = own || body.is_some();
        let rubs = s.effects.friction != Switch::Off && frame.friction.iter().any(|m| *m > 0.0);
        let barrier = meets.then(|| contact(scene, s, frame, body, near, task, &mut costs));
        let objective = Self {
            hessian,
            edge,
            noise: cloth.iter().map(|e| e.noise(&positions)).sum(),
            resists_bending: scene.materials.iter().all(|m| m.bending.warp > 0.0 && m.bending.weft > 0.0),
            costs,
            evaluations: 0,
            force: vec![Vec3::zeros(); positions.len()],
            cloth: ClothTerms::default(),
            terms: Terms {
                cloth,
                barrier,
                friction: (rubs && meets).then(LaggedFriction::default),
                hysteresis,
                pressure: Pressure::new(scene, s.pressure),
                stitches,
                inertia: None,
            },
            unknowns,
        };
        (objective, positions)
    }

    /// Energy at `x`, J; `f` becomes the forces on the unknowns, N.
    pub fn evaluate(&mut self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut lap = CpuTimer::start();
        let all = &mut self.force;
        all.fill(Vec3::zeros());
        let (mut energy, mut elastic) = (0.0, 0.0);
        for e in &self.terms.cloth {
            let own = e.evaluate(x, all);
            energy += own;
            elastic += if e.elastic() { own } else { 0.0 };
        }
        if let Some(i) = &self.terms.inertia {
            energy = i.evaluate(x, energy, all);
        }
        self.cloth.x.clear();
        self.cloth.x.extend_from_slice(x);
        self.cloth.force.clone_from(all);
        (self.cloth.energy, self.cloth.elastic) = (energy, elastic);
        self.costs.spend(Work::Cloth, &mut lap);
        self.add_other_terms(x, f)
    }

    /// The same where only terms other than the cloth's own have changed since the last evaluation.
    pub fn evaluate_again(&mut self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        if self.cloth.x != x {
            return self.evaluate(x, f);
        }
        self.force.copy_from_slice(&self.cloth.force);
        self.add_other_terms(x, f)
    }

    /// Adds all terms that are not the cloth's own.
    fn add_other_terms(&mut self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut lap = CpuTimer::start();
        self.evaluations += 1;
        let (mut energy, all) = (self.cloth.energy, &mut self.force);
        if let Some(s) = &self.terms.stitches {
            energy += s.evaluate(x, all);
            self.costs.spend(Work::Sewing, &mut lap);
        }
        if let Some(h) = &self.terms.hysteresis {
            energy += h.evaluate(x, all);
            self.costs.spend(Work::Hysteresis, &mut lap);
        }
        if let Some(p) = &self.terms.pressure {
            energy += p.evaluate(x, all);
            self.costs.spend(Work::Pressure, &mut lap);
        }
        if let Some(b) = &mut self.terms.barrier {
            energy += b.evaluate(x, all);
            lap = CpuTimer::start();
        }
        if let Some(s) = &self.terms.friction {
            energy += s.evaluate(x, all);
            self.costs.spend(Work::Friction, &mut lap);
        }
        crate::linear::hessian::gather(&self.unknowns.index, all, f);
        energy
    }

    /// The body, if the cloth meets one.
    pub fn body(&self) -> Option<&Body> {
        self.terms.barrier.as_ref().and_then(|b| b.body.as_ref())
    }

    /// Has the objective friction, in contacts or in bending, that is refreshed from place to place?
    pub fn has_friction(&self) -> bool {
        (self.terms.friction.is_some() && self.terms.barrier.is_some()) || self.terms.hysteresis.is_some()
    }

    /// Has friction acted by now?
    pub fn friction_has_acted(&self) -> bool {
        let acts = |s: &LaggedFriction| {
            s.most_contacts > 0 || self.terms.barrier.iter().any(|b| LaggedFriction::is_caused_by(&b.contacts))
        };
        self.terms.friction.as_ref().is_some_and(acts) || self.terms.hysteresis.is_some()
    }

    /// Largest slide at the last refresh of the friction, m.
    pub fn largest_slide(&self) -> f64 {
        let contacts = self.terms.friction.as_ref().map_or(0.0, |s| s.largest_slip);
        self.terms.hysteresis.as_ref().map_or(contacts, |h| contacts.max(h.largest()))
    }

    /// Forces of the last evaluation on all vertices, N.
    pub fn forces(&self) -> &[Vec3] {
        &self.force
    }

    /// Largest strain of the cloth at `x`.
    pub fn strain(&self, x: &[Vec3]) -> f64 {
        self.terms.cloth.iter().map(|e| e.strain(x)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Does the strain-limit barrier act anywhere at `x`?
    pub fn strain_limit_acts(&self, x: &[Vec3]) -> bool {
        self.terms.cloth.iter().any(|e| e.is_locking(x))
    }

    /// Widens the strain-limit barrier to this share of the limits (0: the law's own, infinite: off); says whether that
    /// changes any force at `x`.
    pub fn widen_strain_limit(&mut self, share: f64, x: &[Vec3]) -> bool {
        let before = self.strain_limit_acts(x);
        let changed = self.terms.cloth.iter_mut().fold(false, |any, e| e.lock_over(share) | any);
        changed && (before || self.strain_limit_acts(x))
    }

    /// Uses the surrogate bending Hessian from now on, or the whole one, where the cloth has both.
    pub fn use_surrogate(&mut self, surrogate: bool) {
        let able = self.terms.hysteresis.is_none() && self.terms.cloth.iter().any(|e| e.has_surrogate());
        if surrogate && !able {
            return;
        }
        let Terms { cloth, stitches, .. } = &self.terms;
        let n = self.unknowns.unknown_mass.len();
        self.hessian.choose(surrogate, cloth, stitches.as_ref(), &self.unknowns.index, n);
    }

    /// Is the surrogate bending Hessian in use?
    pub fn uses_surrogate(&self) -> bool {
        self.hessian.is_surrogate()
    }

    /// Second derivatives at `x`, the place of the last evaluation, projected to be convex or as they are. A share
    /// `isotropic` of the stretch stiffness acts in all directions.
    pub fn assemble(&mut self, x: &[Vec3], isotropic: f64, convex: bool) -> System {
        let hessian = self.hessian.of_cloth(&self.terms.cloth, x, convex);
        if isotropic > 0.0 {
            hessian.add_isotropic_stiffness(isotropic);
        }
        if let Some(i) = &self.terms.inertia {
            i.add_hessian(hessian);
        }
        if let Some(s) = &self.terms.stitches {
            s.add_hessian(x, hessian);
        }
        if let Some(b) = &self.terms.barrier {
            b.add_hessian(hessian);
        }
        if let Some(s) = &self.terms.friction {
            s.add_hessian(x, hessian);
        }
        if let Some(h) = &self.terms.hysteresis {
            h.add_hessian(x, hessian);
        }
        hessian.merged()
    }

    /// Elastic energy at the last evaluation, J.
    pub fn last_elastic(&self) -> f64 {
        self.cloth.elastic
    }

    /// Elastic energy at `x`, J.
    pub fn elastic(&self, x: &[Vec3]) -> f64 {
        elastic(&self.terms.cloth, x)
    }

    /// Are all held vertices at their places?
    pub fn pins_placed(&self, x: &[Vec3]) -> bool {
        self.way_of_pins(x) <= PIN_PLACED
    }

    /// Longest way of a held vertex to its place, m.
    pub fn way_of_pins(&self, x: &[Vec3]) -> f64 {
        self.unknowns.pins.iter().map(|(v, at)| (at - x[*v as usize]).norm()).fold(0.0, f64::max)
    }

    /// Widest gap of a stitch, m.
    pub fn widest_stitch(&self, x: &[Vec3]) -> f64 {
        self.terms.stitches.as_ref().map_or(0.0, |s| s.widest(x))
    }

    /// Diagonal of the box around cloth and body, m.
    pub fn size(&self, x: &[Vec3]) -> f64 {
        let cloth = Aabb::of(x);
        let body = self.body().map_or(cloth, |b| b.bounds);
        let all = cloth.join(&body);
        (all.high - all.low).norm()
    }
}

/// Held vertices, and the stitch penalty of sewing. In sewing, a vertex that will be held elsewhere is drawn there by a
/// thread, so that the cloth around it comes along.
fn pins_and_stitches(scene: &Scene, x: &[Vec3], task: Task) -> (Vec<(u32, Vec3)>, Option<Seams>) {
    let mut pins = held(scene);
    if task != Task::Sew {
        return (pins, None);
    }
    let apart = |p: &(u32, Vec3)| (p.1 - x[p.0 as usize]).norm() > 1e-6;
    let drawn: Vec<(u32, Vec3)> = pins.iter().copied().filter(apart).collect();
    pins.retain(|p| !apart(p));
    (pins, Some(Seams::new(scene, &drawn)).filter(|t| !t.is_empty()))
}

/// The contact barrier.
fn contact(
    scene: &Scene,
    s: &Settings,
    mut frame: ContactParameters,
    body: Option<Body>,
    near: Option<SelfCollision>,
    task: Task,
    costs: &mut Costs,
) -> Barrier {
    frame.topology.forget_hinges();
    let mut lap = CpuTimer::start();
    let coarser = task == Task::SettleCoarse;
    let body = body.map(|b| if coarser { b.decimated([frame.mean_edge, s.body_gap]) } else { b });
    costs.spend(Work::BodyContact, &mut lap);
    Barrier::new(frame, body, areas(scene), near)
}

impl Unknowns {
    /// All vertices that have mass and are not held are unknowns, in the order of the vertices.
    fn new(mass: Vec<f64>, pins: Vec<(u32, Vec3)>) -> Self {
        let mut index = vec![FIXED; mass.len()];
        let mut unknown_mass = Vec::new();
        let mut held = pins.iter().map(|p| p.0).peekable();
        let mut next = 0;
        for ((v, u), m) in (0u32..).zip(&mut index).zip(&mass) {
            if held.next_if_eq(&v).is_none() && *m > 0.0 {
                *u = next;
                next += 1;
                unknown_mass.push(*m);
            }
        }
        Self { mass, unknown_mass, index, pins }
    }
}
