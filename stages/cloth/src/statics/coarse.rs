//! Sewing from coarse to fine: the coarsest level is sewn and rests, every finer one starts from where the coarser lies,
//! its seams already one (docs/levels.md).

use super::close::{STRIDE, close};
use super::descent::Descent;
use super::report;
use crate::levels::Level;
use crate::sewing::mean_edge;
use crate::start::Start;
use crate::{ClothError, Outcome, Scene, Settings, StopReason, Vec3, Watch, weld};

/// Widest gap over the mean edge that welding may close.
const NEARLY: f64 = 0.3;
/// Energy won in a block over the elastic energy at which a level is smooth enough to go on from.
const SMOOTH: f64 = 0.01;
/// What slides farther than this falls, m.
const FARTHEST: f64 = 0.15;
/// Shift (mass / τ) from which the metric is the cloth's own, s², and blocks without a step after which it stays.
const FREE: f64 = 1.0;
const MOST_STUCK: u32 = 6;
/// … and with little won.
const STILL: u32 = 3;
/// Mean part of the steps of a block whose win counts.
const FAIR: f64 = 0.3;
/// Most steps spent on it.
const MOST: u64 = 240;

/// Closes the stitches; `None` where something stays in the way.
pub(crate) fn sew(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
    sew_level(scene, true, settings, watch)
}

/// As [`sew`]; `finest`: no finer cloth hangs on this one.
fn sew_level(
    scene: &Scene,
    finest: bool,
    settings: &Settings,
    watch: &mut dyn Watch,
) -> Result<Option<Outcome>, ClothError> {
    if let Some(outcome) = from_below(scene, finest, settings, watch)? {
        return Ok(Some(outcome));
    }
    close(scene, settings, watch)
}

/// Sews the next coarser level first; `None` where there is none, where it cannot be sewn, or where the finer cloth would
/// cross something there.
fn from_below(
    scene: &Scene,
    finest: bool,
    settings: &Settings,
    watch: &mut dyn Watch,
) -> Result<Option<Outcome>, ClothError> {
    if scene.stitches.is_empty() {
        return Ok(None);
    }
    let Some(level) = Level::below(scene) else { return Ok(None) };
    let Some(sewn) = sew_level(&level.scene, false, settings, watch)? else { return Ok(None) };
    if sewn.seam_gap_max > NEARLY * mean_edge(&level.scene) {
        return Ok(None);
    }
    let steps = sewn.steps;
    let Some(below) = let_down(&level.scene, false, &sewn.positions, settings, watch)? else { return Ok(None) };
    let x = level.spread(&below.positions);
    let Some(mut outcome) = let_down(scene, finest, &x, settings, watch)? else { return Ok(None) };
    outcome.steps += steps + below.steps;
    Ok(Some(outcome))
}

/// Lets what is sewn slide down into its place, as hands would, without friction; what would slide off stays.
fn let_down(
    scene: &Scene,
    finest: bool,
    x: &[Vec3],
    settings: &Settings,
    watch: &mut dyn Watch,
) -> Result<Option<Outcome>, ClothError> {
    let heavy = Settings { gravity_scale: 1.0, ..settings.clone() };
    let down = smooth(scene, finest, x, &heavy, watch)?;
    let slid = |o: &Outcome| x.iter().zip(&o.positions).map(|(p, q)| (p - q).norm()).fold(0.0, f64::max);
    if down.as_ref().is_some_and(|o| slid(o) > FARTHEST) { smooth(scene, finest, x, settings, watch) } else { Ok(down) }
}

/// Lets the cloth, its seams welded, come near to rest from `x`; `None` where it crosses something there.
fn smooth(
    scene: &Scene,
    finest: bool,
    x: &[Vec3],
    settings: &Settings,
    watch: &mut dyn Watch,
) -> Result<Option<Outcome>, ClothError> {
    let welded = weld(scene, x);
    let start = match Start::new(&welded.scene, settings) {
        Ok(start) => start,
        Err(ClothError::StartCrosses { .. }) => return Ok(None),
        Err(e) => return Err(e),
    };
    let repaired = start.repaired;
    let mut descent = Descent::new(&welded.scene, settings, start, false);
    if !finest {
        // Between the places where they should be held, coarse cloth would cut through a round body.
        descent.hold_here();
    }
    descent.stride = STRIDE;
    let (mut stuck, mut still) = (0, 0);
    while descent.steps < MOST && stuck <= MOST_STUCK && still < STILL {
        let b = descent.advance(watch, &format!("smoothing {} triangles", scene.triangles.len()))?;
        stuck = if b.steps == 0 { stuck + 1 } else { 0 };
        let little = b.won <= SMOOTH * descent.goal.elastic(&descent.x);
        // Little won under a large shift may only say that the shift is large.
        still = match (little && b.steps > 0, descent.tau >= FREE) {
            (true, true) => STILL,
            (true, false) if b.mean > FAIR => still + 1,
            (true, false) => still,
            _ => 0,
        };
    }
    let mut outcome = report::outcome(descent, &welded.scene, StopReason::Settled, repaired);
    outcome.positions = welded.spread(&outcome.positions);
    Ok(Some(outcome))
}
