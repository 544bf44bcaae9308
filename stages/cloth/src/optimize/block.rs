//! A block: steps with one factorisation.

use crate::optimize::descent::Descent;
use crate::optimize::mechanism::{Block, Mechanism, StepVerdict};

impl Descent<'_> {
    /// Takes at most `steps` steps with one factorisation; the mechanisms may end the block before.
    pub fn take_steps(&mut self, steps: usize, mechanisms: &mut [&mut dyn Mechanism]) -> Block {
        let mut b = Block::default();
        let before = self.energy;
        let (mut sum, mut first) = (0.0, 1.0);
        for _ in 0..steps {
            let taken = self.step(first);
            let mut goes_on = taken.is_some();
            match taken {
                Some(part) => {
                    first = (self.step_cap.growth * part).min(1.0);
                    b.steps += 1;
                    sum += part;
                }
                None => b.stuck = true,
            }
            for m in mechanisms.iter_mut() {
                match m.after_step(self, taken) {
                    StepVerdict::Go => {}
                    StepVerdict::EndBlock => goes_on = false,
                    StepVerdict::Stop(reason) => (b.stop, goes_on) = (Some(reason), false),
                }
            }
            if !goes_on {
                break;
            }
        }
        b.gain = before - self.energy;
        b.mean = if b.steps > 0 { sum / b.steps as f64 } else { 0.0 };
        b
    }
}
