//! The list of built-in stages: one line each.

use toile_stage_api::Registry;

/// All built-in stages.
#[must_use]
pub fn builtin() -> Registry {
    #[cfg(feature = "experiments")]
    crate::experiment::begin_from_environment();
    Registry::default()
        .with(crate::import_dxf::ImportDxf)
        .with(crate::import_garmentcode::ImportGarmentcode)
        .with(crate::import_mesh::ImportMesh)
        .with(crate::triangulate::Triangulate)
        .with(crate::assemble::Assemble)
        .with(crate::stitch::Stitch)
        .with(crate::drape::Drape)
        .with(crate::animate::Animate)
        .with(crate::texture::Texture)
        .with(crate::export_gltf::ExportGltf)
        .with(crate::export_obj::ExportObj)
        .with(crate::flatten::Flatten)
        .with(crate::export_dxf::ExportDxf)
        .with(crate::export_print::ExportPrint)
        .with(crate::export_report::ExportReport)
}
