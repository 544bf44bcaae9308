//! Parameters of the flattening.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toile_garment::units::{Angle, Length, Share};

/// Which lengths the flattened pieces shall have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MetricChoice {
    /// `carried` where the strain of the cloth is known (an own drape, or a shape before an edit), else `surface`.
    #[default]
    Auto,
    /// Stored lengths, changed by what the 3D edit changed; the strain of the drape stays in the cloth.
    Carried,
    /// Lengths of the 3D surface as it is, the strain of the drape included. Darts keep what the shape asks for.
    Surface,
}

/// How pieces that mirror each other come back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SymmetryChoice {
    /// They are made one where the edit was symmetric. Where it was not, they stay as they are, with a warning.
    #[default]
    Auto,
    /// They are made one, whatever the edit: its two sides are averaged.
    Always,
    /// They stay as they are.
    Off,
}

/// Things that the flattening does not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LockKind {
    /// Sewn edges keep the ratio of their lengths.
    Seams,
    /// The grain line keeps its direction.
    Grain,
    /// Straight edges of the outline stay straight, unless the shape clearly asks for a curve.
    Straight,
    /// Right angles of the outline stay right, unless the shape clearly asks for others.
    RightAngles,
    /// Pleats keep their depth.
    Pleats,
    /// Darts keep their stored intake, whatever the edit.
    Darts,
}

/// Changes of a piece that pass without a warning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FlattenTolerance {
    /// Change of the area.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area: Option<Share>,
    /// Change of the length of an edge.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edge: Option<Length>,
    /// Change of the ease between two sewn sides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ease: Option<Length>,
    /// Change of the angle of a dart.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dart_angle: Option<Angle>,
    /// Change of the intake of a dart.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dart_intake: Option<Length>,
    /// Difference between the legs of a dart.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dart_legs: Option<Length>,
    /// Turn of the grain.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grain: Option<Angle>,
    /// Change of a sewn edge beside its seam partner, at the station where they differ most (1 mm).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seam: Option<Length>,
    /// Change of the way of a notch from the start of its edge.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub notch: Option<Length>,
    /// Change of a notch beside the same place of the seam partner (1 mm).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub notch_partner: Option<Length>,
    /// Turn of a corner.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner: Option<Angle>,
    /// Bow of an edge that was straight.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bow: Option<Length>,
    /// Distance from the mirror image.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub symmetry: Option<Length>,
}

/// Parameters of `flatten`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FlattenParams {
    /// Which lengths the flattened pieces shall have.
    pub metric: MetricChoice,
    /// Length of cloth over which lengths are averaged, never across a dart or seam. It does not depend on the mesh.
    /// Use 20 mm for a scanned surface or a drape that had not settled; none is needed for a settled one.
    pub smooth: Length,
    /// How pieces that mirror each other come back.
    pub symmetry: SymmetryChoice,
    /// Things that the flattening does not change.
    pub lock: Vec<LockKind>,
    /// Straight edges and right angles that the shape clearly asks to change are let go. With `false` they are held
    /// whatever it asks.
    pub let_go: bool,
    /// Changes that pass without a warning. Without it no change is judged.
    pub tolerance: FlattenTolerance,
    /// Stop when no vertex moves farther in a round, or when the energy no longer resolves a step.
    pub stop_motion: Length,
    /// Rounds after which it has failed.
    #[schemars(range(min = 1, max = 10000))]
    pub max_rounds: u32,
    /// How much stiffer the equal length of sewn edges and the locks are than the cloth.
    pub pair_stiffness: f64,
    /// A piece whose curvature forces more strain than this is reported with the dart that would cure it.
    pub strain_limit: Share,
}

impl FlattenParams {
    /// Is this locked?
    #[must_use]
    pub fn locks(&self, kind: LockKind) -> bool {
        self.lock.contains(&kind)
    }
}

impl Default for FlattenParams {
    fn default() -> Self {
        Self {
            metric: MetricChoice::Auto,
            smooth: Length(0.0),
            symmetry: SymmetryChoice::Auto,
            lock: vec![LockKind::Seams, LockKind::Grain, LockKind::Straight, LockKind::RightAngles, LockKind::Pleats],
            let_go: true,
            tolerance: FlattenTolerance::default(),
            stop_motion: Length(1e-9),
            max_rounds: 300,
            pair_stiffness: 1e4,
            strain_limit: Share(0.01),
        }
    }
}
