//! `export-dxf`: the pattern as DXF again, as it came or as it was flattened.

mod carry;
pub(crate) mod codes;
mod finer;
mod flat_piece;
mod images;
mod outline_map;
mod quantities;
mod sewing;
#[cfg(test)]
mod tests;

use crate::allowance::{self, AllowanceParams, Which};
use crate::import_dxf;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use toile_formats::dxf::write::{self, Drawing, PieceOptions, StyleText, WriteOptions, piece_drawing};
use toile_formats::{encoding, rul};
use toile_garment::{Aspect, Diagnostic, Garment, Piece};
use toile_stage_api::{Cost, Errors, Forecast, Stage, StageContext, StageError, StageInfo};

pub use flat_piece::{flat_outline, flat_piece, with_outline};

/// Which form of the standard is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DxfDialect {
    /// ANSI/AAMA-292.
    Aama,
    /// ASTM D6673.
    #[default]
    Astm,
    /// The habits of CLO.
    Clo,
    /// The habits of Gerber AccuMark: ASTM in runs, names of 20 ASCII characters.
    Gerber,
    /// The habits of Optitex: AAMA, blocks called by numbers.
    Optitex,
    /// For drawing programs: layers declared with colours.
    Plain,
}

impl DxfDialect {
    fn written(self) -> write::Dialect {
        match self {
            Self::Aama => write::Dialect::Aama,
            Self::Astm => write::Dialect::Astm,
            Self::Clo => write::Dialect::Clo,
            Self::Gerber => write::Dialect::Gerber,
            Self::Optitex => write::Dialect::Optitex,
            Self::Plain => write::Dialect::Plain,
        }
    }
}

/// Which pattern is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DxfSource {
    /// The flattened pieces.
    #[default]
    Flat,
    /// The pattern as it was imported.
    Pattern,
}

/// The unit of lengths in the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum DxfUnit {
    /// Millimetres.
    #[default]
    Mm,
    /// Inches.
    Inch,
}

impl DxfUnit {
    /// Millimetres are not written down with the parameters of a run.
    #[allow(clippy::trivially_copy_pass_by_ref, reason = "serde calls it with a reference")]
    fn is_mm(&self) -> bool {
        *self == Self::Mm
    }
}

/// Parameters of `export-dxf`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExportDxfParams {
    /// Output file.
    #[schemars(extend("format" = "output-file"))]
    pub file: String,
    /// Also a sewing file whose points lie on the outlines that are written. It says all that the garment's own
    /// sewing file says; copies of pieces are pieces of their own.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "output-file"))]
    pub sewing: Option<String>,
    /// Form of the standard.
    pub dialect: DxfDialect,
    /// The flattened pieces, or the pattern unchanged.
    pub source: DxfSource,
    /// Unit of lengths.
    #[serde(skip_serializing_if = "DxfUnit::is_mm")]
    pub units: DxfUnit,
    /// Code page of the texts, e.g. `"windows-1252"`, `"gbk"`, `"utf-8"`; without it 7-bit ASCII, other letters as
    /// `\U+XXXX`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub code_page: Option<String>,
    /// Who made the pattern.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub author: Option<String>,
    /// Date that the file says, as it is to stand there; without it none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub date: Option<String>,
    /// Write pieces that were unfolded as halves with a fold line again.
    pub half_on_fold: bool,
    /// Add a drill hole 10 mm from the apex and notches at the mouth of every dart that has none.
    pub mark_darts: bool,
    /// Makes the cut lines anew from the sew lines, e.g. `{ width = "10 mm" }`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowance: Option<AllowanceParams>,
    /// A pattern file all sizes of which are written instead, with their grade rules in a `.rul` file beside the
    /// output; its own rule table is the file of the same name with `.rul`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub size_run: Option<PathBuf>,
    /// The pattern file that the garment was made of. All its sizes are written for the pieces as they were changed in
    /// one size, with their grade rules in a `.rul` file beside the output.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub grade_from: Option<PathBuf>,
}

impl Default for ExportDxfParams {
    fn default() -> Self {
        Self {
            file: "{out}/pattern.dxf".to_owned(),
            sewing: None,
            dialect: DxfDialect::default(),
            source: DxfSource::default(),
            units: DxfUnit::default(),
            code_page: None,
            author: None,
            date: None,
            half_on_fold: false,
            mark_darts: false,
            allowance: None,
            size_run: None,
            grade_from: None,
        }
    }
}

