//! Poisson's ratio: from strip tests with free sides, as files give them, to laws with the width held, as the fabric
//! has them.

use super::reader::Entries;
use crate::codes::VALUE_OUT_OF_RANGE;
use toile_garment::Diagnostic;
use toile_garment::fabric::StretchLaw;

/// Laws with the width held, and the coupling between them.
pub struct Coupled {
    pub warp: StretchLaw,
    pub weft: StretchLaw,
    /// Coupling modulus as a share of the softer law's slope at rest.
    pub share: f64,
}

/// Couples two laws so that a strip along the warp contracts by `ratio` (ν12) times its extension at small strain, and
/// strips along both directions pull as the given laws say.
///
/// With held widths the moduli are `C_i = E_i / (1 − ν12 ν21)`, `C12 = ν12 C_weft`, and `ν21 = ν12 E_weft / E_warp`.
/// Narrowing costs each strip `C12² / C_j` of its slope at any strain, as compression is linear: adding that slope to
/// the whole law is exact.
pub fn couple(e: &mut Entries, warp: StretchLaw, weft: StretchLaw, ratio: f64) -> Coupled {
    let anisotropy = weft.tangent(0.0) / warp.tangent(0.0);
    let share = ratio * anisotropy.max(1.0);
    if share >= 1.0 {
        refuse(e, ratio, anisotropy);
        return Coupled { warp, weft, share: 0.0 };
    }
    let held = |law: &StretchLaw| matches!(law, StretchLaw::Exponential { .. });
    if ratio == 0.0 || held(&warp) || held(&weft) {
        return Coupled { warp, weft, share };
    }
    let product = ratio * ratio * anisotropy;
    let stiffer = |law: StretchLaw| {
        let more = law.tangent(0.0) * product / (1.0 - product);
        match law {
            StretchLaw::Linear { stiffness } => StretchLaw::Linear { stiffness: stiffness + more },
            StretchLaw::Samples { points } => {
                StretchLaw::Samples { points: points.iter().map(|[s, t]| [*s, t + more * s]).collect() }
            }
            other => other,
        }
    };
    Coupled { warp: stiffer(warp), weft: stiffer(weft), share }
}

fn refuse(e: &mut Entries, ratio: f64, anisotropy: f64) {
    let at = e.values.iter().find(|((_, key), _)| *key == "poisson").map_or(&e.whole, |(_, v)| &v.at).clone();
    let message = format!(
        "`poisson = {ratio}` is out of range; allowed is below {:.3}, as the weft is {anisotropy:.1} times as stiff as the \
         warp",
        1.0 / anisotropy
    );
    let hint = "poisson is the contraction along the weft in a strip test along the warp";
    e.findings.push(Diagnostic::error(VALUE_OUT_OF_RANGE, message).at(at).hint(hint));
}
