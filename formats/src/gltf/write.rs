//! From the garment to a GLB.

use super::surface::Surface;
use super::wishes::Wishes;
use super::{container, document, extra, material, motion, squeeze, variants};
use crate::normals;
use crate::picture::{Field, linear};
use gltf_json as json;
use json::accessor::{ComponentType, GenericComponentType, Type};
use json::buffer::Target;
use json::validation::Checked::Valid;
use json::validation::USize64;
use toile_garment::bundle::BundleError;
use toile_garment::garment::Shape;
use toile_garment::texture::{Material, PieceTexture};
use toile_garment::{Garment, Piece, Vec2, Vec3};

/// Why a garment cannot be written as GLB.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// No piece, no mesh, or no positions in 3D.
    #[error("the garment has no {0} yet")]
    Missing(String),
    /// A number that is NaN or infinite.
    #[error("{what} of vertex {vertex} of piece `{piece}` is not finite")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// Piece name.
        piece: String,
        /// Vertex in the piece.
        vertex: usize,
    },
    /// A list that does not fit the mesh.
    #[error("{0}")]
    Damaged(String),
    /// Over 4 GiB.
    #[error("the GLB would be larger than 4 GiB")]
    TooLarge,
    /// The document cannot be written.
    #[error(transparent)]
    Document(#[from] BundleError),
    /// The JSON cannot be written.
    #[error("the glTF text cannot be written: {0}")]
    Text(#[from] serde_json::Error),
}

/// The binary chunk while it grows.
#[derive(Default)]
pub struct Buffer {
    bytes: Vec<u8>,
    /// Bitmaps that lie in it, with their textures.
    pub(super) textures: Vec<(Vec<u8>, json::Index<json::Texture>)>,
}

impl Buffer {
    /// Adds bytes, aligned to four, as a view of their own.
    pub fn view(
        &mut self,
        root: &mut json::Root,
        bytes: &[u8],
        target: Option<Target>,
    ) -> json::Index<json::buffer::View> {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        root.push(json::buffer::View {
            buffer: json::Index::new(0),
            byte_length: USize64::from(bytes.len()),
            byte_offset: Some(USize64::from(offset)),
            byte_stride: None,
            name: None,
            target: target.map(Valid),
            extensions: None,
            extras: None,
        })
    }

    pub(super) fn floats<const N: usize>(
        &mut self,
        root: &mut json::Root,
        values: &[[f32; N]],
        type_: Type,
        bounds: bool,
    ) -> json::Index<json::Accessor> {
        self.accessor(root, values, type_, bounds, Some(Target::ArrayBuffer))
    }

    /// Numbers from 0 to 1 as whole 16-bit steps.
    pub(super) fn shares<const N: usize>(
        &mut self,
        root: &mut json::Root,
        values: &[[f32; N]],
        type_: Type,
    ) -> json::Index<json::Accessor> {
        let step = |x: &f32| ((x.clamp(0.0, 1.0) * f32::from(u16::MAX)).round() as u16).to_le_bytes();
        // Every entry begins at four bytes.
        let padding = vec![0; (N % 2) * 2];
        let bytes: Vec<u8> =
            values.iter().flat_map(|v| v.iter().flat_map(step).chain(padding.iter().copied())).collect();
        let view = self.view(root, &bytes, Some(Target::ArrayBuffer));
        if N % 2 == 1 {
            root.buffer_views[view.value()].byte_stride = Some(json::buffer::Stride(2 * N + 2));
        }
        root.push(json::Accessor { normalized: true, ..accessor(view, values.len(), ComponentType::U16, type_) })
    }

    /// Numbers that belong to no vertex: times and weights of an animation.
    pub(super) fn plain(
        &mut self,
        root: &mut json::Root,
        values: &[[f32; 1]],
        bounds: bool,
    ) -> json::Index<json::Accessor> {
        self.accessor(root, values, Type::Scalar, bounds, None)
    }

    fn accessor<const N: usize>(
        &mut self,
        root: &mut json::Root,
        values: &[[f32; N]],
        type_: Type,
        bounds: bool,
        target: Option<Target>,
    ) -> json::Index<json::Accessor> {
        let bytes: Vec<u8> = values.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(root, &bytes, target);
        let fold = |beyond: fn(&f32, &f32) -> bool| {
            // By comparison: which zero `min` and `max` give when both signs meet depends on the processor.
            let further = |v: f32, a: f32| if beyond(&v, &a) { v } else { a };
            let first = values.first().copied().unwrap_or([0.0; N]);
            let all = values.iter().fold(first, |a, v| std::array::from_fn(|k| further(v[k], a[k])));
            serde_json::Value::from(all.to_vec())
        };
        root.push(json::Accessor {
            min: bounds.then(|| fold(f32::lt)),
            max: bounds.then(|| fold(f32::gt)),
            ..accessor(view, values.len(), ComponentType::F32, type_)
        })
    }

    /// The bytes so far.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Triangle indices, two bytes each where that is enough (the value 65535 is reserved).
    pub(super) fn indices(
        &mut self,
        root: &mut json::Root,
        triangles: &[[u32; 3]],
        vertices: usize,
    ) -> json::Index<json::Accessor> {
        let small = vertices < usize::from(u16::MAX);
        let flat = triangles.iter().flatten();
        let bytes: Vec<u8> = if small {
            flat.flat_map(|i| (*i as u16).to_le_bytes()).collect()
        } else {
            flat.flat_map(|i| i.to_le_bytes()).collect()
        };
        let view = self.view(root, &bytes, Some(Target::ElementArrayBuffer));
        let kind = if small { ComponentType::U16 } else { ComponentType::U32 };
        root.push(accessor(view, triangles.len() * 3, kind, Type::Scalar))
    }
}

fn accessor(view: json::Index<json::buffer::View>, count: usize, kind: ComponentType, type_: Type) -> json::Accessor {
    json::Accessor {
        buffer_view: Some(view),
        byte_offset: None,
        count: USize64::from(count),
        component_type: Valid(GenericComponentType(kind)),
        extensions: None,
        extras: None,
        type_: Valid(type_),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
    }
}

/// `{"key": value}` as extras.
pub fn extras(key: &str, value: &serde_json::Value) -> json::Extras {
    let mut map = serde_json::Map::new();
    map.insert(key.to_owned(), value.clone());
    json::extras::RawValue::from_string(serde_json::Value::Object(map).to_string()).ok()
}

/// A GLB with a node and a mesh for each piece, named after it: metres, +y up; TEXCOORD_0 in metres of cloth,
/// TEXCOORD_1 packed; images embedded; the garment document in `asset.extras.toile`. Positions are those of the drape,
/// else of the sewn shape; the frames of a motion are morph targets, played by one animation. The same garment gives
/// the same bytes.
///
/// # Errors
/// See [`WriteError`].
pub fn write_garment(garment: &Garment) -> Result<Vec<u8>, WriteError> {
    write_garment_with(garment, &Wishes::default())
}

/// A GLB like that of [`write_garment`], with wishes.
///
/// # Errors
/// See [`WriteError`].
pub fn write_garment_with(garment: &Garment, wishes: &Wishes<'_>) -> Result<Vec<u8>, WriteError> {
    let shape = garment.drape.as_ref().or(garment.stitched.as_ref());
    let shape = shape.ok_or_else(|| WriteError::Missing("positions in 3D".to_owned()))?;
    let meshes = meshes(garment, shape)?;
    let normals = normals::smooth(&meshes);
    let mut root = json::Root::default();
    let mut buffer = Buffer::default();
    for m in &materials(garment) {
        if [&m.image, &m.normal].into_iter().flatten().any(|i| i.bytes.is_empty()) {
            return Err(WriteError::Damaged(format!("the image of material `{}` has no bytes", m.name)));
        }
        material::push(&mut root, &mut buffer, m, !wishes.repeats);
    }
    match (wishes.field, &garment.textures) {
        // The fabrics stay in the file, so that it can be read again.
        (Some(field), _) => {
            extra::plain(&mut root, field.name, [1.0; 3]);
        }
        (None, Some(textures)) => variants::push(&mut root, &mut buffer, textures, !wishes.repeats),
        (None, None) => {}
    }
    for ((piece, mesh), normals) in garment.pieces.iter().zip(&meshes).zip(&normals) {
        push_piece(&mut root, &mut buffer, garment, piece, *mesh, normals, wishes)?;
    }
    motion::push(&mut root, &mut buffer, garment, &meshes, &normals)?;
    beside(&mut root, &mut buffer, garment, &meshes, &normals, wishes)?;
    let nodes: Vec<_> = (0..root.nodes.len() as u32).map(json::Index::new).collect();
    let scene = json::Scene { extensions: None, extras: None, name: None, nodes };
    root.scene = Some(root.push(scene));
    root.buffers.push(json::Buffer {
        byte_length: USize64::from(buffer.bytes.len()),
        name: None,
        uri: None,
        extensions: None,
        extras: None,
    });
    let bytes = if wishes.squeezed { squeeze::squeeze(&mut root, &buffer.bytes)? } else { buffer.bytes };
    root.asset.generator = Some("toile".to_owned());
    root.asset.extras = document::extras(garment, wishes.document)?.and_then(|document| extras("toile", &document));
    let text = toile_garment::text::json(&root.to_string()?);
    container::join(text.as_bytes(), &bytes).ok_or(WriteError::TooLarge)
}

/// Adds what is wished beside the pieces.
fn beside(
    root: &mut json::Root,
    buffer: &mut Buffer,
    garment: &Garment,
    meshes: &[Mesh<'_>],
    normals: &[Vec<Vec3>],
    wishes: &Wishes<'_>,
) -> Result<(), WriteError> {
    if wishes.thickness {
        for (k, piece) in garment.pieces.iter().enumerate() {
            let Some(fabric) = garment.fabric_of(piece) else { continue };
            let texture = garment.textures.as_ref().and_then(|t| t.pieces.get(k));
            let (positions, triangles) = meshes[k];
            let material = material_of(garment, texture);
            let plain = texture.is_none().then(|| untextured(piece));
            let texture = texture.or(plain.as_ref());
            let right =
                Surface { positions, normals: &normals[k], triangles, texture, material, repeats: wishes.repeats };
            extra::wrong_side(root, buffer, piece, &right, fabric.thickness)?;
        }
    }
    if wishes.lines {
        extra::lines(root, buffer, garment, meshes, normals)?;
    }
    if wishes.body {
        extra::body(root, buffer, garment)?;
    }
    Ok(())
}

pub(super) type Mesh<'a> = (&'a [Vec3], &'a [[u32; 3]]);

pub(super) fn meshes<'a>(garment: &'a Garment, shape: &'a Shape) -> Result<Vec<Mesh<'a>>, WriteError> {
    if garment.pieces.is_empty() {
        return Err(WriteError::Missing("pieces".to_owned()));
    }
    let mut out = Vec::with_capacity(garment.pieces.len());
    for (i, piece) in garment.pieces.iter().enumerate() {
        let mesh = piece.mesh.as_ref().filter(|m| !m.triangles.is_empty());
        let mesh = mesh.ok_or_else(|| WriteError::Missing(format!("mesh of piece `{}`", piece.name)))?;
        let positions = shape.positions.get(i).map_or(&[][..], Vec::as_slice);
        if positions.len() != mesh.rest.len() {
            let (n, m) = (positions.len(), mesh.rest.len());
            return Err(WriteError::Damaged(format!("piece `{}` has {m} vertices but {n} positions", piece.name)));
        }
        if let Some(i) = mesh.triangles.iter().flatten().find(|i| **i as usize >= positions.len()) {
            return Err(WriteError::Damaged(format!("a triangle of piece `{}` names vertex {i}", piece.name)));
        }
        floats(piece, "the position", positions.iter().map(|p| [p.x, p.y, p.z]))?;
        out.push((positions, mesh.triangles.as_slice()));
    }
    Ok(out)
}

fn cloth() -> Material {
    Material {
        name: "cloth".to_owned(),
        color: [0.6, 0.6, 0.6],
        image: None,
        repeat: [1.0, 1.0],
        roughness: 0.9,
        normal: None,
        sheen: None,
    }
}

/// The fabrics; a plain one where the garment has no textures.
pub(super) fn materials(garment: &Garment) -> Vec<Material> {
    match &garment.textures {
        Some(textures) if !textures.materials.is_empty() => textures.materials.clone(),
        _ => vec![cloth()],
    }
}

/// A finite `f32` for each number; −0 becomes 0.
pub(super) fn floats<const N: usize>(
    piece: &Piece,
    what: &'static str,
    values: impl Iterator<Item = [f64; N]>,
) -> Result<Vec<[f32; N]>, WriteError> {
    values
        .enumerate()
        .map(|(vertex, v)| {
            let small = v.map(|x| x as f32 + 0.0);
            let finite = small.iter().all(|x| x.is_finite());
            if finite { Ok(small) } else { Err(WriteError::NotFinite { what, piece: piece.name.clone(), vertex }) }
        })
        .collect()
}

fn push_piece(
    root: &mut json::Root,
    buffer: &mut Buffer,
    garment: &Garment,
    piece: &Piece,
    (positions, triangles): Mesh<'_>,
    normals: &[Vec3],
    wishes: &Wishes<'_>,
) -> Result<(), WriteError> {
    let texture = garment.textures.as_ref().and_then(|t| t.pieces.get(piece.id.index()));
    let own = material_of(garment, texture).filter(|_| wishes.field.is_none());
    let plain = texture.is_none().then(|| untextured(piece));
    let texture = texture.or(plain.as_ref());
    let surface = Surface { positions, normals, triangles, texture, material: own, repeats: wishes.repeats };
    let mut attributes = surface.attributes(root, buffer, piece)?;
    if let Some(field) = wishes.field {
        let colours = colours(root, buffer, piece, positions.len(), field);
        attributes.insert(Valid(json::mesh::Semantic::Colors(0)), colours);
    }
    let painted = wishes.field.map(|_| root.materials.len() as u32 - 1);
    let material = painted.unwrap_or_else(|| texture.map_or(0, |t| t.material));
    if material as usize >= root.materials.len() {
        return Err(WriteError::Damaged(format!("piece `{}` names material {material}", piece.name)));
    }
    let indices = buffer.indices(root, triangles, positions.len());
    let primitive = json::mesh::Primitive {
        attributes,
        extensions: variants::of_part(garment.textures.as_ref().filter(|_| wishes.field.is_none()), material),
        extras: None,
        indices: Some(indices),
        material: Some(json::Index::new(material)),
        mode: Valid(json::mesh::Mode::Triangles),
        targets: None,
    };
    let name = serde_json::Value::from(piece.name.clone());
    let mesh = root.push(json::Mesh {
        extensions: None,
        extras: extras("piece", &name),
        name: Some(piece.name.clone()),
        primitives: vec![primitive],
        weights: None,
    });
    root.push(json::Node {
        mesh: Some(mesh),
        name: Some(piece.name.clone()),
        extras: extras("piece", &name),
        ..Default::default()
    });
    Ok(())
}

/// The texture coordinates of a piece without a texture: metres of cloth, weft and warp, and its own box.
fn untextured(piece: &Piece) -> PieceTexture {
    let rest = piece.mesh.as_ref().map_or(&[][..], |m| m.rest.as_slice());
    let warp = piece.warp();
    let cloth: Vec<[f64; 2]> = rest.iter().map(|p| [p.x * warp.y - p.y * warp.x, p.dot(&warp)]).collect();
    let far = Vec2::repeat(f64::INFINITY);
    let ends = |(low, high): (Vec2, Vec2), p: &[f64; 2]| (low.inf(&Vec2::from(*p)), high.sup(&Vec2::from(*p)));
    let (low, high) = cloth.iter().fold((far, -far), ends);
    let size = (high - low).max().max(1e-9);
    let packed = cloth.iter().map(|[u, v]| [(u - low.x) / size, (v - low.y) / size]).collect();
    PieceTexture { material: 0, uv_cloth: cloth, uv_packed: packed }
}

/// The material of a piece, if the garment has one for it.
fn material_of<'a>(garment: &'a Garment, texture: Option<&PieceTexture>) -> Option<&'a Material> {
    garment.textures.as_ref()?.materials.get(texture?.material as usize)
}

/// The colours of a field at the vertices of a piece.
fn colours(
    root: &mut json::Root,
    buffer: &mut Buffer,
    piece: &Piece,
    count: usize,
    field: &Field,
) -> json::Index<json::Accessor> {
    let values = field.values.get(piece.id.index()).map_or(&[][..], Vec::as_slice);
    let value = |v: usize| values.get(v).copied().unwrap_or(f64::NAN);
    let colours: Vec<[f32; 3]> = (0..count).map(|v| field.colour(value(v)).map(|c| linear(c) as f32)).collect();
    buffer.shares(root, &colours, Type::Vec3)
}
