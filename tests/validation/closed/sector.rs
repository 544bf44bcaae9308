//! A narrow sector that hangs over the edge of a disc, free of its neighbours.

use super::{rk4, root};
use std::f64::consts::FRAC_PI_2;

/// Drape coefficient for a bending length `c`. With r from the disc's to the specimen's edge, `B (r θ')' = −w cos θ (R²
/// − r²)/2`, θ = 0 at the disc and θ' = 0 at the rim. It is integrated from the rim. Sectors that hang overlap their
/// neighbours in the shadow, which so is a full disc out to their tips.
pub fn drape_coefficient(c: f64, disc: f64, rim: f64) -> f64 {
    let n = 4000;
    let h = (rim - disc) / n as f64;
    let stiff = c * c * c;
    let shoot = |log: f64| {
        let f = |u: f64, y: [f64; 3]| {
            let r = rim - u;
            let carried = 0.5 * (rim * rim - r * r);
            [y[1] / r, carried * libm::sin(y[0]) / stiff, libm::sin(y[0])]
        };
        let mut y = [libm::exp(log), 0.0, 0.0];
        for i in 0..n {
            y = rk4(y, i as f64 * h, h, &f);
            if y[0] > 4.0 {
                break;
            }
        }
        y
    };
    let log = root(-100.0, libm::log(FRAC_PI_2), |log| shoot(log)[0] - FRAC_PI_2);
    let tip = disc + shoot(log)[2];
    (tip * tip - disc * disc) / (rim * rim - disc * disc)
}
