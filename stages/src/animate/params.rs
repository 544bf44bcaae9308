//! Parameters of `animate` and their meaning for the solver.

use crate::drape::{AccuracyName, DrapeParams, EffectsParam, IntegratorName, ModelName, SwitchName};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toile_cloth::{Dynamics, Motion, Settings};
use toile_garment::Vec3;
use toile_garment::units::{Acceleration, Duration, Length, LineForce, Speed};

/// Frames of a run that ends by itself, at most.
const MOST_SECONDS: f64 = 10.0;
/// Pressure of the air over the square of the speed across the cloth, kg/m³: ½ ρ C_d of a plate, ρ 1.2 kg/m³, C_d 1.
const AIR: f64 = 0.6;

/// Time stepping in motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SteppingName {
    /// Implicit steps of second order (TR-BDF2), stable at any length.
    #[default]
    Implicit,
    /// The paper's explicit central differences, for comparison, with steps as long as the cloth bears, at most `step`.
    /// The body stands still, `accuracy` and bending hysteresis play no part.
    CentralDifference,
    /// Steps like `central-difference`, but `calming` acts against the velocity of half a step before, as it is often
    /// programmed: steps must be the shorter the stronger it is, 2/ω (√(1 + ζ²) − ζ).
    Leapfrog,
}

/// Parameters of `animate`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AnimateParams {
    /// The moving body: the first file of a series of OBJ files, or a GLB. The number of an OBJ file (`walk-000.obj`)
    /// is counted up to the first file that is missing. Each file has the vertices and faces of the body the garment
    /// was draped on. The first animation of a GLB moves the same mesh by a skin, by morph targets or by its nodes.
    /// Without it the body stands still.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub body: Option<PathBuf>,
    /// Frames in a second, of the body and of the result.
    pub fps: f64,
    /// Frames of the result; as many as the body has when not given (1 s without body frames). The body stands still
    /// after its last frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<u32>,
    /// End as soon as the body has stopped and the cloth has come to rest, after `frames` (10 s more than the body has
    /// when not given) at the latest.
    pub until_settled: bool,
    /// Downward acceleration.
    pub gravity: Acceleration,
    /// In-plane model.
    pub model: ModelName,
    /// Time stepping.
    pub integrator: SteppingName,
    /// How far each implicit step is solved.
    pub accuracy: AccuracyName,
    /// Effects, each `auto`, `on` or `off`.
    pub effects: EffectsParam,
    /// Resistance of the air; `auto` is on.
    pub air: SwitchName,
    /// Time in which motion dies away to 1/e by itself, air aside; `0 s` for never.
    pub calming: Duration,
    /// Longest time step; a whole number of equal ones makes a frame, more of them where the body is fast.
    pub step: Duration,
    /// Central differences: take `step` as it is, even where the cloth does not bear it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub fixed_step: bool,
    /// Distance at which cloth is held off the body.
    pub body_gap: Length,
    /// Central differences: stiffness of every contact, a penalty, N/m between vertex and body; without it contacts are
    /// as stiff as the step bears.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_stiffness: Option<LineForce>,
    /// Distance at which cloth is held off cloth; at least the fabric's thickness is used.
    pub self_gap: Length,
    /// Time in which the body is led from the pose of the drape to its first frame, where they differ.
    pub lead_in: Duration,
    /// Speed below which the cloth has come to rest.
    pub rest_speed: Speed,
    /// Also writes every frame as OBJ; this is the name of the first: `{out}/frame-000.obj`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "output-file"))]
    pub sequence: Option<String>,
}

impl Default for AnimateParams {
    fn default() -> Self {
        let drape = DrapeParams::default();
        Self {
            body: None,
            fps: 30.0,
            frames: None,
            until_settled: false,
            gravity: drape.gravity,
            model: drape.model,
            integrator: SteppingName::default(),
            accuracy: drape.accuracy,
            effects: drape.effects,
            air: SwitchName::Auto,
            calming: Duration(2.0),
            step: Duration(1.0 / 120.0),
            fixed_step: false,
            body_gap: drape.body_gap,
            contact_stiffness: None,
            self_gap: drape.self_gap,
            lead_in: Duration(1.0),
            rest_speed: Speed(5e-3),
            sequence: None,
        }
    }
}

impl AnimateParams {
    /// The solver's settings.
    #[must_use]
    pub fn settings(&self, threads: usize) -> Settings {
        let drape = DrapeParams {
            gravity: self.gravity,
            model: self.model,
            integrator: match self.integrator {
                SteppingName::Implicit => IntegratorName::Static,
                SteppingName::CentralDifference | SteppingName::Leapfrog => IntegratorName::CentralDifference,
            },
            effects: self.effects.clone(),
            body_gap: self.body_gap,
            self_gap: self.self_gap,
            ..DrapeParams::default()
        };
        let mut settings = drape.settings(threads);
        settings.explicit.contact_stiffness = self.contact_stiffness.map_or(0.0, |k| k.0);
        settings
    }

    /// How time is stepped.
    #[must_use]
    pub fn dynamics(&self) -> Dynamics {
        Dynamics {
            step: self.step.0,
            damping: if self.calming.0 > 0.0 { 1.0 / self.calming.0 } else { 0.0 },
            lagged: self.integrator == SteppingName::Leapfrog,
            fixed: self.fixed_step,
            drag: if self.air == SwitchName::Off { 0.0 } else { AIR },
            rest_speed: self.rest_speed.0,
            tolerance: Dynamics::default().tolerance
                * match self.accuracy {
                    AccuracyName::Draft => 4.0,
                    AccuracyName::Normal => 1.0,
                    AccuracyName::Fine => 0.2,
                    AccuracyName::Reference => 0.05,
                },
        }
    }

    /// The moving parts; the cloth `rests` at the start, or falls from there.
    #[must_use]
    pub fn motion(&self, body: Vec<Vec<Vec3>>, rests: bool) -> Motion {
        let seconds = |s: f64| (s * self.fps).ceil() as usize;
        let own = match (body.len(), self.until_settled) {
            (n, true) => n + seconds(MOST_SECONDS),
            (0, false) => seconds(1.0) + 1,
            (n, false) => n,
        };
        Motion {
            fps: self.fps,
            frames: self.frames.map_or(own, |n| n as usize),
            until_settled: self.until_settled,
            body,
            lead_in: self.lead_in.0,
            velocities: Vec::new(),
            rests,
        }
    }
}
