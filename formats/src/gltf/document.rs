//! The garment document as it rides in the GLB: without what the GLB already carries, without traces of the machine.

use super::{Carried, pack};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use toile_garment::Garment;
use toile_garment::bundle::{self, BundleError};

/// The value of `extras.toile`; `None` where no document is wanted.
pub fn extras(garment: &Garment, carried: Carried) -> Result<Option<Value>, BundleError> {
    Ok(match carried {
        Carried::Nothing => None,
        Carried::Plain => Some(lean(garment)?),
        Carried::Packed => {
            let packed = STANDARD.encode(pack::pack(lean(garment)?));
            Some(json!({ "kind": bundle::KIND, "version": bundle::VERSION, "packed": packed }))
        }
    })
}

/// The garment of a value of `extras.toile`, packed or plain.
///
/// # Errors
/// What is wrong with it, in words.
pub fn read(text: &str) -> Result<Garment, String> {
    let value: Value = serde_json::from_str(text).map_err(|e| e.to_string())?;
    let value = match value.get("packed").and_then(Value::as_str) {
        None => value,
        Some(_) if value["version"].as_u64().is_none_or(|v| v > u64::from(bundle::VERSION)) => {
            return Err("its packed document was written by a newer program; use a newer toile".to_owned());
        }
        Some(packed) => pack::unpack(&STANDARD.decode(packed).map_err(|e| format!("its packed document: {e}"))?)?,
    };
    bundle::from_value(value).map_err(|e| e.to_string())
}

/// The document without what the GLB carries beside it.
fn lean(garment: &Garment) -> Result<Value, BundleError> {
    let mut lean = garment.clone();
    // The sewn shape is where the drape began; a drape is never begun from a GLB.
    if lean.drape.is_some() {
        lean.stitched = None;
    }
    if let Some(body) = &mut lean.body {
        body.positions = Vec::new();
        body.triangles = Vec::new();
    }
    if let Some(animation) = &mut lean.animation {
        animation.frames = Vec::new();
    }
    for material in lean.textures.iter_mut().flat_map(|t| &mut t.materials) {
        for image in [&mut material.image, &mut material.normal].into_iter().flatten() {
            image.bytes = Vec::new();
        }
    }
    // Times belong to run.json alone: the same garment gives the same bytes.
    for effect in &mut lean.effects {
        effect.cpu_seconds = 0.0;
    }
    let mut value = bundle::to_value(&lean)?;
    scrub(&mut value, false);
    Ok(value)
}

/// Absolute paths become plain file names, in every `file` and `path` and in all parameters of stages.
fn scrub(value: &mut Value, everywhere: bool) {
    match value {
        Value::String(text) if everywhere => {
            if let Some(name) = file_name(text) {
                *text = name;
            }
        }
        Value::Array(items) => items.iter_mut().for_each(|v| scrub(v, everywhere)),
        Value::Object(map) => {
            for (key, v) in map.iter_mut() {
                scrub(v, everywhere || key == "file" || key == "path" || key == "params");
            }
        }
        _ => {}
    }
}

/// The last part of an absolute path; `None` for anything else.
fn file_name(text: &str) -> Option<String> {
    let drive = matches!(text.as_bytes(), [d, b':', b'/' | b'\\', ..] if d.is_ascii_alphabetic());
    let absolute = drive || ["/", "\\\\", "~/", "file://"].iter().any(|start| text.starts_with(start));
    absolute.then(|| text.rsplit(['/', '\\']).find(|p| !p.is_empty()).unwrap_or_default().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absolute_paths_become_names() {
        for (path, name) in [
            ("/home/anna/skirt.dxf", Some("skirt.dxf")),
            ("C:\\Patterns\\skirt.dxf", Some("skirt.dxf")),
            ("~/x/skirt.dxf", Some("skirt.dxf")),
            ("file:///x/skirt.dxf", Some("skirt.dxf")),
            ("\\\\server\\share\\skirt.dxf", Some("skirt.dxf")),
            ("../samples/skirt.dxf", None),
            ("1/2", None),
        ] {
            assert_eq!(file_name(path).as_deref(), name, "{path}");
        }
    }
}
