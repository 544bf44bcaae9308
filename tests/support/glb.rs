//! What a GLB is made of, read without the program's own reader.

use serde_json::{Value, json};

/// Nodes, meshes, vertex and triangle counts, bounds in mm, materials, images and the extensions used.
pub fn structure(bytes: &[u8]) -> Value {
    let word = |at: usize| bytes.get(at..at + 4).map_or(0, |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!(word(8) as usize, bytes.len(), "the length in the header is the file's");
    let text = &bytes[20..20 + word(12) as usize];
    let gltf: Value = serde_json::from_slice(text).expect("JSON chunk");
    let list = |key: &str| gltf[key].as_array().cloned().unwrap_or_default();
    let count = |index: &Value| gltf["accessors"][index.as_u64().unwrap_or(u64::MAX) as usize]["count"].clone();
    let meshes: Vec<Value> = list("meshes")
        .iter()
        .map(|mesh| {
            let parts: Vec<Value> = mesh["primitives"]
                .as_array()
                .cloned()
                .unwrap_or_default()
                .iter()
                .map(|part| {
                    let position = &part["attributes"]["POSITION"];
                    let accessor = &gltf["accessors"][position.as_u64().unwrap_or(u64::MAX) as usize];
                    let attributes: Vec<String> =
                        part["attributes"].as_object().into_iter().flat_map(|a| a.keys().cloned()).collect();
                    json!({
                        "vertices": count(position),
                        "indices": count(&part["indices"]),
                        "attributes": attributes,
                        "min_mm": millimetres(&accessor["min"]),
                        "max_mm": millimetres(&accessor["max"]),
                    })
                })
                .collect();
            json!({ "name": mesh["name"], "primitives": parts })
        })
        .collect();
    json!({
        "nodes": list("nodes").iter().map(|n| n["name"].clone()).collect::<Vec<_>>(),
        "meshes": meshes,
        "materials": list("materials").iter().map(|m| m["name"].clone()).collect::<Vec<_>>(),
        "images": list("images").len(),
        "extensions": gltf["extensionsUsed"],
        "extras": gltf["extras"].as_object().map(|e| e.keys().cloned().collect::<Vec<_>>()),
    })
}

fn millimetres(corner: &Value) -> Value {
    let round = |v: &Value| v.as_f64().map(|v| (v * 1000.0).round());
    corner.as_array().map(|c| c.iter().map(round).collect::<Vec<_>>()).into()
}
