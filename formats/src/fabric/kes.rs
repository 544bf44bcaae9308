//! Tensile law from KES-F figures.
//!
//! KES gives EMT, the strain at Fm = 500 gf/cm, and LT = 2 WT / (Fm · EMT), the linearity. With
//! `T = K0/β · (exp(β ε) − 1)` and `x = β · EMT`, `LT = 2 (1/x − 1/(exp(x) − 1))` and
//! `K0 = Fm · x / (EMT · (exp(x) − 1))`.

use toile_garment::fabric::StretchLaw;

/// Tension at which KES reads EMT: 500 gf/cm, N/m.
pub const FM: f64 = 490.332_5;

/// The law that passes through (EMT, Fm) with linearity `lt`; both as plain ratios.
///
/// `lt` lies in (0, 1]; 1 is a straight line. Returns `None` outside of that.
#[must_use]
pub fn fit(emt: f64, lt: f64) -> Option<StretchLaw> {
    if !(emt > 0.0 && emt.is_finite() && lt > 0.0 && lt <= 1.0) {
        return None;
    }
    let x = solve(lt)?;
    if x < 1e-6 {
        return Some(StretchLaw::Linear { stiffness: FM / emt });
    }
    Some(StretchLaw::Exponential { k0: FM * x / (emt * libm::expm1(x)), beta: x / emt })
}

/// Linearity of the exponential law at `x = β · EMT`.
fn linearity(x: f64) -> f64 {
    if x < 1e-3 {
        // Series of 2 (1/x − 1/(e^x − 1)): the difference of two large numbers loses its digits here.
        return 1.0 - x / 6.0 + x * x * x / 360.0;
    }
    2.0 * (1.0 / x - 1.0 / libm::expm1(x))
}

/// Bisection: `linearity` falls from 1 to 0 without a turn.
fn solve(lt: f64) -> Option<f64> {
    let (mut low, mut high) = (0.0, 700.0);
    if lt < linearity(high) {
        return None;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if linearity(middle) > lt { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(emt: f64, lt: f64, k0: f64, beta: f64) {
        match fit(emt, lt).expect("in range") {
            StretchLaw::Exponential { k0: k, beta: b } => {
                assert!((k / k0 - 1.0).abs() < 5e-5, "K0 {k} against {k0}");
                assert!((b / beta - 1.0).abs() < 2e-4, "beta {b} against {beta}");
            }
            other => panic!("expected an exponential law, got {other:?}"),
        }
    }

    #[test]
    fn reproduces_the_published_fits() {
        check(0.04, 0.8, 6227.6, 30.75);
        check(0.08, 0.6, 1215.8, 33.40);
    }

    #[test]
    fn passes_through_emt_with_the_asked_work() {
        let (emt, lt) = (0.05, 0.7);
        let law = fit(emt, lt).expect("in range");
        assert!((law.tension(emt) / FM - 1.0).abs() < 1e-9);
        let n = 20_000;
        let step = emt / f64::from(n);
        let work: f64 = (0..n).map(|i| law.tension((f64::from(i) + 0.5) * step) * step).sum();
        assert!((2.0 * work / (FM * emt) - lt).abs() < 1e-6);
    }

    #[test]
    fn a_straight_line_and_values_outside() {
        assert_eq!(fit(0.05, 1.0), Some(StretchLaw::Linear { stiffness: FM / 0.05 }));
        assert_eq!(fit(0.05, 1.01), None);
        assert_eq!(fit(0.05, 1e-4), None);
        assert_eq!(fit(f64::NAN, 0.7), None);
    }
}
