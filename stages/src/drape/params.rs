//! Parameters of `drape` and their meaning for the solver.

use super::GatedFigure;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toile_cloth::{
    ContactPenalty, Effects, ElongationCorrection, Equilibrium, ExplicitSteps, Integrator, Model, Settings, Switch,
};
use toile_garment::units::{Acceleration, Duration, Length, Pressure};

/// In-plane model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ModelName {
    /// The paper's three classes of springs on mesh edges.
    Springs,
    /// Triangle springs whose coefficients depend on all three elongations: exact for any orthotropic fabric.
    #[default]
    Coupled,
}

/// Time stepping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum IntegratorName {
    /// No time: the least energy is sought by a descent.
    #[default]
    Static,
    /// Implicit steps in time until nothing moves, after Baraff and Witkin 1998. Seams are closed as by `static`.
    Implicit,
    /// The paper's explicit central differences with an adaptive step.
    CentralDifference,
}

/// Correction of over-elongation after every step of `central-difference` (paper §2.2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CorrectionName {
    /// Yarns of the triangles along warp, weft and bias, in a few passes, after Kang et al. 2000.
    #[default]
    Kang,
    /// Springs on the mesh edges, in one pass, after Provot 1995.
    Provot,
}

/// The force of a contact by its distance, in `central-difference`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PenaltyName {
    /// A spring below the gap, as stiff as the time step bears.
    #[default]
    Linear,
    /// c exp(1/d) with the distance d in gaps, as written in equation 6 of the paper.
    Exponential,
}

/// How near to rest the drape is led.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum AccuracyName {
    /// For a first look.
    Draft,
    /// The default.
    #[default]
    Normal,
    /// Five times nearer to rest than normal.
    Fine,
    /// Twenty times nearer to rest than normal: to measure others by.
    Reference,
}

/// Whether an effect is used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SwitchName {
    /// By the effect's own rule.
    #[default]
    Auto,
    /// Always.
    On,
    /// Never.
    Off,
}

/// Which effects are simulated.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default, rename_all = "kebab-case")]
pub struct EffectsParam {
    /// Cloth against cloth.
    pub self_contact: SwitchName,
    /// Cloth against the body.
    pub body_contact: SwitchName,
    /// Friction at contacts.
    pub friction: SwitchName,
    /// Correction of over-elongation.
    pub strain_limit: SwitchName,
    /// Friction of the yarns in bending (2HB of the fabric).
    pub bending_hysteresis: SwitchName,
}

/// Parameters of `drape`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DrapeParams {
    /// Downward acceleration.
    pub gravity: Acceleration,
    /// Pressure behind the cloth: pushes every triangle to the side from which its corners run counter-clockwise
    /// (outwards, for pieces placed with their right side out). Not with `central-difference`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure: Option<Pressure>,
    /// In-plane model.
    pub model: ModelName,
    /// Time stepping.
    pub integrator: IntegratorName,
    /// Correction of over-elongation after every step of `central-difference`; `kang` when not given.
    #[serde(skip_serializing_if = "is_default")]
    pub correction: CorrectionName,
    /// Force of a contact by its distance, in `central-difference`; `linear` when not given.
    #[serde(skip_serializing_if = "is_default")]
    pub penalty: PenaltyName,
    /// How near to rest.
    pub accuracy: AccuracyName,
    /// Effects, each `auto`, `on` or `off`.
    pub effects: EffectsParam,
    /// Distance at which cloth is held off the body.
    pub body_gap: Length,
    /// Distance at which cloth is held off cloth; at least the fabric's thickness is used.
    pub self_gap: Length,
    /// Longest time in the simulated world.
    pub max_time: Duration,
    /// Lets the cloth come to rest 16 and 4 times as stiff in bending before it does so as it is. Folds then form from the
    /// large to the small, so that coarse and fine meshes find the same ones.
    #[serde(skip_serializing_if = "is_default")]
    pub stiffer_first: bool,
    /// How often the rest is sought again from starts moved by up to 1 µm, 0 to 20: the certificate tells how far the
    /// rests lie apart. Each costs as much as the drape.
    #[serde(skip_serializing_if = "is_default")]
    #[schemars(range(max = 20))]
    pub repeats: u32,
    /// A garment with a seam that stands open by more after sewing is not draped: it is shown as it was sewn (50 mm).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub open_seams: Option<Length>,
    /// Gates of the certificate by figure; they replace the defaults.
    pub limits: BTreeMap<GatedFigure, f64>,
}

