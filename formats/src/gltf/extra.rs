//! Parts that a GLB may show beside the pieces: the body, the wrong side of the cloth, and its lines.

use super::surface::{Attributes, Surface};
use super::write::{Buffer, Mesh, WriteError, floats};
use crate::normals;
use gltf_json as json;
use json::accessor::Type;
use json::mesh::{Mode, Semantic};
use json::validation::Checked::Valid;
use std::collections::BTreeMap;
use toile_garment::texture::PieceTexture;
use toile_garment::{Garment, Piece, Vec3};

/// Colours of body and lines, linear RGB.
const BODY: [f32; 3] = [0.60, 0.56, 0.52];
const THREAD: [f32; 3] = [0.05, 0.05, 0.05];
/// Lines lie this far above the right side of the cloth, metres.
const ABOVE: f64 = 4e-4;

/// Adds a node `body`, where the garment has one with a mesh.
pub fn body(root: &mut json::Root, buffer: &mut Buffer, garment: &Garment) -> Result<(), WriteError> {
    let Some(body) = garment.body.as_ref().filter(|b| !b.triangles.is_empty()) else { return Ok(()) };
    let normals = normals::smooth(&[(&body.positions, &body.triangles)]).remove(0);
    let named = Piece { name: "body".to_owned(), ..Piece::default() };
    let surface = Surface {
        positions: &body.positions,
        normals: &normals,
        triangles: &body.triangles,
        texture: None,
        material: None,
        repeats: false,
    };
    let attributes = surface.attributes(root, buffer, &named)?;
    let indices = buffer.indices(root, &body.triangles, body.positions.len());
    let material = plain(root, "body", BODY);
    node(root, "body", part(attributes, indices, Mode::Triangles, material));
    Ok(())
}

/// Adds a node for the wrong side of a piece: the mesh of the right side, a thickness behind it, and its edges.
///
/// Every vertex lies on the cloth where the vertex of the right side lies that it comes from.
pub fn wrong_side(
    root: &mut json::Root,
    buffer: &mut Buffer,
    piece: &Piece,
    right: &Surface<'_>,
    thickness: f64,
) -> Result<(), WriteError> {
    let (positions, normals) = (right.positions, right.normals);
    let behind = positions.iter().zip(normals).map(|(p, n)| p - n * thickness);
    let (mut points, mut turned): (Vec<Vec3>, Vec<Vec3>) = (behind.collect(), normals.iter().map(|n| -n).collect());
    let mut from: Vec<usize> = (0..positions.len()).collect();
    let mut faces: Vec<[u32; 3]> = right.triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    for edge in rim(right.triangles) {
        let [a, b] = edge.map(|i| i as usize);
        let first = points.len() as u32;
        let out = (positions[b] - positions[a]).cross(&normals[a]);
        let out = if out.norm() > 0.0 { out.normalize() } else { normals[a] };
        points.extend([positions[a], positions[b], points[b], points[a]]);
        turned.extend([out; 4]);
        from.extend([a, b, b, a]);
        faces.extend([[first, first + 2, first + 1], [first, first + 3, first + 2]]);
    }
    let texture = right.texture.map(|t| textured_as(t, &from));
    let material = json::Index::new(right.texture.map_or(0, |t| t.material));
    let shell = Surface {
        positions: &points,
        normals: &turned,
        triangles: &faces,
        texture: texture.as_ref(),
        material: right.material,
        repeats: right.repeats,
    };
    let attributes = shell.attributes(root, buffer, piece)?;
    let indices = buffer.indices(root, &faces, points.len());
    node(root, &format!("{} wrong side", piece.name), part(attributes, indices, Mode::Triangles, material));
    Ok(())
}

/// The texture coordinates of vertices that come from those of a piece.
fn textured_as(texture: &PieceTexture, from: &[usize]) -> PieceTexture {
    let pick = |all: &[[f64; 2]]| from.iter().filter_map(|i| all.get(*i).copied()).collect();
    PieceTexture { material: texture.material, uv_cloth: pick(&texture.uv_cloth), uv_packed: pick(&texture.uv_packed) }
}

