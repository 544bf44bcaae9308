//! The strain of the cloth changes a dart; this is told apart from the change that the shape asks for.
//!
//! Worn cloth stretches around the tip of a dart, so the lengths of the worn surface give a smaller dart. That is no
//! reason to sew a smaller one. Where the strain is known, a dart on the lengths of the surface keeps the intake that
//! the stored lengths and the 3D edit give.

use super::core::{Watch, fitted};
use super::features::{ChainPair, Features};
use super::findings;
use super::lock::Lock;
use super::params::{FlattenParams, LockKind};
use super::solve::Sheet;
use super::source::Source;
use toile_garment::flat::FlatMetric;
use toile_garment::{Garment, Piece, Report, Vec2};
use toile_stage_api::StageError;

/// Change of an intake below which nothing is held, metres.
const INTAKE_UNTOUCHED: f64 = 1e-5;

/// A dart that is held.
pub struct HeldDart<'a> {
    piece: &'a Piece,
    name: String,
    mouths: [usize; 2],
    /// Intake of the stored piece, and of the free answer, metres.
    intake: [f64; 2],
    /// True when it is held whatever the edit, false when it is held against the strain of the cloth alone.
    is_locked: bool,
    /// The terms that hold it.
    pub locks: Vec<Lock>,
}

impl HeldDart<'_> {
    /// Reports the dart with its intakes.
    pub fn tell(&self, x: &[Vec2], report: &mut Report) {
        let kept = (x[self.mouths[1]] - x[self.mouths[0]]).norm();
        report.push(findings::held_dart(self.piece, &self.name, self.intake, kept, self.is_locked));
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
    if features.iter().all(|f| f.darts.is_empty()) || !(is_locked || is_told_apart) {
        return Ok(Vec::new());
    }
    let stored: Vec<Vec2> = sources.iter().flat_map(|s| s.mesh.rest.iter().copied()).collect();
    let asked = if edited && !is_locked {
        let start = Sheet { start: stored.clone(), pairs: sheet.pairs.clone(), ..Sheet::default() };
        fitted(sources, FlatMetric::Carried, start, params, watch)?.solved.positions
    } else {
        stored.clone()
    };
    let mut out = Vec::new();
    for (source, features) in sources.iter().zip(features) {
        for dart in &features.darts {
            let Some(mouths) = mouths(source, dart) else { continue };
            let intake = |x: &[Vec2]| (x[mouths[1]] - x[mouths[0]]).norm();
            if (intake(free) - intake(&asked)).abs() < INTAKE_UNTOUCHED {
                continue;
            }
            out.push(HeldDart {
                piece: source.piece,
                name: dart.name.clone(),
                mouths,
                intake: [intake(&stored), intake(free)],
                is_locked,
                locks: gaps(source, dart, &asked, params.pair_stiffness),
            });
        }
    }
    Ok(out)
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