impl ExportDxfParams {
    /// Unit and code page.
    fn options(&self) -> Result<WriteOptions, Box<Diagnostic>> {
        let page = self.code_page.as_deref().map(encoding::asked);
        Ok(WriteOptions { inches: self.units == DxfUnit::Inch, page: page.transpose()? })
    }

    /// The faults, before anything is read.
    fn faults(&self) -> Errors {
        let mut errors = Errors::default();
        errors.keep(self.options().map_err(|f| StageError::parameter(*f)));
        if self.size_run.is_some() && self.sewing.is_some() {
            let text = "a sewing file belongs to one size, and `size_run` writes all of them";
            let hint = "leave `sewing` out, or write one size: without `size_run`";
            errors.parameters(vec![Diagnostic::error(import_dxf::SIZES_WITH_SEWING, text).hint(hint)]);
        }
        errors
    }

    /// How pieces are drawn.
    fn piece_options(&self) -> PieceOptions {
        PieceOptions { half_on_fold: self.half_on_fold, mark_darts: self.mark_darts }
    }

    /// The texts of the style, with the author and the date of the parameters.
    fn signed(&self, style: StyleText) -> StyleText {
        StyleText { author: self.author.clone().unwrap_or_default(), date: self.date.clone(), ..style }
    }
}

/// The stage.
pub struct ExportDxf;

impl Stage for ExportDxf {
    type Params = ExportDxfParams;
    const INFO: StageInfo = StageInfo::new(
        "export-dxf",
        "writes the flattened pieces, or the pattern, as DXF-AAMA or DXF-ASTM",
        &[Aspect::Pieces],
        &[],
        3,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        let mut errors = params.faults();
        match &params.size_run {
            Some(pattern) => drop(errors.keep(sizes_of(pattern, &forecast.garment, cx))),
            None if params.source == DxfSource::Flat && forecast.garment.flat.is_none() => {
                errors.extend([no_flat()]);
            }
            None => {}
        }
        if let Some(pattern) = &params.grade_from {
            errors.keep(sizes_of(pattern, &forecast.garment, cx));
        }
        errors.parameters(allowance::faults(params.allowance.as_ref(), &forecast.garment.pieces));
        errors.finish()?;
        Ok(forecast.by_triangles(0.01, 0.001, 1.0))
    }

    fn run(
        &self,
        params: &ExportDxfParams,
        garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        // A wrong code page is found before anything is read or flattened pieces are asked for.
        params.faults().finish()?;
        if let Some(pattern) = &params.size_run {
            write_run(pattern, &garment, params, cx)?;
            return Ok(garment);
        }
        let drawn = match params.source {
            DxfSource::Pattern => Cow::Borrowed(&garment),
            DxfSource::Flat => finer::finer(&garment),
        };
        let mut pieces = match params.source {
            DxfSource::Pattern => drawn.pieces.clone(),
            DxfSource::Flat => flat_pieces(&drawn)?,
        };
        quantities::share(&drawn, &mut pieces, cx.report);
        allowance::add(params.allowance.as_ref(), &mut pieces, Which::All, cx)?;
        match &params.grade_from {
            Some(pattern) => write_carried(pattern, &drawn, &pieces, params, cx)?,
            None => {
                let written = draw(&drawn, &pieces, params).map_err(StageError::Input)?;
                written.findings.into_iter().for_each(|f| cx.report.push(f));
                cx.files.write(Path::new(&params.file), &written.bytes)?;
            }
        }
        if let Some(file) = &params.sewing {
            // Before pieces are sewn there are no stitches to follow, and the pieces lie as the plan says.
            let is_as_planned = params.source == DxfSource::Pattern && drawn.seams.is_empty();
            let plan = if is_as_planned { sewing::unsewn(&drawn) } else { sewing::plan(&drawn, &pieces) };
            cx.files.write(Path::new(file), toile_formats::sewing::write::text(&plan, sewing::HEAD).as_bytes())?;
        }
        Ok(garment)
    }
}

/// All sizes of a pattern file, as drawn or as its rule table grades them. A file that the garment was made of is read as
/// it was then: in the same unit, with the same layers and pieces.
fn sizes_of(path: &Path, garment: &Garment, cx: &mut StageContext<'_>) -> Result<write::Sizes, StageError> {
    let (pattern, table) = import_dxf::read(&import_dxf::params_of(path, garment), cx)?;
    write::Sizes::new(&pattern, table.as_ref()).map_err(StageError::Input)
}

