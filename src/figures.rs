//! Figures of a run by their names, and bounds for them.

use crate::engine::{output_below, read_limited};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use toile_garment::Garment;
use toile_garment::garment::Certificate;
use toile_stages::fit;

/// Figures by name. Lengths are in mm.
pub type Figures = BTreeMap<String, f64>;

/// Largest report that is read, bytes.
const MAX_REPORT: u64 = 64 << 20;

/// Things on which a measure is taken, and ways to take it.
const ON: [&str; 3] = ["pattern", "drape", "body"];
const METHODS: [&str; 3] = ["surface", "tape", "straight"];
/// Figures that may lie below 0; no other one does.
const BELOW_ZERO: [&str; 2] = ["energy_J", "slip_mm"];

/// The unit of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A measure: a length with its unit.
    Measure,
    /// A length whose name says that it is in mm.
    Millimetres,
    /// A share, a count, or a quantity whose name tells its unit.
    Number,
}

/// The kind of a figure of a run; nothing for a figure that no run has.
#[must_use]
pub fn kind(figure: &str) -> Option<Kind> {
    let parts: Vec<&str> = figure.rsplitn(3, '.').collect();
    if let [method, on, name] = parts[..] {
        let is_measure = !name.is_empty() && ON.contains(&on) && METHODS.contains(&method);
        return is_measure.then_some(Kind::Measure);
    }
    let is_key = certificate_keys().iter().any(|key| key == figure);
    is_key.then_some(if figure.ends_with("_mm") { Kind::Millimetres } else { Kind::Number })
}

/// The figures of every certificate.
#[must_use]
pub fn certificate_keys() -> Vec<String> {
    numbers(&serde_json::to_value(Certificate::default()).unwrap_or_default()).into_keys().collect()
}

/// Bounds of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    /// The figure: a key of the certificate, or `NAME.on.method` of a measure.
    pub figure: String,
    /// Least value; lengths in mm.
    pub min: Option<f64>,
    /// Largest value; lengths in mm.
    pub max: Option<f64>,
}

impl Bounds {
    /// Why no figure can keep to them, in words.
    #[must_use]
    pub fn impossible(&self) -> Option<String> {
        let name = &self.figure;
        if let (Some(min), Some(max)) = (self.min, self.max)
            && min > max
        {
            return Some(format!("no `{name}` is at least {min} and at most {max}"));
        }
        let below = self.max.filter(|max| *max < 0.0 && !BELOW_ZERO.contains(&name.as_str()))?;
        Some(format!("no `{name}` is at most {below}: it is never below 0"))
    }

    /// Why they do not hold. `owner` is the thing that has the figures, for the message.
    #[must_use]
    pub fn broken_by(&self, figures: &Figures, owner: &str) -> Option<String> {
        let name = &self.figure;
        let Some(value) = figures.get(name) else {
            return Some(format!("the gate `{name}` has nothing to look at: the {owner} has no such figure"));
        };
        if let Some(min) = self.min.filter(|min| value < min) {
            return Some(format!("`{name}` is {value}, at least {min} is asked"));
        }
        self.max.filter(|max| value > max).map(|max| format!("`{name}` is {value}, at most {max} is allowed"))
    }
}

/// Figures of a run: numbers of the certificate, and measures of its reports in mm as NAME.on.method.
#[must_use]
pub fn of_record(folder: &Path, record: &Value) -> Figures {
    let mut figures = numbers(&record["certificate"]);
    let outputs = record["outputs"].as_array().into_iter().flatten().filter_map(|o| o["path"].as_str());
    figures.extend(outputs.filter(|p| p.ends_with(".json")).flat_map(|p| measures(folder, p)));
    figures
}

/// Counts of a run, as `garment.triangles` and so on.
pub fn counts(record: &Value) -> Figures {
    numbers(&record["garment"]).into_iter().map(|(name, value)| (format!("garment.{name}"), value)).collect()
}

/// Measures of a garment in mm as NAME.on.method.
pub fn of_garment(garment: &Garment) -> Figures {
    let measures = fit::measure(garment).measures();
    measures.into_iter().map(|m| (format!("{}.{}.{}", m.name, m.on, m.method), 1e3 * m.length)).collect()
}

/// Numbers of a table; true is 1.
pub fn numbers(table: &Value) -> Figures {
    let number = |value: &Value| value.as_f64().or_else(|| value.as_bool().map(|b| f64::from(u8::from(b))));
    let figures = table.as_object().into_iter().flatten();
    figures.filter_map(|(key, value)| Some((key.clone(), number(value)?))).collect()
}

/// Measures of a report, mm.
fn measures(folder: &Path, name: &str) -> Vec<(String, f64)> {
    let read = || {
        let path = folder.join(output_below(Path::new(name)).ok()?);
        let report: Value = serde_json::from_slice(&read_limited(&path, &path, MAX_REPORT).ok()?).ok()?;
        (report["kind"] == "toile-report").then_some(report)
    };
    let Some(report) = read() else { return Vec::new() };
    let measure = |m: &Value| {
        let name = [&m["name"], &m["on"], &m["method"]].map(|v| v.as_str().unwrap_or_default()).join(".");
        Some((name, m["mm"].as_f64()?))
    };
    report["measures"].as_array().into_iter().flatten().filter_map(measure).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_kinds_and_bounds_have_room() {
        let kinds = ["strain_max", "seam_gap_max_mm", "hip_girth.drape.tape", "side.seam.pattern.surface"].map(kind);
        assert_eq!(kinds, [Kind::Number, Kind::Millimetres, Kind::Measure, Kind::Measure].map(Some));
        assert_eq!(["strain_mix", "hip_girth", "hip_girth.drape.tap", ".drape.tape"].map(kind), [None; 4]);
        let why = |figure: &str, min, max| Bounds { figure: figure.to_owned(), min, max }.impossible();
        assert!(why("strain_max", Some(0.2), Some(0.1)).is_some() && why("body_crossings", None, Some(-1.0)).is_some());
        assert!(why("strain_max", Some(0.1), Some(0.1)).is_none() && why("slip_mm", None, Some(-1.0)).is_none());
    }

    #[test]
    fn bounds_look_at_their_figure_and_miss_none() {
        let figures = BTreeMap::from([("hip_girth.drape.tape".to_owned(), 1030.0)]);
        let broken = |figure: &str, min, max| Bounds { figure: figure.to_owned(), min, max }.broken_by(&figures, "job");
        assert_eq!(broken("hip_girth.drape.tape", Some(1000.0), Some(1040.0)), None);
        let low = broken("hip_girth.drape.tape", Some(1031.0), None).expect("too small");
        assert_eq!(low, "`hip_girth.drape.tape` is 1030, at least 1031 is asked");
        assert!(broken("strain_max", None, Some(0.1)).expect("missing").contains("the job has no such figure"));
    }
}
