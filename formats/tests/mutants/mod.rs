//! Damaged copies of pattern files, and what must hold for each.

mod damage;

pub use damage::{Dice, mutant};

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};
use toile_formats::dxf::ledger::Verdict;
use toile_formats::dxf::{Pattern, ReadOptions, inspect, read};
use toile_formats::{garmentcode, rul};
use toile_garment::Severity;

/// Slowest answer that is allowed.
pub const SLOW: Duration = Duration::from_secs(5);

/// Reads a file of the kind its name says; what went wrong in doing so.
pub fn fault(name: &str, bytes: &[u8]) -> Option<String> {
    let start = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(|| match name.rsplit('.').next().unwrap_or("") {
        "rul" | "RUL" => one_rul(bytes),
        "json" => one_specification(bytes),
        _ => one_dxf(bytes),
    }));
    let fault = match outcome {
        Err(_) => Some("panic".to_owned()),
        Ok(fault) => fault,
    };
    let took = start.elapsed();
    fault.or_else(|| (took > SLOW).then(|| format!("{took:?}")))
}

/// A refusal must have a word, and one of them must be an error.
fn refused(list: &[toile_garment::Diagnostic]) -> Option<String> {
    let error = list.iter().any(|d| d.severity == Severity::Error && !d.message.is_empty());
    (!error).then(|| "refused without a word".to_owned())
}

fn one_dxf(bytes: &[u8]) -> Option<String> {
    // The inspection reads too; every fourth copy also goes through its facts.
    let whole = bytes.len().is_multiple_of(4);
    let pattern = if whole {
        inspect(bytes, "m.dxf", None).map(|i| i.pattern)
    } else {
        read(bytes, "m.dxf", &ReadOptions::default())
    };
    let pattern = match pattern {
        Ok(pattern) => pattern,
        Err(list) => return refused(&list),
    };
    sound(&pattern)
}

/// Nothing lost, nothing without end, and a garment of what was read.
fn sound(pattern: &Pattern) -> Option<String> {
    let l = &pattern.ledger;
    let sum: usize = [Verdict::Accepted, Verdict::Interpreted, Verdict::Refused].map(|v| l.count(v)).iter().sum();
    if sum != l.entities() {
        return Some(format!("{sum} verdicts for {} entities", l.entities()));
    }
    let garment = match pattern.to_garment(None, None) {
        Ok((garment, _)) => garment,
        Err(list) => return refused(&list),
    };
    for piece in &garment.pieces {
        let lines = std::iter::once(&piece.outline).chain(&piece.cut_line).chain(&piece.internal_lines);
        let mut points = lines.flat_map(|l| l.points.iter().map(|p| p.at));
        if !points.all(|p| p.x.is_finite() && p.y.is_finite()) {
            return Some(format!("`{}` holds a point that is none", piece.name));
        }
        if piece.outline.signed_area() <= 0.0 {
            return Some(format!("`{}` has no area", piece.name));
        }
    }
    None
}

fn one_rul(bytes: &[u8]) -> Option<String> {
    match rul::read(bytes, "m.rul") {
        Ok(table) => {
            let whole = table.rules.values().all(|r| r.len() == table.sizes.len());
            (!whole).then(|| "a rule without a growth for every size".to_owned())
        }
        Err(list) => refused(&list),
    }
}

fn one_specification(bytes: &[u8]) -> Option<String> {
    match garmentcode::read(bytes, "m.json", 5e-5) {
        Ok(read) => {
            let sound = read.garment.pieces.iter().all(|p| p.outline.signed_area() > 0.0);
            (!sound).then(|| "a piece without area".to_owned())
        }
        Err(list) => refused(&list),
    }
}
