//! The parts of a GLB, read without the program's own reader.

use serde_json::{Value, json};

/// Nodes, meshes, vertex and triangle counts, bounds in mm, materials, images and the extensions used.
pub fn structure(bytes: &[u8]) -> Value {
    let (gltf, _) = chunks(bytes);
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

/// The document, and the bytes of the binary chunk; none where there is no such chunk.
fn chunks(bytes: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| bytes.get(at..at + 4).map_or(0, |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!(word(8) as usize, bytes.len(), "the length in the header is the file's");
    let end = 20 + word(12) as usize;
    (serde_json::from_slice(&bytes[20..end]).expect("JSON chunk"), bytes.get(end + 8..).unwrap_or_default())
}

fn millimetres(corner: &Value) -> Value {
    let round = |v: &Value| v.as_f64().map(|v| (v * 1000.0).round());
    corner.as_array().map(|c| c.iter().map(round).collect::<Vec<_>>()).into()
}

/// A mesh of a GLB: places (m), the first texture coordinates, triangles.
pub struct Part {
    pub name: String,
    pub positions: Vec<[f64; 3]>,
    /// u along the weft, v along the warp, as glTF has it: downwards.
    pub uv: Vec<[f64; 2]>,
    pub triangles: Vec<[usize; 3]>,
}

/// The meshes with their numbers; a primitive each.
pub fn parts(bytes: &[u8]) -> Vec<Part> {
    let (gltf, binary) = chunks(bytes);
    let index = |v: &Value| v.as_u64().unwrap_or(0) as usize;
    let data = |accessor: &Value| {
        let a = &gltf["accessors"][index(accessor)];
        let view = &gltf["bufferViews"][index(&a["bufferView"])];
        let start = index(&view["byteOffset"]) + index(&a["byteOffset"]);
        (&binary[start..], index(&a["count"]), a["componentType"].as_u64())
    };
    let float =
        |b: &[u8], i: usize| f64::from(f32::from_le_bytes([b[4 * i], b[4 * i + 1], b[4 * i + 2], b[4 * i + 3]]));
    let read = |mesh: &Value| {
        let part = &mesh["primitives"][0];
        let (p, n, _) = data(&part["attributes"]["POSITION"]);
        let (t, _, _) = data(&part["attributes"]["TEXCOORD_0"]);
        let (i, count, kind) = data(&part["indices"]);
        let id = |k: usize| match kind {
            Some(5123) => usize::from(u16::from_le_bytes([i[2 * k], i[2 * k + 1]])),
            _ => u32::from_le_bytes([i[4 * k], i[4 * k + 1], i[4 * k + 2], i[4 * k + 3]]) as usize,
        };
        Part {
            name: mesh["name"].as_str().unwrap_or_default().to_owned(),
            positions: (0..n).map(|k| [0, 1, 2].map(|c| float(p, 3 * k + c))).collect(),
            uv: (0..n).map(|k| [0, 1].map(|c| float(t, 2 * k + c))).collect(),
            triangles: (0..count / 3).map(|k| [0, 1, 2].map(|c| id(3 * k + c))).collect(),
        }
    };
    gltf["meshes"].as_array().into_iter().flatten().map(read).collect()
}

/// The same file with every vertex of its meshes moved, as an editor does it.
pub fn moved(bytes: &[u8], mut to: impl FnMut([f64; 3]) -> [f64; 3]) -> Vec<u8> {
    let (gltf, binary) = chunks(bytes);
    let index = |v: &Value| v.as_u64().unwrap_or(0) as usize;
    let from = bytes.len() - binary.len();
    let mut out = bytes.to_vec();
    for mesh in gltf["meshes"].as_array().into_iter().flatten() {
        let accessor = &gltf["accessors"][index(&mesh["primitives"][0]["attributes"]["POSITION"])];
        let view = &gltf["bufferViews"][index(&accessor["bufferView"])];
        let start = from + index(&view["byteOffset"]) + index(&accessor["byteOffset"]);
        for vertex in out[start..].chunks_exact_mut(12).take(index(&accessor["count"])) {
            let float = |k: usize| f32::from_le_bytes([vertex[k], vertex[k + 1], vertex[k + 2], vertex[k + 3]]);
            let place = to([0, 4, 8].map(|k| f64::from(float(k))));
            for (k, x) in place.into_iter().enumerate() {
                vertex[4 * k..4 * k + 4].copy_from_slice(&(x as f32).to_le_bytes());
            }
        }
    }
    out
}
