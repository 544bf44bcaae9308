//! A GLB for looking only: the garment with its body, its place in the flat lay and numbers per vertex, and no document.

use super::write::{Buffer, WriteError, floats, materials, meshes};
use super::{container, material};
use crate::normals;
use gltf_json as json;
use json::accessor::Type;
use json::mesh::Semantic;
use json::validation::Checked::Valid;
use json::validation::USize64;
use std::collections::BTreeMap;
use toile_garment::{Garment, Piece, Vec3};

/// Numbers per vertex of one piece, or of the body, that a viewer needs beside the shape.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ViewPiece {
    /// Place in the flat lay, metres; none for the body.
    pub flat: Vec<[f64; 2]>,
    /// Numbers by name: a glTF attribute `_NAME` in capitals. A number that is not finite is written as −1e9.
    pub values: Vec<(String, Vec<f64>)>,
}

/// A number that stands for none.
const UNKNOWN: f64 = -1e9;

/// A GLB with a node for each piece and one named `body`. `pieces` has an entry for each piece, then one for the body.
///
/// # Errors
/// See [`WriteError`].
pub fn write_view(garment: &Garment, pieces: &[ViewPiece]) -> Result<Vec<u8>, WriteError> {
    let shape = garment.drape.as_ref().or(garment.stitched.as_ref());
    let shape = shape.ok_or_else(|| WriteError::Missing("positions in 3D".to_owned()))?;
    let meshes = meshes(garment, shape)?;
    let (mut root, mut buffer) = (json::Root::default(), Buffer::default());
    for m in &materials(garment) {
        material::push(&mut root, &mut buffer, m, true);
    }
    let smooth = normals::smooth(&meshes);
    let nothing = ViewPiece::default();
    for (k, (piece, (positions, triangles))) in garment.pieces.iter().zip(&meshes).enumerate() {
        let extra = pieces.get(k).unwrap_or(&nothing);
        let texture = garment.textures.as_ref().and_then(|t| t.pieces.get(k));
        let uv = texture.map_or(&[][..], |t| t.uv_cloth.as_slice());
        let mut made = attributes(&mut root, &mut buffer, piece, positions, &smooth[k], extra)?;
        if uv.len() == positions.len() {
            let uv = floats(piece, "the texture coordinate", uv.iter().map(|[u, v]| [*u, -v]))?;
            made.insert(Valid(Semantic::TexCoords(0)), buffer.floats(&mut root, &uv, Type::Vec2, false));
        }
        let material = texture.map_or(0, |t| t.material);
        let indices = buffer.indices(&mut root, triangles, positions.len());
        node(&mut root, &piece.name, made, indices, Some(material));
    }
    if let Some(body) = garment.body.as_ref().filter(|b| !b.triangles.is_empty()) {
        let named = Piece { name: "body".to_owned(), ..Piece::default() };
        let normals = normals::smooth(&[(&body.positions, &body.triangles)]).remove(0);
        let extra = pieces.get(garment.pieces.len()).unwrap_or(&nothing);
        let made = attributes(&mut root, &mut buffer, &named, &body.positions, &normals, extra)?;
        let indices = buffer.indices(&mut root, &body.triangles, body.positions.len());
        node(&mut root, "body", made, indices, None);
    }
    finish(root, &buffer)
}

type Attributes = BTreeMap<json::validation::Checked<Semantic>, json::Index<json::Accessor>>;

fn attributes(
    root: &mut json::Root,
    buffer: &mut Buffer,
    piece: &Piece,
    positions: &[Vec3],
    normals: &[Vec3],
    extra: &ViewPiece,
) -> Result<Attributes, WriteError> {
    let mut out = Attributes::new();
    let p = floats(piece, "the position", positions.iter().map(|p| [p.x, p.y, p.z]))?;
    out.insert(Valid(Semantic::Positions), buffer.floats(root, &p, Type::Vec3, true));
    let n = floats(piece, "the normal", normals.iter().map(|n| [n.x, n.y, n.z]))?;
    out.insert(Valid(Semantic::Normals), buffer.floats(root, &n, Type::Vec3, false));
    if extra.flat.len() == positions.len() {
        let flat = floats(piece, "the place in the flat lay", extra.flat.iter().copied())?;
        out.insert(Valid(Semantic::Extras("FLAT".to_owned())), buffer.floats(root, &flat, Type::Vec2, false));
    }
    for (name, values) in extra.values.iter().filter(|(_, v)| v.len() == positions.len()) {
        let known = values.iter().map(|v| [if v.is_finite() { *v } else { UNKNOWN }]);
        let known = floats(piece, "a number", known)?;
        let name = name.to_uppercase().replace('-', "_");
        out.insert(Valid(Semantic::Extras(name)), buffer.floats(root, &known, Type::Scalar, false));
    }
    Ok(out)
}

fn node(
    root: &mut json::Root,
    name: &str,
    attributes: Attributes,
    indices: json::Index<json::Accessor>,
    material: Option<u32>,
) {
    let primitive = json::mesh::Primitive {
        attributes,
        extensions: None,
        extras: None,
        indices: Some(indices),
        material: material.map(json::Index::new),
        mode: Valid(json::mesh::Mode::Triangles),
        targets: None,
    };
    let mesh = root.push(json::Mesh {
        extensions: None,
        extras: None,
        name: Some(name.to_owned()),
        primitives: vec![primitive],
        weights: None,
    });
    root.push(json::Node { mesh: Some(mesh), name: Some(name.to_owned()), ..Default::default() });
}

fn finish(mut root: json::Root, buffer: &Buffer) -> Result<Vec<u8>, WriteError> {
    let nodes: Vec<_> = (0..root.nodes.len() as u32).map(json::Index::new).collect();
    root.scene = Some(root.push(json::Scene { extensions: None, extras: None, name: None, nodes }));
    root.buffers.push(json::Buffer {
        byte_length: USize64::from(buffer.bytes().len()),
        name: None,
        uri: None,
        extensions: None,
        extras: None,
    });
    root.asset.generator = Some("toile".to_owned());
    let text = toile_garment::text::json(&root.to_string()?);
    container::join(text.as_bytes(), buffer.bytes()).ok_or(WriteError::TooLarge)
}
