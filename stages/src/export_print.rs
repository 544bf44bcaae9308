//! `export-print`: the pattern at its true size, as SVG, PDF or HPGL.

use crate::allowance::{self, AllowanceParams, Which};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use toile_formats::codes::OUT_OF_RANGE;
use toile_formats::plot::{self, Font, Paper, Sheet};
use toile_garment::units::Length;
use toile_garment::{Aspect, Code, Diagnostic, Garment};
use toile_stage_api::{Cost, Errors, Forecast, Stage, StageContext, StageError, StageInfo};

codes! {
    pub(crate) list CODES;

    /// The ending of the file of `export-print` must be .svg, .pdf or .plt. Exit code 2.
    FORM_UNKNOWN = "form-unknown";

    /// `paper` of `export-print` names no format; the message lists those there are. Exit code 2.
    PAPER_UNKNOWN = "paper-unknown";
}

/// Between pieces, and from the edge, metres.
const GAP: f64 = 0.02;

/// Parameters of `export-print`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExportPrintParams {
    /// Output file; its ending says the form: `.svg` (layers, millimetres), `.pdf` (tiles) or `.plt` (HPGL).
    #[schemars(extend("format" = "output-file"))]
    pub file: String,
    /// Paper of a PDF: `a4`, `a3`, `a2`, `a1`, `a0`, `letter`, or `sheet` for one page as large as the drawing.
    pub paper: String,
    /// Width of the drawing, e.g. of a plotter's roll; without it about as wide as high.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<Length>,
    /// Between pieces (20 mm).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap: Option<Length>,
    /// A TrueType or OpenType file: names are drawn with its letters, so that those of any script stand in PDF and
    /// HPGL.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub font: Option<PathBuf>,
    /// Makes the cut lines anew.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowance: Option<AllowanceParams>,
}

impl Default for ExportPrintParams {
    fn default() -> Self {
        Self {
            file: "{out}/pattern.pdf".to_owned(),
            paper: "a4".to_owned(),
            width: None,
            gap: None,
            font: None,
            allowance: None,
        }
    }
}

/// The stage.
pub struct ExportPrint;

impl Stage for ExportPrint {
    type Params = ExportPrintParams;
    const INFO: StageInfo = StageInfo::new(
        "export-print",
        "writes the pattern at its true size as SVG, tiled PDF or HPGL",
        &[Aspect::Pieces],
        &[],
        1,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        // An empty sheet: every parameter is looked at, and the font is read.
        let mut sheet = plot::lay(&[], GAP * 1e3, None);
        let mut errors = Errors::default();
        errors.keep(params.range());
        errors.keep(params.form());
        if let Some(font) = &params.font {
            errors.keep(spell(&mut sheet, font, cx));
        }
        errors.parameters(allowance::faults(params.allowance.as_ref(), &forecast.garment.pieces));
        errors.finish()?;
        Ok(Some(Cost::seconds(0.01)))
    }

    fn run(
        &self,
        params: &ExportPrintParams,
        garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        let (gap, width) = params.range()?;
        let mut pieces = garment.pieces.clone();
        allowance::add(params.allowance.as_ref(), &mut pieces, Which::All, cx)?;
        let mut sheet = plot::lay(&pieces, gap, width);
        if let Some(font) = &params.font {
            spell(&mut sheet, font, cx)?;
        }
        let (bytes, findings) = match params.form()? {
            Form::Svg => (plot::svg(&sheet, &garment.style).into_bytes(), Vec::new()),
            Form::Pdf(paper) => plot::pdf(&sheet, paper, &garment.style).map_err(StageError::parameter)?,
            Form::Hpgl => {
                let (text, findings) = plot::hpgl(&sheet).map_err(StageError::parameter)?;
                (text.into_bytes(), findings)
            }
        };
        findings.into_iter().for_each(|f| cx.report.push(f));
        cx.files.write(Path::new(&params.file), &bytes)?;
        Ok(garment)
    }
}

/// The form of the output.
enum Form {
    Svg,
    Pdf(Paper),
    Hpgl,
}

fn wrong(code: Code, text: String) -> StageError {
    StageError::parameter(Diagnostic::error(code, text))
}

impl ExportPrintParams {
    /// Gap and width in mm, in range.
    fn range(&self) -> Result<(f64, Option<f64>), StageError> {
        let gap = self.gap.map_or(GAP, |g| g.0) * 1e3;
        let width = self.width.map(|w| w.0 * 1e3);
        if !(0.0..=500.0).contains(&gap) || width.is_some_and(|w| !(50.0..=100_000.0).contains(&w)) {
            return Err(wrong(OUT_OF_RANGE, "`gap` must be 0 to 500 mm and `width` 50 mm to 100 m".into()));
        }
        Ok((gap, width))
    }

    /// The form that the ending says, with its paper.
    fn form(&self) -> Result<Form, StageError> {
        let ending = self.file.rsplit_once('.').map_or("", |(_, e)| e).to_ascii_lowercase();
        match ending.as_str() {
            "svg" => Ok(Form::Svg),
            "pdf" => Paper::named(&self.paper).map(Form::Pdf).ok_or_else(|| {
                let known = "a4, a3, a2, a1, a0, letter, sheet";
                wrong(PAPER_UNKNOWN, format!("`paper` is `{}`; there are {known}", self.paper))
            }),
            "plt" | "hpgl" | "hpg" => Ok(Form::Hpgl),
            _ => {
                let text = format!("`file` is `{}`; its ending must be .svg, .pdf or .plt", self.file);
                Err(wrong(FORM_UNKNOWN, text))
            }
        }
    }
}

/// Draws the labels with the letters of a font file.
fn spell(sheet: &mut Sheet, font: &Path, cx: &mut StageContext<'_>) -> Result<(), StageError> {
    let bytes = cx.files.read(font)?;
    let font = Font::read(&bytes, &font.to_string_lossy()).map_err(StageError::input)?;
    cx.report.findings.extend(plot::spell(sheet, &font));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{one, rectangle, run};

    fn params(file: &str) -> ExportPrintParams {
        ExportPrintParams { file: file.into(), ..ExportPrintParams::default() }
    }

    #[test]
    fn the_ending_says_the_form() {
        let garment = || one(rectangle(0, "front", 300.0, 600.0));
        for file in ["a.svg", "a.PDF", "a.plt"] {
            run(&ExportPrint, &params(file), garment()).unwrap_or_else(|e| panic!("{file}: {e:?}"));
        }
        for wrong in [params("a.doc"), ExportPrintParams { paper: "b7".into(), ..params("a.pdf") }] {
            assert!(matches!(run(&ExportPrint, &wrong, garment()), Err(StageError::Parameter(_))));
        }
    }
}
