//! The strain of the cloth changes a dart; this is told apart from the change that the shape asks for.
//!
//! Worn cloth stretches around the tip of a dart, so the lengths of the worn surface give a smaller dart. That is no
//! reason to sew a smaller one. Where the strain is known, a dart on the lengths of the surface keeps the intake that
//! the stored lengths and the 3D edit give.
//!
//! A dart that an edit did not touch keeps its stored intake: what the cloth beside its legs is cut to has not changed.
//! The free answer turns it all the same, because it spreads the strain of an edit elsewhere over the whole piece.
//!
//! A shape may ask for less than no intake. Then the legs of the free answer overlap, and no cloth can be cut so. Such a
//! dart is held open by a little.

use super::core::{Watch, fitted, stored};
use super::features::{ChainPair, Features};
use super::findings;
use super::lock::Lock;
use super::params::{FlattenParams, LockKind};
use super::solve::Sheet;
use super::source::Source;
use toile_garment::flat::FlatMetric;
use toile_garment::{Garment, Piece, Report, Vec2, Vec3};
use toile_stage_api::StageError;

/// Change of an intake below which nothing is held, metres.
const INTAKE_UNTOUCHED: f64 = 1e-5;

/// Change of the squared length of an edge that is rounding, as a share.
const SAME_LENGTH: f64 = 1e-4;

/// Intake of a dart whose legs would overlap, metres. It is less than is ever sewn, and enough to be cut and read.
const OPEN: f64 = 2e-3;

/// Why a dart is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// Darts are locked, whatever the edit.
    Locked,
    /// The strain of the cloth alone would change it.
    Strain,
    /// The edit did not touch it.
    Untouched,
    /// Its legs would overlap, by so much, metres.
    Overlap(f64),
}

/// A dart that is held.
pub struct HeldDart<'a> {
    piece: &'a Piece,
    name: String,
    mouths: [usize; 2],
    /// Intake of the stored piece, and of the free answer, metres.
    intake: [f64; 2],
    reason: Reason,
    /// By how much its legs overlap in the free answer, metres.
    overlap: f64,
    /// The terms that hold it.
    pub locks: Vec<Lock>,
}

impl HeldDart<'_> {
    /// Do its legs overlap in the free answer?
    pub fn overlaps(&self) -> bool {
        self.overlap > INTAKE_UNTOUCHED
    }

    /// Reports the dart with its intakes.
    pub fn tell(&self, x: &[Vec2], report: &mut Report) {
        let kept = (x[self.mouths[1]] - x[self.mouths[0]]).norm();
        report.push(findings::held_dart(self.piece, &self.name, self.intake, kept, self.reason));
    }
}

/// The darts whose intake the free answer would change without need.
///
/// # Errors
/// When the solve for the shape alone does not come to rest.
#[allow(clippy::too_many_arguments, reason = "all of it is the state of one flattening")]
pub fn find<'a>(
    garment: &Garment,
    sources: &[Source<'a>],
    features: &[Features],
    metric: FlatMetric,
    sheet: &Sheet,
    free: &[Vec2],
    params: &FlattenParams,
    watch: &mut Watch<'_>,
) -> Result<Vec<HeldDart<'a>>, StageError> {
    let is_locked = params.locks(LockKind::Darts);
    let edited = garment.drape_before_edit.is_some();
    let strain_is_known = garment.certificate.is_some() || edited;
    let is_told_apart = metric == FlatMetric::Surface && strain_is_known;
    let is_carried = metric == FlatMetric::Carried && edited;
    if features.iter().all(|f| f.darts.is_empty()) {
        return Ok(Vec::new());
    }
    let stored = stored(sources);
    let asked = if is_told_apart && edited && !is_locked {
        let start = Sheet { start: stored.clone(), pairs: sheet.pairs.clone(), ..Sheet::default() };
        fitted(sources, FlatMetric::Carried, start, params, watch)?.solved.positions
    } else {
        stored.clone()
    };
    let mut out = Vec::new();
    for (source, features) in sources.iter().zip(features) {
        for dart in &features.darts {
            let Some(mouths) = mouths(source, dart) else { continue };
            let stations = stations(source, dart, &stored);
            let intake = |x: &[Vec2]| stations.first().map_or(0.0, |s| s.gap(x));
            let overlap = stations.iter().map(|s| -s.gap(free)).fold(0.0, f64::max);
            let reason = match () {
                () if is_locked => Reason::Locked,
                () if is_told_apart => Reason::Strain,
                () if is_carried && is_untouched(source, dart) => Reason::Untouched,
                () if overlap > INTAKE_UNTOUCHED => Reason::Overlap(overlap),
                () => continue,
            };
            let is_open = matches!(reason, Reason::Overlap(_));
            let held = if is_open { free } else { &asked };
            let locks = gaps(&stations, held, params.pair_stiffness);
            if !is_open && (intake(free) - intake(&asked)).abs() < INTAKE_UNTOUCHED {
                continue;
            }
            out.push(HeldDart {
                piece: source.piece,
                name: dart.name.clone(),
                mouths,
                intake: [intake(&stored), intake(free)],
                reason,
                overlap,
                locks,
            });
        }
    }
    Ok(out)
}

