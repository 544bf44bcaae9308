//! The preconditioner of a descent: a Cholesky factor of the Hessian here or a little before.

use crate::Vec3;
use crate::linear::factor::Factor;

/// The factor, and what is known of it.
pub(crate) struct Preconditioner {
    pub factor: Factor,
    /// True for the factor of the full Hessian, without projection to a convex one?
    pub is_full: bool,
    /// Every block takes a new factor of the convex Hessian, as time steps do.
    pub always_convex: bool,
    pub made: FactorPlace,
    /// Blocks until the full Hessian is tried again, and how many it will be after the next failure.
    pub wait: u32,
    pub next_wait: u32,
}

/// Where and for what the factor was made.
#[derive(Debug, Default)]
pub(crate) struct FactorPlace {
    pub at: Vec<Vec3>,
    pub tau: f64,
    pub isotropic: f64,
    pub surrogate: bool,
    /// Have steps gone well with it so far?
    pub good: bool,
}

impl Preconditioner {
    pub fn new(threads: usize) -> Self {
        Self {
            factor: Factor::by(threads),
            is_full: false,
            always_convex: false,
            made: FactorPlace::default(),
            wait: 0,
            next_wait: 0,
        }
    }

    /// The next block takes a new factor.
    pub fn renew(&mut self) {
        self.made.good = false;
    }

    /// Was the factor made for these positions?
    pub fn is_fresh(&self, x: &[Vec3]) -> bool {
        self.made.at == x
    }
}
