//! The pattern that a folder is made from.

use super::alternatives::word_of_knit;
use super::codes::{PATTERN_HUGE, PATTERN_TINY};
use super::cut;
use crate::engine::{MAX_INPUT, of_file_error, of_stage_error, read_limited};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toile_formats::dxf::{self, ReadOptions};
use toile_formats::rul;
use toile_garment::dart::DartKind;
use toile_garment::sewing::{CopySpec, DartSpec, SewingPlan};
use toile_garment::{Diagnostic, Garment, Piece, Report, Vec2};
use toile_stages::import_dxf::FileUnit;

/// How a person wants a pattern to be read.
#[derive(Debug, Default)]
pub struct Wishes {
    /// Pieces that are not sewn.
    pub leave_out: Vec<String>,
    /// The unit of the coordinates, overruling the file.
    pub unit: Option<FileUnit>,
    /// The size.
    pub size: Option<String>,
    /// Layers of the file that stand for others.
    pub layers: BTreeMap<String, String>,
}

/// Why a piece is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// No sure seam was found for it.
    NoSureSeam,
    /// Another piece stands for it.
    StandsFor,
}

/// A pattern as it was read.
#[derive(Clone, Debug, Default)]
pub struct Source {
    /// Name of the file, without its ending.
    pub stem: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// Its rule table: name and content.
    pub rules: Option<(String, Vec<u8>)>,
    /// The pieces, and the copies that are cut of them.
    pub garment: Garment,
    /// The copies.
    pub copies: Vec<CopySpec>,
    /// Pieces that are not sewn.
    pub left_out: Vec<String>,
    /// Those of them for which no sure seam was found.
    pub without_seam: Vec<String>,
    /// Those of them that lie on or under other pieces.
    pub inner: Vec<String>,
    /// Those of them that the pattern's own quantity does not count.
    pub not_cut: Vec<String>,
    /// Those of them for which another piece stands.
    pub stood_for: Vec<String>,
    /// Pleats that notches tell.
    pub pleats: Vec<DartSpec>,
    /// The unit of the coordinates, where a person gave it.
    pub unit: Option<FileUnit>,
    /// Layers of the file that stand for others, as a person gave them.
    pub layers: BTreeMap<String, String>,
    /// All sizes of the file.
    pub sizes: Vec<String>,
    /// Findings of the reader.
    pub findings: Vec<Diagnostic>,
}

impl Source {
    /// The same pattern, without some pieces.
    #[must_use]
    pub fn without(&self, names: &[String], why: Why) -> Self {
        let mut out = self.clone();
        let is_copy = |name: &String| self.copies.iter().any(|c| c.name == *name);
        let drawn: Vec<String> = names.iter().filter(|n| !is_copy(n)).cloned().collect();
        // A copy is not left out alone: what is drawn once is sewn twice or not at all.
        let is_out = |c: &CopySpec| drawn.contains(&c.piece);
        out.garment.plan.leave_out.extend(self.copies.iter().filter(|c| is_out(c)).map(|c| c.name.clone()));
        out.garment.plan.leave_out.extend(drawn.iter().cloned());
        out.copies.retain(|c| !is_out(c));
        out.left_out.extend(drawn.iter().cloned());
        match why {
            Why::NoSureSeam => out.without_seam.extend(drawn),
            Why::StandsFor => out.stood_for.extend(drawn),
        }
        out
    }

    /// The piece that is an instance of a block, and whether it is turned over.
    #[must_use]
    pub fn find(&self, block: &str, instance: u64) -> Option<(usize, bool)> {
        let is_copy = |name: &str| self.copies.iter().find(|c| c.name == name);
        let mut pieces = self.garment.pieces.iter().enumerate().filter(|(_, p)| p.block == block);
        pieces.find_map(|(i, p)| match is_copy(&p.name) {
            None => (instance == 0).then_some((i, false)),
            Some(copy) => (instance > 0).then_some((i, copy.mirror)),
        })
    }

    /// A piece that is cut of a knit, such as a rib, and the word that tells it. What it is sewn to is a knit, too.
    #[must_use]
    pub fn knit(&self) -> Option<(&Piece, String)> {
        self.garment.pieces.iter().find_map(|p| Some((p, word_of_knit(p)?)))
    }

    /// Name of the pattern in the folder.
    #[must_use]
    pub fn file_name(&self) -> String {
        format!("{}.dxf", self.stem)
    }
}

