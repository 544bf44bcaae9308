//! The search for self-contact in a build without this effect: a type without a value.
//!
//! Nothing of its work is compiled. The build check has refused every scene with self-contact.

use crate::Vec3;
use crate::collision::narrow_phase::candidates::{ClothCandidates, LinearMotion};

/// The search for self-contact, which this build does not have.
pub(crate) enum SelfCollision {}

impl SelfCollision {
    pub fn new(_: &crate::Scene, _: &[Vec3], _: &crate::scene::topology::Topology) -> Option<Self> {
        None
    }

    pub fn list(&mut self, _: &mut ClothCandidates, _: &LinearMotion<'_>, _: f64) {
        match *self {}
    }

    pub fn is_surely_free(&mut self, _: &[Vec3], _: &crate::scene::topology::Topology) -> bool {
        match *self {}
    }
}
