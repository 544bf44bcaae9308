//! Progress, stopping and failures of the solver in the engine's words.

use super::codes;
use crate::codes::SETTING_OUT_OF_RANGE;
use std::sync::atomic::{AtomicBool, Ordering};
use toile_cloth::{ClothError, SceneFault, Vec3, Watch};
use toile_garment::{Diagnostic, Garment};
use toile_stage_api::{Progress, StageContext, StageError};

/// Parts of the work that are told apart.
const PARTS: u64 = 1000;

/// The garment as it is with the solver's vertices at some places.
type Shown<'a> = &'a dyn Fn(&[Vec3]) -> Garment;

/// Tells the engine how far the solver is.
pub struct Follow<'a> {
    progress: &'a mut dyn Progress,
    cancel: &'a AtomicBool,
    garment: Option<Shown<'a>>,
    /// Parts of [`PARTS`] that are done; 0 while nothing is known.
    done: u64,
}

impl<'a> Follow<'a> {
    /// Follows on behalf of a stage.
    pub fn new(cx: &'a mut StageContext<'_>) -> Self {
        Self { progress: &mut *cx.progress, cancel: cx.cancel, garment: None, done: 0 }
    }

    /// The same, with a way to show the garment while it is worked on.
    pub fn showing(cx: &'a mut StageContext<'_>, garment: Shown<'a>) -> Self {
        Self { garment: Some(garment), ..Self::new(cx) }
    }
}

impl Watch for Follow<'_> {
    fn progress(&mut self, step: u64, words: &str) {
        match self.done {
            0 => self.progress.update(step, 0, words),
            done => self.progress.update(done, PARTS, words),
        }
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    fn done(&mut self, part: f64) {
        self.done = self.done.max((part.clamp(0.0, 1.0) * PARTS as f64) as u64);
    }

    fn looks(&self) -> bool {
        self.garment.is_some() && self.progress.looks()
    }

    fn look(&mut self, positions: &[Vec3], triangles: usize) {
        if let Some(garment) = self.garment.filter(|_| self.progress.looks()) {
            self.progress.look(&garment(positions), &format!("as {triangles} triangles hang"));
        }
    }

    fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }
}

/// The remedy for a triangle without width.
pub const MESH_ANEW: &str = "mesh the cloth anew there, or join the vertices of the short edge";

/// How to run without an effect, or with it. `stitch` has no switch of effects, and sews with those of the build.
fn do_without(effect: &str) -> String {
    let off = match effect {
        "pressure" => "leave out with.pressure of `drape`, or".to_owned(),
        _ => format!("`drape` and `animate` can leave it out (with.effects.{effect} = \"off\"); else"),
    };
    format!("{off} take a build that has it (cargo build --features {effect})")
}

/// The solver's failure as a stage's: by whose fault it is.
#[must_use]
pub fn failure(error: ClothError) -> StageError {
    match error {
        ClothError::Cancelled { .. } => StageError::Cancelled,
        ClothError::BadScene { fault: SceneFault::FlatTriangle, what } => StageError::input(
            Diagnostic::error(codes::FLAT_TRIANGLE, what).hint(MESH_ANEW),
        ),
        ClothError::BadScene { fault, what } => StageError::input(Diagnostic::error(codes::of(fault), what)),
        ClothError::BadSetting { name, what } => {
            StageError::parameter(Diagnostic::error(SETTING_OUT_OF_RANGE, format!("{name}: {what}")))
        }
        ClothError::NotBuilt { effect } => StageError::parameter(
            Diagnostic::error(codes::EFFECT_NOT_BUILT, error.to_string()).hint(do_without(effect)),
        ),
        ClothError::StartCrosses { .. } => StageError::input(
            Diagnostic::error(codes::START_CROSSES, error.to_string())
                .hint("move the cloth there apart, or off the body: [[place]] in the sewing file, or the start positions of a mesh"),
        ),
        ClothError::Caught { .. } => StageError::input(
            Diagnostic::error(codes::BODY_CATCHES_CLOTH, error.to_string())
                .hint("give the body more room there (arms, thighs), shorten with.step, or lessen with.body_gap"),
        ),
        ClothError::Unstable { .. } => StageError::Unstable(error.to_string()),
        other => StageError::Internal(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::do_without;

    #[test]
    fn a_missing_effect_names_the_stages_that_can_leave_it_out() {
        let remedy = do_without("self-contact");
        assert!(remedy.starts_with("`drape` and `animate` can") && remedy.contains("with.effects.self-contact"));
        assert!(do_without("pressure").contains("with.pressure of `drape`"));
    }
}
