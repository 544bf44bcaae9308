//! The barrier potential of a contact.

/// The barrier b(d) = −(d − ĝ)² ln(d/ĝ) and its first two derivatives, at distance d and activation distance ĝ, m.
///
/// It is zero at ĝ with zero slope, and infinite at d = 0 (Li et al. 2020, equation 6).
#[inline]
pub(crate) fn barrier(d: f64, activation_distance: f64) -> (f64, f64, f64) {
    let (s, l) = (d - activation_distance, libm::log(d / activation_distance));
    (-s * s * l, -2.0 * s * l - s * s / d, -2.0 * l - 4.0 * s / d + s * s / (d * d))
}

/// The activation distance, m, whose barrier pushes at distance `to` as that of `activation_distance` does at `d`.
pub(crate) fn equivalent_activation_distance(d: f64, activation_distance: f64, to: f64) -> f64 {
    let push = -barrier(d, activation_distance).1;
    // Four gaps are beyond every limit that callers set.
    bisect([to, 4.0 * to.max(activation_distance)], |g| -barrier(to, g).1 < push)
}

/// The place between two bounds up to which `is_below` is true, by forty bisections.
pub(crate) fn bisect([mut low, mut high]: [f64; 2], is_below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if is_below(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The distance at which a contact of the given stiffness, N/m³, balances a pressure, Pa.
#[cfg(test)]
pub(crate) fn resting_distance(activation_distance: f64, pressure: f64, stiffness: f64) -> f64 {
    bisect([0.0, activation_distance], |d| -barrier(d, activation_distance).1 * stiffness > pressure)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_barrier_starts_without_a_kink_and_its_derivatives_agree() {
        let gap = 1e-3;
        for d in [1e-5, 2e-4, 5e-4, 9e-4] {
            let h = 1e-9;
            let (low, high) = (barrier(d - h, gap), barrier(d + h, gap));
            let (_, slope, curvature) = barrier(d, gap);
            assert!(((high.0 - low.0) / (2.0 * h) / slope - 1.0).abs() < 1e-4, "{d}");
            assert!(((high.1 - low.1) / (2.0 * h) / curvature - 1.0).abs() < 1e-4, "{d}");
            assert!(slope < 0.0 && curvature > 0.0);
        }
        let (b, slope, curvature) = barrier(gap, gap);
        assert_eq!((b, slope, curvature), (0.0, 0.0, 0.0));
    }
}
