//! Negative-curvature descent: at a saddle all forces vanish, but the cloth would fall further at a touch. A sheet held exactly
//! upright and a strip pressed exactly along itself rest on one.

use crate::Vec3;
use crate::linear::hessian::scattered;
use crate::optimize::descent::Descent;
use crate::optimize::mechanism::{Mechanism, Verdict};
use crate::optimize::tuning::{
    CURVATURE_GAIN_LEAST, CURVATURE_HALVINGS, CURVATURE_MOVE_FIRST, CURVATURE_POWER_ROUNDS, SADDLES_MOST,
};

/// Leaves saddles, at most [`SADDLES_MOST`] times in a descent. After that the cloth is called at rest on one.
#[derive(Default)]
pub(crate) struct NegativeCurvature {
    saddles: u32,
}

impl Mechanism for NegativeCurvature {
    fn at_rest(&mut self, d: &mut Descent<'_>) -> Verdict {
        if self.saddles == SADDLES_MOST.get() || !d.leave_saddle() {
            return Verdict::Go;
        }
        self.saddles += 1;
        d.use_surrogate(true);
        Verdict::Again
    }
}

impl Descent<'_> {
    /// Goes down along the direction of most negative curvature where the full Hessian is indefinite; `false` where it is
    /// definite, or where no way leads down. Cloth without bending stiffness stays flat: its wrinkles would be as small as the
    /// mesh allows.
    fn leave_saddle(&mut self) -> bool {
        if self.preconditioner.is_full || !self.objective().resists_bending {
            return false;
        }
        let own = self.assemble(false);
        if self.factorise(own) {
            return false;
        }
        // Power iteration with C⁻¹ (C − H): its largest eigenvalue belongs to the direction in which H is least against C.
        // The full Hessian H is assembled again rather than kept beside its own factor.
        let mut less = self.assemble(false);
        let convex = self.assemble(true);
        less.subtract_from(&convex);
        if !self.factorise(convex) {
            return false;
        }
        let mut v: Vec<Vec3> = (0u32..).take(self.f.len()).map(scrambled).collect();
        for _ in 0..CURVATURE_POWER_ROUNDS.get() {
            let mut w = less.times(&v);
            self.preconditioner.factor.solve(&mut w);
            let longest = crate::longest(&w);
            if !(longest.is_finite() && longest > 0.0) {
                return false;
            }
            v = w.iter().map(|p| p / longest).collect();
        }
        self.descend_along(&v)
    }

    /// Tries both ways along a direction, shorter and shorter.
    fn descend_along(&mut self, v: &[Vec3]) -> bool {
        let (from, before) = (self.x.clone(), self.energy);
        let least = CURVATURE_GAIN_LEAST.get() * self.objective().elastic(&self.x);
        let mut length = CURVATURE_MOVE_FIRST.get() * self.objective().edge;
        for _ in 0..CURVATURE_HALVINGS.get() {
            for along in [length, -length] {
                let mut step = scattered(&self.objective().unknowns.index, v, along);
                self.limit(&mut step);
                self.move_to(from.iter().zip(&step).map(|(x, d)| x + d).collect());
                if self.energy < before - least {
                    let x = self.x.clone();
                    if let Some(b) = self.detection() {
                        b.step_taken(&x);
                    }
                    return true;
                }
                self.x.copy_from_slice(&from);
            }
            length *= 0.5;
        }
        self.move_to(from);
        false
    }
}

/// A component of a direction that is not orthogonal to any other: between −1 and 1, without order, and the same in every run.
fn scrambled(i: u32) -> Vec3 {
    let part = |k: u32| f64::from((3 * i + k).wrapping_mul(2_654_435_761)) / f64::from(u32::MAX) * 2.0 - 1.0;
    Vec3::new(part(0), part(1), part(2))
}
