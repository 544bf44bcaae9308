//! Sewing from coarse to fine: the coarsest level is sewn and rests, every finer one starts from where the coarser lies,
//! its seams already one (docs/levels.md).

use crate::hierarchy::Level;
use crate::optimize::descent::Descent;
use crate::optimize::report;
use crate::optimize::strain_limit_homotopy::Locks;
use crate::report::watch::Part;
use crate::scene::measures::mean_edge;
use crate::scene::weld::weld;
use crate::sewing::closing::close;
use crate::{ClothError, Outcome, Scene, Settings, StopReason, Vec3, Watch};

/// Widest gap over the mean edge that welding may close.
const NEARLY: f64 = 0.3;
/// Energy won in a block over the elastic energy at which a level is smooth enough to go on from.
const SMOOTH: f64 = 0.01;
/// What slides farther than this falls, m.
const FARTHEST: f64 = 0.15;
/// τ with which letting down begins, s²: what is sewn lies near its rest.
const TAU_DOWN: f64 = 0.1;
/// Shift (mass / τ) from which the metric is the cloth's own, s², and blocks without a step after which it stays.
const FREE: f64 = 1.0;
const MOST_STUCK: u32 = 6;
/// … and with little won.
const STILL: u32 = 3;
/// Mean part of the steps of a block whose win counts.
const FAIR: f64 = 0.3;
/// Most steps spent on it.
const MOST: u64 = 240;

/// Parts of all work: sewing coarser levels, and letting down the coarser of two; sewing where there is one level only.
const SEWING_WORK: f64 = 0.5;
const DOWN_WORK: f64 = 0.65;
const ALONE_WORK: f64 = 0.8;

/// Closes the stitches; `None` where something stays in the way.
pub(crate) fn sew(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
    Step { scene, settings, finest: true }.sew(watch)
}

/// One level to be sewn.
#[derive(Clone, Copy)]
struct Step<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    /// No finer cloth hangs on it.
    finest: bool,
}

impl Step<'_> {
    fn sew(self, watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
        if let Some(outcome) = self.by_levels(watch)? {
            return Ok(Some(outcome));
        }
        let same = <[Vec3]>::to_vec;
        // Coarser cloth is let down by the finer one's.
        let work = if self.finest { ALONE_WORK } else { 1.0 };
        let closed = close(self.scene, self.settings, &mut Part::new(watch, [0.0, work], &same))?;
        let watch = &mut Part::new(watch, [work, 1.0], &same);
        match closed.as_ref().filter(|c| self.finest && c.seam_gap_max <= NEARLY * mean_edge(self.scene)) {
            // Else a garment that has no coarser level would hang where sewing left it.
            Some(c) => Ok(self.let_down(&c.positions, watch)?.map(|down| Outcome::after(down, c)).or(closed)),
            None => Ok(closed),
        }
    }

    /// Sews the next coarser level first; `None` where there is none, where it cannot be sewn, or where the finer cloth
    /// would cross something there.
    fn by_levels(self, watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
        if self.scene.stitches.is_empty() {
            return Ok(None);
        }
        let Some(level) = Level::below(self.scene) else { return Ok(None) };
        let below = Step { scene: &level.scene, finest: false, ..self };
        let spread = |x: &[Vec3]| level.spread(x);
        let Some(sewn) = below.sew(&mut Part::new(watch, [0.0, SEWING_WORK], &spread))? else { return Ok(None) };
        if sewn.seam_gap_max > NEARLY * mean_edge(&level.scene) {
            return Ok(None);
        }
        let mut part = Part::new(watch, [SEWING_WORK, DOWN_WORK], &spread);
        let Some(down) = below.let_down(&sewn.positions, &mut part)? else { return Ok(None) };
        let x = level.spread(&down.positions);
        watch.look(&x, level.scene.triangles.len());
        let mut watch = Part::new(watch, [DOWN_WORK, 1.0], &<[Vec3]>::to_vec);
        Ok(self.let_down(&x, &mut watch)?.map(|outcome| outcome.after(&sewn).after(&down)))
    }

    /// Lets what is sewn slide down into its place, as hands would, without friction; what would slide off stays.
    fn let_down(self, x: &[Vec3], watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
        let heavy = Settings { gravity_scale: 1.0, ..self.settings.clone() };
        let down = Step { settings: &heavy, ..self }.smooth(x, watch)?;
        let slid = |o: &Outcome| crate::farthest(x, &o.positions);
        if down.as_ref().is_some_and(|o| slid(o) > FARTHEST) { self.smooth(x, watch) } else { Ok(down) }
    }

    /// Lets the cloth, its seams welded, come near to rest from `x`; `None` where it crosses something there.
    fn smooth(self, x: &[Vec3], watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
        let welded = weld(self.scene, x);
        let mut descent = match Descent::begin(&welded.scene, self.settings, false) {
            Ok(descent) => descent,
            Err(ClothError::StartCrosses { .. }) => return Ok(None),
            Err(e) => return Err(e),
        };
        if !self.finest {
            // Between the places where they should be held, coarse cloth would cut through a round body.
            descent.hold_here();
        }
        descent.take_care();
        descent.tau = TAU_DOWN;
        descent.goal.set_rough(true);
        ease(&mut descent, self.scene.triangles.len(), watch)?;
        let mut outcome = report::outcome(&mut descent, &welded.scene, StopReason::Settled);
        outcome.positions = welded.spread(&outcome.positions);
        Ok(Some(outcome))
    }
}

/// Descends until little is won, with locks at the strain limits that become as narrow as the law has them on the way.
fn ease(descent: &mut Descent<'_>, triangles: usize, watch: &mut dyn Watch) -> Result<(), ClothError> {
    let (mut stuck, mut still) = (0, 0);
    let mut locks = descent.widen_locks();
    while descent.steps < MOST && stuck <= MOST_STUCK && still < STILL {
        let b = descent.advance(watch, &format!("smoothing {triangles} triangles"))?;
        watch.done((descent.steps as f64 / MOST as f64).sqrt());
        stuck = if b.steps == 0 { stuck + 1 } else { 0 };
        let little = b.won <= SMOOTH * descent.goal.elastic(&descent.x);
        // Little won by steps that fell short says nothing, and under a large shift only that the shift is large.
        still = match (little && b.steps > 0, b.mean > FAIR) {
            (true, true) if descent.tau >= FREE => STILL,
            (true, true) => still + 1,
            (true, false) => still,
            _ => 0,
        };
        if let (Locks::Wide(share), true) = (locks, still >= STILL) {
            let changed;
            (locks, changed) = descent.narrow_locks(share);
            still = if changed { 0 } else { still };
        }
    }
    Ok(())
}