/// Do all triangles at the legs of a dart have the lengths that they had before the edit?
fn is_untouched(source: &Source<'_>, dart: &ChainPair) -> bool {
    let is_leg = |v: &u32| dart.a.contains(v) || dart.b.contains(v);
    let length = |at: &[Vec3], [a, b]: [u32; 2]| (at[b as usize] - at[a as usize]).norm_squared();
    let is_same = |side: [u32; 2]| {
        let before = length(source.before, side);
        (length(source.surface, side) - before).abs() <= SAME_LENGTH * before
    };
    let at_legs = source.mesh.triangles.iter().filter(|t| t.iter().any(is_leg));
    at_legs.into_iter().all(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]].into_iter().all(is_same))
}

fn mouths(source: &Source<'_>, dart: &ChainPair) -> Option<[usize; 2]> {
    let at = |leg: &[u32]| leg.first().map(|v| (*v + source.offset) as usize);
    Some([at(&dart.a)?, at(&dart.b)?])
}

/// Two vertices of a dart that are sewn to each other.
struct Station {
    /// The apex, and the vertices on both legs.
    v: [u32; 3],
    /// The gap in the stored piece, metres. It is counted against its side, so that it is over 0.
    stored: f64,
    /// Which side the second leg lies on: 1 or −1.
    side: f64,
    /// Least gap that can be cut, metres.
    least: f64,
}

impl Station {
    /// The gap between the legs, metres; below 0 where they overlap.
    fn gap(&self, x: &[Vec2]) -> f64 {
        let [apex, a, b] = self.v.map(|v| x[v as usize]);
        (b - a).norm().copysign(self.side * (a - apex).perp(&(b - apex)))
    }
}

/// The stations of a dart from its mouth on. A least gap shrinks towards the apex as the stored one does.
fn stations(source: &Source<'_>, dart: &ChainPair, stored: &[Vec2]) -> Vec<Station> {
    let Some(apex) = dart.a.last() else { return Vec::new() };
    let station = |(a, b): (&u32, &u32)| {
        let v = [*apex, *a, *b].map(|v| v + source.offset);
        let [p, a, b] = v.map(|v| stored[v as usize]);
        let side = 1f64.copysign((a - p).perp(&(b - p)));
        Station { v, stored: (b - a).norm(), side, least: 0.0 }
    };
    let mut out: Vec<Station> = dart.a.iter().zip(&dart.b).filter(|(a, b)| a != b).map(station).collect();
    let mouth = out.first().map_or(0.0, |s| s.stored);
    out.iter_mut().for_each(|s| s.least = s.stored * (OPEN / mouth.max(OPEN)));
    out
}

/// The gap between the legs at every station.
fn gaps(stations: &[Station], asked: &[Vec2], stiffness: f64) -> Vec<Lock> {
    let lock = |s: &Station| Lock::Distance { v: [s.v[1], s.v[2]], length: s.gap(asked).max(s.least), stiffness };
    let is_one = |l: &Lock| !matches!(l, Lock::Distance { length, .. } if *length < 1e-6);
    stations.iter().map(lock).filter(is_one).collect()
}
