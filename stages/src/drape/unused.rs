//! Values of a fabric that this drape has no use for: each is told.

use super::{DrapeParams, HYSTERESIS_UNUSED, ModelName, SPRINGS_UNUSED};
use toile_garment::{Diagnostic, Garment};

/// One note for each kind of value that was not used.
pub(super) fn findings(garment: &Garment, params: &DrapeParams) -> Vec<Diagnostic> {
    let springs = garment.fabrics.values().find(|f| f.springs.is_some() && params.model != ModelName::Springs);
    let springs = springs.map(|fabric| {
        let message = format!("`{}` gives spring constants ([springs]); the drape went by its laws", fabric.name);
        Diagnostic::info(SPRINGS_UNUSED, message).hint("with.model = \"springs\" takes them")
    });
    let friction = garment.fabrics.values().find(|f| f.bend_holds_friction && f.bend_hysteresis.is_some());
    let friction = friction.map(|fabric| {
        let message = format!(
            "`{}` gives bending_hysteresis and bending lengths, which hold this friction already; it was not used again",
            fabric.name
        );
        Diagnostic::info(HYSTERESIS_UNUSED, message).hint("give bending stiffnesses instead of bending lengths, or leave it out")
    });
    springs.into_iter().chain(friction).collect()
}
