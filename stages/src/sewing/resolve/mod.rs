//! Seams resolved: every side an ordered list of spans on piece rings, with matched notches and checked lengths.

mod direction;
mod fitting;
mod lengths;
mod notches;
mod side;
mod twice;
mod twisted;

pub use lengths::Limits;
pub use side::{Side, Span};

use super::lookup;
use super::shapes::Shapes;
use toile_garment::sewing::{ElasticSpec, SeamSpec};
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

/// One seam of the plan as it was found, with the notes on it.
///
/// Looking for a seam has no side effect. So every stage that needs to know where the seams run asks [`find`], and the
/// one that sews them has them judged.
#[derive(Clone, Debug)]
pub struct Found {
    /// Notes on the direction of its sides; they hold even where the seam is wrong.
    direction: Vec<Diagnostic>,
    /// Notes on its notches.
    notches: Vec<Diagnostic>,
    /// The seam, or all that is wrong with it.
    seam: Result<ResolvedSeam, Vec<Diagnostic>>,
}

/// Looks for all seams of the plan, in its order.
#[must_use]
pub fn find(garment: &Garment, shapes: &Shapes) -> Vec<Found> {
    garment.plan.seams.iter().map(|spec| found(garment, shapes, spec)).collect()
}

/// The seams alone, for stages that only need to know where they run.
///
/// # Errors
/// All seams that cannot be sewn as written: unknown names, points off the outline, directions that contradict the
/// marks. Lengths are not compared.
pub fn placed(found: Vec<Found>) -> Result<Vec<ResolvedSeam>, Vec<Diagnostic>> {
    collect(found.into_iter().map(|f| f.seam))
}

/// The remedy where the sides of a seam cannot be eased or gathered into each other, and no edge fits.
const OTHER_EDGE: &str = "no cloth is eased by so much: name another edge, or a part of it, such as \
     { piece = \"FRONT\", edge = 2, from = \"start\", to = \"notch 1\" }; `toile inspect` lists the edges";

/// The seams with their lengths compared. Notes go to the report.
///
/// # Errors
/// As [`placed`], and differences in length that are not declared.
pub fn judged(
    garment: &Garment,
    shapes: &Shapes,
    limits: &Limits,
    report: &mut Report,
) -> Result<Vec<ResolvedSeam>, Vec<Diagnostic>> {
    let found = find(garment, shapes);
    let judge = |(f, spec): (&Found, &SeamSpec)| {
        f.direction.iter().for_each(|note| report.push(note.clone()));
        let seam = f.seam.clone()?;
        lengths::check(spec, seam.a.length, seam.b.length, limits, report).map_err(|error| {
            match fitting::fitting(garment, shapes, &found, &seam, limits.max_ease) {
                Some(fits) => {
                    let declare = error.hint.clone().map_or_else(String::new, |remedy| format!("; or {remedy}"));
                    vec![error.hint(fits + &declare)]
                }
                None if error.hint.is_none() => vec![error.hint(OTHER_EDGE)],
                None => vec![error],
            }
        })?;
        f.notches.iter().for_each(|note| report.push(note.clone()));
        Ok(seam)
    };
    let seams = collect(found.iter().zip(&garment.plan.seams).map(judge))?;
    twice::sewn_twice(garment, shapes, &seams).into_iter().for_each(|warning| report.push(warning));
    twisted::twisted(&garment.plan.seams, &garment.pieces).into_iter().for_each(|warning| report.push(warning));
    Ok(seams)
}

/// All seams, or all that is wrong with any.
fn collect(
    each: impl Iterator<Item = Result<ResolvedSeam, Vec<Diagnostic>>>,
) -> Result<Vec<ResolvedSeam>, Vec<Diagnostic>> {
    let (mut seams, mut errors) = (Vec::new(), Vec::new());
    for one in each {
        match one {
            Ok(seam) => seams.push(seam),
            Err(e) => errors.extend(e),
        }
    }
    if errors.is_empty() { Ok(seams) } else { Err(errors) }
}

/// The edges that an elastic band is sewn to, without the intakes of darts.
///
/// # Errors
/// The first of its runs that is not there.
pub fn elastic_side(garment: &Garment, shapes: &Shapes, spec: &ElasticSpec) -> Result<Side, Diagnostic> {
    let found = |r| lookup::run(garment, shapes, r, spec.source.as_ref());
    let runs = spec.along.iter().map(found).collect::<Result<Vec<_>, _>>()?;
    side::spans(garment, shapes, &format!("elastic `{}`", spec.name), spec.source.as_ref(), &runs)
}

fn found(garment: &Garment, shapes: &Shapes, spec: &SeamSpec) -> Found {
    let (mut direction, mut notches) = (Vec::new(), Vec::new());
    let seam = seam(garment, shapes, spec, &mut direction, &mut notches);
    Found { direction, notches, seam }
}

fn seam(
    garment: &Garment,
    shapes: &Shapes,
    spec: &SeamSpec,
    direction: &mut Vec<Diagnostic>,
    notches: &mut Vec<Diagnostic>,
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
    let (a, b) = direction::settle(garment, shapes, spec, a, b, direction).map_err(|e| vec![e])?;
    let a = side::side(garment, shapes, spec, &a).map_err(|e| vec![e])?;
    let b = side::side(garment, shapes, spec, &b).map_err(|e| vec![e])?;
    side::check_not_itself(spec, &a, &b, shapes).map_err(|e| vec![e])?;
    let pairs = notches::matched(garment, shapes, spec, &a, &b, notches);
    let (gather, source) = (spec.gather, spec.source.clone());
    Ok(ResolvedSeam { name: spec.name.clone(), a, b, notches: pairs, gather, source })
}
