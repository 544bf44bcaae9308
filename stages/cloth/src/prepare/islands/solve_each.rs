//! Drapes islands, each as a scene of its own, and joins their outcomes.

use crate::collision::broad_phase::aabb::Aabb;
use crate::prepare::islands::Island;
use crate::prepare::islands::thread_pool;
use crate::prepare::islands::thread_pool::Word;
use crate::scene::measures::OPEN_STITCHES_MOST;
use crate::{ClothError, EffectReport, Outcome, Place, Reaction, Scene, StopReason, Vec3, Watch};

/// Drapes every island by itself, `threads` at a time; `None` where one left its box.
///
/// # Errors
/// The error of the first island that has one.
pub(crate) fn each(
    scene: &Scene,
    groups: &[Island],
    threads: usize,
    watch: &mut dyn Watch,
    drape: impl Fn(&Scene, &mut dyn Watch) -> Result<Outcome, ClothError> + Sync,
) -> Result<Option<Outcome>, ClothError> {
    let mut shown = Shown::new(scene, groups);
    let work = |k: usize, watch: &mut dyn Watch| drape(&groups[k].scene, watch);
    let draped = thread_pool::work(groups.len(), threads, watch, work, |k, word, watch| shown.tell(k, word, watch));
    let (mut whole, mut positions) = (None, shown.positions);
    // The order is that of one thread.
    for (g, outcome) in groups.iter().zip(draped) {
        let outcome = outcome.map_err(|e| e.placed(|p| g.told(p)))?;
        let stays = |p: &Vec3| g.within.meets(&Aabb::of_one(p));
        if !outcome.positions.iter().all(stays) {
            return Ok(None);
        }
        g.put(&outcome.positions, &mut positions);
        let own = g.named(outcome);
        whole = Some(match whole {
            None => own,
            Some(w) => joined(w, own),
        });
    }
    Ok(whole.map(|w| Outcome { positions, ..w }))
}

/// The whole cloth on the way, for a watch.
struct Shown<'a> {
    groups: &'a [Island],
    positions: Vec<Vec3>,
    /// Share of each island in all work.
    shares: Vec<f64>,
    /// Part of each island's work that is done.
    done: Vec<f64>,
}

impl<'a> Shown<'a> {
    fn new(scene: &Scene, groups: &'a [Island]) -> Self {
        let all = groups.iter().map(|g| g.scene.triangles.len()).sum::<usize>().max(1) as f64;
        let shares = groups.iter().map(|g| g.scene.triangles.len() as f64 / all).collect();
        Self { groups, positions: scene.positions.clone(), shares, done: vec![0.0; groups.len()] }
    }

    /// Passes on a message of an island as one of the whole.
    fn tell(&mut self, k: usize, word: Word, watch: &mut dyn Watch) {
        match word {
            Word::Progress(step, words) => watch.progress(step, &words),
            Word::Done(part) => {
                self.done[k] = part;
                watch.done(self.done.iter().zip(&self.shares).map(|(d, s)| d * s).sum());
            }
            Word::Look(x, triangles) => {
                self.groups[k].put(&x, &mut self.positions);
                watch.look(&self.positions, triangles);
            }
        }
    }
}

impl Island {
    /// The outcome with the numbers of vertices and stitches in the whole scene.
    fn named(&self, mut outcome: Outcome) -> Outcome {
        for r in &mut outcome.reactions {
            *r = Reaction { vertex: self.vertices[r.vertex as usize], ..*r };
        }
        outcome.open_stitches.iter_mut().for_each(|s| s.0 = self.stitches[s.0 as usize]);
        outcome
    }

    /// A place with the number of its triangle in the whole scene.
    fn told(&self, place: Place) -> Place {
        Place { triangle: self.triangles.get(place.triangle as usize).copied().unwrap_or(place.triangle), ..place }
    }
}

/// The outcome of two islands together.
fn joined(a: Outcome, b: Outcome) -> Outcome {
    let (more, less) = if b.energy > a.energy { (&b, &a) } else { (&a, &b) };
    let effects = more.effects.iter().map(|e| {
        let other = less.effects.iter().find(|o| o.name == e.name);
        EffectReport {
            on: e.on || other.is_some_and(|o| o.on),
            cpu_seconds: e.cpu_seconds + other.map_or(0.0, |o| o.cpu_seconds),
            ..e.clone()
        }
    });
    let effects = effects.collect();
    let mut open_stitches = [a.open_stitches, b.open_stitches].concat();
    open_stitches.sort_by(|p, q| q.1.total_cmp(&p.1).then(p.0.cmp(&q.0)));
    open_stitches.truncate(OPEN_STITCHES_MOST);
    let mut reactions = [a.reactions, b.reactions].concat();
    reactions.sort_by_key(|r| r.vertex);
    Outcome {
        positions: Vec::new(),
        steps: a.steps + b.steps,
        seconds: a.seconds.max(b.seconds),
        settled: a.settled && b.settled,
        stop_reason: if a.stop_reason == StopReason::Settled { b.stop_reason } else { a.stop_reason },
        energy: a.energy + b.energy,
        speed_max: a.speed_max.max(b.speed_max),
        residual_rel: a.residual_rel.max(b.residual_rel),
        seam_gap_max: a.seam_gap_max.max(b.seam_gap_max),
        open_stitches,
        effects,
        reactions,
        repaired: (a.repaired.0 + b.repaired.0, a.repaired.1.max(b.repaired.1)),
        joined: a.joined + b.joined,
    }
}
