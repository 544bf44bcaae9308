//! Central differences of `x″ = −ω² x`, exactly: `x⁺ − 2x + x⁻ = −(ω Δt)² x`.

/// ω that the steps show, 1/s.
pub fn omega(omega: f64, dt: f64) -> f64 {
    2.0 / dt * libm::asin(0.5 * omega * dt)
}

/// Longest stable step of a square lattice of masses σ h² (kg) with springs K (N/m) along its lines, s: 2/ω of the mode in
/// which neighbours go against each other.
pub fn longest_step(k: f64, sigma: f64, h: f64) -> f64 {
    h * (sigma / k).sqrt()
}
