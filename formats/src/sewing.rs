//! The sewing file: what a DXF cannot say (contracts §7).

use toile_garment::Diagnostic;
use toile_garment::sewing::SewingPlan;

/// Reads a sewing file. `file` is its name for messages.
///
/// # Errors
/// All mistakes at once, each with line and column.
pub fn read(_text: &str, file: &str) -> Result<SewingPlan, Vec<Diagnostic>> {
    Err(vec![Diagnostic::error("sewing-file", format!("{file}: not read yet"))])
}
