//! The energy that a descent lowers: cloth, weight, contact, friction of the last refresh, sewing threads.

use crate::collision::broad_phase::bvh::Aabb;
use crate::contact::barrier::Barrier;
use crate::contact::lagged_friction::Stick;
use crate::contact::parameters::frame;
use crate::energy::hysteresis;
use crate::energy::hysteresis::held::Hysteresis;
use crate::energy::inertia::Inert;
use crate::energy::model::model;
use crate::energy::pressure::Pressure;
use crate::energy::stitch_penalty::Seams;
use crate::energy::{Energy, elastic};
use crate::linear::hessian::{FIXED, Pattern};
use crate::optimize::hessian_choice::Slate;
use crate::prepare::start::Start;
use crate::report::cost::{Costs, Lap, Work};
use crate::scene::measures::{areas, held, masses};
use crate::{Scene, Settings, Switch, Vec3};
use nalgebra::Matrix3;

/// What cloth, weight and inertia did at the last evaluation.
#[derive(Default)]
struct Cloth {
    place: Vec<Vec3>,
    force: Vec<Vec3>,
    energy: f64,
    /// Of it elastic, J.
    stored: f64,
}

pub(crate) struct Objective {
    pub energies: Vec<Box<dyn Energy>>,
    pub barrier: Option<Barrier>,
    pub stick: Option<Stick>,
    pub hysteresis: Option<Hysteresis>,
    pub pressure: Option<Pressure>,
    pub seams: Option<Seams>,
    /// Inertia and damping of a stage of a time step; none at rest.
    pub inert: Option<Inert>,
    /// kg, per vertex.
    pub mass: Vec<f64>,
    /// kg, per unknown.
    pub inertia: Vec<f64>,
    /// Unknown of every vertex, or [`FIXED`].
    pub unknown: Vec<u32>,
    slate: Slate,
    /// The other one, once it was used.
    spare: Option<Slate>,
    pub pins: Vec<(u32, Vec3)>,
    /// m, mean rest length of an edge.
    pub edge: f64,
    /// Rounding of the energy beside that which goes with its size, J.
    pub noise: f64,
    force: Vec<Vec3>,
    cloth: Cloth,
    /// Do all fabrics resist bending?
    pub bends: bool,
    /// Not part of any result; what contacts cost stands with them.
    pub costs: Costs,
    pub looks: u64,
}

impl Objective {
    pub fn new(scene: &Scene, s: &Settings, start: Start, pulls: bool) -> (Self, Vec<Vec3>) {
        let Start { topology, positions, body, own, near, mut costs, .. } = start;
        let mass = masses(scene);
        let energies = model(scene, s, &topology, &mass);
        let mut pins = held(scene);
        // In sewing, what will be held is drawn there by threads, so that the cloth around it comes along.
        let apart = |p: &(u32, Vec3)| (p.1 - positions[p.0 as usize]).norm() > 1e-6;
        let drawn: Vec<(u32, Vec3)> = pins.iter().copied().filter(|p| pulls && apart(p)).collect();
        pins.retain(|p| !pulls || !apart(p));
        let seams = pulls.then(|| Seams::new(scene, &drawn)).filter(|t| !t.is_empty());
        let (unknown, n) = number(&mass, &pins);
        let slate = Slate::new(&energies, seams.as_ref(), unknown.clone(), n, false);
        let mut inertia = vec![0.0; n];
        unknown.iter().zip(&mass).filter(|(u, _)| **u != FIXED).for_each(|(u, m)| inertia[*u as usize] = *m);
        let hysteresis = hysteresis::called_for(scene, s).then(|| Hysteresis::new(scene, &topology)).flatten();
        let mut frame = frame(scene, s, topology, &mass, body.is_some(), own);
        let edge = frame.edge;
        let stick =
            (s.effects.friction != Switch::Off && (own || body.is_some()) && frame.friction.iter().any(|m| *m > 0.0))
                .then(Stick::default);
        let barrier = (own || body.is_some()).then(|| {
            frame.topology.forget_hinges();
            let mut lap = Lap::start();
            let coarser = s.of_coarser_level();
            let body = body.map(|b| if coarser { b.held_off([frame.edge, s.body_gap]) } else { b });
            costs.spend(Work::BodyContact, &mut lap);
            Barrier::new(frame, body, areas(scene), near)
        });
        let noise = energies.iter().map(|e| e.noise(&positions)).sum();
        let force = vec![Vec3::zeros(); positions.len()];
        let bends = scene.materials.iter().all(|m| m.bend_warp > 0.0 && m.bend_weft > 0.0);
        (
            Self {
                energies,
                barrier,
                stick,
                hysteresis,
                pressure: Pressure::new(scene, s.pressure),
                seams,
                inert: None,
                mass,
                inertia,
                unknown,
                slate,
                spare: None,
                pins,
                edge,
                noise,
                force,
                cloth: Cloth::default(),
                costs,
                bends,
                looks: 0,
            },
            positions,
        )
    }

