//! The start of every run: a scene that is checked, and positions free of crossings.

use crate::collision::body::Body;
use crate::collision::self_candidates::SelfCollision;
use crate::effects::{self, BODY_CONTACT, Facts, SELF_CONTACT};
use crate::prepare::initial_feasibility::repair;
use crate::report::cost::{Costs, CpuTimer, Work};
use crate::scene::topology::Topology;
use crate::scene::validate;
use crate::{ClothError, Scene, Settings, Vec3};

/// The start of a run.
pub(crate) struct Start {
    pub topology: Topology,
    /// Positions freed of the body and of the cloth itself, where these effects are on.
    pub positions: Vec<Vec3>,
    /// The body, if cloth meets it.
    pub body: Option<Body>,
    /// Set where cloth meets cloth.
    pub own: bool,
    /// The search for cloth near cloth.
    pub near: Option<SelfCollision>,
    /// Vertices moved, and the largest move, m.
    pub repaired: (usize, f64),
    /// CPU time so far. It is not part of any result.
    pub costs: Costs,
}

impl Start {
    /// Checks a scene and repairs its start.
    pub fn new(scene: &Scene, s: &Settings) -> Result<Self, ClothError> {
        validate::scene(scene)?;
        validate::settings(s)?;
        effects::check(scene, s)?;
        let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
        let mut positions = scene.positions.clone();
        let (mut costs, mut lap) = (Costs::default(), CpuTimer::start());
        let facts = Facts::of_scene(scene, s);
        let body = if BODY_CONTACT.is_on(&facts, s) { Body::of_scene(scene) } else { None };
        costs.spend(Work::BodyContact, &mut lap);
        let own = SELF_CONTACT.is_on(&facts, s);
        let mut repaired = (0, 0.0);
        let mut held = vec![false; positions.len()];
        scene.pins.iter().for_each(|p| held[p.vertex as usize] = true);
        let mut near = own.then(|| SelfCollision::new(scene, &positions, &topology)).flatten();
        if own {
            if !near.as_mut().is_some_and(|n| n.is_surely_free(&positions, &topology)) {
                repaired = repair::free_of_itself(&mut positions, &topology, &held)?;
            }
            costs.spend(Work::SelfContact, &mut lap);
        }
        if let Some(b) = &body {
            let distances = [s.body_gap, s.repair_share];
            let held = own.then_some(&held[..]);
            let freed = repair::free_of_body_in_turns(&mut positions, &topology, b, distances, held)?;
            repaired = (repaired.0.max(freed.0), f64::max(repaired.1, freed.1));
            costs.spend(Work::BodyContact, &mut lap);
        }
        if near.is_some() && repaired.0 > 0 {
            near = SelfCollision::new(scene, &positions, &topology);
        }
        Ok(Self { topology, positions, body, own, near, repaired, costs })
    }
}
