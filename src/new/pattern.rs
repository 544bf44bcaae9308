//! The pattern that a folder is made from.

use crate::engine::{MAX_INPUT, of_file_error, of_stage_error, read_limited};
use std::path::{Path, PathBuf};
use toile_formats::dxf::{self, ReadOptions};
use toile_formats::rul;
use toile_garment::sewing::{CopySpec, SewingPlan};
use toile_garment::{Diagnostic, Garment, Report};

/// A pattern as it was read.
#[derive(Debug)]
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
    /// Findings of the reader.
    pub findings: Vec<Diagnostic>,
}

impl Source {
    /// Name of the pattern in the folder.
    #[must_use]
    pub fn file_name(&self) -> String {
        format!("{}.dxf", self.stem)
    }
}

/// Reads a pattern with the rule table beside it.
///
/// # Errors
/// It is not there, or cannot be read.
pub fn read(path: &Path) -> Result<Source, Vec<Diagnostic>> {
    let bytes = read_limited(path, path, MAX_INPUT).map_err(|e| of_file_error(&e).0.into_iter().collect::<Vec<_>>())?;
    let name = path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    let stem = path.file_stem().map_or_else(|| "pattern".to_owned(), |n| n.to_string_lossy().into_owned());
    let beside = rules_beside(path).and_then(|p| Some((p.clone(), read_limited(&p, &p, MAX_INPUT).ok()?)));
    let table = beside.as_ref().and_then(|(p, b)| rul::read(b, &p.to_string_lossy()).ok());
    let options = ReadOptions { rule_units: table.as_ref().and_then(|t| t.units.clone()), ..ReadOptions::default() };
    let pattern = dxf::read(&bytes, &name, &options)?;
    let (mut garment, more) = pattern.to_garment(None, table.as_ref())?;
    let mut findings = pattern.all_findings();
    findings.extend(more);
    let copies = copies(&garment);
    let plan = SewingPlan { copies: copies.clone(), ..SewingPlan::default() };
    let mut report = Report::default();
    toile_stages::sewing::apply(&mut garment, plan, &mut report).map_err(|e| of_stage_error(e).0)?;
    findings.extend(report.findings);
    let rules = beside.map(|(_, bytes)| (format!("{stem}.rul"), bytes));
    Ok(Source { stem, bytes, rules, garment, copies, findings })
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

/// The mirrored copies of pieces that are cut in pairs: once as drawn and once turned over. A count of two alone means
/// a pair only where the piece is not its own mirror image.
fn copies(garment: &Garment) -> Vec<CopySpec> {
    let own = toile_stages::proposal::own_images(garment);
    let is_pair = |p: &toile_garment::Piece| {
        let both = p.quantity.plain > 0 && p.quantity.mirrored > 0;
        both || (p.quantity.plain == 2 && !own[p.id.index()])
    };
    let copy = |p: &toile_garment::Piece| CopySpec {
        piece: p.name.clone(),
        name: format!("{}-M", p.name),
        mirror: true,
        source: None,
    };
    garment.pieces.iter().filter(|p| is_pair(p)).map(copy).collect()
}
