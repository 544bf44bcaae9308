//! `import-garmentcode`: pieces, places, seams and darts from a GarmentCode specification.

use crate::allowance::{self, AllowanceParams, Which};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toile_formats::codes::OUT_OF_RANGE;
use toile_formats::garmentcode;
use toile_garment::units::Length;
use toile_garment::{Aspect, Diagnostic, Garment};
use toile_stage_api::{Cost, Forecast, Stage, StageContext, StageError, StageInfo};

/// How near chords keep to curves, metres.
const FLATNESS: f64 = 5e-5;

/// Parameters of `import-garmentcode`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImportGarmentcodeParams {
    /// The specification (JSON), relative to the pipeline file.
    #[schemars(extend("format" = "input-file"))]
    pub file: PathBuf,
    /// A sewing file that adds to what the specification says: attachments, layers, names of edges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub sewing: Option<PathBuf>,
    /// Chords keep this near a curve (0.05 mm).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curve: Option<Length>,
    /// Makes a cut line around the pieces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub allowance: Option<AllowanceParams>,
}

/// The stage.
pub struct ImportGarmentcode;

impl Stage for ImportGarmentcode {
    type Params = ImportGarmentcodeParams;
    const INFO: StageInfo = StageInfo::new(
        "import-garmentcode",
        "reads pieces, places, seams and darts of a GarmentCode specification",
        &[],
        &[Aspect::Pieces],
        2,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        forecast.garment = self.run(params, Garment::default(), cx)?;
        Ok(Some(Cost::seconds(0.01)))
    }

    fn run(
        &self,
        params: &ImportGarmentcodeParams,
        garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        let flatness = params.curve.map_or(FLATNESS, |c| c.0);
        if !(1e-6..=2e-3).contains(&flatness) {
            let text = format!("`curve` is {} mm; it must be 0.001 to 2 mm", flatness * 1e3);
            return Err(StageError::parameter(Diagnostic::error(OUT_OF_RANGE, text)));
        }
        let file = params.file.to_string_lossy().into_owned();
        let bytes = cx.files.read(&params.file)?;
        let read = garmentcode::read(&bytes, &file, flatness).map_err(StageError::Input)?;
        cx.report.findings.extend(read.findings);
        let mut plan = read.plan;
        if let Some(path) = &params.sewing {
            // What the sewing file says of a place comes after the specification and wins.
            plan.extend(crate::sewing::file(path, cx)?);
        }
        let mut pieces = read.garment.pieces;
        allowance::add(params.allowance.as_ref(), &mut pieces, Which::Missing, cx)?;
        let mut garment = Garment { style: read.garment.style, pieces, ..garment };
        crate::sewing::apply(&mut garment, plan, cx.report)?;
        Ok(garment)
    }
}
