//! Pattern files: DXF with its rule table, and the rule table alone.

use super::{Inspected, Source, darts, edges};
use crate::engine::{MAX_INPUT, read_limited};
use serde_json::{Map, Value, json};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use toile_formats::dxf::{self, Inspection};
use toile_formats::rul::{self, RuleTable};
use toile_formats::svg;
use toile_garment::{Diagnostic, Piece};

/// A group code, or a comment, stands first.
pub(super) fn is_dxf(bytes: &[u8]) -> bool {
    let body = bytes.trim_ascii_start();
    body.starts_with(b"0\n") || body.starts_with(b"0\r") || body.starts_with(b"999") || body.starts_with(b"AutoCAD")
}

pub(super) fn is_rul(bytes: &[u8]) -> bool {
    let head = bytes.get(..bytes.len().min(2000)).unwrap_or_default().to_ascii_uppercase();
    head.windows(10).any(|w| w == b"SIZE LIST:") || head.windows(11).any(|w| w == b"GRADE RULE ")
}

pub(super) fn dxf(source: &Source<'_>) -> Result<Inspected, Vec<Diagnostic>> {
    let beside = rules_beside(source.path);
    let bytes = beside.as_ref().and_then(|path| read_limited(path, path, MAX_INPUT).ok());
    let inspection = dxf::inspect(source.bytes, source.name, bytes.as_deref())?;
    let table = bytes.as_deref().and_then(|b| rul::read(b, source.name).ok());
    let svg = source.draw.then(|| drawing(&inspection, table.as_ref(), source.name));
    let mut findings = inspection.pattern.told_findings();
    let is_usable = inspection.pattern.is_usable();
    // The findings go to stderr, so that a table piped elsewhere is a table.
    let listed: String = findings.iter().map(|f| format!("{f}\n")).collect();
    let mut text = inspection.text.strip_suffix(&listed).unwrap_or(&inspection.text).to_owned();
    let mut json = inspection.json;
    let garment = inspection.pattern.to_garment(None, table.as_ref());
    // A bad piece does not keep the others from being listed.
    let garment = garment.or_else(|_| inspection.pattern.of_sound_pieces().to_garment(None, table.as_ref()));
    let garment = garment.ok().map(|(garment, _)| garment);
    findings.extend(garment.as_ref().map(edges::faults).unwrap_or_default());
    let tables = garment.map(|g| [("edges", edges::table(&g)), ("darts", darts::table(&g))]);
    for (key, table) in tables.into_iter().flatten() {
        if let Some((rows, values)) = table {
            text.push_str(&rows);
            json[key] = values;
        }
    }
    Ok(Inspected { json, text, svg, findings, is_usable })
}

/// The garment's pieces in the sample size; all drawn pieces when no size can be chosen.
fn drawing(inspection: &Inspection, table: Option<&RuleTable>, name: &str) -> String {
    let with_refused = |mut pieces: Vec<Piece>| {
        pieces.extend(inspection.refused.iter().cloned());
        pieces
    };
    match inspection.pattern.to_garment(None, table) {
        Ok((garment, _)) => {
            let title = format!("{name} {}", garment.size.unwrap_or_default());
            svg::pattern(&with_refused(garment.pieces), &title)
        }
        Err(_) => svg::pattern(&with_refused(inspection.pieces.clone()), name),
    }
}

/// The rule table beside a DXF: the same name with `.rul`, upper and lower case not told apart.
fn rules_beside(path: &Path) -> Option<PathBuf> {
    let wanted = path.with_extension("rul").file_name()?.to_str()?.to_lowercase();
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut names: Vec<String> =
        std::fs::read_dir(folder).ok()?.flatten().filter_map(|e| e.file_name().into_string().ok()).collect();
    names.sort();
    names.into_iter().find(|n| n.to_lowercase() == wanted).map(|n| folder.join(n))
}

pub(super) fn rul(source: &Source<'_>) -> Result<Inspected, Vec<Diagnostic>> {
    let table = rul::read(source.bytes, source.name)?;
    let rules: Map<String, Value> = table
        .rules
        .iter()
        .map(|(number, growth)| (number.to_string(), growth.iter().map(|g| json!([g.x, g.y])).collect()))
        .collect();
    let json = json!({
        "format": "rul",
        "name": table.name,
        "units": table.units,
        "sizes": table.sizes,
        "sample_size": table.sample,
        "rule_count": table.rules.len(),
        "growth_mm": rules,
        "findings": table.findings,
    });
    Ok(Inspected { json, text: growth_table(&table), svg: None, findings: table.findings, is_usable: true })
}

fn growth_table(table: &RuleTable) -> String {
    let or = |text: &Option<String>| text.clone().unwrap_or_else(|| "-".to_owned());
    let mut text =
        format!("rule table {}  units {}  sample {}\n", or(&table.name), or(&table.units), or(&table.sample));
    let _ = writeln!(text, "sizes {}", table.sizes.join(" "));
    let _ = writeln!(text, "{:>6}  growth x, y in mm, size by size", "rule");
    for (number, growth) in &table.rules {
        let steps: Vec<String> = growth.iter().map(|g| format!("{:.2}, {:.2}", g.x, g.y)).collect();
        let _ = writeln!(text, "{number:>6}  {}", steps.join("  "));
    }
    text
}
