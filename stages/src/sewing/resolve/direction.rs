//! The ends of a seam that meet.
//!
//! Two points state it: `a.from` meets `b.from`. Edges by name or number do not. A list of edges that follow one another
//! is walked in the order written, and edges of several pieces so that their corners meet. Two pieces that both lie right
//! side out are sewn against each other's sense: one outline forward, the other backward. Only so does the right side stay
//! outside. `reverse = false` states the opposite (a fold-over). Notches must agree with the reading, or both readings are
//! shown.
//!
//! A line inside a piece has cloth on both sides, so no sense follows from it: an edge is sewn along it as both are
//! drawn, unless `reverse` says otherwise.

use super::super::lookup::RawRun;
use super::super::ring::SAME;
use super::super::shapes::{Shapes, mm};
use super::{notches, side};
use crate::sewing::codes;
use toile_garment::sewing::SeamSpec;
use toile_garment::{Diagnostic, Garment};

/// Sides with every run in sewing direction.
pub fn settle(
    garment: &Garment,
    shapes: &Shapes,
    spec: &SeamSpec,
    mut a: Vec<RawRun>,
    mut b: Vec<RawRun>,
    notes: &mut Vec<Diagnostic>,
) -> Result<(Vec<RawRun>, Vec<RawRun>), Diagnostic> {
    let (fixed_a, fixed_b) = (fixed(shapes, &a), fixed(shapes, &b));
    let on_line = a.iter().chain(&b).any(|r| shapes[r.piece.index()].seam_line(r.ring).is_some());
    let against = spec.reverse.unwrap_or(!on_line);
    let (way_a, way_b) = match (fixed_a, fixed_b) {
        (Some(x), Some(y)) => {
            contradiction(garment, shapes, spec, &a, &b, x, y)?;
            (x, y)
        }
        (Some(x), None) => (x, x != against),
        (None, Some(y)) => (y != against, y),
        (None, None) => {
            let forward = reads_forward(garment, shapes, spec, &a, &b)?;
            (forward, forward != against)
        }
    };
    turn(&mut a, way_a);
    turn(&mut b, way_b);
    if spec.reverse.is_none() {
        if a.iter().chain(&b).any(|r| !r.stated) {
            check_notches(garment, shapes, spec, &a, &b)?;
        }
        if way_a == way_b && a.len() == 1 && b.len() == 1 && !on_line {
            let message = format!("seam `{}` folds over: both sides are walked in the same sense", spec.name);
            notes.push(
                Diagnostic::warning(codes::SEAM_FOLDS_OVER, message)
                    .at(spec.source.clone())
                    .hint("swap from and to on one side, or write reverse = false if the pieces lie face to face"),
            );
        }
    }
    Ok((a, b))
}

/// The walking direction that points or the order of edges fix.
fn fixed(shapes: &Shapes, runs: &[RawRun]) -> Option<bool> {
    if let Some(r) = runs.iter().find(|r| r.stated) {
        return Some(r.forward);
    }
    runs.windows(2).find_map(|w| {
        let [x, y] = w else { return None };
        if x.piece != y.piece || x.ring != y.ring {
            return None;
        }
        let ring = &shapes[x.piece.index()].rings[x.ring];
        let follows = ring.sewn_ahead(x.to, y.from) < SAME;
        let leads = ring.sewn_ahead(y.to, x.from) < SAME;
        (follows != leads).then_some(follows)
    })
}

fn turn(runs: &mut [RawRun], forward: bool) {
    for r in runs.iter_mut().filter(|r| !r.stated && r.forward != forward) {
        *r = r.turned();
    }
}

/// `reverse` and what the points say.
fn contradiction(
    garment: &Garment,
    shapes: &Shapes,
    spec: &SeamSpec,
    a: &[RawRun],
    b: &[RawRun],
    x: bool,
    y: bool,
) -> Result<(), Diagnostic> {
    match spec.reverse {
        Some(against) if (x != y) != against => Err(both_readings(
            garment,
            shapes,
            spec,
            a,
            b,
            format!("says reverse = {against}, but its points or the order of its edges say the contrary"),
        )),
        _ => Ok(()),
    }
}