/// Reads a pattern with the rule table beside it. A plan that a person wrote decides on copies, darts and what is left
/// out; without one, the pattern's own quantities do.
///
/// # Errors
/// It is not there, or cannot be read.
pub fn read(path: &Path, plan: Option<SewingPlan>, wishes: &Wishes) -> Result<Source, Vec<Diagnostic>> {
    let bytes = read_limited(path, path, MAX_INPUT).map_err(|e| of_file_error(&e).0.into_iter().collect::<Vec<_>>())?;
    let name = path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    let stem = path.file_stem().map_or_else(|| "pattern".to_owned(), |n| n.to_string_lossy().into_owned());
    let beside = rules_beside(path).and_then(|p| Some((p.clone(), read_limited(&p, &p, MAX_INPUT).ok()?)));
    let table = beside.as_ref().and_then(|(p, b)| rul::read(b, &p.to_string_lossy()).ok());
    let options = ReadOptions {
        mm_per_unit: wishes.unit.map(FileUnit::mm),
        layers: wishes.layers.clone(),
        rule_units: table.as_ref().and_then(|t| t.units.clone()),
        ..ReadOptions::default()
    };
    let pattern = dxf::read(&bytes, &name, &options)?;
    let (mut garment, more) = pattern.to_garment(wishes.size.as_deref(), table.as_ref())?;
    check_size(&garment, pattern.units.mm_per_unit, wishes.unit.is_some())?;
    let mut findings = pattern.told_findings();
    findings.extend(more);
    let cut = if plan.is_none() { cut::plan(&garment, &wishes.leave_out) } else { cut::Cut::default() };
    let plan = plan.unwrap_or(cut.plan);
    let pleats = plan.darts.iter().filter(|d| d.kind == Some(DartKind::Pleat)).cloned().collect();
    let (copies, left_out) = (plan.copies.clone(), plan.leave_out.clone());
    let mut report = Report::default();
    toile_stages::sewing::apply(&mut garment, plan, &mut report).map_err(|e| of_stage_error(e).0)?;
    findings.extend(report.findings);
    let rules = beside.map(|(_, bytes)| (format!("{stem}.rul"), bytes));
    Ok(Source {
        stem,
        bytes,
        rules,
        garment,
        copies,
        left_out,
        without_seam: cut.without_slit,
        inner: cut.inner,
        not_cut: cut.not_cut,
        stood_for: cut.stood_for,
        pleats,
        unit: wishes.unit,
        layers: wishes.layers.clone(),
        sizes: pattern.size_order(table.as_ref()),
        findings,
    })
}

/// The largest piece of a garment is longer, m. The mitten of a baby measures 0.1 m.
const LARGEST_PIECE_LEAST: f64 = 0.09;
/// The largest piece of a garment has a smaller area, m². Cloth is up to 3.2 m wide. A full circle skirt down to the floor
/// has 7 m², and the front of a child's shirt, ten times too large, has 12.
const AREA_MOST: f64 = 10.0;
/// Lengths of the largest piece of a garment that are named as likely, mm.
const GARMENT: std::ops::Range<f64> = 90.0..2500.0;

/// Refuses a pattern whose largest piece is smaller than any garment's, unless a person said the unit, or larger than any
/// garment's. `mm` is the unit that it was read in, millimetres.
fn check_size(garment: &Garment, mm: f64, is_unit_said: bool) -> Result<(), Vec<Diagnostic>> {
    let largest = garment.pieces.iter().map(span).fold(0.0, f64::max);
    let area = garment.pieces.iter().map(|p| p.outline.signed_area().abs()).fold(0.0, f64::max);
    let is_tiny = largest > 0.0 && largest < LARGEST_PIECE_LEAST && !is_unit_said;
    let (code, told) = if is_tiny {
        (PATTERN_TINY, format!("is {:.0} mm long", largest * 1e3))
    } else if area > AREA_MOST {
        (PATTERN_HUGE, format!("has {area:.0} m² and is up to {:.1} m long", largest))
    } else {
        return Ok(());
    };
    let long = |unit: f64| largest * 1e3 / mm * unit;
    let units = [("mm", 1.0), ("cm", 10.0), ("inch", 25.4), ("m", 1e3)];
    let (likely, others): (Vec<_>, Vec<_>) = units.into_iter().partition(|(_, unit)| GARMENT.contains(&long(*unit)));
    // A doll's dress may be meant: the smallest unit is always named.
    let named = likely.into_iter().chain(others.into_iter().filter(|(word, _)| is_tiny && *word == "mm"));
    let in_unit = |(word, unit): (&str, f64)| format!("`--units {word}` makes it {:.0} mm long", long(unit));
    let choices: Vec<String> = named.map(in_unit).collect();
    let message = format!("the largest piece {told}, which no garment's is: the unit is wrong");
    let hint = if choices.is_empty() { "no unit makes a garment of it".to_owned() } else { choices.join(", ") };
    Err(vec![Diagnostic::error(code, message).hint(format!("say the unit: {hint}"))])
}

/// The longer side of the box around a piece, metres.
fn span(piece: &Piece) -> f64 {
    let far = Vec2::repeat(f64::INFINITY);
    let bounds = |[low, high]: [Vec2; 2], p: Vec2| [low.inf(&p), high.sup(&p)];
    let [low, high] = piece.outline.positions().into_iter().fold([far, -far], bounds);
    (high - low).max()
}

/// The rule table beside a pattern: the same name with `.rul`, upper and lower case not told apart.
fn rules_beside(path: &Path) -> Option<PathBuf> {
    let wanted = path.with_extension("rul").file_name()?.to_str()?.to_lowercase();
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let entries = std::fs::read_dir(folder).ok()?.flatten();
    let mut names: Vec<String> = entries.filter_map(|e| e.file_name().into_string().ok()).collect();
    names.sort();
    names.into_iter().find(|n| n.to_lowercase() == wanted).map(|n| folder.join(n))
}
