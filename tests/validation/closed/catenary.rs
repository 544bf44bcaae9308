//! Cables between level ends.

use super::root;

/// A hanging cable: sag, horizontal force and end tension per width (N/m), stretched length.
pub struct Cable {
    pub sag: f64,
    pub horizontal: f64,
    pub tension: f64,
    pub stretched: f64,
}

/// Without stretch: `sinh u / u = L/a`, `c = a/2u`, sag `c (cosh u − 1)`, `H = w c`.
pub fn rigid(span: f64, length: f64, w: f64) -> Cable {
    let u = root(1e-6, 50.0, |u| libm::sinh(u) / u - length / span);
    let c = span / (2.0 * u);
    Cable { sag: c * (libm::cosh(u) - 1.0), horizontal: w * c, tension: w * c * libm::cosh(u), stretched: length }
}

/// With `T = K ε` and the weight per rest length (Irvine 1981), both ends level.
pub fn elastic(span: f64, length: f64, w: f64, k: f64) -> Cable {
    let v = 0.5 * w * length;
    let x = |h: f64, s: f64| h * s / k + h / w * (libm::asinh(v / h) - libm::asinh((v - w * s) / h));
    let h = root(1e-9 * w * length, 10.0 * k, |h| x(h, length) - span);
    let s = 0.5 * length;
    let z = s / k * (v - 0.5 * w * s) + h / w * ((1.0 + (v / h) * (v / h)).sqrt() - 1.0);
    let n = 20_000;
    let step = length / f64::from(n);
    let tension = |s: f64| libm::hypot(h, v - w * s);
    let stretched = (0..n).map(|i| step * (1.0 + tension((f64::from(i) + 0.5) * step) / k)).sum();
    Cable { sag: z, horizontal: h, tension: tension(0.0), stretched }
}
