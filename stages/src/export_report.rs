//! The stage `export-report`: JSON, CSV, SVG and HTML of what was made.

use crate::fit;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toile_formats::report::{self, Language};
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
    /// Measures as comma-separated values, lengths in millimetres; empty writes none.
    #[schemars(extend("format" = "output-file"))]
    pub csv: PathBuf,
    /// One self-contained page with the garment in 3D; empty writes none.
    #[schemars(extend("format" = "output-file"))]
    pub html: PathBuf,
    /// Language of the page: `en` (English) or `zh` (Chinese). Names and findings stay as they are.
    pub language: LanguageParam,
}

/// A language of the page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LanguageParam {
    /// English.
    #[default]
    En,
    /// Chinese, in simplified letters.
    Zh,
}

impl LanguageParam {
    fn language(self) -> Language {
        match self {
            Self::En => Language::English,
            Self::Zh => Language::Chinese,
        }
    }
}

impl Default for ExportReportParams {
    fn default() -> Self {
        let [json, svg, csv, html] =
            ["report.json", "report.svg", "measures.csv", "report.html"].map(|name| format!("{{out}}/{name}").into());
        Self { json, svg, csv, html, language: LanguageParam::En }
    }
}

/// Writes the report; the garment stays as it is.
pub struct ExportReport;

impl Stage for ExportReport {
    type Params = ExportReportParams;
    const INFO: StageInfo = StageInfo::new(
        "export-report",
        "write the report in millimetres: JSON, CSV, SVG and one HTML page with the garment in 3D",
        &[Aspect::Pieces],
        &[],
        2,
    );

    fn forecast(
        &self,
        _: &Self::Params,
        forecast: &mut Forecast,
        _: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        Ok(forecast.by_triangles(0.7, 0.05, 6.0))
    }

    fn run(&self, params: &Self::Params, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let findings = cx.report.findings.clone();
        let fit = fit::measure(&garment);
        let given = |path: &PathBuf| !path.as_os_str().is_empty();
        if given(&params.json) {
            let text = serde_json::to_string_pretty(&report::json(&garment, &findings, &fit))
                .map_err(|e| StageError::Internal(format!("report as JSON: {e}")))?;
            let text = toile_garment::text::json(&text) + "\n";
            cx.files.write(&params.json, text.as_bytes())?;
        }
        if given(&params.svg) {
            cx.files.write(&params.svg, report::drawing(&garment).as_bytes())?;
        }
        if given(&params.csv) {
            cx.files.write(&params.csv, fit.csv().as_bytes())?;
        }
        if given(&params.html) {
            cx.files
                .write(&params.html, report::html(&garment, &findings, &fit, params.language.language()).as_bytes())?;
        }
        Ok(garment)
    }
}
