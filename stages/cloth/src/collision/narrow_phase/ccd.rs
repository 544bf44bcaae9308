//! Continuous collision detection by additive conservative advancement (Li et al. 2021).
//!
//! Along an accepted step no near pair comes closer than a share of its distance, and nothing crosses.

use crate::Vec3;
use crate::collision::narrow_phase::distance::{point_triangle_gap, segment_gap};
use crate::collision::narrow_phase::pair_kind::PairKind;
use crate::collision::tuning::{
    ADVANCE_END_SHARE, ADVANCES_PER_TEST, DISTANCE_KEPT_PER_STEP, IMPACT_FRACTION_USED, REACHED_DISTANCE_TOLERANCE,
    SLOW_APPROACH_DISTANCE,
};

/// A pair whose cloth moves by at most this share of its distance cannot come too near.
///
/// The least distance of [`MovingPair::max_step_fraction`] is at most the rest of the distance.
pub(crate) const FREE_MOTION_SHARE: f64 = 0.2;

/// A pair of primitives with the positions and displacements of its four points. The kind says which points form the
/// first primitive.
pub(crate) struct MovingPair {
    /// Positions of the points.
    pub at: [Vec3; 4],
    /// Displacements of the points, m.
    pub by: [Vec3; 4],
    pub kind: PairKind,
}

impl MovingPair {
    /// Distance of the two primitives, m.
    pub fn distance(&self) -> f64 {
        let [p, q, r, s] = &self.at;
        match self.kind {
            PairKind::VertexTriangle | PairKind::VertexBodyTriangle => point_triangle_gap(p, [q, r, s]),
            PairKind::TriangleBodyVertex => point_triangle_gap(s, [p, q, r]),
            _ => segment_gap([p, q], [r, s]),
        }
    }

    /// Bound of the approach of the two primitives, m: their largest displacements relative to the mean, which is
    /// taken off.
    fn approach(&mut self) -> f64 {
        let mean = (self.by[0] + self.by[1] + self.by[2] + self.by[3]) * 0.25;
        self.by.iter_mut().for_each(|d| *d -= mean);
        let n = self.by.map(|d| d.norm());
        match self.kind {
            PairKind::VertexTriangle | PairKind::VertexBodyTriangle => n[0] + n[1].max(n[2]).max(n[3]),
            PairKind::TriangleBodyVertex => n[3] + n[0].max(n[1]).max(n[2]),
            _ => n[0].max(n[1]) + n[2].max(n[3]),
        }
    }

    /// Largest part (at most 1) of the displacement that keeps the least distance: [`DISTANCE_KEPT_PER_STEP`] of
    /// `distance`, or [`SLOW_APPROACH_DISTANCE`] where that is more.
    pub fn max_step_fraction(&mut self, distance: f64) -> f64 {
        let approach = self.approach();
        let least = (DISTANCE_KEPT_PER_STEP.get() * distance)
            .max(SLOW_APPROACH_DISTANCE.get().min((1.0 - FREE_MOTION_SHARE) * distance));
        if approach <= distance - least {
            return 1.0;
        }
        let (mut t, mut gap) = (0.0, distance);
        for _ in 0..ADVANCES_PER_TEST.get() {
            let step = IMPACT_FRACTION_USED.get() * (gap - least) / approach;
            t += step;
            if t >= 1.0 {
                return 1.0;
            }
            for k in 0..4 {
                self.at[k] += self.by[k] * step;
            }
            gap = self.distance();
            if gap - least < ADVANCE_END_SHARE.get() * (distance - least) {
                break;
            }
        }
        t
    }

    /// Does the pair stay farther apart than `least` along the displacement, m? `false` also where the test takes too
    /// many advances.
    pub fn stays_beyond(&mut self, least: f64) -> bool {
        let (approach, mut left) = (self.approach(), 1.0);
        for _ in 0..ADVANCES_PER_TEST.get() {
            let room = self.distance() - least;
            if room <= REACHED_DISTANCE_TOLERANCE.get() * least {
                return false;
            }
            if approach * left <= room {
                return true;
            }
            let step = room / approach;
            left -= step;
            (0..4).for_each(|k| self.at[k] += self.by[k] * step);
        }
        false
    }
}
