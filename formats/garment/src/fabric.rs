//! Fabric: measured numbers with unit, method and source.
//!
//! Directions after ISO: warp along the grain line, weft across, bias at 45 degrees.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Tension against strain in one direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StretchLaw {
    /// `T = stiffness · ε`.
    Linear {
        /// N/m.
        stiffness: f64,
    },
    /// `T = k0/beta · (exp(beta ε) − 1)`, fitted to KES EMT and LT (`toile_formats::fabric::kes`).
    Exponential {
        /// Slope at rest, N/m.
        k0: f64,
        /// Dimensionless growth.
        beta: f64,
    },
    /// Measured samples (strain, tension N/m), ascending, first at (0, 0); linear between, last slope beyond.
    Samples {
        /// Pairs.
        points: Vec<[f64; 2]>,
    },
}

/// Where a fabric number comes from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct ValueSource {
    /// Number and unit as written in the file.
    pub written: String,
    /// KES-F, FAST, U3M, cantilever, textbook, …
    pub method: String,
    /// Who measured, or which table.
    pub source: String,
}

/// A fabric in SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Fabric {
    /// Name.
    pub name: String,
    /// Areal mass, kg/m².
    pub areal_mass: f64,
    /// Thickness, m.
    pub thickness: f64,
    /// Friction coefficient, cloth on body and on itself.
    pub friction: f64,
    /// Tension along the warp at unchanged width along the weft.
    pub stretch_warp: StretchLaw,
    /// Tension along the weft at unchanged width along the warp.
    pub stretch_weft: StretchLaw,
    /// Poisson coupling C12: tension in one direction per strain in the other, as a fraction of the softer slope at
    /// rest. So Poisson's ratio of a strip along the stiffer direction is this number, along the softer one this number
    /// times softer over stiffer slope.
    #[serde(default)]
    pub poisson: f64,
    /// Shear stiffness G, N/m per radian: the smallest slope of the measured curve, where there is one.
    pub shear: f64,
    /// Measured (angle rad, force per width N/m) pairs of shear, ascending from (0, 0), where the file gives them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear_curve: Option<Vec<[f64; 2]>>,
    /// Bending rigidity along the warp, N·m.
    pub bend_warp: f64,
    /// Bending rigidity along the weft, N·m.
    pub bend_weft: f64,
    /// Bending rigidity on the bias, N·m, where measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bend_bias: Option<f64>,
    /// Measured (curvature 1/m, moment per width N) pairs along the warp, ascending from (0, 0), where the file gives them.
    /// `bend_warp` is their smallest slope.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bend_curve_warp: Option<Vec<[f64; 2]>>,
    /// The same along the weft.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bend_curve_weft: Option<Vec<[f64; 2]>>,
    /// Bending hysteresis 2HB, N (KES), where measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bend_hysteresis: Option<f64>,
    /// Do the rigidities hold the friction of the yarns already? Those from bending lengths of a cantilever (FAST) do.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub bend_holds_friction: bool,
    /// Curvature of unloaded cloth along the warp, 1/m, where measured: above 0 where the right side is hollow.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest_curvature_warp: Option<f64>,
    /// The same along the weft.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest_curvature_weft: Option<f64>,
    /// Largest strain the cloth is used at, along the warp.
    pub strain_limit_warp: f64,
    /// Largest strain the cloth is used at, along the weft.
    pub strain_limit_weft: f64,
    /// Largest strain the cloth is used at, on the bias, where it has a limit there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub strain_limit_bias: Option<f64>,
    /// Constants of the springs of `model = "springs"`, where they are given and not derived from the laws.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub springs: Option<SpringConstants>,
    /// The look of the cloth, where the file tells it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub look: Option<FabricLook>,
    /// Where each number comes from, by field name.
    #[serde(default)]
    pub sources: BTreeMap<String, ValueSource>,
}

