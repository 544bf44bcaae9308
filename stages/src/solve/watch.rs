//! Progress, stopping and failures of the solver in the engine's words.

use std::sync::atomic::{AtomicBool, Ordering};
use toile_cloth::{ClothError, Watch};
use toile_garment::Diagnostic;
use toile_stage_api::{Progress, StageContext, StageError};

/// Tells the engine how far the solver is.
pub struct Follow<'a> {
    progress: &'a mut dyn Progress,
    cancel: &'a AtomicBool,
}

impl<'a> Follow<'a> {
    /// Follows on behalf of a stage.
    pub fn new(cx: &'a mut StageContext<'_>) -> Self {
        Self { progress: &mut *cx.progress, cancel: cx.cancel }
    }
}

impl Watch for Follow<'_> {
    fn progress(&mut self, step: u64, words: &str) {
        self.progress.update(step, 0, words);
    }

    fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }
}

/// What to do about a triangle without width.
pub const MESH_ANEW: &str = "mesh the cloth anew there, or join the vertices of the short edge";

/// The solver's failure as a stage's: by whose fault it is.
#[must_use]
pub fn failure(error: ClothError) -> StageError {
    match error {
        ClothError::Cancelled { .. } => StageError::Cancelled,
        ClothError::BadScene { code: code @ "flat-triangle", what } => StageError::input(
            Diagnostic::error(code, what).hint(MESH_ANEW),
        ),
        ClothError::BadScene { code, what } => StageError::input(Diagnostic::error(code, what)),
        ClothError::BadSetting { name, what } => {
            StageError::parameter(Diagnostic::error("setting-out-of-range", format!("{name}: {what}")))
        }
        ClothError::StartCrosses { .. } => StageError::input(
            Diagnostic::error("start-crosses", error.to_string())
                .hint("move the cloth there apart, or off the body: [[place]] in the sewing file, or the start positions of a mesh"),
        ),
        ClothError::Caught { .. } => StageError::input(
            Diagnostic::error("body-catches-cloth", error.to_string())
                .hint("give the body more room there (arms, thighs), shorten with.step, or lessen with.body_gap"),
        ),
        ClothError::Unstable { .. } => StageError::Unstable(error.to_string()),
        other => StageError::Internal(other.to_string()),
    }
}
