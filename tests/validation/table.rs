//! The table as text and as JSON.

use crate::case::{Row, Verdict};
use serde_json::json;

pub fn head() -> String {
    format!(
        "{:<28} {:<22} {:>12} {:>12} {:>10} {:>8} {:>8}  {:<5} {:>6}  note",
        "case", "figure", "measured", "expected", "error", "good", "poor", "", "CPU s"
    )
}

pub fn line(r: &Row) -> String {
    let t = r.tolerance;
    let size = |v: f64| if t.absolute { format!("{v:.1e}") } else { format!("{:.2} %", v * 100.0) };
    let verdict = word(r.verdict);
    let (case, target) = (&r.case, &r.target);
    match r.measured {
        Some(measured) => format!(
            "{case:<28} {target:<22} {:>12} {:>12} {:>10} {:>8} {:>8}  {verdict:<5} {:>6.1}  {}",
            number(measured),
            number(r.expected),
            size(r.error),
            size(t.good),
            size(t.poor),
            r.cpu,
            r.note
        ),
        None => format!("{case:<28} {target:<22} {:>68}  {verdict:<5} {:>6.1}  {}", "", r.cpu, r.note),
    }
}

fn number(v: f64) -> String {
    if v != 0.0 && v.abs() < 1e-3 { format!("{v:.5e}") } else { format!("{v:.6}") }
}

fn word(v: Verdict) -> &'static str {
    match v {
        Verdict::Good => "good",
        Verdict::Poor => "poor",
        Verdict::Bad => "BAD",
    }
}

pub fn summary(rows: &[Row]) -> String {
    let count = |v: Verdict| rows.iter().filter(|r| r.verdict == v).count();
    let names: std::collections::BTreeSet<&str> = rows.iter().map(|r| r.case.as_str()).collect();
    let all_good = |n: &&&str| rows.iter().filter(|r| r.case == **n).all(|r| r.verdict == Verdict::Good);
    format!(
        "\n{} cases, {} of them good throughout; {} figures: {} good, {} poor, {} bad; {:.0} CPU s",
        names.len(),
        names.iter().filter(all_good).count(),
        rows.len(),
        count(Verdict::Good),
        count(Verdict::Poor),
        count(Verdict::Bad),
        rows.iter().map(|r| r.cpu).sum::<f64>()
    )
}

pub fn json(rows: &[Row]) -> String {
    let list: Vec<_> = rows
        .iter()
        .map(|r| {
            json!({ "case": r.case, "figure": r.target, "measured": r.measured, "expected": r.expected,
                    "error": r.error, "absolute": r.tolerance.absolute, "good": r.tolerance.good,
                    "poor": r.tolerance.poor, "verdict": word(r.verdict), "cpu_seconds": r.cpu, "note": r.note })
        })
        .collect();
    format!("{:#}\n", json!({ "figures": list }))
}