    /// Energy at `x`, J; `f` becomes the forces on the unknowns.
    pub fn evaluate(&mut self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut lap = Lap::start();
        let all = &mut self.force;
        all.fill(Vec3::zeros());
        let (mut energy, mut stored) = (0.0, 0.0);
        for e in &self.energies {
            let own = e.evaluate(x, all);
            energy += own;
            stored += if e.elastic() { own } else { 0.0 };
        }
        if let Some(i) = &self.inert {
            energy = i.evaluate(x, energy, all);
        }
        self.cloth.place.clear();
        self.cloth.place.extend_from_slice(x);
        self.cloth.force.clone_from(all);
        (self.cloth.energy, self.cloth.stored) = (energy, stored);
        self.costs.spend(Work::Cloth, &mut lap);
        self.press(x, f)
    }

    /// The same after only what presses or holds the cloth has been told anew.
    pub fn evaluate_again(&mut self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        if self.cloth.place != x {
            return self.evaluate(x, f);
        }
        self.force.copy_from_slice(&self.cloth.force);
        self.press(x, f)
    }

    /// Adds all that is not the cloth's own.
    fn press(&mut self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut lap = Lap::start();
        self.looks += 1;
        let (mut energy, all) = (self.cloth.energy, &mut self.force);
        if let Some(s) = &self.seams {
            energy += s.evaluate(x, all);
            self.costs.spend(Work::Sewing, &mut lap);
        }
        if let Some(h) = &self.hysteresis {
            energy += h.evaluate(x, all);
            self.costs.spend(Work::Hysteresis, &mut lap);
        }
        if let Some(p) = &self.pressure {
            energy += p.evaluate(x, all);
            self.costs.spend(Work::Pressure, &mut lap);
        }
        if let Some(b) = &mut self.barrier {
            energy += b.evaluate(x, all);
            lap = Lap::start();
        }
        if let Some(s) = &self.stick {
            energy += s.evaluate(x, all);
            self.costs.spend(Work::Friction, &mut lap);
        }
        crate::linear::hessian::gather(&self.unknown, all, f);
        energy
    }

    /// Is there a body?
    pub fn on_body(&self) -> bool {
        self.barrier.as_ref().is_some_and(|b| b.body.is_some())
    }

    /// Is there friction that is taken over from place to place?
    pub fn rubs(&self) -> bool {
        (self.stick.is_some() && self.barrier.is_some()) || self.hysteresis.is_some()
    }

    /// Has anything rubbed by now?
    pub fn has_rubbed(&self) -> bool {
        let rub = |s: &Stick| s.most > 0 || self.barrier.iter().any(|b| Stick::would_hold(&b.touches));
        self.stick.as_ref().is_some_and(rub) || self.hysteresis.is_some()
    }

