//! The trait an author writes.

use crate::context::StageContext;
use crate::error::StageError;
use crate::forecast::{Cost, Forecast};
use crate::knob::Knob;
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::borrow::Cow;
use toile_garment::{Aspect, Garment, Report};

/// Name of a stage, its needs and its results.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct StageInfo {
    /// Name in the pipeline, verb-noun in kebab case; a third party's is `vendor.stage`.
    pub name: Cow<'static, str>,
    /// One line.
    pub summary: Cow<'static, str>,
    /// Aspects that an earlier stage must have given.
    pub needs: Cow<'static, [Aspect]>,
    /// Aspects it adds.
    pub gives: Cow<'static, [Aspect]>,
    /// Raised whenever the output changes for the same input.
    pub revision: u32,
    /// Does it read what it outdates? Then that is forgotten once the stage has run, else before.
    #[serde(skip)]
    pub reads_outdated: bool,
}

impl StageInfo {
    /// Info of a built-in stage.
    #[must_use]
    pub const fn new(
        name: &'static str,
        summary: &'static str,
        needs: &'static [Aspect],
        gives: &'static [Aspect],
        revision: u32,
    ) -> Self {
        Self {
            name: Cow::Borrowed(name),
            summary: Cow::Borrowed(summary),
            needs: Cow::Borrowed(needs),
            gives: Cow::Borrowed(gives),
            revision,
            reads_outdated: false,
        }
    }

    /// The same stage, which reads what it outdates: shapes of pieces that it makes anew, for example.
    #[must_use]
    pub const fn reading_outdated(mut self) -> Self {
        self.reads_outdated = true;
        self
    }
}

/// A stage: takes the garment and gives it back richer.
pub trait Stage: Send + Sync + 'static {
    /// Parameters: the table `with` of the pipeline. Use `#[serde(deny_unknown_fields, default)]` where it fits;
    /// doc comments become the manual and the schema.
    type Params: DeserializeOwned + Serialize + JsonSchema + Send + Sync + 'static;
    /// Name, needs, gives.
    const INFO: StageInfo;

    /// Parameters that an asked accuracy, or a study, may set. There are none by default.
    const KNOBS: &'static [Knob] = &[];

    /// Foresees what `run` will need, from the parameters and from what files say; it does none of the work. What the
    /// stage learns for others (pieces, fabrics, body, mesh) it leaves in the forecast; files are read through the
    /// context, and what is wrong with them goes into its report. `None` says that nothing can be foreseen, and is the
    /// default.
    ///
    /// # Errors
    /// See [`StageError`]: an error here ends the plan as it would end the run.
    fn forecast(
        &self,
        _params: &Self::Params,
        _forecast: &mut Forecast,
        _cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        Ok(None)
    }

    /// Looks without changing; called just before `run`.
    fn check(&self, _params: &Self::Params, _garment: &Garment, _report: &mut Report) {}

    /// Does the work. On error nothing half-done survives.
    ///
    /// # Errors
    /// See [`StageError`]: the kind says whose fault it is.
    fn run(&self, params: &Self::Params, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError>;
}
