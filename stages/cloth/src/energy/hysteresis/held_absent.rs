//! The stand-in for friction in bending in a build without this effect: a type without a value.
//!
//! No work of the effect is compiled. The build check has refused every scene that calls for the effect.

use crate::Vec3;

/// Friction in bending, which this build does not have.
#[derive(Clone)]
pub(crate) enum Hysteresis {}

impl Hysteresis {
    pub fn new(_: &crate::Scene, _: &crate::scene::topology::Topology) -> Option<Self> {
        None
    }

    pub fn refresh(&mut self, _: &[Vec3]) {
        match *self {}
    }

    pub fn evaluate(&self, _: &[Vec3], _: &mut [Vec3]) -> f64 {
        match *self {}
    }

    pub fn add_hessian(&self, _: &[Vec3], _: &mut crate::linear::hessian::Hessian) {
        match *self {}
    }

    pub fn slip(&self) -> usize {
        match *self {}
    }

    pub fn largest(&self) -> f64 {
        match *self {}
    }

    pub fn len(&self) -> usize {
        match *self {}
    }
}
