//! Blocks of steps ahead of their proof: cloth that touches itself nowhere goes on without a look at itself. Most often it would
//! not have met itself; where the straight way from there says that it may have, it is taken back, and looks for a while.

use crate::Vec3;
use crate::contact::lagged_friction::Stick;
use crate::energy::hysteresis::held::Hysteresis;
use crate::optimize::descent::{Block, Descent};

/// Blocks in which cloth must not touch itself after it was taken back, before it goes ahead again: at first, and at most; they
/// double each time.
const FIRST_PATIENCE: u32 = 4;
const MOST_PATIENCE: u32 = 64;
/// Blocks to one proof where it may be left open: at first, and at most; twice as many after each.
const FIRST_FAR: u32 = 2;
const FARTHEST: u32 = 4;

/// When blocks go ahead, and from where.
pub(crate) struct Ahead {
    wait: u32,
    patience: u32,
    /// Where the last proof ended, once there are blocks ahead of it.
    mark: Option<Mark>,
    /// How many there are, and how many there may be.
    blocks: u32,
    far: u32,
}

impl Default for Ahead {
    fn default() -> Self {
        Self { wait: 0, patience: 0, mark: None, blocks: 0, far: FIRST_FAR }
    }
}

/// What is known of a place to which the cloth may be taken back, with what it is held by there.
struct Mark {
    x: Vec<Vec3>,
    tau: f64,
    firm: f64,
    steps: u64,
    stick: Option<Stick>,
    hysteresis: Option<Hysteresis>,
}

impl Descent<'_> {
    /// Of at least `few` steps, if none ends it; proved.
    pub fn block(&mut self, few: usize) -> Block {
        if !self.goes_ahead() {
            return self.watched_block(few);
        }
        let block = self.blind_block(few);
        // What is taken back has the same metric as before.
        if self.is_proved() { block } else { self.take_steps(few) }
    }

    /// The same with its proof left open where it may be ([`Self::is_proved`]); `None` if instead the cloth has been taken back,
    /// and needs another metric.
    pub fn block_ahead(&mut self, few: usize) -> Option<Block> {
        let far = self.ahead.blocks >= self.ahead.far;
        if (far || !self.may_look_away()) && !self.is_proved() {
            return None;
        }
        Some(if self.goes_ahead() { self.blind_block(few) } else { self.watched_block(few) })
    }

    /// Proves what is ahead of its proof, if anything is; `false` if the cloth had to be taken back.
    pub fn is_proved(&mut self) -> bool {
        let Some(mark) = self.ahead.mark.take() else { return true };
        self.ahead.blocks = 0;
        if self.goal.barrier.as_mut().is_none_or(|b| b.is_clear_between(&mark.x, &self.x)) {
            self.ahead.far = (2 * self.ahead.far).min(FARTHEST);
            return true;
        }
        self.ahead.patience = (2 * self.ahead.patience).clamp(FIRST_PATIENCE, MOST_PATIENCE);
        (self.ahead.wait, self.ahead.far) = (self.ahead.patience, FIRST_FAR);
        self.return_to(mark);
        false
    }

    fn may_look_away(&self) -> bool {
        self.goal.barrier.as_ref().is_some_and(|b| b.may_look_away())
    }

    fn goes_ahead(&self) -> bool {
        self.ahead.mark.is_some() || self.ahead.wait == 0 && self.may_look_away()
    }

    /// Without a look at the cloth itself.
    fn blind_block(&mut self, few: usize) -> Block {
        if self.ahead.mark.is_none() {
            self.ahead.mark = Some(self.mark());
        }
        self.ahead.blocks += 1;
        self.goal.barrier.iter_mut().for_each(|b| b.look_away());
        let block = self.take_steps(few);
        self.goal.barrier.iter_mut().for_each(|b| b.look_again());
        block
    }

    /// With a look at the cloth itself in every step.
    fn watched_block(&mut self, few: usize) -> Block {
        let touches = |d: &Self| d.goal.barrier.as_ref().map_or(0, |b| b.tally.own_looks);
        let (before, free) = (touches(self), self.may_look_away());
        let block = self.take_steps(few);
        if free && touches(self) == before {
            self.ahead.wait = self.ahead.wait.saturating_sub(1);
        }
        block
    }

    fn mark(&self) -> Mark {
        Mark {
            x: self.x.clone(),
            tau: self.tau,
            firm: self.firm,
            steps: self.steps,
            stick: self.goal.stick.clone(),
            hysteresis: self.goal.hysteresis.clone(),
        }
    }

    /// What has become harder on the way stays so. Steps remembered from before would take as much memory as all others.
    fn return_to(&mut self, mark: Mark) {
        let Mark { x, tau, firm, steps, stick, hysteresis } = mark;
        (self.x, self.tau, self.firm, self.steps) = (x, tau, firm, steps);
        (self.goal.stick, self.goal.hysteresis) = (stick, hysteresis);
        self.goal.barrier.iter_mut().for_each(|b| b.relist(&self.x));
        self.start_anew();
    }
}

#[cfg(all(test, feature = "self-contact"))]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::collision::crossings::count;
    use crate::optimize::test_sheets;
    use crate::{Material, Scene, Settings, Silent, StopReason, Switch};

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

    /// Rests from there; the lowest place of the flap, crossings, blocks ahead and taken back.
    fn rests(self_contact: Switch) -> (f64, usize, [u64; 2]) {
        let scene = flap();
        let mut settings = Settings::default();
        settings.effects.self_contact = self_contact;
        let mut d = Descent::begin(&scene, &settings, false).unwrap();
        assert_eq!(d.settle(&mut Silent).unwrap(), StopReason::Settled);
        let faces: Vec<[u32; 3]> = scene.triangles.iter().map(|t| t.vertices).collect();
        let lowest = d.x[81..].iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
        let tally = d.goal.barrier.as_ref().map_or([0; 2], |b| [b.tally.ahead, b.tally.back]);
        (lowest, count::own(&d.x, &faces).count, tally)
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
