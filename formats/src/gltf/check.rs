//! Checks before the `gltf` crate may see a document: every index, count, offset and stride that it
//! would otherwise use unchecked.

use super::ReadError;
use gltf_json as json;
use json::accessor::{Accessor, ComponentType, Type};
use json::mesh::Semantic;
use json::validation::Checked::{self, Valid};

/// Most entries of any list.
const MAX_LIST: usize = 1_000_000;
/// Most vertices or indices of one accessor.
const MAX_COUNT: u64 = 100_000_000;

/// Checks a document against its binary chunk.
pub fn check(root: &json::Root, bin: Option<&[u8]>) -> Result<(), ReadError> {
    let bad = |what: String| Err(ReadError::Damaged(what));
    let lists = [
        ("accessors", root.accessors.len()),
        ("bufferViews", root.buffer_views.len()),
        ("nodes", root.nodes.len()),
        ("meshes", root.meshes.len()),
        ("materials", root.materials.len()),
        ("images", root.images.len()),
    ];
    if let Some((name, n)) = lists.iter().find(|(_, n)| *n > MAX_LIST) {
        return bad(format!("{n} {name}, over the limit of {MAX_LIST}"));
    }
    if let Some(i) = root.buffers.iter().position(|b| b.uri.is_some()) {
        return bad(format!("buffer {i} lies in another file; export as one GLB"));
    }
    for (i, buffer) in root.buffers.iter().enumerate() {
        let there = if i == 0 { bin.map_or(0, <[u8]>::len) } else { 0 };
        if buffer.byte_length.0 > there as u64 {
            return bad(format!("buffer {i} declares {} bytes, {there} are there", buffer.byte_length.0));
        }
    }
    for i in 0..root.buffer_views.len() {
        view(root, i)?;
    }
    for mesh in &root.meshes {
        for primitive in &mesh.primitives {
            check_primitive(root, primitive)?;
        }
    }
    for (i, image) in root.images.iter().enumerate() {
        let inside = image.buffer_view.is_none_or(|v| v.value() < root.buffer_views.len());
        if image.uri.is_some() || !inside {
            return bad(format!("image {i} lies in another file or nowhere; export as one GLB"));
        }
    }
    check_nodes(root)
}

/// Start, length and stride of a buffer view inside the binary chunk.
pub fn view(root: &json::Root, index: usize) -> Result<(usize, usize, Option<usize>), ReadError> {
    let fail = |what: &str| ReadError::Damaged(format!("bufferView {index} {what}"));
    let view = root.buffer_views.get(index).ok_or_else(|| fail("does not exist"))?;
    let buffer = root.buffers.get(view.buffer.value()).ok_or_else(|| fail("names a buffer that is not there"))?;
    let start = view.byte_offset.map_or(0, |o| o.0);
    let end = start.checked_add(view.byte_length.0).filter(|end| *end <= buffer.byte_length.0);
    if end.is_none() {
        return Err(fail("leaves its buffer"));
    }
    let stride = view.byte_stride.map(|s| s.0);
    if stride.is_some_and(|s| !(4..=252).contains(&s)) {
        return Err(fail("has a stride outside 4 to 252"));
    }
    let small = |n: u64| usize::try_from(n).map_err(|_| fail("is too large"));
    Ok((small(start)?, small(view.byte_length.0)?, stride))
}

