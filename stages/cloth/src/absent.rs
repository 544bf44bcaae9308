//! What stands for effects that are not in this build: types without a value, so that nothing of what would be done for them is
//! there either. `built.rs` has refused whatever calls for them.

use crate::Vec3;
#[cfg(not(feature = "self-contact"))]
use crate::collide::near::{Near, Way};

/// For [`crate::energy::pressure`].
#[cfg(not(feature = "pressure"))]
pub(crate) enum Pressure {}

#[cfg(not(feature = "pressure"))]
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

/// For [`crate::energy::hysteresis`].
#[cfg(not(feature = "bending-hysteresis"))]
#[derive(Clone)]
pub(crate) enum Hysteresis {}

#[cfg(not(feature = "bending-hysteresis"))]
impl Hysteresis {
    pub fn new(_: &crate::Scene, _: &crate::topology::Topology) -> Option<Self> {
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

    pub fn slid(&self) -> usize {
        match *self {}
    }

    pub fn largest(&self) -> f64 {
        match *self {}
    }

    pub fn len(&self) -> usize {
        match *self {}
    }
}

/// For cloth near cloth.
#[cfg(not(feature = "self-contact"))]
pub(crate) enum Own {}

#[cfg(not(feature = "self-contact"))]
impl Own {
    pub fn new(_: &crate::Scene, _: &[Vec3], _: &crate::topology::Topology) -> Option<Self> {
        None
    }

    pub fn list(&mut self, _: &mut Near, _: &Way<'_>, _: f64, _: f64, _: f64) {
        match *self {}
    }

    pub fn list_once(&mut self, _: &mut Near, _: &Way<'_>, _: f64) {
        match *self {}
    }

    pub fn surely_lies_free(&mut self, _: &[Vec3], _: &crate::topology::Topology) -> bool {
        match *self {}
    }

    pub fn forget(&mut self) {
        match *self {}
    }
}
