//! Speculative steps: cloth that touches itself nowhere goes on without detection of self-contact. Most often it would not have
//! met itself. Where continuous detection along the straight way says that it may have, the cloth is taken back, and detection
//! accompanies every step for a while.

use crate::optimize::descent::{Change, Descent};
use crate::optimize::mechanism::{Block, Mechanism};
use crate::optimize::speculation::Checkpoint;
use crate::optimize::tuning::{
    SPECULATION, SPECULATION_BLOCKS_FIRST, SPECULATION_BLOCKS_MOST, SPECULATION_WAIT_FIRST, SPECULATION_WAIT_MOST,
};

impl Descent<'_> {
    /// Takes a block that is checked at its end. A block that fails the check is taken again with detection in every step.
    pub fn take_checked_block(&mut self, steps: usize, mechanisms: &mut [&mut dyn Mechanism]) -> Block {
        if !self.speculates() {
            return self.take_detected_block(steps, mechanisms);
        }
        let block = self.take_speculative_block(steps, mechanisms);
        // Cloth that is taken back stands where the block began. The preconditioner still fits, so the block is repeated.
        if self.check_or_roll_back() { block } else { self.take_steps(steps, mechanisms) }
    }

    /// Takes a block whose check may be left open until [`Self::check_or_roll_back`]. `None` if instead the cloth has been
    /// taken back and needs another preconditioner.
    pub fn take_block_ahead(&mut self, steps: usize, mechanisms: &mut [&mut dyn Mechanism]) -> Option<Block> {
        let far = self.speculation.blocks >= self.speculation.most_blocks;
        if (far || !self.touches_itself_nowhere()) && !self.check_or_roll_back() {
            return None;
        }
        Some(if self.speculates() {
            self.take_speculative_block(steps, mechanisms)
        } else {
            self.take_detected_block(steps, mechanisms)
        })
    }

    /// Checks the blocks ahead of detection, if there are any; `false` if the cloth had to be taken back.
    pub fn check_or_roll_back(&mut self) -> bool {
        let Some(checkpoint) = self.speculation.checkpoint.take() else { return true };
        self.speculation.blocks = 0;
        let to = std::mem::take(&mut self.x);
        let clear = self.detection().is_none_or(|b| b.is_clear_between(&checkpoint.x, &to));
        self.x = to;
        let s = &mut self.speculation;
        if clear {
            s.most_blocks = (2 * s.most_blocks).min(SPECULATION_BLOCKS_MOST.get());
            return true;
        }
        s.next_wait = (2 * s.next_wait).clamp(SPECULATION_WAIT_FIRST.get(), SPECULATION_WAIT_MOST.get());
        (s.wait, s.most_blocks) = (s.next_wait, SPECULATION_BLOCKS_FIRST.get());
        self.roll_back_to(checkpoint);
        false
    }

    fn touches_itself_nowhere(&self) -> bool {
        self.objective().terms.barrier.as_ref().is_some_and(|b| b.may_defer_self_detection())
    }

    fn speculates(&self) -> bool {
        SPECULATION.is_on()
            && (self.speculation.checkpoint.is_some() || self.speculation.wait == 0 && self.touches_itself_nowhere())
    }

    /// Takes a block without detection of self-contact.
    fn take_speculative_block(&mut self, steps: usize, mechanisms: &mut [&mut dyn Mechanism]) -> Block {
        if self.speculation.checkpoint.is_none() {
            self.speculation.checkpoint = Some(self.checkpoint());
        }
        self.speculation.blocks += 1;
        self.detection().into_iter().for_each(|b| b.defer_self_detection());
        let block = self.take_steps(steps, mechanisms);
        self.detection().into_iter().for_each(|b| b.resume_self_detection());
        block
    }

    /// Takes a block with detection of self-contact in every step.
    fn take_detected_block(&mut self, steps: usize, mechanisms: &mut [&mut dyn Mechanism]) -> Block {
        let touches =
            |d: &Self| d.objective().terms.barrier.as_ref().map_or(0, |b| b.statistics.evaluations_with_self_contact);
        let (before, free) = (touches(self), self.touches_itself_nowhere());
        let block = self.take_steps(steps, mechanisms);
        if free && touches(self) == before {
            self.speculation.wait = self.speculation.wait.saturating_sub(1);
        }
        block
    }

    fn checkpoint(&self) -> Checkpoint {
        let terms = &self.objective().terms;
        Checkpoint {
            x: self.x.clone(),
            tau: self.regularization.tau,
            isotropic: self.regularization.isotropic,
            steps: self.steps,
            friction: terms.friction.clone(),
            hysteresis: terms.hysteresis.clone(),
        }
    }

    /// Takes the cloth back. Contacts that were stiffened on the way stay so. The history is cleared: keeping the one from
    /// before would take as much memory as all other vectors.
    fn roll_back_to(&mut self, checkpoint: Checkpoint) {
        let Checkpoint { x, tau, isotropic, steps, friction, hysteresis } = checkpoint;
        (self.x, self.steps) = (x, steps);
        (self.regularization.tau, self.regularization.isotropic) = (tau, isotropic);
        self.change(|o, x| {
            (o.terms.friction, o.terms.hysteresis) = (friction, hysteresis);
            o.terms.barrier.iter_mut().for_each(|b| b.rebuild_lists(x));
            Change::Energy
        });
    }
}

#[cfg(all(test, feature = "self-contact"))]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::collision::crossings::count;
    use crate::optimize::drape::settle;
    use crate::optimize::task::Task;
    use crate::optimize::test_sheets;
    use crate::{Material, Scene, Settings, Silent, StopReason, Switch, Vec3};

    const SIDE: u32 = 8;
    const HIGH: f64 = 0.03;

    /// A square held all round, and a flap above it that is held by one edge and would hang through it.
    fn flap() -> Scene {
        let mut scene = Scene { materials: vec![Material::isotropic(0.15, 500.0, 0.0, 1e-5)], ..Scene::default() };
        scene.gravity = Vec3::new(0.0, -9.81, 0.0);
        test_sheets::add(&mut scene, SIDE, 0.3, 0.0, |i, j| i.min(j) == 0 || i.max(j) == SIDE);
        test_sheets::add(&mut scene, SIDE, 0.15, HIGH, |i, _| i == 0);
        scene
    }

    /// Settles it. Returns the lowest place of the flap, crossings, and the blocks that were ahead and taken back.
    fn rests(self_contact: Switch) -> (f64, usize, [u64; 2]) {
        let scene = flap();
        let mut settings = Settings::default();
        settings.effects.self_contact = self_contact;
        let mut d = Descent::begin(&scene, &settings, Task::Settle).unwrap();
        assert_eq!(settle(&mut d, Task::Settle, &mut Silent).unwrap(), StopReason::Settled);
        let faces: Vec<[u32; 3]> = scene.triangles.iter().map(|t| t.vertices).collect();
        let lowest = d.x[81..].iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
        let tally = d
            .objective()
            .terms
            .barrier
            .as_ref()
            .map_or([0; 2], |b| [b.statistics.deferred_blocks, b.statistics.rolled_back_blocks]);
        (lowest, count::self_crossings(&d.x, &faces).count, tally)
    }

    #[test]
    fn cloth_that_met_itself_on_the_way_is_taken_back() {
        let (lowest, crossings, tally) = rests(Switch::On);
        assert!(lowest > -0.01 && crossings == 0, "{lowest} {crossings}");
        assert!(tally[1] > 0 && tally[0] > tally[1], "{tally:?}");
        let (lowest, ..) = rests(Switch::Off);
        assert!(lowest < -0.1, "{lowest}");
    }
}
