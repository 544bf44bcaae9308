//! `EXT_meshopt_compression`: vertices and triangles of a finished GLB are packed for the web.
//!
//! Numbers of vertices are rounded to so many bits of the largest one of their kind in the mesh, and stay floats for the
//! reader. Bitmaps and animations lie there as they were.

use super::material::uses;
use super::write::WriteError;
use gltf_json as json;
use json::accessor::ComponentType;
use json::buffer::{Stride, Target};
use json::mesh::Semantic;
use json::validation::Checked::{self, Valid};
use json::validation::USize64;
use meshoptimizer_rs::codec::{
    ExpMode, IndexEncoding, VertexEncoding, decode_filter_exp, encode_filter_exp, encode_index_buffer,
    encode_vertex_buffer,
};
use meshoptimizer_rs::{Error, Workspace};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// Name of the extension.
pub const EXTENSION: &str = "EXT_meshopt_compression";
/// Bits of a place and of a texture coordinate: 0.03 mm where the largest is 1 to 2 m.
const BITS: u32 = 17;
/// Bits of a direction: 0.03°.
const BITS_OF_DIRECTIONS: u32 = 12;
/// The versions of the codecs that the extension allows.
const VERSIONS: (u8, u8) = (0, 1);

/// A packed view, and what its accessor has when it is unpacked.
struct Packed {
    bytes: Vec<u8>,
    count: usize,
    stride: usize,
    mode: &'static str,
    filter: Option<&'static str>,
    bounds: Option<[Vec<f32>; 2]>,
}

/// Packs the views of vertices and triangles. Gives the binary chunk.
///
/// # Errors
/// When the library refuses a view.
pub fn squeeze(root: &mut json::Root, bytes: &[u8]) -> Result<Vec<u8>, WriteError> {
    let directions = directions(root);
    let (mut out, mut unpacked) = (Vec::new(), 0usize);
    for view in 0..root.buffer_views.len() {
        let own = root.buffer_views[view].clone();
        let start = own.byte_offset.map_or(0, |o| o.0 as usize);
        let raw = &bytes[start..start + own.byte_length.0 as usize];
        out.resize(out.len().next_multiple_of(4), 0);
        let accessor = root.accessors.iter().position(|a| a.buffer_view.is_some_and(|v| v.value() == view));
        let packed = accessor.map(|k| pack(root, k, raw, &directions)).transpose().map_err(refused)?.flatten();
        let Some(packed) = packed else {
            root.buffer_views[view].byte_offset = Some(USize64::from(out.len()));
            out.extend_from_slice(raw);
            continue;
        };
        unpacked = unpacked.next_multiple_of(4);
        place(&mut root.buffer_views[view], &packed, [out.len(), unpacked]);
        unpacked += raw.len();
        out.extend_from_slice(&packed.bytes);
        if let (Some([low, high]), Some(k)) = (packed.bounds, accessor.filter(|k| root.accessors[*k].min.is_some())) {
            (root.accessors[k].min, root.accessors[k].max) = (Some(json!(low)), Some(json!(high)));
        }
    }
    told(root, out.len(), unpacked);
    Ok(out)
}

fn refused(error: Error) -> WriteError {
    WriteError::Damaged(format!("the GLB cannot be packed: {error}"))
}

/// Accessors of normals and tangents.
fn directions(root: &json::Root) -> BTreeSet<usize> {
    let is_one = |s: &Checked<Semantic>| matches!(s, Valid(Semantic::Normals | Semantic::Tangents));
    let parts = root.meshes.iter().flat_map(|m| &m.primitives);
    let own = parts.clone().flat_map(|p| &p.attributes).filter(|(s, _)| is_one(s)).map(|(_, a)| a.value());
    let moved = parts.flat_map(|p| p.targets.iter().flatten()).filter_map(|t| t.normals).map(|a| a.value());
    own.chain(moved).collect()
}

/// Packs the view of an accessor; `None` where it belongs to no vertex and no triangle.
fn pack(root: &json::Root, accessor: usize, raw: &[u8], directions: &BTreeSet<usize>) -> Result<Option<Packed>, Error> {
    let a = &root.accessors[accessor];
    let view = a.buffer_view.and_then(|v| root.buffer_views.get(v.value()));
    let (Some(view), Valid(component)) = (view, &a.component_type) else { return Ok(None) };
    let count = a.count.0 as usize;
    match view.target {
        Some(Valid(Target::ElementArrayBuffer)) => triangles(raw, count, component.0 == ComponentType::U16).map(Some),
        Some(Valid(Target::ArrayBuffer)) if component.0 == ComponentType::F32 => {
            let bits = if directions.contains(&accessor) { BITS_OF_DIRECTIONS } else { BITS };
            floats(raw, count, bits).map(Some)
        }
        Some(Valid(Target::ArrayBuffer)) => {
            let stride = view.byte_stride.map_or_else(|| raw.len() / count.max(1), |Stride(s)| s);
            let work = &mut Workspace::default();
            let bytes = encode_vertex_buffer(raw, count, stride, VertexEncoding::new(VERSIONS.0, 0)?, work)?;
            Ok(Some(Packed { bytes, count, stride, mode: "ATTRIBUTES", filter: None, bounds: None }))
        }
        _ => Ok(None),
    }
}

