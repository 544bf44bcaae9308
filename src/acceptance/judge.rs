//! The result of a case, and how it differs from its file.

use super::document::{GoldenFigure, GoldenHash, Like};
use super::{GoldenCase, TestFile};
use crate::diff::{self, exceeds};
use crate::engine::{Exit, clean};
use crate::figures::{Figures, counts, of_garment, of_record};
use crate::pipeline::remedy;
use crate::rerun::Ended;
use serde::Serialize;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};
use toile_garment::{Diagnostic, Severity};

/// The result of a case.
pub struct Verdict {
    /// How the run ended.
    pub exit: Exit,
    /// Differences; none for a case that passed.
    pub differences: Vec<Difference>,
    /// Findings of the run.
    pub findings: Vec<Diagnostic>,
    /// All figures that the run has.
    pub figures: Figures,
    /// Digests of its outputs.
    pub outputs: BTreeMap<String, String>,
    /// Its garment, as a file.
    pub garment: Option<PathBuf>,
}

/// Kinds of differences: values can be blessed, all else is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A golden value, hash or garment.
    Golden,
    /// An exit code, finding or bound, or something that is not there.
    Asked,
}

/// Something that is not as the file says.
#[derive(Clone, Debug, Serialize)]
pub struct Difference {
    /// The thing that differs.
    pub what: String,
    /// Its kind.
    pub kind: Kind,
    /// In a sentence.
    pub why: String,
    /// The value in the file.
    pub expected: Option<String>,
    /// The value of the run.
    pub found: Option<String>,
    /// How far it may be off.
    pub tolerance: Option<String>,
    /// Its place in the file.
    #[serde(skip)]
    pub span: Range<usize>,
}

impl Verdict {
    /// Did the case pass?
    #[must_use]
    pub fn has_passed(&self) -> bool {
        self.differences.is_empty()
    }

    /// Errors of the run.
    pub fn errors(&self) -> impl Iterator<Item = &Diagnostic> {
        self.findings.iter().filter(|f| f.severity == Severity::Error)
    }
}

pub(super) fn judge(file: &TestFile, case: &GoldenCase, ended: Ended, folder: &Path) -> Verdict {
    let record = ended.record.unwrap_or_default();
    let mut verdict = Verdict {
        exit: ended.exit,
        differences: Vec::new(),
        findings: ended.findings,
        figures: counts(&record),
        outputs: outputs(&record),
        garment: None,
    };
    let mut differences = exit(case, ended.exit).into_iter().chain(untold(case, &verdict.findings)).collect::<Vec<_>>();
    // A run that failed left no outputs: what is missing follows from that, and is not told again.
    if matches!(ended.exit, Exit::Good | Exit::Gate) {
        let side = diff::open(folder).ok();
        let garment = side.as_ref().and_then(|s| s.garment.as_ref());
        let report = of_record(folder, &record);
        verdict.figures.extend(garment.map(of_garment).unwrap_or_default());
        verdict.figures.extend(report);
        verdict.garment = diff::glb_of(folder, &record);
        differences.extend(case.figures.iter().flat_map(|f| figure(f, &verdict.figures)));
        differences.extend(case.hashes.iter().filter_map(|h| hash(h, &verdict.outputs)));
        differences.extend(case.like.iter().flat_map(|l| like(l, file, side.as_ref())));
    }
    Verdict { differences, ..verdict }
}

fn outputs(record: &Value) -> BTreeMap<String, String> {
    let text = |v: &Value| v.as_str().map(str::to_owned);
    let outputs = record["outputs"].as_array().into_iter().flatten();
    outputs.filter_map(|o| Some((text(&o["path"])?, text(&o["blake3"])?))).collect()
}

fn exit(case: &GoldenCase, exit: Exit) -> Option<Difference> {
    (exit.code() != case.exit).then(|| Difference {
        what: "exit code".to_owned(),
        kind: Kind::Asked,
        why: format!("the exit code is {} ({}), expected {}", exit.code(), exit.word(), case.exit),
        expected: Some(case.exit.to_string()),
        found: Some(exit.code().to_string()),
        tolerance: None,
        span: case.span.clone(),
    })
}

/// Findings that are asked for and were not told.
fn untold(case: &GoldenCase, findings: &[Diagnostic]) -> Vec<Difference> {
    let told: BTreeSet<&str> = findings.iter().map(|f| f.code.as_str()).collect();
    let missing = case.findings.iter().filter(|code| !told.contains(code.as_str()));
    let difference = |code: &String| Difference {
        what: code.clone(),
        kind: Kind::Asked,
        why: format!("the finding `{code}` was not told; {}", remedy(code, told.iter().copied())),
        expected: Some(code.clone()),
        found: None,
        tolerance: None,
        span: case.span.clone(),
    };
    missing.map(difference).collect()
}

fn figure(golden: &GoldenFigure, figures: &Figures) -> Vec<Difference> {
    let name = &golden.bounds.figure;
    let difference = |kind, why, found| Difference {
        what: name.clone(),
        kind,
        why,
        expected: golden.value.map(|v| golden.shown(v)),
        found,
        tolerance: golden.within.map(|w| golden.with_unit(w)),
        span: golden.span.clone(),
    };
    let Some(value) = figures.get(name).copied() else {
        let why = format!("there is no figure `{name}`; {}", remedy(name, figures.keys().map(String::as_str)));
        return vec![difference(Kind::Asked, why, None)];
    };
    let shown = golden.shown(value);
    let off = match (golden.value, golden.within) {
        (Some(expected), Some(within)) if exceeds(value - expected, within) => {
            let by = golden.with_sign(value - expected);
            let within = golden.with_unit(within);
            Some(format!("`{name}` is {shown}, expected {} ± {within} ({by})", golden.shown(expected)))
        }
        (None, Some(_)) => Some(format!("`{name}` is {shown} and has no golden value yet")),
        _ => None,
    };
    let off = off.map(|why| difference(Kind::Golden, why, Some(shown.clone())));
    let over = golden.bounds.broken_by(figures, "run").map(|why| difference(Kind::Asked, why, Some(shown)));
    off.into_iter().chain(over).collect()
}

