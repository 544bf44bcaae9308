//! Central differences of `x″ = −ω² x`, exactly: `x⁺ − 2x + x⁻ = −(ω Δt)² x`.

/// ω that the steps show, 1/s.
pub fn omega(omega: f64, dt: f64) -> f64 {
    2.0 / dt * libm::asin(0.5 * omega * dt)
}

/// Longest stable step when damping (ratio ζ) acts on the velocity of half a step before, s.
pub fn lagged_step(omega: f64, zeta: f64) -> f64 {
    2.0 / omega * (libm::sqrt(1.0 + zeta * zeta) - zeta)
}

/// Longest stable step of a chain of `n` masses of σ h per width on springs of K/h per width (h = `length`/n), s: 2/ω
/// of its last mode. One end is held, and the mass at the free end is half.
pub fn chain_step(k: f64, sigma: f64, length: f64, n: usize) -> f64 {
    let (h, n) = (length / n as f64, n as f64);
    let omega = 2.0 / h * (k / sigma).sqrt() * libm::sin(std::f64::consts::FRAC_PI_4 * (2.0 * n - 1.0) / n);
    2.0 / omega
}

/// Longest stable step of a square lattice of masses σ h² (kg) with springs K (N/m) along its lines, s: 2/ω of the mode
/// in which neighbours go against each other.
pub fn longest_step(k: f64, sigma: f64, h: f64) -> f64 {
    h * (sigma / k).sqrt()
}
