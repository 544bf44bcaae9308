//! The hot kernels of a descent by themselves, for the bench that times and counts them (`benches/kernels.rs`).

use crate::linear::system::System;
use crate::optimize::descent::Descent;
use crate::optimize::task::Task;
use crate::{ClothError, Scene, Settings};

/// A descent at its start, and a system to solve.
pub struct Kernels<'a> {
    descent: Descent<'a>,
    system: System,
}

impl<'a> Kernels<'a> {
    /// Begins a descent at the positions of a scene.
    ///
    /// # Errors
    /// When the scene or the settings are refused.
    pub fn new(scene: &Scene, settings: &'a Settings) -> Result<Self, ClothError> {
        let mut descent = Descent::begin(scene, settings, Task::Settle)?;
        let system = descent.assemble(true);
        Ok(Self { descent, system })
    }

    /// Evaluates energy and forces, contact included.
    pub fn forces(&mut self) {
        self.descent.evaluate();
    }

    /// Assembles the Hessian.
    pub fn assemble(&mut self) {
        self.system = self.descent.assemble(true);
    }

    /// Factorises it; says whether it is positive definite.
    pub fn factor(&mut self) -> bool {
        let shift: Vec<f64> = self.descent.shift().collect();
        self.descent.preconditioner.factor.take_in(&self.system, &shift)
            && self.descent.preconditioner.factor.eliminate()
    }

    /// Solves for a direction.
    pub fn solve(&mut self) {
        let mut d = self.descent.f.clone();
        self.descent.preconditioner.factor.solve(&mut d);
    }

    /// Makes the proximity lists anew, without anything that is known from before.
    pub fn lists(&mut self) {
        let x = self.descent.x.clone();
        if let Some(b) = self.descent.detection() {
            b.rebuild_lists(&x);
        }
    }
}