fn check_primitive(root: &json::Root, primitive: &json::mesh::Primitive) -> Result<(), ReadError> {
    let mut vertices = None;
    for (semantic, index) in &primitive.attributes {
        let accessor = root.accessors.get(index.value());
        let accessor = accessor.ok_or_else(|| ReadError::Damaged(format!("accessor {} is missing", index.value())))?;
        let form = match semantic {
            Valid(Semantic::Positions | Semantic::Normals) => Some((Type::Vec3, false)),
            Valid(Semantic::TexCoords(_)) => Some((Type::Vec2, true)),
            _ => None,
        };
        // Others are never read, only counted.
        let Some((type_, integers)) = form else { continue };
        check_accessor(root, index.value(), accessor, type_, |c| {
            c == ComponentType::F32 || (integers && matches!(c, ComponentType::U8 | ComponentType::U16))
        })?;
        if *vertices.get_or_insert(accessor.count.0) != accessor.count.0 {
            return Err(ReadError::Damaged("attributes of one mesh differ in number".to_owned()));
        }
    }
    if let Some(index) = primitive.indices {
        let accessor = root.accessors.get(index.value());
        let accessor = accessor.ok_or_else(|| ReadError::Damaged(format!("accessor {} is missing", index.value())))?;
        check_accessor(root, index.value(), accessor, Type::Scalar, |c| {
            matches!(c, ComponentType::U8 | ComponentType::U16 | ComponentType::U32)
        })?;
    }
    Ok(())
}

fn check_accessor(
    root: &json::Root,
    index: usize,
    accessor: &Accessor,
    type_: Type,
    allowed: impl Fn(ComponentType) -> bool,
) -> Result<(), ReadError> {
    let bad = |what: String| Err(ReadError::Damaged(format!("accessor {index} {what}")));
    let component = match (&accessor.component_type, &accessor.type_) {
        (Valid(c), Valid(t)) if *t == type_ && allowed(c.0) => c.0,
        _ => return bad("has the wrong type for its use".to_owned()),
    };
    if accessor.sparse.is_some() {
        return bad("is sparse; export without sparse accessors".to_owned());
    }
    let Some(buffer_view) = accessor.buffer_view else { return bad("has no data".to_owned()) };
    if !(1..=MAX_COUNT).contains(&accessor.count.0) {
        return bad(format!("has {} entries; allowed are 1 to {MAX_COUNT}", accessor.count.0));
    }
    let (_, length, stride) = view(root, buffer_view.value())?;
    let size = (component.size() * type_.multiplicity()) as u64;
    let step = stride.map_or(size, |s| s as u64);
    let offset = accessor.byte_offset.map_or(0, |o| o.0);
    let need = step
        .checked_mul(accessor.count.0 - 1)
        .and_then(|n| n.checked_add(size))
        .and_then(|n| n.checked_add(offset))
        .filter(|n| *n <= length as u64);
    if need.is_none() || step < size {
        return bad(format!("with {} entries does not fit into its bufferView of {length} bytes", accessor.count.0));
    }
    Ok(())
}

fn check_nodes(root: &json::Root) -> Result<(), ReadError> {
    let n = root.nodes.len();
    let bad = |what: String| Err(ReadError::Damaged(what));
    let mut parent = vec![None; n];
    for (i, node) in root.nodes.iter().enumerate() {
        if node.mesh.is_some_and(|m| m.value() >= root.meshes.len()) {
            return bad(format!("node {i} names a mesh that is not there"));
        }
        for child in node.children.iter().flatten() {
            match parent.get_mut(child.value()) {
                Some(slot @ None) => *slot = Some(i),
                Some(Some(_)) => return bad(format!("node {} has two parents", child.value())),
                None => return bad(format!("node {i} names a child that is not there")),
            }
        }
    }
    // With one parent each, a node that no root reaches lies on a loop.
    let mut reached = 0;
    let mut stack: Vec<usize> = (0..n).filter(|i| parent[*i].is_none()).collect();
    while let Some(i) = stack.pop() {
        reached += 1;
        stack.extend(root.nodes[i].children.iter().flatten().map(|c| c.value()));
    }
    if reached < n {
        return bad("its nodes form a loop".to_owned());
    }
    for scene in &root.scenes {
        if scene.nodes.iter().any(|i| i.value() >= n) {
            return bad("a scene names a node that is not there".to_owned());
        }
    }
    if let Some(Checked::Invalid) =
        root.meshes.iter().flat_map(|m| &m.primitives).map(|p| &p.mode).find(|m| **m == Checked::Invalid)
    {
        return bad("a mesh has an unknown mode".to_owned());
    }
    Ok(())
}