    /// Largest slide at the last refresh of the friction, m.
    pub fn slid(&self) -> f64 {
        let contacts = self.stick.as_ref().map_or(0.0, |s| s.largest);
        self.hysteresis.as_ref().map_or(contacts, |h| contacts.max(h.largest()))
    }

    /// Forces of the last evaluation on all vertices.
    pub fn forces(&self) -> &[Vec3] {
        &self.force
    }

    /// Largest strain of cloth that lies so.
    pub fn strain(&self, x: &[Vec3]) -> f64 {
        self.energies.iter().map(|e| e.strain(x)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Does cloth that lies so carry more anywhere than its curves, because it locks at its strain limits?
    pub fn is_locking(&self, x: &[Vec3]) -> bool {
        self.energies.iter().any(|e| e.is_locking(x))
    }

    /// Cloth locks at its strain limits over this share of them from now on; says whether that changes any force at `x`.
    pub fn lock_over(&mut self, locking: f64, x: &[Vec3]) -> bool {
        let before = self.is_locking(x);
        let changed = self.energies.iter_mut().fold(false, |any, e| e.lock_over(locking) | any);
        changed && (before || self.is_locking(x))
    }

    /// From now on second derivatives are rough ones, or all there is, where the cloth has both.
    pub fn set_rough(&mut self, rough: bool) {
        let able = self.hysteresis.is_none() && self.energies.iter().any(|e| e.rough());
        if rough == self.slate.rough || rough && !able {
            return;
        }
        let anew = || {
            let (unknown, n) = (self.unknown.clone(), self.inertia.len());
            Slate::new(&self.energies, self.seams.as_ref(), unknown, n, rough)
        };
        let next = self.spare.take().unwrap_or_else(anew);
        self.spare = Some(std::mem::replace(&mut self.slate, next));
    }

    pub fn is_rough(&self) -> bool {
        self.slate.rough
    }

    /// Second derivatives at `x`, which must be where the last evaluation was; those of the cloth `convex` or as they are,
    /// with a share `firm` of them in all directions.
    pub fn assemble(&mut self, x: &[Vec3], firm: f64, convex: bool) -> (Pattern, Vec<Matrix3<f64>>) {
        self.slate.start(&self.energies, x, convex);
        let hessian = &mut self.slate.hessian;
        if firm > 0.0 {
            hessian.stiffen(firm);
        }
        if let Some(i) = &self.inert {
            i.add_hessian(hessian);
        }
        if let Some(s) = &self.seams {
            s.add_hessian(x, hessian);
        }
        if let Some(b) = &self.barrier {
            b.add_hessian(hessian);
        }
        if let Some(s) = &self.stick {
            s.add_hessian(x, hessian);
        }
        if let Some(h) = &self.hysteresis {
            h.add_hessian(x, hessian);
        }
        hessian.merged()
    }

    /// Elastic energy where it was evaluated last, J.
    pub fn stored(&self) -> f64 {
        self.cloth.stored
    }

    /// J.
    pub fn elastic(&self, x: &[Vec3]) -> f64 {
        elastic(&self.energies, x)
    }

    /// Diagonal of the box around cloth and body, m.
    pub fn size(&self, x: &[Vec3]) -> f64 {
        let cloth = Aabb::of(x);
        let body = self.barrier.as_ref().and_then(|b| b.body.as_ref()).map_or(cloth, |b| b.bounds);
        let all = cloth.join(&body);
        (all.high - all.low).norm()
    }
}

/// Unknowns: all vertices with mass that are not held.
fn number(mass: &[f64], pins: &[(u32, Vec3)]) -> (Vec<u32>, usize) {
    let mut unknown = vec![FIXED; mass.len()];
    let mut n = 0;
    let mut held = pins.iter().map(|p| p.0).peekable();
    for (v, u) in (0u32..).zip(&mut unknown) {
        if held.next_if_eq(&v).is_none() && mass[v as usize] > 0.0 {
            *u = n;
            n += 1;
        }
    }
    (unknown, n as usize)
}
