//! How a fabric resists bending.

use crate::Curve;

/// Resistance of a fabric to bending. By default it has none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bending {
    /// Rigidity along the warp, N·m.
    pub warp: f64,
    /// Rigidity along the weft, N·m.
    pub weft: f64,
    /// Rigidity at 45°, N·m; `None`: the orthotropic estimate from warp and weft.
    pub bias: Option<f64>,
    /// Measured moment per width (N) over the curvature (1/m) along [warp, weft]; `None`: the straight line of `warp` or
    /// `weft`. Where there is a curve, that rigidity is its smallest slope.
    pub curve: [Option<Curve>; 2],
    /// Friction HB against bending, as a moment per width, N: half of the hysteresis 2HB; 0 for none.
    pub friction: f64,
    /// Curvature without load along [warp, weft], 1/m: above 0 where the cloth is hollow on the side from which the corners
    /// of its triangles run counter-clockwise.
    pub rest_curvature: [f64; 2],
}

/// Least flexibility in twist over that of the mean of warp and weft.
///
/// A measured bias strip may be stiffer than any plate.
const TWIST_FLEXIBILITY_MIN: f64 = 0.5;

impl Bending {
    /// The same rigidity (N·m) in all directions, straight and without friction.
    #[must_use]
    pub fn isotropic(rigidity: f64) -> Self {
        Self { warp: rigidity, weft: rigidity, ..Self::default() }
    }

    /// Rigidity of the softer direction, N·m.
    #[must_use]
    pub fn softer(&self) -> f64 {
        self.warp.min(self.weft)
    }

    /// Rigidity against twist D₆₆, N·m.
    ///
    /// A strip cut on the bias shows its measured rigidity with it. Without a measurement it is Huber's √(B₁ B₂)/2
    /// (docs/bending.md).
    #[must_use]
    pub fn twist(&self) -> f64 {
        let mean = (self.warp * self.weft).sqrt();
        match self.bias {
            Some(bias) if mean > 0.0 && bias > 0.0 => {
                let soft = 4.0 / bias - 1.0 / self.warp - 1.0 / self.weft;
                1.0 / soft.max(TWIST_FLEXIBILITY_MIN / mean)
            }
            _ => 0.5 * mean,
        }
    }

    /// Rigidity of a strip cut at 45° that is free to twist, N·m: 4/(1/B₁ + 1/B₂ + 1/D₆₆).
    #[must_use]
    pub fn at_45(&self) -> f64 {
        let twist = self.twist();
        if twist > 0.0 { 4.0 / (1.0 / self.warp + 1.0 / self.weft + 1.0 / twist) } else { 0.0 }
    }
}
