//! Draping: descents until a Newton step would win nothing more.

use super::descent::{Descent, TAU_FREE};
use super::report;
use crate::start::Start;
use crate::{ClothError, Outcome, Scene, Settings, StopReason, Watch};

/// Blocks in a row without any step after which nothing more can be won.
const MOST_STUCK: u32 = 12;
/// Way over the size of the scene after which the cloth is given up as falling.
const FAR: f64 = 3.0;

/// Settles the cloth.
pub(crate) fn drape(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    let start = Start::new(scene, settings)?;
    let repaired = start.repaired;
    let mut descent = Descent::new(scene, settings, start, false);
    let reason = descent.settle(watch)?;
    Ok(report::outcome(descent, scene, reason, repaired))
}

impl Descent<'_> {
    /// Goes on until at rest.
    pub fn settle(&mut self, watch: &mut dyn Watch) -> Result<StopReason, ClothError> {
        let mut stuck = 0;
        let start = self.x.clone();
        let far = FAR * self.goal.size(&start);
        loop {
            self.lead();
            self.metric()?;
            self.look();
            if self.resting() {
                return Ok(StopReason::Settled);
            }
            if (self.tau < self.free || self.firm > 0.0) && self.nearly_resting() {
                // Is it so with the cloth's own metric, too?
                (self.tau, self.firm) = (TAU_FREE, 0.0);
                continue;
            }
            if watch.cancelled() {
                return Err(ClothError::Cancelled { step: self.steps });
            }
            watch.progress(self.steps, &self.words());
            if start.iter().zip(&self.x).any(|(p, q)| (p - q).norm_squared() > far * far) {
                return Ok(StopReason::Unheld);
            }
            if self.steps >= self.settings.max_descents {
                return Ok(StopReason::MaxSteps);
            }
            let b = self.block();
            stuck = if b.steps == 0 { stuck + 1 } else { 0 };
            if stuck > MOST_STUCK {
                return Ok(StopReason::MaxSteps);
            }
            self.adapt(b);
        }
    }

    fn nearly_resting(&self) -> bool {
        self.decrement < self.settings.decrement_tolerance && self.residual < 10.0 * self.settings.residual_tolerance
    }

    fn words(&self) -> String {
        format!(
            "a Newton step would win {:.1e} of the elastic energy (goal {:.0e}) and move {:.3} mm (goal {:.1})",
            self.decrement,
            self.settings.decrement_tolerance,
            self.longest * 1e3,
            self.settings.move_tolerance * 1e3
        )
    }
}
