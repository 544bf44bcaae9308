//! The rig that holds a specimen while the solver looks for its rest.

use super::GRAVITY;
use super::mesh::Flat;
use crate::solve::{Follow, failure};
use std::collections::BTreeMap;
use toile_cloth::{Effects, Element, Equilibrium, Material, Pin, Scene, Settings, Switch};
use toile_garment::Vec3;
use toile_stage_api::{StageContext, StageError};

/// How much nearer to rest than a garment's drape: figures are read off it.
const FINE: f64 = 0.2;

/// A specimen in its clamps.
pub struct Rig<'a> {
    /// The specimen.
    pub cloth: &'a Flat,
    /// Its fabric.
    pub material: Material,
    /// Where its vertices start, m.
    pub start: Vec<Vec3>,
    /// The vertices that the clamps hold, and their places.
    pub held: Vec<(u32, Vec3)>,
    /// Does it hang? Otherwise it lies on a table without friction.
    pub heavy: bool,
    /// May it meet itself?
    pub folds: bool,
}

/// A specimen at rest.
pub struct Rest {
    /// m.
    pub at: Vec<Vec3>,
    /// Elastic energy and that of the weight above y = 0, J.
    pub energy: f64,
    /// Force of the clamps on every held vertex, N.
    pub forces: BTreeMap<u32, Vec3>,
}

impl Rig<'_> {
    /// Lets the specimen come to rest.
    ///
    /// # Errors
    /// When it does not, or the user asks to stop.
    pub fn settle(self, cx: &mut StageContext<'_>) -> Result<Rest, StageError> {
        let settings = self.settings(cx.threads);
        let (cloth, weight) = (self.cloth, if self.heavy { GRAVITY * self.material.areal_mass } else { 0.0 });
        let outcome = toile_cloth::drape(&self.scene(), &settings, &mut Follow::new(cx)).map_err(failure)?;
        if !outcome.settled {
            let (why, force) = (outcome.stop_reason.words(), outcome.residual_rel);
            return Err(StageError::Unstable(format!(
                "the specimen did not come to rest: {why}; net force up to {force:.2} of a vertex's weight; try another --edge"
            )));
        }
        let forces = outcome.reactions.iter().map(|r| (r.vertex, r.force)).collect();
        let energy = outcome.energy + weight * cloth.moment(&outcome.positions);
        Ok(Rest { at: outcome.positions, energy, forces })
    }

    fn settings(&self, threads: usize) -> Settings {
        let base = Settings::default();
        let own = if self.folds { Switch::Auto } else { Switch::Off };
        Settings {
            effects: Effects { self_contact: own, ..Effects::default() },
            self_gap: self.material.thickness.max(1e-4),
            equilibrium: Equilibrium {
                decrement_tolerance: FINE * base.equilibrium.decrement_tolerance,
                move_tolerance: FINE * base.equilibrium.move_tolerance,
                residual_tolerance: FINE * base.equilibrium.residual_tolerance,
                ..base.equilibrium
            },
            threads,
            ..base
        }
    }

    fn scene(self) -> Scene {
        let corner = |v: u32| self.cloth.rest[v as usize];
        let element = |t: &[u32; 3]| Element { vertices: *t, rest: t.map(corner), material: 0 };
        Scene {
            positions: self.start,
            triangles: self.cloth.triangles.iter().map(element).collect(),
            materials: vec![self.material],
            pins: self.held.into_iter().map(|(vertex, at)| Pin { vertex, at }).collect(),
            gravity: Vec3::new(0.0, if self.heavy { -GRAVITY } else { 0.0 }, 0.0),
            ..Scene::default()
        }
    }
}
