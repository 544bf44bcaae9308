//! Stands in for self-contact in a build without this effect: a type without a value, so that nothing of its work is compiled.
//! The build check has refused every scene that calls for the effect.

use crate::Vec3;
use crate::collision::narrow_phase::candidates::{Near, Way};

/// The search for cloth near cloth, which this build does not have.
pub(crate) enum Own {}

impl Own {
    pub fn new(_: &crate::Scene, _: &[Vec3], _: &crate::scene::topology::Topology) -> Option<Self> {
        None
    }

    pub fn list(&mut self, _: &mut Near, _: &Way<'_>, _: f64, _: f64, _: f64) {
        match *self {}
    }

    pub fn list_once(&mut self, _: &mut Near, _: &Way<'_>, _: f64) {
        match *self {}
    }

    pub fn surely_lies_free(&mut self, _: &[Vec3], _: &crate::scene::topology::Topology) -> bool {
        match *self {}
    }

    pub fn forget(&mut self) {
        match *self {}
    }
}
