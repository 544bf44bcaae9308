//! The stage `export-report`: JSON, SVG and HTML of what was made.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toile_formats::report;
use toile_garment::{Aspect, Garment};
use toile_stage_api::{Cost, Forecast, Stage, StageContext, StageError, StageInfo};

/// Parameters of `export-report`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExportReportParams {
    /// Tables for programs; empty writes none.
    #[schemars(extend("format" = "output-file"))]
    pub json: PathBuf,
    /// Drawing of the flattened pieces over the originals; empty writes none.
    #[schemars(extend("format" = "output-file"))]
    pub svg: PathBuf,
    /// One self-contained page; empty writes none.
    #[schemars(extend("format" = "output-file"))]
    pub html: PathBuf,
}

impl Default for ExportReportParams {
    fn default() -> Self {
        Self { json: "{out}/report.json".into(), svg: "{out}/report.svg".into(), html: "{out}/report.html".into() }
    }
}

/// Writes the report; the garment stays as it is.
pub struct ExportReport;

impl Stage for ExportReport {
    type Params = ExportReportParams;
    const INFO: StageInfo = StageInfo::new(
        "export-report",
        "write the report in millimetres: JSON, SVG and one HTML page",
        &[Aspect::Pieces],
        &[],
        1,
    );

    fn forecast(
        &self,
        _: &Self::Params,
        forecast: &mut Forecast,
        _: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        Ok(forecast.by_triangles(0.01, 0.002, 1.0))
    }

    fn run(&self, params: &Self::Params, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let findings = cx.report.findings.clone();
        let given = |path: &PathBuf| !path.as_os_str().is_empty();
        if given(&params.json) {
            let text = serde_json::to_string_pretty(&report::json(&garment, &findings))
                .map_err(|e| StageError::Internal(format!("report as JSON: {e}")))?;
            let text = toile_garment::text::json(&text) + "\n";
            cx.files.write(&params.json, text.as_bytes())?;
        }
        if given(&params.svg) {
            cx.files.write(&params.svg, report::drawing(&garment).as_bytes())?;
        }
        if given(&params.html) {
            cx.files.write(&params.html, report::html(&garment, &findings).as_bytes())?;
        }
        Ok(garment)
    }
}
