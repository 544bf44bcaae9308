//! How cloth locks at its strain limits: what it carries over its curves there, along warp and weft ([`crate::energy::law::Law`]) and
//! along its two bias directions ([`Bias`]).

use nalgebra::Vector3;

/// Strain over which cloth comes to be locked, as a share of the limit: over more of a small limit (a tenth of one of 1.2 %, 2.5 % of
/// one of 2 %: width · limit² in between), where few triangles at a corner or at the end of a seam reach it, many times as
/// stiff as all others.
const LOCKING: f64 = 0.004;
const MOST_LOCKING: f64 = 0.1;
const WIDTH_OF_SMALL: f64 = 2e-7;
/// Widths by which it is locked before its limit: so that it carries three times as much there.
const BEFORE: f64 = 0.5;
/// Tension that it carries over that of its curve where it is locked: so many times what the curve itself has at the limit, within
/// these bounds, N/m. More would only be stiffer than what the cloth has to bear, and cost steps.
const TIMES_ITS_CURVE: f64 = 7.0;
const LEAST_LOCKED: f64 = 50.0;
const MOST_LOCKED: f64 = 900.0;
/// How much faster it grows beyond, up to so many widths on: so that a band drawn over gathers stays within its limit. Only so far,
/// because cloth that comes from a coarser mesh begins far beyond in places, and must find back.
const SHUTTING: f64 = 4.0;
const SHUT_AFTER: f64 = 0.5;

/// What a locking cloth carries over its curve: a tension that grows with the square of the strain from where it begins, and
/// faster just after it is locked. Below it adds nothing, so that a limit that is not reached changes no bit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lock {
    limit: f64,
    /// Tension where the cloth is locked, N/m, if it locks as late as it ever does.
    latest: f64,
    pub from: f64,
    /// Strain from its beginning to where the cloth is locked.
    width: f64,
    /// Tension there, N/m.
    locked: f64,
}

impl Lock {
    /// Infinite limit for never; `tension`: what the curve carries at the limit, N/m.
    pub fn at(limit: f64, tension: f64) -> Self {
        let latest = (TIMES_ITS_CURVE * tension).clamp(LEAST_LOCKED, MOST_LOCKED);
        if limit.is_finite() {
            Self { limit, latest, from: 0.0, width: 0.0, locked: 0.0 }.over_share(0.0)
        } else {
            Self { limit, latest, from: limit, width: 1.0, locked: 0.0 }
        }
    }

    /// Locks over this share of its limit, or over more if that is the least it takes, or never if it is infinite; the earlier
    /// it begins, the less it carries, so that it is softer by the square.
    fn over_share(self, locking: f64) -> Self {
        let least = width(self.limit);
        let width = least.max(locking.min(1.0) * self.limit);
        let from = if locking.is_finite() { self.limit - BEFORE * least - width } else { f64::INFINITY };
        Self { from, width, locked: self.latest * least / width, ..self }
    }

    /// Lets the cloth lock over this share of its limit; says whether that is anything new.
    pub fn lock_over(&mut self, locking: f64) -> bool {
        if self.limit.is_infinite() {
            return false;
        }
        let before = std::mem::replace(self, self.over_share(locking));
        before.from != self.from
    }

    /// Tension, N/m, energy, J/m², and slope, N/m, at a strain over `from`.
    pub fn over(&self, strain: f64) -> [f64; 3] {
        let near = (strain - self.from) / self.width;
        let (rise, on) = (near.min(1.0), (near - 1.0).max(0.0));
        let first = on.min(SHUT_AFTER);
        let rest = on - first;
        let tension = rise * rise + 2.0 * on + SHUTTING * first * (first + 2.0 * rest);
        let energy = rise * rise * rise / 3.0
            + on * (1.0 + on)
            + SHUTTING * first * (first * first / 3.0 + rest * (first + rest));
        let slope = 2.0 * (rise + SHUTTING * first) / self.width;
        [self.locked * tension, self.locked * self.width * energy, self.locked * slope]
    }
}

/// Strain over which cloth with this limit comes to be locked, at the least.
fn width(limit: f64) -> f64 {
    (LOCKING * limit).max((MOST_LOCKING * limit).min(WIDTH_OF_SMALL / (limit * limit)))
}

/// Strain from which cloth with this limit locks.
pub(crate) fn locks_from(limit: f64) -> f64 {
    Lock::at(limit, 0.0).from
}

/// How cloth locks along its two bias directions, where it has no curve of its own: in its shear law the bias is bound to warp
/// and weft.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bias {
    lock: Lock,
    /// Green strain of a bias direction from which it locks.
    from: f64,
}

/// What one locking bias direction adds.
pub(crate) struct Pull {
    /// How its Green strain grows with (E_weft, E_warp, 2 E_12).
    pub by: Vector3<f64>,
    /// Stress conjugate to its Green strain, N/m, and how that grows with it: by the slope, and by the turning of the stretch.
    pub stress: f64,
    pub slope: f64,
    pub turning: f64,
    /// J/m².
    pub energy: f64,
}

impl Bias {
    /// As [`Lock::at`].
    pub fn at(limit: f64, tension: f64) -> Self {
        Self::of(Lock::at(limit, tension))
    }

    fn of(lock: Lock) -> Self {
        Self { lock, from: lock.from + 0.5 * lock.from * lock.from }
    }

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

    pub fn is_locking(&self, green: &[f64; 3]) -> bool {
        Self::largest(*green) > self.from
    }

    /// What locks at (E_weft, E_warp, 2 E_12).
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
