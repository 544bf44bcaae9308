//! Straight ways from rest.

use super::G;

/// Speed (m/s) and way (m) after `t` of a fall against a drag of c (kg/(m² s)) on σ (kg/m²): v′ = g − c/σ v.
pub fn dragged(sigma: f64, c: f64, t: f64) -> [f64; 2] {
    let (rate, end) = (c / sigma, sigma * G / c);
    let lost = -libm::expm1(-rate * t);
    [end * lost, end * (t - lost / rate)]
}

/// Way down a slope (rad) after `t`, m; none where it sticks (Coulomb).
pub fn slid(slope: f64, mu: f64, t: f64) -> f64 {
    let pull = libm::sin(slope) - mu * libm::cos(slope);
    0.5 * G * pull.max(0.0) * t * t
}