/// Edges of one triangle only, in the direction of that triangle, by its first vertex.
fn rim(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut met: BTreeMap<[u32; 2], (usize, [u32; 2])> = BTreeMap::new();
    for [a, b, c] in triangles {
        for [p, q] in [[*a, *b], [*b, *c], [*c, *a]] {
            met.entry([p.min(q), p.max(q)]).or_insert((0, [p, q])).0 += 1;
        }
    }
    met.into_values().filter(|(count, _)| *count == 1).map(|(_, edge)| edge).collect()
}

/// Adds a node `seams`: lines of all seams, darts and free edges, a little above the right side.
pub fn lines(
    root: &mut json::Root,
    buffer: &mut Buffer,
    garment: &Garment,
    meshes: &[Mesh<'_>],
    normals: &[Vec<Vec3>],
) -> Result<(), WriteError> {
    let mut points: Vec<Vec3> = Vec::new();
    let mut draw = |piece: usize, chain: &[u32]| {
        let at = |v: u32| {
            let (positions, normals) = (meshes.get(piece)?.0, normals.get(piece)?);
            Some(positions.get(v as usize)? + normals.get(v as usize)? * ABOVE)
        };
        for pair in chain.windows(2) {
            points.extend(at(pair[0]).zip(at(pair[1])).into_iter().flat_map(|(a, b)| [a, b]));
        }
    };
    for run in garment.seams.iter().flat_map(|s| [&s.a, &s.b]).flat_map(|s| &s.runs) {
        draw(run.piece.index(), &run.vertices);
    }
    for (k, piece) in garment.pieces.iter().enumerate() {
        for chain in piece.mesh.iter().flat_map(|m| &m.chains).filter(|c| c.closed) {
            let ring: Vec<u32> = chain.vertices.iter().chain(chain.vertices.first()).copied().collect();
            draw(k, &ring);
        }
        piece.darts.iter().filter_map(|d| d.mesh.as_ref()).flat_map(|m| &m.legs).for_each(|leg| draw(k, leg));
    }
    if points.is_empty() {
        return Ok(());
    }
    let named = Piece { name: "seams".to_owned(), ..Piece::default() };
    let mut attributes = Attributes::new();
    let p = floats(&named, "the position", points.iter().map(|p| [p.x, p.y, p.z]))?;
    attributes.insert(Valid(Semantic::Positions), buffer.floats(root, &p, Type::Vec3, true));
    let material = plain(root, "thread", THREAD);
    let primitive = json::mesh::Primitive {
        attributes,
        extensions: None,
        extras: None,
        indices: None,
        material: Some(material),
        mode: Valid(Mode::Lines),
        targets: None,
    };
    node(root, "seams", primitive);
    Ok(())
}

/// A plain, dull material.
pub fn plain(root: &mut json::Root, name: &str, [r, g, b]: [f32; 3]) -> json::Index<json::Material> {
    root.push(json::Material {
        name: Some(name.to_owned()),
        double_sided: true,
        pbr_metallic_roughness: json::material::PbrMetallicRoughness {
            base_color_factor: json::material::PbrBaseColorFactor([r, g, b, 1.0]),
            metallic_factor: json::material::StrengthFactor(0.0),
            roughness_factor: json::material::StrengthFactor(1.0),
            ..Default::default()
        },
        ..Default::default()
    })
}

fn part(
    attributes: Attributes,
    indices: json::Index<json::Accessor>,
    mode: Mode,
    material: json::Index<json::Material>,
) -> json::mesh::Primitive {
    json::mesh::Primitive {
        attributes,
        extensions: None,
        extras: None,
        indices: Some(indices),
        material: Some(material),
        mode: Valid(mode),
        targets: None,
    }
}

fn node(root: &mut json::Root, name: &str, primitive: json::mesh::Primitive) {
    let mesh = root.push(json::Mesh {
        extensions: None,
        extras: None,
        name: Some(name.to_owned()),
        primitives: vec![primitive],
        weights: None,
    });
    root.push(json::Node { mesh: Some(mesh), name: Some(name.to_owned()), ..Default::default() });
}
