//! The stage `export-report`: JSON, CSV, SVG and HTML of what was made.

use crate::fit;
use crate::text::utf8;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toile_formats::measures::{self, PointOfMeasure};
use toile_formats::report::accuracy::Accuracy;
use toile_formats::report::{self, Language, Point};
use toile_garment::{Aspect, Code, Diagnostic, Garment};
use toile_stage_api::{Cost, Errors, Forecast, Knob, Meaning, Stage, StageContext, StageError, StageInfo};

codes! {
    pub(crate) list CODES;

    /// A point of measure cannot be taken on this garment. The message says what is not there; correct its names. A name
    /// that pattern or body does not have is an error before any work; a line that the cloth does not reach is a warning.
    MEASURE_MISSING = "measure-missing";

    /// A point of measure is further off than its tolerance. Change the pattern, or the length that is expected.
    MEASURE_OFF = "measure-off";

    /// A study lies beside the pipeline, or is named, and is not of this garment as it is now: a file, a parameter or the
    /// program has changed. So the page shows no chart of it. Make it anew with `toile study`, or take it away.
    STUDY_NOT_SHOWN = "study-not-shown";
}

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
    /// Points of measure of your own, as TOML (`formats/src/measures.rs`): what is measured, and how far it may be off.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub measures: Option<PathBuf>,
    /// The study of the garment, as `toile study` wrote it: the page shows its chart. Without it `NAME.study.json` beside
    /// the pipeline `NAME.toml` is taken, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub study: Option<PathBuf>,
    /// Language of page and drawing: `en` (English) or `zh` (Chinese). Names stay as they are. Findings are told in
    /// both: what one means in Chinese, its figures in English.
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
        Self { json, svg, csv, html, measures: None, study: None, language: LanguageParam::En }
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
    const KNOBS: &'static [Knob] = &[Knob::new(Meaning::Study, "study")];

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        let mut errors = Errors::default();
        let points = errors.keep(asked(params, cx)).unwrap_or_default();
        errors.parameters(unknown_names(&points, forecast));
        errors.keep(study_text(params, cx));
        errors.finish()?;
        let body = forecast.body_thousands();
        let cost = forecast.by_triangles(0.3 + 0.013 * body, 0.02, 4.0);
        // The page holds the body a few times on its way: as surface, as bytes and as text.
        Ok(cost.map(|c| Cost { mb: c.mb + 2.2 * body, ..c }))
    }

    fn run(&self, params: &Self::Params, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let mut fit = fit::measure(&garment);
        fit.points = points(params, &garment, cx)?;
        fit.accuracy = accuracy(params, &garment, cx)?;
        let findings = cx.report.findings.clone();
        let given = |path: &PathBuf| !path.as_os_str().is_empty();
        if given(&params.json) {
            let text = serde_json::to_string_pretty(&report::json(&garment, &findings, &fit))
                .map_err(|e| StageError::Internal(format!("report as JSON: {e}")))?;
            let text = toile_garment::text::json(&text) + "\n";
            cx.files.write(&params.json, text.as_bytes())?;
        }
        if given(&params.svg) {
            cx.files.write(&params.svg, report::drawing(&garment, params.language.language()).as_bytes())?;
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

/// The points of measure that are asked for.
fn asked(params: &ExportReportParams, cx: &mut StageContext<'_>) -> Result<Vec<PointOfMeasure>, StageError> {
    let Some(file) = &params.measures else { return Ok(Vec::new()) };
    let bytes = cx.files.read(file)?;
    measures::read(&utf8(file, &bytes)?, &file.to_string_lossy()).map_err(StageError::Input)
}

/// Names of points of measure that pattern and body do not have.
fn unknown_names(points: &[PointOfMeasure], forecast: &Forecast) -> Vec<Diagnostic> {
    let of_point = |m: &PointOfMeasure| {
        let finding = |(why, remedy)| {
            let message = format!("the measure `{}`: {why}", m.name);
            Diagnostic::error(MEASURE_MISSING, message).at(m.place.clone()).hint(remedy)
        };
        fit::unknown_names(m, &forecast.garment, &forecast.unread).into_iter().map(finding).collect::<Vec<_>>()
    };
    points.iter().flat_map(of_point).collect()
}

/// The text of the study that is named.
fn study_text(params: &ExportReportParams, cx: &mut StageContext<'_>) -> Result<Option<String>, StageError> {
    let Some(file) = &params.study else { return Ok(None) };
    let bytes = cx.files.read(file)?;
    utf8(file, &bytes).map(Some)
}

/// The study that is to be shown, where it is of this garment.
fn accuracy(
    params: &ExportReportParams,
    garment: &Garment,
    cx: &mut StageContext<'_>,
) -> Result<Option<Accuracy>, StageError> {
    if garment.certificate.is_none() {
        return Ok(None);
    }
    let Some((text, file)) = study_text(params, cx)?.zip(params.study.as_ref()) else { return Ok(None) };
    let why = match Accuracy::read(&text) {
        Err(why) => why,
        Ok(study) => match study.made_of.changed(garment) {
            None => return Ok(Some(study)),
            Some(why) => why,
        },
    };
    let message = format!("the study `{}` is not shown: {why}", file.display());
    cx.report.push(Diagnostic::info(STUDY_NOT_SHOWN, message).hint("make it anew with `toile study`, or take it away"));
    Ok(None)
}

/// All points of measure; those that cannot be taken, or are off, become findings.
fn points(params: &ExportReportParams, garment: &Garment, cx: &mut StageContext<'_>) -> Result<Vec<Point>, StageError> {
    let mut out = Vec::new();
    for wanted in asked(params, cx)? {
        match fit::point(&wanted, garment) {
            Ok(point) => {
                if point.passed == Some(false) {
                    cx.report.push(off(&point));
                }
                out.push(point);
            }
            // A run that failed has said what is wrong; what cannot be measured then is no news.
            Err(_) if cx.report.has_errors() => {}
            Err(why) => {
                let message = format!("the measure `{}` cannot be taken: {why}", wanted.name);
                cx.report.push(Diagnostic::warning(MEASURE_MISSING, message));
            }
        }
    }
    Ok(out)
}

fn off(point: &Point) -> Diagnostic {
    let mm = |x: Option<f64>| 1e3 * x.unwrap_or_default();
    let message = format!(
        "the measure `{}` is {:.1} mm; {:.1} mm are expected, {:.1} mm more or less are allowed",
        point.name,
        1e3 * point.length,
        mm(point.expected),
        mm(point.tolerance)
    );
    Diagnostic::warning(MEASURE_OFF, message)
}
