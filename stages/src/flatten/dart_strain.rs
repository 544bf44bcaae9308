//! The strain of the cloth changes a dart; this is told apart from the change that the shape asks for.
//!
//! Worn cloth stretches around the tip of a dart, so the lengths of the worn surface give a smaller dart. That is no
//! reason to sew a smaller one. Where the strain is known, a dart on the lengths of the surface keeps the intake that
//! the stored lengths and the 3D edit give.
//!
//! A dart that an edit did not touch keeps its stored intake: what the cloth beside its legs is cut to has not changed.
//! The free answer turns it all the same, because it spreads the strain of an edit elsewhere over the whole piece.

use super::core::{Watch, fitted};
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

/// Why a dart is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Darts are locked, whatever the edit.
    Locked,
    /// The strain of the cloth alone would change it.
    Strain,
    /// The edit did not touch it.
    Untouched,
}

/// A dart that is held.
pub struct HeldDart<'a> {
    piece: &'a Piece,
    name: String,
    mouths: [usize; 2],
    /// Intake of the stored piece, and of the free answer, metres.
    intake: [f64; 2],
    reason: Reason,
    /// The terms that hold it.
    pub locks: Vec<Lock>,
}

impl HeldDart<'_> {
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
    if features.iter().all(|f| f.darts.is_empty()) || !(is_locked || is_told_apart || is_carried) {
        return Ok(Vec::new());
    }
    let stored: Vec<Vec2> = sources.iter().flat_map(|s| s.mesh.rest.iter().copied()).collect();
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
            let reason = match () {
                () if is_locked => Reason::Locked,
                () if is_told_apart => Reason::Strain,
                () if is_untouched(source, dart) => Reason::Untouched,
                () => continue,
            };
            let intake = |x: &[Vec2]| (x[mouths[1]] - x[mouths[0]]).norm();
            if (intake(free) - intake(&asked)).abs() < INTAKE_UNTOUCHED {
                continue;
            }
            out.push(HeldDart {
                piece: source.piece,
                name: dart.name.clone(),
                mouths,
                intake: [intake(&stored), intake(free)],
                reason,
                locks: gaps(source, dart, &asked, params.pair_stiffness),
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

/// The gap between the legs at every station.
fn gaps(source: &Source<'_>, dart: &ChainPair, asked: &[Vec2], stiffness: f64) -> Vec<Lock> {
    let pairs = dart.a.iter().zip(&dart.b).filter(|(a, b)| a != b);
    pairs
        .map(|(a, b)| {
            let v = [*a + source.offset, *b + source.offset];
            let length = (asked[v[1] as usize] - asked[v[0] as usize]).norm();
            Lock::Distance { v, length, stiffness }
        })
        .filter(|l| !matches!(l, Lock::Distance { length, .. } if *length < 1e-6))
        .collect()
}
