//! Directions in which specimens are cut, and what a fabric's bending is along them.

use super::GRAVITY;
use crate::solve::material;
use toile_garment::fabric::Fabric;

/// Along which yarns a specimen is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Along the grain line.
    Warp,
    /// Across it.
    Weft,
    /// At 45° to both.
    Bias,
}

impl Direction {
    /// All, in the order of a test sheet.
    pub const ALL: [Self; 3] = [Self::Warp, Self::Weft, Self::Bias];

    /// The word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Warp => "warp",
            Self::Weft => "weft",
            Self::Bias => "bias",
        }
    }

    /// Cosine and sine of the angle between the specimen's length and the warp.
    #[must_use]
    pub fn cut(self) -> [f64; 2] {
        use std::f64::consts::FRAC_1_SQRT_2;
        match self {
            Self::Warp => [1.0, 0.0],
            Self::Weft => [0.0, 1.0],
            Self::Bias => [FRAC_1_SQRT_2, FRAC_1_SQRT_2],
        }
    }

    /// Bending rigidity that the fabric's numbers say for this direction, N·m; on the bias that of the solver's cloth,
    /// which is the measured one or its estimate from warp and weft (`stages/cloth/docs/bending.md`).
    #[must_use]
    pub fn bending(self, fabric: &Fabric) -> f64 {
        match self {
            Self::Warp => fabric.bend_warp,
            Self::Weft => fabric.bend_weft,
            Self::Bias => material(fabric).bending.at_45(),
        }
    }

    /// Was the bending of this direction measured as a curve, of which that number is the smallest slope?
    #[must_use]
    pub fn is_curved(self, fabric: &Fabric) -> bool {
        let [warp, weft] = [&fabric.bend_curve_warp, &fabric.bend_curve_weft].map(Option::is_some);
        match self {
            Self::Warp => warp,
            Self::Weft => weft,
            Self::Bias => warp || weft,
        }
    }

    /// Does the fabric file give that number, or is it estimated?
    #[must_use]
    pub fn is_given(self, fabric: &Fabric) -> bool {
        self != Self::Bias || fabric.bend_bias.is_some()
    }
}

/// Peirce's bending length of a rigidity on Earth, m.
#[must_use]
pub fn bending_length(bending: f64, areal_mass: f64) -> f64 {
    toile_cloth::scene::bending_length(bending, areal_mass, GRAVITY)
}
