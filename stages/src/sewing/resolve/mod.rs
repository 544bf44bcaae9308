//! Seams resolved: every side an ordered list of spans on piece rings, with matched notches and checked lengths.

mod direction;
mod lengths;
mod notches;
mod side;

pub use lengths::Limits;
pub use notches::on_rings;
pub use side::{Side, Span};

use super::lookup;
use super::shapes::Shapes;
use toile_garment::sewing::SeamSpec;
use toile_garment::{Diagnostic, Garment, Report, SourceRef};

/// A declared seam, found on the outlines.
#[derive(Clone, Debug, PartialEq)]
pub struct ResolvedSeam {
    /// Name.
    pub name: String,
    /// Side a.
    pub a: Side,
    /// Side b, in the order in which it meets side a.
    pub b: Side,
    /// Matched notches: distance from the start along a and along b, metres, rising.
    pub notches: Vec<(f64, f64)>,
    /// Declared gather.
    pub gather: Option<f64>,
    /// Origin.
    pub source: Option<SourceRef>,
}

/// Resolves all seams of the plan. Findings go to the report.
///
/// # Errors
/// All seams that cannot be sewn as written: unknown names, points off the outline, directions that contradict the
/// marks, undeclared differences in length.
pub fn resolve(
    garment: &Garment,
    shapes: &Shapes,
    limits: &Limits,
    report: &mut Report,
) -> Result<Vec<ResolvedSeam>, Vec<Diagnostic>> {
    let mut errors = Vec::new();
    let mut seams = Vec::new();
    for spec in &garment.plan.seams {
        match seam(garment, shapes, spec, limits, report) {
            Ok(s) => seams.push(s),
            Err(e) => errors.extend(e),
        }
    }
    if errors.is_empty() { Ok(seams) } else { Err(errors) }
}

fn seam(
    garment: &Garment,
    shapes: &Shapes,
    spec: &SeamSpec,
    limits: &Limits,
    report: &mut Report,
) -> Result<ResolvedSeam, Vec<Diagnostic>> {
    let at = spec.source.as_ref();
    let find = |runs: &[toile_garment::sewing::RunSpec]| {
        let found: Vec<_> = runs.iter().map(|r| lookup::run(garment, shapes, r, at)).collect();
        let errors: Vec<_> = found.iter().filter_map(|r| r.as_ref().err().cloned()).collect();
        if errors.is_empty() { Ok(found.into_iter().flatten().collect::<Vec<_>>()) } else { Err(errors) }
    };
    let (a, b) = match (find(&spec.a), find(&spec.b)) {
        (Ok(a), Ok(b)) => (a, b),
        (a, b) => return Err([a.err(), b.err()].into_iter().flatten().flatten().collect()),
    };
    let (a, b) = direction::settle(garment, shapes, spec, a, b, report).map_err(|e| vec![e])?;
    let a = side::side(garment, shapes, spec, &a).map_err(|e| vec![e])?;
    let b = side::side(garment, shapes, spec, &b).map_err(|e| vec![e])?;
    side::check_not_itself(spec, &a, &b, shapes).map_err(|e| vec![e])?;
    lengths::check(spec, a.length, b.length, limits, report).map_err(|e| vec![e])?;
    let notches = notches::matched(garment, shapes, spec, &a, &b, report);
    Ok(ResolvedSeam { name: spec.name.clone(), a, b, notches, gather: spec.gather, source: spec.source.clone() })
}
