//! The hot kernels of a descent by themselves, for the bench that times and counts them (`benches/kernels.rs`).

use crate::linear::hessian::Pattern;
use crate::optimize::descent::Descent;
use crate::{ClothError, Scene, Settings};
use nalgebra::Matrix3;

/// A descent at its start, and a system to solve.
pub struct Kernels<'a> {
    descent: Descent<'a>,
    system: (Pattern, Vec<Matrix3<f64>>),
}

impl<'a> Kernels<'a> {
    /// Of a scene.
    ///
    /// # Errors
    /// When the scene or the settings are refused.
    pub fn new(scene: &Scene, settings: &'a Settings) -> Result<Self, ClothError> {
        let mut descent = Descent::begin(scene, settings, false)?;
        let system = descent.assemble(true);
        Ok(Self { descent, system })
    }

    /// Energy and forces, contact included.
    pub fn forces(&mut self) {
        self.descent.evaluate();
    }

    /// The metric.
    pub fn assemble(&mut self) {
        self.system = self.descent.assemble(true);
    }

    /// Its factor.
    pub fn factor(&mut self) -> bool {
        let (shift, (pattern, values)) = (self.descent.shift().collect::<Vec<_>>(), &self.system);
        self.descent.factor.take_in(pattern, values, &shift) && self.descent.factor.eliminate()
    }

    /// A direction from it.
    pub fn solve(&mut self) {
        let mut d = self.descent.f.clone();
        self.descent.factor.solve(&mut d);
    }

    /// Lists of what is near, nothing known from before.
    pub fn lists(&mut self) {
        if let Some(b) = &mut self.descent.goal.barrier {
            b.cover_anew(&self.descent.x);
        }
    }

    /// Lists along a short step, from a wide search that still holds.
    pub fn lists_again(&mut self) {
        if let Some(b) = &mut self.descent.goal.barrier {
            b.relist(&self.descent.x);
        }
    }
}
