//! The contents of an OBJ.

use super::read;
use serde_json::{Value, json};
use toile_garment::Diagnostic;

/// Facts about an OBJ file: counts, size, names, materials, lines without meaning for us.
///
/// # Errors
/// As [`read`].
pub fn inspect(bytes: &[u8], file: &str) -> Result<Value, Vec<Diagnostic>> {
    let mesh = read(bytes, file)?;
    let bounds = mesh.bounds();
    Ok(json!({
        "format": "obj",
        "bytes": bytes.len(),
        "vertices": mesh.positions.len(),
        "texture_vertices": mesh.texcoords.len(),
        "faces": mesh.faces,
        "polygons": mesh.polygons,
        "triangles": mesh.triangles.len(),
        "whole_uv": mesh.uv_triangles.is_some(),
        "bbox_m": bounds.map(|b| b.map(|p| [p.x, p.y, p.z])),
        "size_m": bounds.map(|[lo, hi]| [hi.x - lo.x, hi.y - lo.y, hi.z - lo.z]),
        "groups": mesh.groups.iter().map(|g| &g.name).collect::<Vec<_>>(),
        "materials": mesh.materials,
        "ignored_lines": mesh.ignored,
        "findings": mesh.findings,
        "toile": null,
    }))
}
