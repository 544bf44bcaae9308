//! Meshes: Wavefront OBJ and GLB.

use super::garment::table;
use super::{Inspected, Source};
use crate::engine::clean;
use serde_json::Value;
use std::fmt::Write as _;
use toile_formats::gltf::ReadError;
use toile_formats::{gltf, obj, svg};
use toile_garment::Diagnostic;

pub(super) fn is_obj(bytes: &[u8]) -> bool {
    let mut lines = bytes.get(..bytes.len().min(4000)).unwrap_or_default().split(|b| *b == b'\n');
    lines.any(|l| l.starts_with(b"v ") || l.starts_with(b"o ") || l.starts_with(b"mtllib "))
}

pub(super) fn is_glb(bytes: &[u8]) -> bool {
    bytes.starts_with(b"glTF")
}

pub(super) fn obj(source: &Source<'_>) -> Result<Inspected, Vec<Diagnostic>> {
    let json = obj::inspect(source.bytes, source.name)?;
    let findings: Vec<Diagnostic> = serde_json::from_value(json["findings"].clone()).unwrap_or_default();
    let mut text =
        format!("OBJ: {} vertices, {} faces, {} triangles", json["vertices"], json["faces"], json["triangles"]);
    text.push_str(&size_text(&json));
    for (what, key) in [("groups", "groups"), ("materials", "materials")] {
        let names = names(&json[key]);
        if !names.is_empty() {
            let _ = writeln!(text, "{what}: {}", names.join(", "));
        }
    }
    Ok(Inspected { json, text, svg: None, findings, is_usable: true })
}

pub(super) fn glb(source: &Source<'_>) -> Result<Inspected, Vec<Diagnostic>> {
    let json = gltf::inspect(source.bytes).map_err(|e| vec![gltf::refused(&e, &clean(source.path))])?;
    let mut text =
        format!("GLB: {} nodes, {} vertices, {} triangles", json["nodes"], json["vertices"], json["triangles"]);
    text.push_str(&size_text(&json));
    for mesh in json["meshes"].as_array().into_iter().flatten() {
        let name = mesh["node"].as_str().or(mesh["mesh"].as_str()).unwrap_or("-");
        let _ = writeln!(text, "  {name:<20} {} vertices, {} triangles", mesh["vertices"], mesh["triangles"]);
    }
    // A GLB of another program is no mistake: it only has no pieces to draw.
    let read = gltf::read_garment_with_findings(source.bytes);
    let (svg, findings) = match read {
        Ok(read) => {
            text.push_str(&table(&read.garment));
            (source.draw.then(|| svg::pattern(&read.garment.pieces, &read.garment.style)), read.findings)
        }
        Err(ReadError::NoDocument) => (None, Vec::new()),
        Err(error) => (None, vec![gltf::refused(&error, source.name).softened()]),
    };
    Ok(Inspected { json, text, svg, findings, is_usable: true })
}

fn size_text(json: &Value) -> String {
    let size: Vec<String> =
        json["size_m"].as_array().into_iter().flatten().filter_map(Value::as_f64).map(|m| format!("{m:.3}")).collect();
    if size.is_empty() { "\n".to_owned() } else { format!(", {} m\n", size.join(" × ")) }
}

fn names(list: &Value) -> Vec<&str> {
    list.as_array().into_iter().flatten().filter_map(Value::as_str).filter(|n| !n.is_empty()).collect()
}