/// Writes all sizes of a pattern file, and its grade rules.
fn write_run(
    path: &Path,
    garment: &Garment,
    params: &ExportDxfParams,
    cx: &mut StageContext<'_>,
) -> Result<(), StageError> {
    let mut sizes = sizes_of(path, garment, cx)?;
    if params.allowance.is_some() {
        sizes.recut(|pieces| allowance::add(params.allowance.as_ref(), pieces, Which::All, cx))?;
    }
    write_sizes(sizes.draw(params.piece_options()), params, cx)
}

/// The pieces as they were changed, in all sizes of the pattern that they were made of.
fn write_carried(
    path: &Path,
    garment: &Garment,
    pieces: &[Piece],
    params: &ExportDxfParams,
    cx: &mut StageContext<'_>,
) -> Result<(), StageError> {
    let before = garment.pieces.iter().cloned();
    let changed: Vec<write::Changed> =
        before.zip(pieces.iter().cloned()).map(|(before, after)| write::Changed { before, after }).collect();
    let run = sizes_of(path, garment, cx)?.carried(garment.size.as_deref(), &changed, params.piece_options());
    write_sizes(run.map_err(StageError::Input)?, params, cx)
}

/// Writes a size run: the drawing, and its rules beside it.
fn write_sizes(mut run: write::SizeRun, params: &ExportDxfParams, cx: &mut StageContext<'_>) -> Result<(), StageError> {
    run.drawing.style = params.signed(run.drawing.style);
    let dialect = params.dialect.written();
    let options = params.options().map_err(|f| StageError::parameter(*f))?;
    let written = write::write_with(&run.drawing, dialect, options).map_err(StageError::Input)?;
    run.findings.into_iter().chain(written.findings).for_each(|f| cx.report.push(f));
    cx.files.write(Path::new(&params.file), &written.bytes)?;
    if let Some(table) = &run.table {
        let file = Path::new(&params.file).with_extension("rul");
        cx.files
            .write(&file, &rul::write_with(table, dialect.is_astm(), dialect != write::Dialect::Clo, options.inches))?;
    }
    Ok(())
}

fn no_flat() -> StageError {
    StageError::parameter(
        Diagnostic::error(codes::FLAT_MISSING, "there are no flattened pieces to write")
            .hint("put `flatten` before `export-dxf`, or set with.source = \"pattern\""),
    )
}

/// All pieces at their flattened places.
fn flat_pieces(garment: &Garment) -> Result<Vec<Piece>, StageError> {
    let Some(flat) = &garment.flat else { return Err(no_flat()) };
    let flat_of = |piece: &Piece| flat.pieces.iter().find(|f| f.piece == piece.id).ok_or_else(|| not_flattened(piece));
    let flats = all_of(garment.pieces.iter().map(flat_of))?;
    let both = || garment.pieces.iter().zip(&flats);
    let mut outlines = all_of(both().map(|(piece, flat)| flat_outline(piece, flat)))?;
    let images = images::make_one(garment, &flats, &mut outlines);
    let mut pieces = all_of(both().zip(&outlines).map(|((piece, flat), moved)| with_outline(piece, flat, moved)))?;
    images::marks_one(garment, &images, &mut pieces);
    sewing::redraw_pleats(garment, &mut pieces);
    Ok(pieces)
}

fn not_flattened(piece: &Piece) -> Box<Diagnostic> {
    Box::new(Diagnostic::error(codes::FLAT_MISSING, format!("piece `{}` was not flattened", piece.name)))
}

/// All values, or all faults.
fn all_of<T>(results: impl Iterator<Item = Result<T, Box<Diagnostic>>>) -> Result<Vec<T>, StageError> {
    let (mut values, mut faults) = (Vec::new(), Vec::new());
    for result in results {
        match result {
            Ok(value) => values.push(value),
            Err(fault) => faults.push(*fault),
        }
    }
    if faults.is_empty() { Ok(values) } else { Err(StageError::Input(faults)) }
}

/// The file: bytes and findings.
///
/// # Errors
/// As [`write::write`].
pub fn draw(garment: &Garment, pieces: &[Piece], params: &ExportDxfParams) -> Result<write::Written, Vec<Diagnostic>> {
    let dialect = params.dialect.written();
    let mut findings = Vec::new();
    let drawing = Drawing {
        style: params.signed(StyleText {
            name: garment.style.clone(),
            sample_size: garment.size.clone(),
            ..StyleText::default()
        }),
        pieces: pieces.iter().map(|p| piece_drawing(p, params.piece_options(), &mut findings)).collect(),
    };
    let options = params.options().map_err(|f| vec![*f])?;
    let mut written = write::write_with(&drawing, dialect, options)?;
    findings.append(&mut written.findings);
    written.findings = findings;
    Ok(written)
}
