//! How the strain limits lock while cloth settles: not while it falls, softly where it is slow to settle, as the law has it at rest.

use crate::optimize::descent::Descent;

/// Steps after which cloth locks more softly for a while: single triangles that hang at a corner turn in steps of
/// micrometres beside a stiffness a thousand times that of all others. On a body not from the start: what slides under friction
/// would stay where the softer cloth brought it.
const LONG_LOCKED: u64 = 400;
/// Share of the strain limits over which it locks then, what that narrows by each time a Newton step would win less of the elastic
/// energy than this, and below which share it is the law's own again.
const WIDE_LOCK: f64 = 0.6;
const NARROWER: f64 = 0.3;
const LEAST_LOCK: f64 = 0.01;
const NARROW_AT: f64 = 1e-3;
/// What a Newton step would win over the elastic energy, above which cloth falls and locks nowhere, and below which it does again:
/// what is stretched on the way down says little of how it will hang, and a limit that is not reached then costs nothing.
const FALLING: f64 = 0.5;
const AWAKE: f64 = 2e-3;

/// How cloth locks at its strain limits while it settles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Locks {
    /// Not asked yet.
    Unseen,
    /// Never: the cloth still falls.
    Asleep,
    /// As the law has it since that step, and not widened yet.
    Untouched(u64),
    /// Over this share of the limits.
    Wide(f64),
    /// As the law has it again.
    Own,
}

impl Descent<'_> {
    /// Large cloth that locks and surely falls needs no factor to be told so.
    pub(crate) fn locks_at_start(&mut self) -> Locks {
        if !(self.is_large() && self.goal.is_locking(&self.x)) {
            return Locks::Unseen;
        }
        self.refresh_lagged();
        if self.surely_wins(FALLING) && self.lock_over(f64::INFINITY) { Locks::Asleep } else { Locks::Unseen }
    }

    /// What the locks at the strain limits are to be now, and whether that changes a force.
    pub(crate) fn turn_locks(&mut self, locks: Locks) -> (Locks, bool) {
        match locks {
            Locks::Unseen if self.decrement > FALLING => (Locks::Asleep, self.lock_over(f64::INFINITY)),
            Locks::Unseen => (self.first_locks(), false),
            // Coarser cloth only finds the way; between the places where it is held it may be stretched by its coarseness alone.
            Locks::Asleep if !self.is_coarser() && (self.decrement < AWAKE || self.resting()) => {
                let changed = self.lock_over(0.0);
                (self.first_locks(), changed)
            }
            Locks::Wide(share) if self.decrement < NARROW_AT || self.resting() => self.narrow_locks(share),
            as_they_are => (as_they_are, false),
        }
    }

    /// Has cloth that locks as the law has it been long about it?
    pub(crate) fn is_long_locked(&self, locks: Locks) -> bool {
        matches!(locks, Locks::Untouched(since) if self.steps - since >= LONG_LOCKED) && self.goal.is_locking(&self.x)
    }

    /// Of cloth that locks as the law has it.
    fn first_locks(&mut self) -> Locks {
        if self.goal.on_body() || !self.goal.is_locking(&self.x) {
            return Locks::Untouched(self.steps);
        }
        self.widen_locks()
    }

    pub(crate) fn widen_locks(&mut self) -> Locks {
        self.lock_over(WIDE_LOCK);
        Locks::Wide(WIDE_LOCK)
    }

    /// Lets locks be narrower than over this share of the limits, until that changes a force; says whether it did.
    pub(crate) fn narrow_locks(&mut self, mut share: f64) -> (Locks, bool) {
        let mut changed = false;
        while share > 0.0 && !changed {
            share = if share > LEAST_LOCK { NARROWER * share } else { 0.0 };
            changed = self.lock_over(share);
        }
        (if share > 0.0 { Locks::Wide(share) } else { Locks::Own }, changed)
    }

    fn lock_over(&mut self, share: f64) -> bool {
        let changed = self.goal.lock_over(share, &self.x);
        if changed {
            self.start_anew();
            self.renew();
        }
        changed
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::optimize::test_sheets;
    use crate::{Material, Scene, Settings, Vec3};

    /// A square metre of so many squares along a side, held by one edge and drawn away from it by 0.9 %, with a limit of 1 %: it
    /// locks a little, and falls.
    fn drawn(squares: u32) -> Scene {
        let limited =
            Material { strain_limit: [0.01, 0.01, f64::INFINITY], ..Material::isotropic(0.15, 500.0, 0.0, 1e-5) };
        let mut scene = Scene { materials: vec![limited], gravity: Vec3::new(0.0, -9.81, 0.0), ..Scene::default() };
        test_sheets::add(&mut scene, squares, 1.0, 0.0, |_, j| j == 0);
        scene.positions.iter_mut().for_each(|p| p.z += 0.009 * (p.z + 0.5));
        scene
    }

    #[test]
    fn large_cloth_that_surely_falls_sleeps_without_a_factor() {
        let settings = Settings::default();
        for (squares, first) in [(68, Locks::Asleep), (20, Locks::Unseen)] {
            let mut d = Descent::begin(&drawn(squares), &settings, false).unwrap();
            assert!(d.goal.is_locking(&d.x));
            let locks = d.locks_at_start();
            assert_eq!(locks, first);
            assert_eq!(d.factors(), 0);
            assert_eq!(d.goal.is_locking(&d.x), first == Locks::Unseen);
            // The small one is told the same by its factor.
            if first == Locks::Unseen {
                d.metric().unwrap();
                d.look();
                assert_eq!(d.turn_locks(locks), (Locks::Asleep, true));
            }
        }
    }
}
