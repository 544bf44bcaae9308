//! The table as text and as JSON.

use crate::case::Row;
use crate::lab::Count;
use serde_json::json;

/// Failures written out of one case.
const WRITTEN: usize = 4;

pub fn head() -> String {
    format!(
        "{:<32} {:>5} {:>5} {:>9} {:>7} {:>9}  {:<12} {:>7}  what",
        "case", "times", "runs", "accepted", "refused", "converged", "", "CPU s"
    )
}

fn verdict(row: &Row) -> String {
    match (row.failed, row.known) {
        (0, Some(_)) => "pass (known)".to_owned(),
        (0, None) => "pass".to_owned(),
        (n, Some(_)) => format!("FAIL {n} known"),
        (n, None) => format!("FAIL {n}"),
    }
}

pub fn line(row: &Row) -> String {
    let c = &row.count;
    let mut words: Vec<&str> = row.failures.iter().take(WRITTEN).map(String::as_str).collect();
    let more =
        if row.failures.len() > WRITTEN { format!("and {} more", row.failures.len() - WRITTEN) } else { String::new() };
    words.extend((!more.is_empty()).then_some(more.as_str()));
    words.extend(row.notes.iter().take(WRITTEN).map(String::as_str));
    format!(
        "{:<32} {:>5} {:>5} {:>9} {:>7} {:>9}  {:<12} {:>7.1}  {}",
        row.id,
        row.variants,
        c.runs,
        c.accepted,
        c.refused,
        c.converged,
        verdict(row),
        row.cpu,
        words.join("; ")
    )
}

pub fn summary(rows: &[Row]) -> String {
    let mut c = Count::default();
    rows.iter().for_each(|r| c.add(&r.count));
    let share = if c.accepted > 0 { 100.0 * c.converged as f64 / c.accepted as f64 } else { 100.0 };
    let failed: Vec<&Row> = rows.iter().filter(|r| r.failed > 0).collect();
    let mut text = format!(
        "\n{} cases, {} times: {} pass, {} fail\n{} runs: {} accepted, {} refused as they should; {} converged ({share:.1} % of the accepted)\n\
         {} not finite, {} crossings, {} silent stops; {:.0} CPU s",
        rows.len(),
        rows.iter().map(|r| r.variants).sum::<usize>(),
        rows.len() - failed.len(),
        failed.len(),
        c.runs,
        c.accepted,
        c.refused,
        c.converged,
        c.not_finite,
        c.crossings,
        c.silent,
        rows.iter().map(|r| r.cpu).sum::<f64>()
    );
    for row in failed {
        let why = row.known.map_or_else(String::new, |k| format!("; known: {k}"));
        text += &format!("\nFAIL {}: {} of {}{why}", row.id, row.failed, row.variants);
    }
    text
}

pub fn json(rows: &[Row]) -> String {
    let list: Vec<_> = rows
        .iter()
        .map(|r| {
            let c = &r.count;
            json!({ "case": r.id, "variants": r.variants, "failed": r.failed, "known": r.known, "failures": r.failures,
                    "runs": c.runs, "accepted": c.accepted, "refused": c.refused, "converged": c.converged,
                    "not_finite": c.not_finite, "crossings": c.crossings, "silent": c.silent, "cpu_seconds": r.cpu,
                    "notes": r.notes })
        })
        .collect();
    format!("{:#}\n", json!({ "cases": list }))
}
