//! A translation-invariant quadratic form of the positions as springs: E = ½ Σ k |x_b − x_a|² over pairs of vertices.
//!
//! The stiffness k is below 0 where the two push apart. It takes a third of the sums of the squares one by one.

use crate::Vec3;

/// Springs between pairs of vertices.
#[derive(Default)]
pub(crate) struct Springs {
    /// For every vertex the first of its springs to vertices of higher numbers.
    start: Vec<u32>,
    /// Ends of all springs with the higher numbers.
    ends: Vec<u32>,
    /// Stiffness of all springs, in the unit of the caller.
    stiffness: Vec<f64>,
}

fn length(ends: &[u32]) -> u32 {
    u32::try_from(ends.len()).unwrap_or(u32::MAX)
}

/// Springs sorted by their first ends (a stable counting sort).
fn sorted_by_first_end(n: usize, all: Vec<([u32; 2], f64)>) -> Vec<(u32, u32, f64)> {
    let mut next = vec![0; n + 1];
    all.iter().for_each(|([a, _], _)| next[*a as usize + 1] += 1);
    (0..n).for_each(|v| next[v + 1] += next[v]);
    let mut sorted = vec![(0, 0, 0.0); all.len()];
    for ([a, b], k) in all {
        sorted[next[a as usize]] = (a, b, k);
        next[a as usize] += 1;
    }
    sorted
}

impl Springs {
    /// Springs between `n` vertices; those of one pair are summed in their order.
    pub fn new(n: usize, mut all: Vec<([u32; 2], f64)>) -> Self {
        all.retain(|([a, b], k)| a != b && *k != 0.0);
        all.iter_mut().for_each(|(ends, _)| ends.sort_unstable());
        let (mut start, mut ends, mut stiffness): (_, _, Vec<f64>) = (vec![0], Vec::new(), Vec::new());
        for own in sorted_by_first_end(n, all).chunk_by_mut(|p, q| p.0 == q.0) {
            start.resize(own[0].0 as usize + 1, length(&ends));
            own.sort_by_key(|s| s.1);
            for same in own.chunk_by(|p, q| p.1 == q.1) {
                ends.push(same[0].1);
                stiffness.push(same.iter().map(|s| s.2).sum());
            }
        }
        start.resize(n + 1, length(&ends));
        ends.shrink_to_fit();
        stiffness.shrink_to_fit();
        Self { start, ends, stiffness }
    }

    /// Ends and stiffness of all springs.
    pub fn all(&self) -> impl Iterator<Item = ([u32; 2], f64)> + '_ {
        let springs = self.ends.iter().zip(&self.stiffness);
        let from = (0u32..).zip(self.start.windows(2)).flat_map(|(a, s)| (s[0]..s[1]).map(move |_| a));
        from.zip(springs).map(|(a, (b, k))| ([a, *b], *k))
    }

    /// Adds the forces and returns the energy, both times `size`.
    pub fn evaluate(&self, size: f64, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut twice = 0.0;
        for (a, own) in self.start.windows(2).enumerate() {
            let own = own[0] as usize..own[1] as usize;
            let (from, mut pull) = (x[a], Vec3::zeros());
            for (b, k) in self.ends[own.clone()].iter().zip(&self.stiffness[own]) {
                let way = x[*b as usize] - from;
                let force = way * (size * k);
                twice += way.dot(&force);
                pull += force;
                f[*b as usize] -= force;
            }
            f[a] += pull;
        }
        0.5 * twice
    }

    /// The energy at `x`, times `size`.
    pub fn energy(&self, size: f64, x: &[Vec3]) -> f64 {
        let twice: f64 = self.all().map(|([a, b], k)| size * k * (x[b as usize] - x[a as usize]).norm_squared()).sum();
        0.5 * twice
    }

    /// Rounding error of the energy. In flat cloth large energies of pulling and pushing springs cancel.
    pub fn noise(&self, size: f64, x: &[Vec3]) -> f64 {
        let sizes = self.all().map(|([a, b], k)| (size * k).abs() * (x[b as usize] - x[a as usize]).norm_squared());
        f64::EPSILON * sizes.sum::<f64>()
    }

    /// Adds a bound of every vertex's row sum.
    pub fn add_stiffness(&self, size: f64, sums: &mut [f64]) {
        let mut own = vec![0.0; sums.len()];
        for (ends, k) in self.all() {
            for v in ends {
                sums[v as usize] += size * k.abs();
                own[v as usize] += size * k;
            }
        }
        sums.iter_mut().zip(own).for_each(|(s, k)| *s += k.abs());
    }
}