fn hash(golden: &GoldenHash, outputs: &BTreeMap<String, String>) -> Option<Difference> {
    let name = &golden.path;
    let found = outputs.get(name);
    let (kind, why) = match (found, &golden.blake3) {
        (None, _) => {
            (Kind::Asked, format!("there is no output `{name}`; {}", remedy(name, outputs.keys().map(String::as_str))))
        }
        (Some(_), None) => (Kind::Golden, format!("`{name}` has no golden hash yet")),
        (Some(found), Some(golden)) if !found.eq_ignore_ascii_case(golden) => (
            Kind::Golden,
            format!("`{name}` has other bytes: its hash is {}, expected {}", &found[..12], &golden[..12]),
        ),
        _ => return None,
    };
    let (expected, found) = (golden.blake3.clone(), found.cloned());
    Some(Difference { what: name.clone(), kind, why, expected, found, tolerance: None, span: golden.span.clone() })
}

/// Differences to the golden garment that are over the tolerance.
fn like(like: &Like, file: &TestFile, side: Option<&diff::Side>) -> Vec<Difference> {
    let path = file.folder.join(&like.path);
    let one = |kind, why| Difference {
        what: clean(&like.path),
        kind,
        why,
        expected: None,
        found: None,
        tolerance: None,
        span: like.span.clone(),
    };
    let Some(side) = side.filter(|s| s.garment.is_some()) else {
        return vec![one(Kind::Asked, "there is no GLB among the outputs to compare".to_owned())];
    };
    if !path.exists() {
        return vec![one(Kind::Golden, format!("there is no golden garment `{}` yet", clean(&like.path)))];
    }
    let golden = match diff::open(&path) {
        Ok(golden) => golden,
        Err(finding) => return vec![one(Kind::Golden, finding.message)],
    };
    let over = diff::diff(&golden, side).into_iter().filter(|change| like.tolerance.is_over(change));
    let difference = |change: diff::Change| Difference {
        what: change.what.clone(),
        kind: Kind::Golden,
        why: format!("{}, {}: {}", change.group.word(), change.what, change.words()),
        tolerance: like.tolerance.stated(change.group),
        expected: change.before,
        found: change.after.or_else(|| change.by.map(|by| format!("{by:.3} {}", change.unit))),
        span: like.span.clone(),
    };
    over.map(difference).collect()
}

/// Digits of a golden value: a hundredth of what it may be off.
const SHARE: f64 = 1e-2;

impl GoldenFigure {
    /// A value of the figure, with as many digits as its tolerance asks for.
    pub(super) fn rounded(&self, value: f64) -> f64 {
        let Some(within) = self.within.filter(|w| *w > 0.0) else { return value };
        let digits = (-libm::log10(SHARE * within)).ceil().clamp(0.0, 15.0);
        // As text: so the value is the nearest one with so many digits.
        format!("{value:.*}", digits as usize).parse().unwrap_or(value)
    }

    /// A rounded value with its unit.
    pub(super) fn shown(&self, value: f64) -> String {
        self.with_unit(self.rounded(value))
    }

    fn with_unit(&self, value: f64) -> String {
        if self.is_length { format!("{value} mm") } else { value.to_string() }
    }

    fn with_sign(&self, value: f64) -> String {
        let shown = self.shown(value);
        if value > 0.0 { format!("+{shown}") } else { shown }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::Bounds;

    fn golden(value: Option<f64>, within: Option<f64>, max: Option<f64>) -> GoldenFigure {
        let bounds = Bounds { figure: "hip.drape.tape".to_owned(), min: None, max };
        GoldenFigure { keys: Vec::new(), bounds, value, within, is_length: true, span: 0..0 }
    }

    fn whys(golden: &GoldenFigure, value: f64) -> Vec<String> {
        figure(golden, &BTreeMap::from([("hip.drape.tape".to_owned(), value)])).into_iter().map(|d| d.why).collect()
    }

    #[test]
    fn a_figure_is_told_with_both_values_and_its_tolerance() {
        let close = golden(Some(1000.0), Some(2.0), None);
        assert!(whys(&close, 1002.0).is_empty() && whys(&close, 998.0).is_empty());
        let off = whys(&close, 1002.128);
        assert_eq!(off, ["`hip.drape.tape` is 1002.13 mm, expected 1000 mm ± 2 mm (+2.13 mm)"]);
        assert_eq!(whys(&close, f64::NAN).len(), 1, "what is no number is off");
        let both = whys(&golden(None, Some(2.0), Some(900.0)), 1000.0);
        assert!(both[0].contains("no golden value yet") && both[1].contains("at most 900 is allowed"), "{both:?}");
    }

    #[test]
    fn golden_values_have_the_digits_that_their_tolerance_asks_for() {
        assert_eq!(golden(None, Some(2.0), None).shown(1_012.394_857), "1012.39 mm");
        assert_eq!(golden(None, Some(0.5), None).shown(1_012.394_857), "1012.395 mm");
        assert_eq!(golden(None, Some(0.0), None).shown(0.1), "0.1 mm");
        assert_eq!(golden(None, Some(1e6), None).shown(1012.4), "1012 mm");
    }
}
