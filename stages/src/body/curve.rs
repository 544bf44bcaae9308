//! Monotone cubic interpolation of numbers along an axis.

/// Half width of the smoothing that takes the jumps of curvature at the keys away, metres.
const SMOOTH: f64 = 0.014;

/// A C1 curve through keys that never overshoots them (Fritsch and Butland's harmonic slopes, flat at both ends).
#[derive(Clone, Debug)]
pub struct Curve<const VALUES: usize> {
    keys: Vec<(f64, [f64; VALUES])>,
    slopes: Vec<[f64; VALUES]>,
    /// The largest absolute value of each component over the keys.
    pub largest: [f64; VALUES],
}

impl<const VALUES: usize> Curve<VALUES> {
    /// A curve through keys with rising positions; keys at or below the one before are left out.
    pub fn new(given: &[(f64, [f64; VALUES])]) -> Self {
        let mut keys: Vec<(f64, [f64; VALUES])> = Vec::new();
        for key in given {
            if keys.last().is_none_or(|last| key.0 > last.0 + 1e-6) {
                keys.push(*key);
            }
        }
        let mut slopes = vec![[0.0; VALUES]; keys.len()];
        for (i, trio) in keys.windows(3).enumerate() {
            for (c, slope) in slopes[i + 1].iter_mut().enumerate() {
                let (h0, h1) = (trio[1].0 - trio[0].0, trio[2].0 - trio[1].0);
                *slope = harmonic((trio[1].1[c] - trio[0].1[c]) / h0, (trio[2].1[c] - trio[1].1[c]) / h1, h0, h1);
            }
        }
        let mut largest = [0.0; VALUES];
        for (_, row) in &keys {
            for (most, value) in largest.iter_mut().zip(row) {
                *most = f64::max(*most, value.abs());
            }
        }
        Self { keys, slopes, largest }
    }

    /// First and last key position.
    pub fn range(&self) -> (f64, f64) {
        (self.keys.first().map_or(0.0, |k| k.0), self.keys.last().map_or(0.0, |k| k.0))
    }

    /// Values and their derivatives, smoothed over [`SMOOTH`]; constant beyond the ends.
    pub fn at(&self, t: f64) -> ([f64; VALUES], [f64; VALUES]) {
        let (mut out, before, after) = (self.raw(t), self.raw(t - SMOOTH), self.raw(t + SMOOTH));
        for c in 0..VALUES {
            out.0[c] = 0.5 * out.0[c] + 0.25 * (before.0[c] + after.0[c]);
            out.1[c] = 0.5 * out.1[c] + 0.25 * (before.1[c] + after.1[c]);
        }
        out
    }

    fn raw(&self, t: f64) -> ([f64; VALUES], [f64; VALUES]) {
        let after = self.keys.partition_point(|k| k.0 <= t);
        if after == 0 || after == self.keys.len() {
            let key = if after == 0 { self.keys.first() } else { self.keys.last() };
            return (key.map_or([0.0; VALUES], |k| k.1), [0.0; VALUES]);
        }
        let (low, high) = (&self.keys[after - 1], &self.keys[after]);
        let h = high.0 - low.0;
        let s = (t - low.0) / h;
        let mut out = ([0.0; VALUES], [0.0; VALUES]);
        for c in 0..VALUES {
            let (m0, m1) = (self.slopes[after - 1][c] * h, self.slopes[after][c] * h);
            let rise = high.1[c] - low.1[c];
            let (c2, c3) = (3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise);
            out.0[c] = low.1[c] + s * (m0 + s * (c2 + s * c3));
            out.1[c] = (m0 + s * (2.0 * c2 + 3.0 * s * c3)) / h;
        }
        out
    }
}

fn harmonic(d0: f64, d1: f64, h0: f64, h1: f64) -> f64 {
    if d0 * d1 <= 0.0 {
        return 0.0;
    }
    let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
    (w0 + w1) / (w0 / d0 + w1 / d1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_through_its_keys_and_never_overshoots() {
        let row = |x: f64| [x, 0.0, 0.0, 0.0];
        let curve = Curve::new(&[(0.0, row(1.0)), (1.0, row(3.0)), (2.0, row(3.0)), (4.0, row(-1.0))]);
        for (t, x) in [(0.0, 1.0), (1.0, 3.0), (2.0, 3.0), (4.0, -1.0), (-5.0, 1.0), (9.0, -1.0)] {
            assert!((curve.raw(t).0[0] - x).abs() < 1e-12);
        }
        for i in 0..=400 {
            let x = curve.at(f64::from(i) * 0.01).0[0];
            assert!((-1.0..=3.0).contains(&x));
        }
    }

    #[test]
    fn derivative_agrees_with_differences() {
        let row = |x: f64| [x, x * 2.0, 0.0, 0.0];
        let curve = Curve::new(&[(0.0, row(1.0)), (0.3, row(2.0)), (1.0, row(2.5)), (1.4, row(5.0))]);
        for i in 1..14 {
            let t = f64::from(i) * 0.1 + 0.003;
            let slope = (curve.at(t + 1e-6).0[1] - curve.at(t - 1e-6).0[1]) / 2e-6;
            assert!((curve.at(t).1[1] - slope).abs() < 1e-5, "{t}");
        }
    }
}