fn floats(raw: &[u8], count: usize, bits: u32) -> Result<Packed, Error> {
    let (stride, work) = (raw.len() / count.max(1), &mut Workspace::default());
    let numbers = |bytes: &[u8]| bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let values: Vec<f32> = numbers(raw);
    let filtered = encode_filter_exp(count, stride, bits, &values, ExpMode::SharedComponent, work)?;
    let bytes = encode_vertex_buffer(&filtered, count, stride, VertexEncoding::new(VERSIONS.0, 0)?, work)?;
    let mut back = filtered;
    decode_filter_exp(&mut back, count, stride, work)?;
    let back: Vec<f32> = numbers(&back);
    let size = (stride / 4).max(1);
    let end = |beyond: fn(&f32, &f32) -> bool, k: usize| {
        let column = back.iter().skip(k).step_by(size);
        column.copied().reduce(|a, b| if beyond(&b, &a) { b } else { a }).unwrap_or(0.0) + 0.0
    };
    let bounds = [f32::lt, f32::gt].map(|beyond| (0..size).map(|k| end(beyond, k)).collect());
    Ok(Packed { bytes, count, stride, mode: "ATTRIBUTES", filter: Some("EXPONENTIAL"), bounds: Some(bounds) })
}

fn triangles(raw: &[u8], count: usize, is_small: bool) -> Result<Packed, Error> {
    let corners: Vec<u32> = if is_small {
        raw.chunks_exact(2).map(|b| u32::from(u16::from_le_bytes([b[0], b[1]]))).collect()
    } else {
        raw.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect()
    };
    let bytes = encode_index_buffer(&corners, IndexEncoding::new(VERSIONS.1)?, &mut Workspace::default())?;
    let stride = if is_small { 2 } else { 4 };
    Ok(Packed { bytes, count, stride, mode: "TRIANGLES", filter: None, bounds: None })
}

/// The view as it is unpacked, and in its extension where the packed bytes lie.
fn place(view: &mut json::buffer::View, packed: &Packed, [at, unpacked]: [usize; 2]) {
    let mut value = json!({
        "buffer": 0, "byteOffset": at, "byteLength": packed.bytes.len(), "byteStride": packed.stride,
        "count": packed.count, "mode": packed.mode,
    });
    if let (Some(filter), Some(map)) = (packed.filter, value.as_object_mut()) {
        map.insert("filter".to_owned(), json!(filter));
    }
    view.buffer = json::Index::new(1);
    view.byte_offset = Some(USize64::from(unpacked));
    let others: Map<String, Value> = [(EXTENSION.to_owned(), value)].into_iter().collect();
    view.extensions = Some(json::extensions::buffer::View { others });
}

/// The buffers, and the extension, without which the file cannot be read.
fn told(root: &mut json::Root, length: usize, unpacked: usize) {
    for buffer in &mut root.buffers {
        buffer.byte_length = USize64::from(length);
    }
    let others: Map<String, Value> = [(EXTENSION.to_owned(), json!({ "fallback": true }))].into_iter().collect();
    root.buffers.push(json::Buffer {
        byte_length: USize64::from(unpacked.max(1)),
        name: None,
        uri: None,
        extensions: Some(json::extensions::buffer::Buffer { others }),
        extras: None,
    });
    uses(root, EXTENSION);
    root.extensions_required.push(EXTENSION.to_owned());
}

#[cfg(test)]
mod tests {
    use super::*;
    use meshoptimizer_rs::codec::{decode_index_buffer, decode_vertex_buffer};

    fn packed(values: &[f32], stride: usize, bits: u32) -> (Packed, Vec<f32>) {
        let raw: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
        let count = raw.len() / stride;
        let packed = floats(&raw, count, bits).expect("packed");
        let work = &mut Workspace::default();
        let mut back = decode_vertex_buffer(count, stride, &packed.bytes, work).expect("unpacked");
        decode_filter_exp(&mut back, count, stride, work).expect("numbers");
        let back = back.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        (packed, back)
    }

    #[test]
    fn places_come_back_within_a_thirtieth_of_a_millimetre() {
        let values: Vec<f32> = (0..300).flat_map(|k| [0.001 * k as f32 - 0.2, 0.9 + 0.003 * k as f32, 0.11]).collect();
        let (packed, back) = packed(&values, 12, BITS);
        let worst = values.iter().zip(&back).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(worst < 3e-5, "{worst}");
        assert!(packed.bytes.len() < values.len() * 2, "{} bytes", packed.bytes.len());
        let [low, high] = packed.bounds.expect("bounds");
        assert!((low[1] - 0.9).abs() < 3e-5 && (high[1] - 1.797).abs() < 3e-5, "{low:?} {high:?}");
        assert!(back.iter().skip(1).step_by(3).all(|y| (low[1]..=high[1]).contains(y)));
    }

    #[test]
    fn triangles_keep_their_order_and_their_sides() {
        let corners: Vec<u16> = vec![0, 1, 2, 2, 1, 3, 4, 2, 3];
        let raw: Vec<u8> = corners.iter().flat_map(|i| i.to_le_bytes()).collect();
        let packed = triangles(&raw, 9, true).expect("packed");
        let back = decode_index_buffer(9, 2, &packed.bytes, &mut Workspace::default()).expect("unpacked");
        let back: Vec<u16> = back.chunks_exact(2).map(|b| u16::from_le_bytes([b[0], b[1]])).collect();
        let turned = |t: &[u16]| [[t[0], t[1], t[2]], [t[1], t[2], t[0]], [t[2], t[0], t[1]]];
        for (a, b) in corners.chunks_exact(3).zip(back.chunks_exact(3)) {
            assert!(turned(b).iter().any(|t| t == a), "{a:?} {b:?}");
        }
    }
}
