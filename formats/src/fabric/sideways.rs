//! From curves measured with free sides to curves with the other direction held.
//!
//! A laboratory pulls a strip whose sides are free: it narrows, and the measured tension T(ε) is that of the narrowed
//! strip. The document holds T₁ = f₁(ε₁) + c ε₂ and T₂ = f₂(ε₂) + c ε₁. Setting T₂ = 0 with f₂ straight in compression
//! gives f₁ = T + (c²/f₂′(0)) ε, and with ν the narrowing per strain along the warp c = ν f₂′(0). For straight lines
//! this is the textbook's f₁′ = K₁/(1 − ν₁₂ ν₂₁), c = ν₁₂ K₂/(1 − ν₁₂ ν₂₁), ν₂₁ = ν₁₂ K₂/K₁.

use toile_garment::fabric::StretchLaw;

/// Samples of an exponential law that gets a straight part.
const SAMPLES: u32 = 512;

/// Laws with the other direction held, and the coupling as a fraction of the softer stiffness at rest.
pub struct Held {
    pub warp: StretchLaw,
    pub weft: StretchLaw,
    pub coupling: f64,
}

/// Converts measured laws; `reach` is how far each is used (strain). `poisson` is the narrowing across the warp per
/// strain along it.
///
/// # Errors
/// The Poisson ratio along the weft that follows, when it is too large for any elastic cloth.
pub fn held(warp: StretchLaw, weft: StretchLaw, poisson: f64, reach: [f64; 2]) -> Result<Held, f64> {
    if poisson == 0.0 {
        return Ok(Held { warp, weft, coupling: 0.0 });
    }
    let [k1, k2] = [warp.tangent(0.0), weft.tangent(0.0)];
    let other = poisson * k2 / k1;
    let left = 1.0 - poisson * other;
    // Below 1 the coupling stays under both stiffnesses, which keeps the energy of every strain above zero.
    if other.is_nan() || other >= 1.0 {
        return Err(other);
    }
    let gain = |k: f64| k / left - k;
    Ok(Held {
        warp: stiffened(warp, gain(k1), reach[0]),
        weft: stiffened(weft, gain(k2), reach[1]),
        coupling: if k2 <= k1 { poisson } else { other },
    })
}

/// The law with a straight line added.
fn stiffened(law: StretchLaw, by: f64, reach: f64) -> StretchLaw {
    match law {
        StretchLaw::Linear { stiffness } => StretchLaw::Linear { stiffness: stiffness + by },
        StretchLaw::Samples { points } => {
            StretchLaw::Samples { points: points.into_iter().map(|[e, t]| [e, t + by * e]).collect() }
        }
        StretchLaw::Exponential { .. } => {
            let step = 1.5 * reach / f64::from(SAMPLES);
            let at = |i| {
                let strain = step * f64::from(i);
                [strain, law.tension(strain) + by * strain]
            };
            StretchLaw::Samples { points: (0..=SAMPLES).map(at).collect() }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tension along the warp of a strip with free sides, by Newton's rule on the strain across.
    fn uniaxial(h: &Held, strain: f64) -> (f64, f64) {
        let c = h.coupling * h.warp.tangent(0.0).min(h.weft.tangent(0.0));
        let mut across = 0.0;
        for _ in 0..50 {
            across -= (h.weft.tension(across) + c * strain) / h.weft.tangent(across);
        }
        (h.warp.tension(strain) + c * across, across)
    }

    #[test]
    fn a_free_strip_shows_the_measured_line_and_narrows_by_the_ratio() {
        for (k1, k2) in [(500.0, 300.0), (300.0, 500.0), (400.0, 400.0)] {
            let line = |stiffness| StretchLaw::Linear { stiffness };
            let h = held(line(k1), line(k2), 0.3, [0.1; 2]).expect("possible");
            let (tension, across) = uniaxial(&h, 0.02);
            assert!((tension / (k1 * 0.02) - 1.0).abs() < 1e-12, "{tension}");
            assert!((across / (-0.3 * 0.02) - 1.0).abs() < 1e-12, "{across}");
        }
    }

    #[test]
    fn curves_keep_their_tension() {
        let exponential = StretchLaw::Exponential { k0: 1200.0, beta: 33.0 };
        let samples = StretchLaw::Samples { points: vec![[0.0, 0.0], [0.02, 10.0], [0.06, 60.0]] };
        for law in [exponential, samples] {
            let h = held(law.clone(), StretchLaw::Linear { stiffness: 400.0 }, 0.25, [0.08; 2]).expect("possible");
            for strain in [0.005, 0.02, 0.05, 0.08] {
                let (tension, across) = uniaxial(&h, strain);
                assert!((tension / law.tension(strain) - 1.0).abs() < 1e-3, "{law:?} at {strain}: {tension}");
                assert!((across / (-0.25 * strain) - 1.0).abs() < 1e-9, "{across}");
            }
        }
    }

    #[test]
    fn an_impossible_ratio_is_named() {
        let line = |stiffness| StretchLaw::Linear { stiffness };
        let ratio = held(line(100.0), line(400.0), 0.3, [0.1; 2]).err().expect("refused");
        assert!((ratio - 1.2).abs() < 1e-12);
    }
}
