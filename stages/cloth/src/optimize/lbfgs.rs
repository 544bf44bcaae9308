//! Limited-memory BFGS around a given preconditioner (Nocedal and Wright, Numerical Optimization, algorithm 7.4).

use crate::Vec3;
use crate::optimize::tuning::LBFGS_PAIRS;
use std::collections::VecDeque;

#[derive(Default)]
pub(crate) struct Lbfgs {
    pairs: VecDeque<(Vec<Vec3>, Vec<Vec3>, f64)>,
}

pub(crate) fn dot(a: &[Vec3], b: &[Vec3]) -> f64 {
    a.iter().zip(b).map(|(p, q)| p.dot(q)).sum()
}

impl Lbfgs {
    pub fn forget(&mut self) {
        self.pairs.clear();
    }

    /// Keeps a step and the change of the gradient, if it shows positive curvature.
    pub fn push(&mut self, s: Vec<Vec3>, y: Vec<Vec3>) {
        let sy = dot(&s, &y);
        if sy > 1e-14 * (dot(&s, &s) * dot(&y, &y)).sqrt() && sy > 0.0 {
            if self.pairs.len() == LBFGS_PAIRS.get() {
                self.pairs.pop_front();
            }
            self.pairs.push_back((s, y, 1.0 / sy));
        }
    }

    /// The direction for forces `f`: the preconditioner's solution, corrected by the pairs.
    pub fn direction(&self, f: &[Vec3], solve: impl FnOnce(&mut [Vec3])) -> Vec<Vec3> {
        let mut q = f.to_vec();
        let mut shares = Vec::with_capacity(self.pairs.len());
        for (s, y, r) in self.pairs.iter().rev() {
            let a = r * dot(s, &q);
            q.iter_mut().zip(y).for_each(|(q, y)| *q -= y * a);
            shares.push(a);
        }
        solve(&mut q);
        for ((s, y, r), a) in self.pairs.iter().zip(shares.iter().rev()) {
            let b = r * dot(y, &q);
            q.iter_mut().zip(s).for_each(|(q, s)| *q += s * (a - b));
        }
        q
    }
}
