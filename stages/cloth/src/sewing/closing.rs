//! Sewing: threads pull the stitched pairs together (docs/sewing.md).

use crate::collision::crossings::count;
use crate::optimize::descent::Descent;
use crate::optimize::report;
use crate::{ClothError, Outcome, Scene, Settings, StopReason, Vec3, Watch};

/// Pull of the threads at first, per length of seam, N/m, and at most.
const PULL_FIRST: f64 = 1.0;
const PULL_MOST: f64 = 300.0;
/// Blocks without much progress after which something must be in the way; a standstill counts four times.
const PATIENCE: u32 = 160;
/// Distance to the body at first, over the mean edge, and at most, m: farther off there is no room in a fitted garment.
const WIDE: f64 = 0.6;
const WIDEST: f64 = 0.012;
/// Pull from which cloth that no longer comes is let nearer to the body as it is pulled harder, N/m, and what is left of the
/// distance each time.
const CRAMPED: f64 = 40.0;
const NEARER: f64 = 0.7;
/// Longest step of a vertex over the mean edge: short enough that a contact is felt before it is passed, and that flat
/// cloth may bend.
const SEWING_STRIDE: f64 = 0.3;
/// Largest part of a step that is tried first, over that of the last step which was taken: cloth that is turned so far takes few
/// steps as a whole, and what was too much for one is so for the next.
const BOLDER: f64 = 1.3;
/// Widest gap over the mean edge at which a seam that no longer closes lets the cloth nearer to the body, and how near.
const NEARLY: f64 = 2.0;
const LEAST_WIDE: f64 = 0.05;
/// Gap over the mean edge at which the full pull acts while the pieces come together.
const REACH: f64 = 0.25;
/// Energy won in a block over the elastic energy at which a sewn state is good enough to drape.
const SEWN: f64 = 0.2;
/// Widest gap over the mean edge from which the threads are drawn tight.
const NEAR: f64 = 0.1;
/// Widest gap over the mean edge that is drawn shut where the full pull holds it open: the garment is tight there.
const DRAWN: f64 = 0.7;
/// A block that leaves more than this of the widest gap made no progress …
const SHRINKS: f64 = 0.9;
/// … and lets the threads pull so much harder.
const HARDER: f64 = 2.5;
/// Part of the work until the pieces are together.
const GATHERING: f64 = 0.8;
/// Part of the widest gap left after a block of the tightening above which nothing shrinks any more, if the block also won
/// no more than this of the elastic energy.
const AS_WIDE: f64 = 0.9;
const WON_NOTHING: f64 = 0.01;
/// Most steps of the tightening.
const MOST_TIGHTENING: u64 = 200;
/// Stitches closer than this share of the sewing distance are joined exactly.
const JOINED: f64 = 0.1;
/// Pull at the sewing distance in the end, N/m.
const PULL_SEWN: f64 = 1e4;

