//! Elastic bands sewn along lines of the cloth (docs/lines.md).
//!
//! A band follows the mean line of the cloth's edge: the middles between its vertices. So the cloth may stand in folds of
//! two mesh edges along a band that is shorter, as gathers do.

use crate::energy::Energy;
use crate::energy::structural::row_sums;
use crate::linear::hessian::Hessian;
use crate::scene::lines::Band;
use crate::{Scene, Vec3};

/// The strand of a band between two middles: half of the way between two vertices.
struct Strand {
    ends: [u32; 2],
    /// Twice its length at rest, m.
    rest: f64,
    /// N per strain.
    stiffness: f64,
}

/// The strands of all bands.
pub(crate) struct Bands {
    strands: Vec<Strand>,
}

/// The strands of one band.
fn strands(band: &Band) -> Vec<Strand> {
    let (n, k) = (band.vertices.len(), band.stiffness);
    let strand = |a: usize, b: usize, rest: f64| Strand {
        ends: [band.vertices[a % n], band.vertices[b % n]],
        rest,
        stiffness: k,
    };
    if band.is_closed() {
        let rest = |i: usize| band.rest[i % n] + band.rest[(i + 1) % n];
        return (0..n).map(|i| strand(i, i + 2, rest(i))).filter(|s| s.ends[0] != s.ends[1]).collect();
    }
    // Both ends of an open band run from a vertex to the first middle.
    let inner = (0..n - 2).map(|i| strand(i, i + 2, band.rest[i] + band.rest[i + 1]));
    let first = strand(0, 1, band.rest[0]);
    let last = strand(n - 2, n - 1, band.rest[n - 2]);
    std::iter::once(first).chain(inner).chain([last]).collect()
}

impl Bands {
    /// The bands of a scene.
    pub fn new(scene: &Scene) -> Self {
        Self { strands: scene.bands.iter().flat_map(strands).collect() }
    }
}

impl Strand {
    /// Way between its ends and its strain, which is 0 where it is slack.
    fn state(&self, x: &[Vec3]) -> (Vec3, f64) {
        let way = x[self.ends[1] as usize] - x[self.ends[0] as usize];
        (way, (way.norm() / self.rest - 1.0).max(0.0))
    }
}

/// Length of a band along the mean line of its edge, m, and its mean tension, N, at `x`.
#[must_use]
pub fn band_state(band: &Band, x: &[Vec3]) -> (f64, f64) {
    let (mut length, mut tension) = (0.0, 0.0);
    for s in strands(band) {
        let (way, strain) = s.state(x);
        length += 0.5 * way.norm();
        tension += 0.5 * s.rest * s.stiffness * strain;
    }
    (length, tension / band.rest_length())
}

impl Energy for Bands {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        for s in &self.strands {
            let (way, strain) = s.state(x);
            if strain > 0.0 {
                // Half of the way carries the tension, and each end of it moves half as far as the vertex.
                let pull = way * (0.5 * s.stiffness * strain / way.norm());
                f[s.ends[0] as usize] += pull;
                f[s.ends[1] as usize] -= pull;
            }
        }
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        let of = |s: &Strand| {
            let strain = s.state(x).1;
            0.25 * s.rest * s.stiffness * strain * strain
        };
        self.strands.iter().map(of).sum()
    }

    fn add_stiffness(&self, _: &[Vec3], k: &mut [f64]) {
        self.strands.iter().for_each(|s| row_sums(s.ends, 0.5 * s.stiffness / s.rest, k));
    }

    fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        pairs.extend(self.strands.iter().map(|s| s.ends));
    }

    fn add_hessian(&self, x: &[Vec3], _: bool, h: &mut Hessian) {
        for s in &self.strands {
            let (way, strain) = s.state(x);
            if strain > 0.0 {
                let l = way.norm();
                let along = way * way.transpose() / (l * l);
                let across = 0.5 * s.stiffness * strain / l;
                let block = along * (0.5 * s.stiffness / s.rest - across) + nalgebra::Matrix3::identity() * across;
                h.spread(&s.ends, &[1.0, -1.0], &block);
            }
        }
    }
}
