//! A sheet that hangs by its upper edge.

/// Elongation of a sheet of length `l` and weight `w` (N/m²) whose strain at tension T is `strain(T)`, by Simpson's
/// rule.
pub fn elongation(l: f64, w: f64, strain: impl Fn(f64) -> f64) -> f64 {
    let n = 20_000;
    let h = l / f64::from(n);
    let at = |i: i32| strain(w * h * f64::from(i));
    (0..n / 2).map(|i| h / 3.0 * (at(2 * i) + 4.0 * at(2 * i + 1) + at(2 * i + 2))).sum()
}

/// Strain of `T = k0/b (exp(b ε) − 1)`.
pub fn exponential(k0: f64, b: f64) -> impl Fn(f64) -> f64 {
    move |t| libm::log1p(b * t / k0) / b
}