/// Closes the stitches: the threads pull harder from block to block, until all pairs are closed. `None` where something
/// stays in the way.
pub(crate) fn close(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Option<Outcome>, ClothError> {
    let mut descent = Descent::begin(scene, settings, true)?;
    if descent.goal.seams.is_some() {
        descent.goal.set_rough(true);
        let mut sewing = Sewing::new(&mut descent);
        if !sewing.gather(scene, watch)? {
            return Ok(None);
        }
        sewing.tighten(watch)?;
        descent.join(scene);
    }
    let open = descent.widest() > settings.sewing_distance;
    let reason = if open { StopReason::SeamsOpen } else { StopReason::Settled };
    Ok(Some(report::outcome(&mut descent, scene, reason)))
}

struct Sewing<'a, 'b> {
    descent: &'a mut Descent<'b>,
    /// Largest distance to the body as it should be in the end, m.
    gap: f64,
    /// Distance that is held for now, m.
    wide: f64,
    /// N/m.
    force: f64,
}

impl<'a, 'b> Sewing<'a, 'b> {
    fn new(descent: &'a mut Descent<'b>) -> Self {
        let gap = descent.goal.barrier.as_ref().map_or(0.0, |b| b.frame.body_gap.iter().copied().fold(0.0, f64::max));
        let wide = (WIDE * descent.goal.edge).min(WIDEST);
        // Threads pull single triangles to their limit; beside their stiffness steps would be micrometres.
        descent.widen_locks();
        let mut sewing = Self { descent, gap, wide, force: PULL_FIRST };
        sewing.stand_off(wide);
        sewing
    }

    fn pull(&mut self, force: f64, reach: f64) {
        self.force = force;
        if let Some(s) = &mut self.descent.goal.seams {
            (s.force, s.reach) = (force, reach);
        }
        self.descent.start_anew();
    }

    /// Holds the cloth further off the body than its gaps: what feels the body early slides round it.
    fn stand_off(&mut self, wide: f64) {
        self.wide = wide;
        if let Some(b) = &mut self.descent.goal.barrier {
            b.stand_off = wide;
            b.cover_anew(&self.descent.x);
        }
        self.descent.start_anew();
    }

    /// Brings the pieces together; `false` if they do not come.
    fn gather(&mut self, scene: &Scene, watch: &mut dyn Watch) -> Result<bool, ClothError> {
        let edge = self.descent.goal.edge;
        let reach = REACH * edge;
        self.descent.take_care();
        self.pull(PULL_FIRST, reach);
        self.descent.lay(scene);
        let mut idle = 0;
        let first = self.descent.widest();
        loop {
            let before = self.descent.widest();
            watch.done(GATHERING * ((first - before) / first.max(1e-12)).max(0.0));
            if before < self.wide {
                // Nearly closed: the distance to the body shrinks with the gaps.
                self.stand_off(before.max(0.5 * self.wide));
            }
            if before <= NEAR * edge {
                return Ok(true);
            }
            let b = self.descent.advance(watch, &format!("widest seam {:.1} mm open", before * 1e3))?;
            self.descent.tau = self.descent.tau.min(1.0);
            if self.descent.widest() <= SHRINKS * before {
                continue;
            }
            // Pull harder when the gaps no longer shrink by themselves.
            if self.force < PULL_MOST && b.steps > 3 && b.mean > 0.3 {
                self.pull(HARDER * self.force, reach);
                if self.force >= CRAMPED && self.wide > LEAST_WIDE * edge {
                    self.stand_off(NEARER * self.wide);
                }
            } else if self.force >= PULL_MOST && before < NEARLY * edge && self.wide > LEAST_WIDE * edge {
                // In a narrow place the body itself may hold the gap open.
                self.stand_off(NEARER * self.wide);
            } else {
                // Short steps are no standstill yet, no steps are.
                idle += if b.steps == 0 || self.force >= PULL_MOST { 4 } else { 1 };
            }
            if idle > PATIENCE {
                return Ok(before <= DRAWN * edge);
            }
        }
    }

    /// Draws the threads tight while the cloth comes to its distance from the body.
    fn tighten(&mut self, watch: &mut dyn Watch) -> Result<(), ClothError> {
        let distance = self.descent.settings.sewing_distance;
        self.pull(PULL_SEWN, distance);
        let most = self.descent.steps + MOST_TIGHTENING;
        let mut last = f64::INFINITY;
        while self.descent.steps < most {
            let widest = self.descent.widest();
            let done = 1.0 - (most - self.descent.steps) as f64 / MOST_TIGHTENING as f64;
            watch.done(GATHERING + (1.0 - GATHERING) * done);
            let b = self.descent.advance(watch, &format!("widest seam {:.3} mm open", widest * 1e3))?;
            if self.wide > 0.0 {
                let next = 0.5 * self.wide;
                self.stand_off(if next <= self.gap { 0.0 } else { next });
                last = f64::INFINITY;
                continue;
            }
            let won = last - self.descent.energy;
            last = self.descent.energy;
            let elastic = self.descent.goal.elastic(&self.descent.x);
            let closed = self.descent.widest() <= 0.1 * distance;
            // Few stitches of tight cloth hold out against any pull: what is sewn is welded all the same.
            let in_vain = self.descent.widest() > AS_WIDE * widest && won <= WON_NOTHING * elastic;
            // The drape goes on from here: no need to rest.
            if closed && won <= SEWN * elastic || in_vain || b.steps == 0 && won <= 0.0 {
                break;
            }
        }
        Ok(())
    }
}

impl Descent<'_> {
    /// Steps from here on are those of sewing.
    pub(crate) fn take_care(&mut self) {
        (self.stride, self.bolder) = (SEWING_STRIDE, BOLDER);
    }

    /// Puts the members of closed stitches on one point, unless something would cross.
    fn join(&mut self, scene: &Scene) {
        let gap = |s: &&[u32; 2]| (self.x[s[0] as usize] - self.x[s[1] as usize]).norm();
        let closed: Vec<[u32; 2]> =
            scene.stitches.iter().filter(|s| gap(s) <= JOINED * self.settings.sewing_distance).copied().collect();
        let group = crate::scene::weld::groups(self.x.len(), &closed);
        let mut sums = vec![(Vec3::zeros(), 0.0); self.x.len()];
        for (x, g) in self.x.iter().zip(&group) {
            let (sum, n) = &mut sums[*g as usize];
            (*sum, *n) = (*sum + x, *n + 1.0);
        }
        let joined: Vec<Vec3> = (self.x.iter().zip(&group))
            .map(|(x, g)| if sums[*g as usize].1 > 1.0 { sums[*g as usize].0 / sums[*g as usize].1 } else { *x })
            .collect();
        let faces: Vec<[u32; 3]> = scene.triangles.iter().map(|t| t.vertices).collect();
        let free = self.goal.barrier.as_ref().is_none_or(|b| {
            (!b.frame.own || count::own(&joined, &faces).count <= count::own(&self.x, &faces).count)
                && b.body.as_ref().is_none_or(|b| count::with_body(&joined, &faces, b).count == 0)
        });
        if free {
            self.x = joined;
        }
    }

    /// Widest gap of a stitch, m.
    fn widest(&self) -> f64 {
        self.goal.seams.as_ref().map_or(0.0, |s| s.widest(&self.x))
    }
}
