//! Is a place of rest a least, or only a saddle? There all forces vanish, but the cloth would fall further at a touch: a
//! sheet held exactly upright, a strip pressed exactly along itself.

use crate::Vec3;
use crate::linear::hessian::scattered;
use crate::optimize::descent::Descent;

/// Rounds of the iteration for the direction that bends down most.
const ROUNDS: usize = 12;
/// First move along it over the mean edge, and how often it is halved.
const PUSH: f64 = 0.1;
const HALVINGS: u32 = 6;
/// Least energy that a way down must win, over the elastic energy.
const WORTH: f64 = 1e-6;

impl Descent<'_> {
    /// Where the second derivatives as they are are not convex: goes down along the direction that bends down most.
    /// `false` where this is a least, or no way leads down. Cloth that does not resist bending stays flat: its wrinkles would
    /// be as small as the mesh allows.
    pub(crate) fn leave_saddle(&mut self) -> bool {
        if self.exact || !self.goal.bends {
            return false;
        }
        let own = self.assemble(false);
        if self.factorise(own) {
            return false;
        }
        // Powers of C⁻¹ (C − H): its largest value belongs to the direction along which H / C is least. H is put together again rather
        // than held beside its own factor.
        let (pattern, mut less) = self.assemble(false);
        let convex = self.assemble(true);
        less.iter_mut().zip(&convex.1).for_each(|(h, c)| *h = c - *h);
        if !self.factorise(convex) {
            return false;
        }
        let mut v: Vec<Vec3> = (0u32..).take(self.f.len()).map(any).collect();
        for _ in 0..ROUNDS {
            let mut w = pattern.times(&less, &v);
            self.factor.solve(&mut w);
            let longest = crate::longest(&w);
            if !(longest.is_finite() && longest > 0.0) {
                return false;
            }
            v = w.iter().map(|p| p / longest).collect();
        }
        self.fall(&v)
    }

    /// Tries both ways along a direction, shorter and shorter.
    fn fall(&mut self, v: &[Vec3]) -> bool {
        let (from, before) = (self.x.clone(), self.energy);
        let least = WORTH * self.goal.elastic(&self.x);
        let mut length = PUSH * self.goal.edge;
        for _ in 0..HALVINGS {
            for along in [length, -length] {
                let mut step = scattered(&self.goal.unknown, v, along);
                self.limit(&mut step);
                self.x.iter_mut().zip(&step).for_each(|(x, d)| *x += d);
                self.start_anew();
                if self.energy < before - least {
                    if let Some(b) = &mut self.goal.barrier {
                        b.took(&self.x);
                    }
                    return true;
                }
                self.x.copy_from_slice(&from);
            }
            length *= 0.5;
        }
        self.start_anew();
        false
    }
}

/// A direction that is not square to any other: from −1 to 1, without order, the same in every run.
fn any(i: u32) -> Vec3 {
    let part = |k: u32| f64::from((3 * i + k).wrapping_mul(2_654_435_761)) / f64::from(u32::MAX) * 2.0 - 1.0;
    Vec3::new(part(0), part(1), part(2))
}
