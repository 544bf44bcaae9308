//! Is a line the cut line moved inwards by the allowance? Then it is the sew line, however narrow the piece is.

use crate::dxf::chain::Path;
use crate::dxf::geom;
use std::ops::RangeInclusive;
use toile_garment::Vec2;

/// Width of a seam allowance, mm.
pub(super) const ALLOWANCE: RangeInclusive<f64> = 3.0..=40.0;
/// Places along each of the two lines that are looked at.
const PLACES: usize = 400;
/// Most vertices of a line that is looked at.
const VERTICES: usize = 20_000;
/// The boxes of both lines lie at most this far apart on each side, in allowances. A mitre is longer than the
/// allowance.
const BOX: f64 = 1.5;
/// Share of the cut line that must have the sew line an allowance away, or on itself. Corners take the rest.
const COVERED: f64 = 0.9;
/// Share of the cut line beside the fold that must have an allowance. Hems and other sides may be drawn without one. A
/// facing along an edge shares three sides with its piece, so less of that has an allowance.
const WITH_ALLOWANCE: f64 = 0.5;
/// Share of the sew line that must run along the cut line. The inner ends of darts take the rest.
const ALONG: f64 = 0.6;
/// Sine of the angle within which two lines run along each other.
const PARALLEL: f64 = 0.2;
/// A sew line may run this far outside the cut line by rounding, mm.
pub(super) const OUTSIDE: f64 = 0.5;

/// A place on a line, and the direction of the line there.
struct Place {
    at: Vec2,
    along: Vec2,
}

/// Is a line this closed cut line moved inwards by an allowance?
pub(crate) fn is_moved_inwards(cut: &[Vec2], line: &Path) -> bool {
    is_offset(cut, line, None, &ALLOWANCE)
}

/// Does `sew` run inside the closed line `cut` all round, an allowance away? Sides may have no allowance, if others have
/// one. What lies on `fold` has none.
pub(super) fn is_offset(cut: &[Vec2], sew: &Path, fold: Option<[Vec2; 2]>, allowance: &RangeInclusive<f64>) -> bool {
    let line = sew.positions();
    if line.len() > VERTICES || !boxes_fit(cut, &line, *allowance.end()) {
        return false;
    }
    let inside = |p: &Vec2| geom::inside(*p, cut) || geom::distance(*p, cut, true) <= OUTSIDE;
    if !line.iter().step_by(line.len() / PLACES + 1).all(inside) {
        return false;
    }
    let on_fold = |p: Vec2| fold.is_some_and(|[a, b]| geom::cross(b - a, p - a).abs() <= OUTSIDE * (b - a).norm());
    let with_allowance = |p: &Place| allowance.contains(&geom::distance(p.at, &line, true));
    let covered = |p: &Place| on_fold(p.at) || with_allowance(p) || geom::distance(p.at, &line, true) <= OUTSIDE;
    let runs_along = |p: &Place| {
        geom::nearest(p.at, cut, true).is_some_and(|foot| {
            let away = p.at - foot.on(cut);
            // On the cut line itself there is no direction away from it.
            let square = away.norm() <= OUTSIDE || away.dot(&p.along).abs() <= PARALLEL * away.norm();
            (foot.distance <= OUTSIDE || allowance.contains(&foot.distance)) && square
        })
    };
    let around = places(cut, true);
    let (folded, free): (Vec<Place>, Vec<Place>) = around.into_iter().partition(|p| on_fold(p.at));
    let is_covered = |count: usize| count as f64 >= COVERED * (folded.len() + free.len()) as f64;
    is_covered(folded.len() + free.iter().filter(|p| covered(p)).count())
        && share(&free, with_allowance) >= WITH_ALLOWANCE
        && share(&places(&line, sew.closed), runs_along) >= ALONG
}

/// May the one line be the other, moved inwards? The boxes of both must be alike.
fn boxes_fit(cut: &[Vec2], sew: &[Vec2], most: f64) -> bool {
    let bounds = |line: &[Vec2]| geom::bounds(line.iter().copied());
    let Some(((lo, hi), (low, high))) = bounds(cut).zip(bounds(sew)) else { return false };
    let near = |d: Vec2| d.x.abs().max(d.y.abs()) <= BOX * most;
    near(low - lo) && near(hi - high)
}

/// Share of the places of which something is true.
fn share(places: &[Place], is: impl Fn(&Place) -> bool) -> f64 {
    places.iter().filter(|p| is(p)).count() as f64 / places.len().max(1) as f64
}

/// Places at even ways along a line.
fn places(line: &[Vec2], closed: bool) -> Vec<Place> {
    let n = line.len();
    let step = geom::length(line, closed) / PLACES as f64;
    let segments = if closed { n } else { n.saturating_sub(1) };
    let (mut out, mut next) = (Vec::with_capacity(PLACES), 0.5 * step);
    for i in 0..segments {
        let (a, d) = (line[i], line[(i + 1) % n] - line[i]);
        let length = d.norm();
        while next < length && step > 0.0 {
            out.push(Place { at: a + d * (next / length), along: d / length });
            next += step;
        }
        next -= length;
    }
    out
}