/// Chains that ask for nothing keep their text.
fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl Default for DrapeParams {
    fn default() -> Self {
        Self {
            gravity: Acceleration(9.81),
            pressure: None,
            model: ModelName::default(),
            integrator: IntegratorName::default(),
            correction: CorrectionName::default(),
            penalty: PenaltyName::default(),
            accuracy: AccuracyName::default(),
            effects: EffectsParam::default(),
            body_gap: Length(1e-3),
            self_gap: Length(1e-3),
            max_time: Duration(20.0),
            stiffer_first: false,
            repeats: 0,
            open_seams: None,
            limits: BTreeMap::new(),
        }
    }
}

impl DrapeParams {
    /// The solver's settings.
    #[must_use]
    pub fn settings(&self, threads: usize) -> Settings {
        let base = Settings::default();
        let share = match self.accuracy {
            AccuracyName::Draft => 5.0,
            AccuracyName::Normal => 1.0,
            AccuracyName::Fine => 0.2,
            AccuracyName::Reference => 0.05,
        };
        Settings {
            model: self.model.into(),
            integrator: self.integrator.into(),
            effects: Effects {
                self_contact: self.effects.self_contact.into(),
                body_contact: self.effects.body_contact.into(),
                friction: self.effects.friction.into(),
                strain_limit: self.effects.strain_limit.into(),
                bending_hysteresis: self.effects.bending_hysteresis.into(),
            },
            pressure: self.pressure.map_or(0.0, |p| p.0),
            body_gap: self.body_gap.0,
            self_gap: self.self_gap.0,
            equilibrium: Equilibrium {
                decrement_tolerance: base.equilibrium.decrement_tolerance * share,
                move_tolerance: base.equilibrium.move_tolerance * share,
                residual_tolerance: base.equilibrium.residual_tolerance * share,
                ..base.equilibrium
            },
            explicit: ExplicitSteps {
                energy_tolerance: base.explicit.energy_tolerance * share,
                speed_tolerance: base.explicit.speed_tolerance * share,
                max_seconds: self.max_time.0,
                correction: self.correction.into(),
                penalty: self.penalty.into(),
                ..base.explicit
            },
            threads,
            ..base
        }
    }
}

impl From<ModelName> for Model {
    fn from(name: ModelName) -> Self {
        match name {
            ModelName::Springs => Self::Springs,
            ModelName::Coupled => Self::Coupled,
        }
    }
}

impl From<IntegratorName> for Integrator {
    fn from(name: IntegratorName) -> Self {
        match name {
            IntegratorName::Static => Self::Static,
            IntegratorName::Implicit => Self::Implicit,
            IntegratorName::CentralDifference => Self::CentralDifference,
        }
    }
}

impl From<CorrectionName> for ElongationCorrection {
    fn from(name: CorrectionName) -> Self {
        match name {
            CorrectionName::Kang => Self::Kang,
            CorrectionName::Provot => Self::Provot,
        }
    }
}

impl From<PenaltyName> for ContactPenalty {
    fn from(name: PenaltyName) -> Self {
        match name {
            PenaltyName::Linear => Self::Linear,
            PenaltyName::Exponential => Self::Exponential,
        }
    }
}

impl From<SwitchName> for Switch {
    fn from(name: SwitchName) -> Self {
        match name {
            SwitchName::Auto => Self::Auto,
            SwitchName::On => Self::On,
            SwitchName::Off => Self::Off,
        }
    }
}
