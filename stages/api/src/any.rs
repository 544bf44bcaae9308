//! Stages as the engine stores them: typed for authors, erased here.

use crate::context::StageContext;
use crate::error::StageError;
use crate::forecast::{Cost, Forecast};
use crate::knob::Knob;
use crate::stage::{Stage, StageInfo};
use schemars::{Schema, SchemaGenerator};
use serde::Deserialize as _;
use toile_garment::{Garment, Report};

/// A stage without its parameter type. Every [`Stage`] is one; a stage in another process is one too.
pub trait AnyStage: Send + Sync {
    /// Name, needs, gives.
    fn info(&self) -> StageInfo;

    /// Parameters that an asked accuracy, or a study, may set.
    fn knobs(&self) -> &[Knob];

    /// Schema of the parameters.
    fn schema(&self, generator: &mut SchemaGenerator) -> Schema;

    /// Parses the parameters of one use of the stage.
    ///
    /// # Errors
    /// The deserialiser's error, with the span of the wrong value.
    fn configure<'a>(
        &'a self,
        params: toml::de::ValueDeserializer<'_>,
    ) -> Result<Box<dyn ReadyStage + 'a>, toml::de::Error>;
}

/// A stage with its parameters, ready to run.
pub trait ReadyStage: Send + Sync {
    /// Name, needs, gives.
    fn info(&self) -> StageInfo;

    /// Parameters that an asked accuracy, or a study, may set.
    fn knobs(&self) -> &[Knob];

    /// The full parameters, defaults included.
    fn params(&self) -> serde_json::Value;

    /// Foresees what `run` will need; see [`Stage::forecast`].
    ///
    /// # Errors
    /// See [`StageError`].
    fn forecast(&self, forecast: &mut Forecast, cx: &mut StageContext<'_>) -> Result<Option<Cost>, StageError>;

    /// Looks without changing.
    fn check(&self, garment: &Garment, report: &mut Report);

    /// Does the work.
    ///
    /// # Errors
    /// See [`StageError`].
    fn run(&self, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError>;
}

struct Ready<'a, S: Stage> {
    stage: &'a S,
    params: S::Params,
}

impl<S: Stage> AnyStage for S {
    fn info(&self) -> StageInfo {
        S::INFO
    }

    fn knobs(&self) -> &[Knob] {
        S::KNOBS
    }

    fn schema(&self, generator: &mut SchemaGenerator) -> Schema {
        generator.subschema_for::<S::Params>()
    }

    fn configure<'a>(
        &'a self,
        params: toml::de::ValueDeserializer<'_>,
    ) -> Result<Box<dyn ReadyStage + 'a>, toml::de::Error> {
        let params = S::Params::deserialize(params)?;
        Ok(Box::new(Ready { stage: self, params }))
    }
}

impl<S: Stage> ReadyStage for Ready<'_, S> {
    fn info(&self) -> StageInfo {
        S::INFO
    }

    fn knobs(&self) -> &[Knob] {
        S::KNOBS
    }

    fn params(&self) -> serde_json::Value {
        serde_json::to_value(&self.params).unwrap_or(serde_json::Value::Null)
    }

    fn forecast(&self, forecast: &mut Forecast, cx: &mut StageContext<'_>) -> Result<Option<Cost>, StageError> {
        self.stage.forecast(&self.params, forecast, cx)
    }

    fn check(&self, garment: &Garment, report: &mut Report) {
        self.stage.check(&self.params, garment, report);
    }

    fn run(&self, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        self.stage.run(&self.params, garment, cx)
    }
}
