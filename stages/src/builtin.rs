//! The list of built-in stages: one line each.

use toile_stage_api::Registry;

/// All built-in stages.
#[must_use]
pub fn builtin() -> Registry {
    Registry::default()
        .with(crate::import_dxf::ImportDxf)
        .with(crate::triangulate::Triangulate)
        .with(crate::assemble::Assemble)
        .with(crate::stitch::Stitch)
        .with(crate::drape::Drape)
        .with(crate::flatten::Flatten)
        .with(crate::export_report::ExportReport)
}
