//! A mass that falls onto a spring: `m x″ = m g − k x` while it touches.

use super::G;

/// Depth to which the spring gives way under a mass (kg) that meets it with a speed (m/s), m.
pub fn deepest(m: f64, k: f64, v: f64) -> f64 {
    let rest = at_rest(m, k);
    rest + (rest * rest + m * v * v / k).sqrt()
}

/// Depth under the weight alone, m.
pub fn at_rest(m: f64, k: f64) -> f64 {
    m * G / k
}

/// Time from touching to leaving, s.
pub fn contact_time(m: f64, k: f64, v: f64) -> f64 {
    let omega = (k / m).sqrt();
    (std::f64::consts::PI + 2.0 * libm::atan(G / (omega * v))) / omega
}
