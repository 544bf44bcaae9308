//! Differences in length: declared ease and gather, and what is over the limit.

use crate::sewing::codes;
use toile_garment::sewing::SeamSpec;
use toile_garment::{Diagnostic, Report};

/// Differences below this are drawing noise (0.5 mm).
const NOISE: f64 = 5e-4;
/// A declared ease or gather may miss what is drawn by 1 mm or 1 %.
const DECLARED: f64 = 1e-3;

/// Sides that differ by more than this share of the shorter are hardly meant to be eased into each other.
pub const WRONG_EDGE: f64 = 0.15;
/// The longer side over the shorter, where it may be meant as a gather.
const GATHERS: std::ops::RangeInclusive<f64> = 1.05..=3.0;

/// How much two sides may differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest undeclared difference as a share of the shorter side.
    pub max_ease: f64,
}

/// Compares the sides' lengths with what is declared.
pub fn check(spec: &SeamSpec, a: f64, b: f64, limits: &Limits, report: &mut Report) -> Result<(), Diagnostic> {
    let difference = a - b;
    let figures = format!("{:.1} mm against {:.1} mm", a * 1e3, b * 1e3);
    let shorter = a.min(b);
    if let Some(gather) = spec.gather {
        let drawn = a.max(b) / shorter;
        if (drawn / gather - 1.0).abs() > limits.max_ease.max(0.01) {
            return Err(differ(spec, format!("is declared to gather {gather}, drawn is {drawn:.3} ({figures})"))
                .hint(format!("write gather = {drawn:.3}, or redraw")));
        }
        return Ok(());
    }
    let over = difference - spec.ease.unwrap_or(0.0);
    if over.abs() > (limits.max_ease * shorter).max(DECLARED) {
        let share = over.abs() / shorter * 100.0;
        let declared = spec.ease.map_or(String::new(), |e| format!(", declared ease {:.1} mm", e * 1e3));
        let found = differ(spec, format!("has sides of {figures}{declared}: {share:.1} % undeclared"));
        return Err(match remedy(spec, a, b) {
            Some(line) => found.hint(line),
            None => found,
        });
    }
    if difference.abs() > NOISE {
        let message = format!("seam `{}` eases {:.1} mm ({figures})", spec.name, difference.abs() * 1e3);
        report.push(Diagnostic::info(codes::SEAM_EASED, message).at(spec.source.clone()));
    }
    Ok(())
}

/// The line to write where the difference may be meant: a gather, or an ease. `None` where it is too large for both.
fn remedy(spec: &SeamSpec, a: f64, b: f64) -> Option<String> {
    let longer = if a > b { "a" } else { "b" };
    let gather = a.max(b) / a.min(b);
    let may_gather = GATHERS.contains(&gather) && spec.ease.is_none();
    let gathered = may_gather.then(|| format!("if side {longer} is gathered, write gather = {gather:.3}"));
    if (a - b).abs() > WRONG_EDGE * a.min(b) {
        return gathered;
    }
    let ease = format!("write ease = \"{:.1} mm\" (a minus b), or raise max_ease", (a - b) * 1e3);
    Some(gathered.map_or_else(|| ease.clone(), |gathered| format!("{gathered}; if it is eased, {ease}")))
}

fn differ(spec: &SeamSpec, what: String) -> Diagnostic {
    Diagnostic::error(codes::SEAM_LENGTHS_DIFFER, format!("seam `{}` {what}", spec.name)).at(spec.source.clone())
}
