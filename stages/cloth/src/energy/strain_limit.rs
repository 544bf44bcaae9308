//! Strain-limit barrier: the additional tension with which cloth locks at its strain limits.
//!
//! It acts along warp and weft ([`crate::energy::law::Law`]) and along the two bias directions ([`Bias`]).

use crate::energy::tuning::{
    LOCK_BEFORE_WIDTHS, LOCK_SHUTTING, LOCK_SHUTTING_WIDTHS, LOCK_TENSION_CURVES, LOCK_TENSION_MAX, LOCK_TENSION_MIN,
    LOCK_WIDTH_SHARE, LOCK_WIDTH_SHARE_MAX, LOCK_WIDTH_SMALL_LIMIT,
};
use nalgebra::Vector3;

/// The lock of one direction: a tension over that of the curve.
///
/// It grows with the square of the strain from where it begins, and faster just after the cloth is locked. Below it
/// adds nothing, so that a limit that is not reached changes no bit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lock {
    /// Strain limit; infinite for none.
    limit: f64,
    /// Tension where the cloth is locked, N/m, if it locks as late as it ever does.
    latest: f64,
    /// Strain from which it acts.
    pub from: f64,
    /// Strain from its beginning to where the cloth is locked.
    width: f64,
    /// Tension there, N/m.
    locked: f64,
}

impl Lock {
    /// The lock at a strain limit, infinite for never; `tension` is that of the curve at the limit, N/m.
    pub fn at(limit: f64, tension: f64) -> Self {
        let latest = (LOCK_TENSION_CURVES.get() * tension).clamp(LOCK_TENSION_MIN.get(), LOCK_TENSION_MAX.get());
        if limit.is_finite() {
            Self { limit, latest, from: 0.0, width: 0.0, locked: 0.0 }.over_share(0.0)
        } else {
            Self { limit, latest, from: limit, width: 1.0, locked: 0.0 }
        }
    }

    /// The lock over a share of its limit, at least over its own width, or never for an infinite share.
    ///
    /// The earlier it begins, the less it carries, so that it is softer by the square.
    fn over_share(self, locking: f64) -> Self {
        let least = width(self.limit);
        let width = least.max(locking.min(1.0) * self.limit);
        let from =
            if locking.is_finite() { self.limit - LOCK_BEFORE_WIDTHS.get() * least - width } else { f64::INFINITY };
        Self { from, width, locked: self.latest * least / width, ..self }
    }

    /// Lets the cloth lock over this share of its limit. Returns `true` if that is a change.
    pub fn lock_over(&mut self, locking: f64) -> bool {
        if self.limit.is_infinite() {
            return false;
        }
        let before = std::mem::replace(self, self.over_share(locking));
        before.from != self.from
    }

    /// Tension, N/m, energy, J/m², and slope, N/m, at a strain over `from`.
    pub fn over(&self, strain: f64) -> [f64; 3] {
        let (shutting, shut_after) = (LOCK_SHUTTING.get(), LOCK_SHUTTING_WIDTHS.get());
        let near = (strain - self.from) / self.width;
        let (rise, on) = (near.min(1.0), (near - 1.0).max(0.0));
        let first = on.min(shut_after);
        let rest = on - first;
        let tension = rise * rise + 2.0 * on + shutting * first * (first + 2.0 * rest);
        let energy = rise * rise * rise / 3.0
            + on * (1.0 + on)
            + shutting * first * (first * first / 3.0 + rest * (first + rest));
        let slope = 2.0 * (rise + shutting * first) / self.width;
        [self.locked * tension, self.locked * self.width * energy, self.locked * slope]
    }
}

/// Least strain over which cloth with this limit comes to be locked.
fn width(limit: f64) -> f64 {
    (LOCK_WIDTH_SHARE.get() * limit)
        .max((LOCK_WIDTH_SHARE_MAX.get() * limit).min(LOCK_WIDTH_SMALL_LIMIT.get() / (limit * limit)))
}

/// Strain from which cloth with this limit locks.
pub(crate) fn locks_from(limit: f64) -> f64 {
    Lock::at(limit, 0.0).from
}

/// The locks of the two bias directions. The bias has no curve of its own; in the shear law it is bound to warp and
/// weft.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bias {
    lock: Lock,
    /// Green strain of a bias direction from which it locks.
    from: f64,
}

/// Stress and energy that one locking bias direction adds.
pub(crate) struct Pull {
    /// Derivative of its Green strain by (E_weft, E_warp, 2 E_12).
    pub by: Vector3<f64>,
    /// Stress conjugate to its Green strain, N/m.
    pub stress: f64,
    /// Growth of the stress with the Green strain by the slope of the tension, N/m.
    pub slope: f64,
    /// Growth of the stress with the Green strain by the change of the stretch, N/m.
    pub turning: f64,
    /// Energy per area, J/m².
    pub energy: f64,
}

impl Bias {
    /// The locks at a strain limit of the bias; the arguments are those of [`Lock::at`].
    pub fn at(limit: f64, tension: f64) -> Self {
        Self::of(Lock::at(limit, tension))
    }

    fn of(lock: Lock) -> Self {
        Self { lock, from: lock.from + 0.5 * lock.from * lock.from }
    }

    /// Lets the bias lock over this share of its limit. Returns `true` if that is a change.
    pub fn lock_over(&mut self, locking: f64) -> bool {
        let changed = self.lock.lock_over(locking);
        *self = Self::of(self.lock);
        changed
    }

    /// Green strain of a bias direction from which it locks.
    pub fn from(&self) -> f64 {
        self.from
    }

    /// Largest Green strain of the two at (E_weft, E_warp, 2 E_12).
    #[inline(always)]
    pub fn largest(green: [f64; 3]) -> f64 {
        0.5 * (green[0] + green[1] + green[2].abs())
    }

    /// Returns `true` if a bias direction locks at (E_weft, E_warp, 2 E_12).
    pub fn is_locking(&self, green: &[f64; 3]) -> bool {
        Self::largest(*green) > self.from
    }

    /// The bias directions that lock at (E_weft, E_warp, 2 E_12).
    pub fn pulls(&self, green: &[f64; 3]) -> impl Iterator<Item = Pull> + use<> {
        let (lock, from, green) = (self.lock, self.from, Vector3::from(*green));
        [0.5, -0.5].into_iter().filter_map(move |lean| {
            let by = Vector3::new(0.5, 0.5, lean);
            let strain = by.dot(&green);
            (strain > from).then(|| {
                let stretch = (1.0 + 2.0 * strain).sqrt();
                let [tension, energy, slope] = lock.over((stretch - 1.0).max(lock.from));
                let one = 1.0 / stretch;
                Pull {
                    by,
                    stress: tension * one,
                    slope: slope * one * one,
                    turning: -tension * one * one * one,
                    energy,
                }
            })
        })
    }
}
