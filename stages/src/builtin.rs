//! The list of built-in stages: one line each.

use toile_stage_api::Registry;

/// All built-in stages.
#[must_use]
pub fn builtin() -> Registry {
    Registry::default()
        .with(crate::import_mesh::ImportMesh)
        .with(crate::texture::Texture)
        .with(crate::export_gltf::ExportGltf)
        .with(crate::export_obj::ExportObj)
}
