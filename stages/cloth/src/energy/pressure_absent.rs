//! The stand-in for pressure in a build without this effect: a type without a value, so that no work of it is compiled.
//!
//! The build check has refused every scene that calls for the effect.

use crate::Vec3;

/// Pressure, which this build does not have.
pub(crate) enum Pressure {}

impl Pressure {
    pub fn new(_: &crate::Scene, _: f64) -> Option<Self> {
        None
    }

    pub fn refresh(&mut self, _: &[Vec3]) {
        match *self {}
    }

    pub fn evaluate(&self, _: &[Vec3], _: &mut [Vec3]) -> f64 {
        match *self {}
    }

    pub fn words(&self) -> String {
        match *self {}
    }
}
