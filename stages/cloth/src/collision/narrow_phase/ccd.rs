//! How far a step may go: continuous collision detection by additive conservative advancement (Li et al. 2021), so
//! that along an accepted step no near pair comes closer than a share of its distance, and nothing crosses.

use crate::Vec3;
use crate::collision::narrow_phase::distance::{point_triangle_gap, segment_gap};
use crate::collision::narrow_phase::pair_kind::PairKind;

/// Share of its distance that a pair keeps in a step.
const KEEP: f64 = 0.2;
/// Nearer than this a pair comes only slowly, m: far above rounding, also to `f32`.
const NEAREST: f64 = 2e-5;
/// Share of a found time of impact that is used.
pub(crate) const SAFE: f64 = 0.9;
const MOST_ADVANCES: usize = 64;
/// A pair that comes so near to a distance, over it, is said to reach it.
const NEARLY: f64 = 1e-3;

/// A pair: positions and displacements of its four points, and which of them are on the first side (its kind).
pub(crate) struct Pair {
    pub at: [Vec3; 4],
    pub by: [Vec3; 4],
    pub kind: PairKind,
}

impl Pair {
    /// Distance of the two primitives, m.
    pub fn distance(&self) -> f64 {
        let [p, q, r, s] = &self.at;
        match self.kind {
            PairKind::VertexTriangle | PairKind::VertexBodyTriangle => point_triangle_gap(p, [q, r, s]),
            PairKind::TriangleBodyVertex => point_triangle_gap(s, [p, q, r]),
            _ => segment_gap([p, q], [r, s]),
        }
    }

    /// Bound of how fast the two sides approach: largest displacements against their mean.
    fn pace(&mut self) -> f64 {
        let mean = (self.by[0] + self.by[1] + self.by[2] + self.by[3]) * 0.25;
        self.by.iter_mut().for_each(|d| *d -= mean);
        let n = self.by.map(|d| d.norm());
        match self.kind {
            PairKind::VertexTriangle | PairKind::VertexBodyTriangle => n[0] + n[1].max(n[2]).max(n[3]),
            PairKind::TriangleBodyVertex => n[3] + n[0].max(n[1]).max(n[2]),
            _ => n[0].max(n[1]) + n[2].max(n[3]),
        }
    }

    /// Largest part (at most 1) of the displacement that keeps [`KEEP`] of the distance.
    pub fn free_part(&mut self, distance: f64) -> f64 {
        let pace = self.pace();
        let least = (KEEP * distance).max(NEAREST.min(0.8 * distance));
        if pace <= distance - least {
            return 1.0;
        }
        let (mut t, mut gap) = (0.0, distance);
        for _ in 0..MOST_ADVANCES {
            let step = SAFE * (gap - least) / pace;
            t += step;
            if t >= 1.0 {
                return 1.0;
            }
            for k in 0..4 {
                self.at[k] += self.by[k] * step;
            }
            gap = self.distance();
            if gap - least < 0.05 * (distance - least) {
                break;
            }
        }
        t
    }

    /// Does it stay farther apart than `least` all along the displacement? `false`, too, where that takes too long to tell.
    pub fn stays_beyond(&mut self, least: f64) -> bool {
        let (pace, mut left) = (self.pace(), 1.0);
        for _ in 0..MOST_ADVANCES {
            let room = self.distance() - least;
            if room <= NEARLY * least {
                return false;
            }
            if pace * left <= room {
                return true;
            }
            let step = room / pace;
            left -= step;
            (0..4).for_each(|k| self.at[k] += self.by[k] * step);
        }
        false
    }
}
