//! Parameters of the flattening.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toile_garment::units::{Length, Share};

/// Which lengths the flattened pieces shall have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MetricChoice {
    /// `carried` where the strain of the cloth is known (an own drape, or a shape before an edit), else `surface`.
    #[default]
    Auto,
    /// Stored lengths, changed by what the 3D edit changed; the strain of the drape stays in the cloth.
    Carried,
    /// Lengths of the 3D surface as it is, the strain of the drape included.
    Surface,
}

/// Parameters of `flatten`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FlattenParams {
    /// Which lengths the flattened pieces shall have.
    pub metric: MetricChoice,
    /// Passes of averaging the stretch between neighbouring triangles, never across a dart or seam. Use 20 for a
    /// drape that had not settled or a scanned surface; none is needed for a settled one.
    #[schemars(range(max = 200))]
    pub smoothing: u32,
    /// Stop when no vertex moves farther in a round.
    pub stop_motion: Length,
    /// Rounds after which it has failed.
    #[schemars(range(min = 1, max = 10000))]
    pub max_rounds: u32,
    /// How much stiffer the equal length of sewn edges is than the cloth.
    pub pair_stiffness: f64,
    /// A piece whose curvature forces more strain than this is reported with the dart that would cure it.
    pub strain_limit: Share,
}

impl Default for FlattenParams {
    fn default() -> Self {
        Self {
            metric: MetricChoice::Auto,
            smoothing: 0,
            stop_motion: Length(1e-9),
            max_rounds: 300,
            pair_stiffness: 1e4,
            strain_limit: Share(0.01),
        }
    }
}