/// A list of edges of several pieces can be walked forward or backward: the corners of the pieces tell which. With one edge a
/// side both are the same seam.
fn reads_forward(
    garment: &Garment,
    shapes: &Shapes,
    spec: &SeamSpec,
    a: &[RawRun],
    b: &[RawRun],
) -> Result<bool, Diagnostic> {
    if a.len() == 1 && b.len() == 1 {
        return Ok(true);
    }
    // Many runs: the order within the list is written for one sense only. The corners must tell which.
    let reversed = |forward: bool| {
        // The other side is walked in the other sense.
        let side_a = a.windows(2).filter(|w| joined(garment, shapes, w, forward)).count();
        let side_b = b.windows(2).filter(|w| joined(garment, shapes, w, !forward)).count();
        side_a + side_b
    };
    let (forward, backward) = (reversed(true), reversed(false));
    // A ring of two pieces (an armhole) is joined at both ends in either sense: then the file must say it.
    if forward != backward || spec.reverse.is_some() {
        return Ok(forward >= backward);
    }
    let why = "names edges of several pieces, and their corners fit in both senses".to_owned();
    Err(both_readings(garment, shapes, spec, a, b, why))
}

/// Is the end of one run sewn to the start of the next by a seam that states its points?
fn joined(garment: &Garment, shapes: &Shapes, pair: &[RawRun], forward: bool) -> bool {
    let [x, y] = pair else { return false };
    let (end, start) = if forward { (x.to, y.from) } else { (x.from, y.to) };
    garment.plan.seams.iter().any(|s| {
        let find = |runs: &[toile_garment::sewing::RunSpec]| match runs {
            [only] => super::lookup::run(garment, shapes, only, None).ok(),
            _ => None,
        };
        let (Some(a), Some(b)) = (find(&s.a), find(&s.b)) else { return false };
        let same = s.reverse.map_or(a.stated && b.stated && a.forward == b.forward, |against| !against);
        let b = if a.stated == b.stated && a.stated || (a.forward == b.forward) == same { b } else { b.turned() };
        let is = |r: &RawRun, other: &RawRun, s0: f64, s1: f64| {
            let near = |run: &RawRun, of: &RawRun, s: f64, t: f64| {
                let ring = &shapes[run.piece.index()].rings[run.ring];
                run.piece == of.piece && run.ring == of.ring && (ring.at(s) - ring.at(t)).norm() < SAME
            };
            near(r, x, s0, end) && near(other, y, s1, start)
        };
        [(a.from, b.from), (a.to, b.to)].iter().any(|(s0, s1)| is(&a, &b, *s0, *s1) || is(&b, &a, *s1, *s0))
    })
}

/// Notches that fit the other reading and not this one.
fn check_notches(
    garment: &Garment,
    shapes: &Shapes,
    spec: &SeamSpec,
    a: &[RawRun],
    b: &[RawRun],
) -> Result<(), Diagnostic> {
    let turned: Vec<RawRun> = b.iter().rev().map(RawRun::turned).collect();
    let Ok(side_a) = side::side(garment, shapes, spec, a) else { return Ok(()) };
    let fit = |runs: &[RawRun]| {
        side::side(garment, shapes, spec, runs).ok().and_then(|b| notches::misfit(garment, shapes, &side_a, &b))
    };
    let (Some(here), Some(there)) = (fit(b), fit(&turned)) else { return Ok(()) };
    if here > notches::TOLERANCE && there <= notches::TOLERANCE {
        let why = format!("has notches that fit the other direction ({:.0} % off here)", here * 100.0);
        return Err(both_readings(garment, shapes, spec, a, b, why));
    }
    Ok(())
}

fn both_readings(
    garment: &Garment,
    shapes: &Shapes,
    spec: &SeamSpec,
    a: &[RawRun],
    b: &[RawRun],
    why: String,
) -> Diagnostic {
    let end = |r: Option<&RawRun>, start: bool| {
        r.map_or(String::new(), |r| {
            let ring = &shapes[r.piece.index()].rings[r.ring];
            let at = ring.at(if start { r.from } else { r.to });
            format!("`{}` {}", garment.pieces[r.piece.index()].name, mm(at))
        })
    };
    let (a0, a1) = (end(a.first(), true), end(a.last(), false));
    let (b0, b1) = (end(b.first(), true), end(b.last(), false));
    let message = format!(
        "seam `{}` {why}. One reading: {a0} meets {b0} and {a1} meets {b1}. The other: {a0} meets {b1} and {a1} meets {b0}",
        spec.name
    );
    Diagnostic::error(codes::SEAM_DIRECTION_AMBIGUOUS, message).at(spec.source.clone()).hint(
        if spec.reverse.is_some() {
            "list the edges of one side the other way round, or give both sides by two points (a.from meets b.from)"
        } else {
            "state reverse = true or false, or give both sides by two points (a.from meets b.from)"
        },
    )
}
