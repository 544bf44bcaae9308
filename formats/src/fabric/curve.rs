//! Measured curves: rows of strain and tension, of angle and shear force, of curvature and bending moment.

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
/// The quantities of a curve.
pub struct Kind {
    /// Its key in the table `curve`.
    pub key: &'static str,
    /// Its name in findings.
    name: &'static str,
    /// Units of both columns.
    pub units: [Unit; 2],
    /// Names of both columns.
    pub columns: [&'static str; 2],
    /// Units in which findings show both columns, with their factors from SI.
    shown: [(&'static str, f64); 2],
    /// Largest value of the first column, SI.
    most: f64,
    /// Slope that a row may have to the one before, SI: the range of a constant stiffness of that kind, with its unit.
    steepest: (f64, &'static str),
}

const fn tension(key: &'static str) -> Kind {
    Kind {
        key,
        name: key,
        units: [Unit::Share, Unit::LineForce],
        columns: ["strain", "tension"],
        shown: [("%", 100.0), ("N/m", 1.0)],
        most: 3.0,
        steepest: (1e8, "N/m"),
    }
}

const fn moment(key: &'static str, name: &'static str) -> Kind {
    Kind {
        key,
        name,
        units: [Unit::Curvature, Unit::Hysteresis],
        columns: ["curvature", "moment"],
        shown: [("1/m", 1.0), ("mN", 1e3)],
        most: 1e4,
        steepest: (1.0, "N.m"),
    }
}

/// Every curve that a file may give.
pub const KINDS: [Kind; 5] = [
    tension("warp"),
    tension("weft"),
    Kind {
        key: "shear_force",
        name: "shear",
        units: [Unit::Angle, Unit::LineForce],
        columns: ["angle", "force"],
        shown: [("deg", 180.0 / std::f64::consts::PI), ("N/m", 1.0)],
        most: std::f64::consts::FRAC_PI_3,
        steepest: (1e7, "N/m/rad"),
    },
    moment("bending_moment_warp", "bending moment along the warp"),
    moment("bending_moment_weft", "bending moment along the weft"),
];

/// Keys of the curves.
pub const WORDS: &[&str] = &["warp", "weft", "shear_force", "bending_moment_warp", "bending_moment_weft"];

/// Reads one curve; every wrong row is named.
pub fn read(toml: &TomlText<'_>, key: &str, value: &Spanned<DeValue<'_>>, origin: &Origin, out: &mut Entries) {
    let Some(kind) = KINDS.iter().find(|k| k.key == key) else { return };
    let (direction, hinted) = (kind.name, |message: String| kind.hinted(message));
    let before = out.findings.len();
    let Some(rows) = value.get_ref().as_array() else {
        let message = format!("`{key}` must be a list of rows, not {}", describe(value.get_ref()));
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
        match kind.point(row.get_ref()).and_then(|p| kind.follows(points.last(), p)) {
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
    out.curves.insert(kind.key, CurveEntry { points, source, at: toml.place(value) });
}

impl Kind {
    fn hinted(&self, message: String) -> Diagnostic {
        let [(x, _), (y, _)] = self.shown;
        let [first, second] = self.columns;
        Diagnostic::error(codes::FABRIC_CURVE, message)
            .hint(format!("rows are [\"{first} {x}\", \"{second} {y}\"], both rising from [\"0 {x}\", \"0 {y}\"]"))
    }

    fn point(&self, row: &DeValue<'_>) -> Result<[f64; 2], String> {
        let [first, second] = self.columns;
        let two = || format!("a row has two values, {first} and {second}");
        let cells = row.as_array().filter(|r| r.len() == 2).ok_or_else(two)?;
        let cell = |i: usize| match cells.get(i).map(Spanned::get_ref) {
            Some(DeValue::String(text)) => fields::value(self.units[i], text).map_err(|e| e.message),
            Some(other) => Err(format!("{} has no unit", describe(other))),
            None => Err("a value is missing".to_owned()),
        };
        Ok([cell(0)?, cell(1)?])
    }

    fn follows(&self, last: Option<&[f64; 2]>, p: [f64; 2]) -> Result<[f64; 2], String> {
        let [(x, by), (y, times)] = self.shown;
        let [first, second] = self.columns;
        let row = format!("({} {x}, {} {y})", p[0] * by, p[1] * times);
        let [x0, y0] = last.copied().unwrap_or([0.0, 0.0]);
        if last.is_none() && p == [0.0, 0.0] {
            return Ok(p);
        }
        if p[0] < 0.0 || p[1] < 0.0 {
            return Err(format!("{row} is negative"));
        }
        if p[0] <= x0 {
            let none = format!("{second} without {first}");
            return Err(format!("{row}: {}", if last.is_none() { none } else { format!("the {first} does not rise") }));
        }
        if p[0] > self.most {
            return Err(format!("{row}: the {first} is over {:.0} {x}", self.most * by));
        }
        if p[1] <= y0 {
            return Err(format!("{row}: the {second} falls or stays"));
        }
        let (steepest, unit) = self.steepest;
        if (p[1] - y0) / (p[0] - x0) > steepest {
            return Err(format!("{row}: steeper than {steepest} {unit}"));
        }
        Ok(p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_curve_has_a_key() {
        assert_eq!(KINDS.map(|k| k.key), WORDS);
    }
}