/// How yarns cross, or loops hang in each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Weave {
    /// One over, one under.
    Plain,
    /// Two over, two under, both ways: panama, canvas.
    Basket,
    /// 2/2 twill: the diagonal of suiting.
    Twill,
    /// 3/1 twill: the diagonal of denim.
    WarpTwill,
    /// Five-end satin.
    Satin,
    /// Crepe: crossings without a visible line.
    Crepe,
    /// Plain knit.
    Jersey,
    /// Cut pile: velvet, fleece, melton.
    Pile,
    /// Cut pile in ribs along the warp: corduroy.
    Cord,
}

/// The look of a cloth: what a bitmap and a normal map of it are drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FabricLook {
    /// Weave or knit.
    pub weave: Weave,
    /// Ends (warp yarns) or wales per metre.
    pub ends: f64,
    /// Picks (weft yarns) or courses per metre.
    pub picks: f64,
    /// Colour, linear RGB 0–1.
    pub color: [f64; 3],
    /// Sheen, 0 (none) to 1.
    pub sheen: f64,
    /// glTF roughness, 0 (mirror) to 1 (chalk).
    pub roughness: f64,
}

/// Spring constants of the edges of a mesh, N/m (force over change of length): bare springs in the sense of Liu, Chen,
/// Shi 2003, whatever the lengths of the edges.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SpringConstants {
    /// Edges within 22.5° of warp or weft.
    pub yarn: f64,
    /// All others.
    pub bias: f64,
}

impl Fabric {
    /// The same cloth with its wrong side for its right one: it curls the other way.
    #[must_use]
    pub fn turned(&self) -> Self {
        let negative = |curvature: Option<f64>| curvature.map(|k| -k);
        Self {
            rest_curvature_warp: negative(self.rest_curvature_warp),
            rest_curvature_weft: negative(self.rest_curvature_weft),
            ..self.clone()
        }
    }

    /// Shear force per width over the angle (rad), N/m: by the measured curve, or by the shear stiffness.
    #[must_use]
    pub fn shear_secant(&self, angle: f64) -> f64 {
        match &self.shear_curve {
            Some(points) if angle > 0.0 => {
                let (a, b) = segment(points, angle);
                (a[1] + (b[1] - a[1]) / (b[0] - a[0]) * (angle - a[0])) / angle
            }
            _ => self.shear,
        }
    }

    /// Frictional moment HB per width that acts beside the elastic one, N: half of 2HB.
    #[must_use]
    pub fn bend_friction(&self) -> f64 {
        if self.bend_holds_friction { 0.0 } else { 0.5 * self.bend_hysteresis.unwrap_or(0.0) }
    }
}

impl StretchLaw {
    /// Tension, N/m, at a strain. Compression uses the slope at rest.
    #[must_use]
    pub fn tension(&self, strain: f64) -> f64 {
        match self {
            Self::Linear { stiffness } => stiffness * strain,
            Self::Exponential { k0, beta } => {
                if strain <= 0.0 {
                    k0 * strain
                } else {
                    k0 / beta * libm::expm1(beta * strain)
                }
            }
            Self::Samples { points } => {
                let (a, b) = segment(points, strain);
                a[1] + (b[1] - a[1]) / (b[0] - a[0]) * (strain - a[0])
            }
        }
    }

    /// Tangent stiffness dT/dε, N/m: the slope of the measured curve, as the paper reads it.
    #[must_use]
    pub fn tangent(&self, strain: f64) -> f64 {
        match self {
            Self::Linear { stiffness } => *stiffness,
            Self::Exponential { k0, beta } => k0 * libm::exp(beta * strain.max(0.0)),
            Self::Samples { points } => {
                let (a, b) = segment(points, strain);
                (b[1] - a[1]) / (b[0] - a[0])
            }
        }
    }
}

fn segment(points: &[[f64; 2]], strain: f64) -> ([f64; 2], [f64; 2]) {
    let last = points.len().saturating_sub(2);
    let i = points.iter().skip(1).position(|p| strain <= p[0]).unwrap_or(last).min(last);
    match (points.get(i), points.get(i + 1)) {
        (Some(a), Some(b)) => (*a, *b),
        _ => ([0.0, 0.0], [1.0, 0.0]),
    }
}
