//! Measured tension curves: rows of strain and tension.

use super::codes;
use super::fields::{self, Unit};
use super::reader::{CurveEntry, Entries, Origin};
use crate::toml_text::{TomlText, describe};
use serde_spanned::Spanned;
use toile_garment::Diagnostic;
use toile_garment::fabric::ValueSource;
use toml::de::DeValue;

/// Most rows of one curve.
const MAX_ROWS: usize = 10_000;
/// Slope that a row may have to the one before, N/m: the range of a stretch stiffness.
const MAX_SLOPE: f64 = 1e8;

/// Reads one curve; every wrong row is named.
pub fn read(
    toml: &TomlText<'_>,
    direction: &'static str,
    value: &Spanned<DeValue<'_>>,
    origin: &Origin,
    out: &mut Entries,
) {
    let before = out.findings.len();
    let Some(rows) = value.get_ref().as_array() else {
        let message = format!("`{direction}` must be a list of rows, not {}", describe(value.get_ref()));
        out.findings.push(hinted(message).at(toml.place(value)));
        return;
    };
    if rows.len() > MAX_ROWS {
        let message = format!("the {direction} curve has {} rows, over the limit of {MAX_ROWS}", rows.len());
        out.findings.push(Diagnostic::error(codes::FABRIC_CURVE, message).at(toml.place(value)));
        return;
    }
    let mut points: Vec<[f64; 2]> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        match point(row.get_ref()).and_then(|p| follows(points.last(), p)) {
            Ok(p) => points.push(p),
            Err(why) => {
                let message = format!("row {} of the {direction} curve: {why}", i + 1);
                out.findings.push(hinted(message).at(toml.place(row)));
            }
        }
    }
    if out.findings.len() > before {
        return;
    }
    if points.first().is_some_and(|p| p[0] > 0.0) {
        points.insert(0, [0.0, 0.0]);
    }
    if points.len() < 2 {
        let message = format!("the {direction} curve has no row beyond the origin");
        out.findings.push(hinted(message).at(toml.place(value)));
        return;
    }
    let written = format!("{} rows", rows.len());
    let source = ValueSource { written, method: origin.method.clone(), source: origin.source.clone() };
    out.curves.insert(direction, CurveEntry { points, source, at: toml.place(value) });
}

fn hinted(message: String) -> Diagnostic {
    Diagnostic::error(codes::FABRIC_CURVE, message)
        .hint("rows are [\"strain %\", \"tension N/m\"], both rising from [\"0 %\", \"0 N/m\"]")
}

fn point(row: &DeValue<'_>) -> Result<[f64; 2], String> {
    let cells = row.as_array().filter(|r| r.len() == 2).ok_or("a row has two values, strain and tension")?;
    let cell = |i: usize, unit: Unit| match cells.get(i).map(Spanned::get_ref) {
        Some(DeValue::String(text)) => fields::value(unit, text).map_err(|e| e.message),
        Some(other) => Err(format!("{} has no unit", describe(other))),
        None => Err("a value is missing".to_owned()),
    };
    Ok([cell(0, Unit::Share)?, cell(1, Unit::LineForce)?])
}

fn follows(last: Option<&[f64; 2]>, p: [f64; 2]) -> Result<[f64; 2], String> {
    let (strain, tension) = (p[0] * 100.0, p[1]);
    let [s0, t0] = last.copied().unwrap_or([0.0, 0.0]);
    if last.is_none() && p == [0.0, 0.0] {
        return Ok(p);
    }
    if p[0] < 0.0 || p[1] < 0.0 {
        return Err(format!("({strain} %, {tension} N/m) is negative"));
    }
    if p[0] <= s0 {
        let what = if last.is_none() { "tension without strain" } else { "the strain does not rise" };
        return Err(format!("({strain} %, {tension} N/m): {what}"));
    }
    if p[0] > 3.0 {
        return Err(format!("a strain of {strain} % is over 300 %"));
    }
    if p[1] <= t0 {
        return Err(format!("({strain} %, {tension} N/m): the tension falls or stays"));
    }
    if (p[1] - t0) / (p[0] - s0) > MAX_SLOPE {
        return Err(format!("({strain} %, {tension} N/m): steeper than {MAX_SLOPE} N/m"));
    }
    Ok(p)
}
