//! The garment document as it rides in the GLB: without what the GLB already carries, without traces of the machine.

use serde_json::Value;
use toile_garment::Garment;
use toile_garment::bundle::{self, BundleError};

/// The text of `extras.toile`.
pub fn text(garment: &Garment) -> Result<String, BundleError> {
    let mut lean = garment.clone();
    if let Some(body) = &mut lean.body {
        body.positions = Vec::new();
        body.triangles = Vec::new();
    }
    if let Some(animation) = &mut lean.animation {
        animation.frames = Vec::new();
    }
    for material in lean.textures.iter_mut().flat_map(|t| &mut t.materials) {
        if let Some(image) = &mut material.image {
            image.bytes = Vec::new();
        }
    }
    // Times belong to run.json alone: the same garment gives the same bytes.
    for effect in &mut lean.effects {
        effect.cpu_seconds = 0.0;
    }
    let mut value = bundle::to_value(&lean)?;
    scrub(&mut value, false);
    Ok(value.to_string())
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
