//! The list of built-in stages: one line each.

use toile_stage_api::Registry;

/// All built-in stages.
#[must_use]
pub fn builtin() -> Registry {
    Registry::default().with(crate::export_dxf::ExportDxf)
}
