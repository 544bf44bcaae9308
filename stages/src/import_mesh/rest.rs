//! The rest shape of an imported mesh.
//!
//! A flat mesh, or one whose `vt` give every vertex one place, becomes a layout of one point per vertex. A curved rest
//! shape has no such layout: there each triangle keeps the rest places of its own corners (`PieceMesh::rest_corners`),
//! so edge lengths at rest are exactly those of the file.

use super::codes;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toile_formats::obj::ObjMesh;
use toile_garment::mesh::PieceMesh;
use toile_garment::{Diagnostic, SourceRef, Tally, Vec2, Vec3};

/// Where the rest shape comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Rest {
    /// The start positions are the rest shape.
    #[default]
    Positions,
    /// The texture vertices: metres, u along the weft, v along the warp.
    Uv,
}

/// A mesh is flat when no vertex leaves the plane by more than this share of its size.
const FLAT: f64 = 1e-9;
/// Triangles thinner than this (area over squared longest edge) have no shape to keep.
const THIN: f64 = 1e-12;

/// A mesh with its rest shape.
pub struct Built {
    pub mesh: PieceMesh,
    pub findings: Vec<Diagnostic>,
}

/// The triangles that have an area at rest, and what became of the others.
struct Sorted {
    triangles: Vec<[u32; 3]>,
    /// Shape of each triangle in the plane, as drawn.
    shapes: Vec<[Vec2; 3]>,
    /// Triangles that lie mirrored in the plane.
    turned: Vec<bool>,
    /// Triangles without area.
    flat: Tally,
}

/// Builds the mesh; triangles without area are left out and counted.
pub fn build(rest: Rest, file: &str, positions: &[Vec3], cloth: &ObjMesh) -> Result<Built, Box<Diagnostic>> {
    let uv = texture_corners(rest, file, cloth)?;
    let frame = frame_of(positions, &cloth.triangles);
    let Sorted { triangles, mut shapes, turned, flat } = sort(positions, cloth, uv, &frame);
    if triangles.is_empty() {
        let finding = Diagnostic::error(codes::MESH_EMPTY, format!("`{file}` has no triangle with area at rest"));
        return Err(Box::new(finding.at(SourceRef::file(file))));
    }
    let findings = notes(file, &turned, &flat);
    for (shape, _) in shapes.iter_mut().zip(&turned).filter(|(_, turned)| **turned) {
        shape.iter_mut().for_each(|p| p.x = -p.x);
    }
    let mesh = match layout(positions.len(), &triangles, &shapes) {
        Some(rest) => PieceMesh { rest, triangles, ..PieceMesh::default() },
        None => PieceMesh {
            rest: picture(&frame, positions),
            triangles,
            rest_corners: Some(shapes),
            ..PieceMesh::default()
        },
    };
    Ok(Built { mesh, findings })
}

/// The texture vertices of all corners, when they are the rest shape.
fn texture_corners<'c>(
    rest: Rest,
    file: &str,
    cloth: &'c ObjMesh,
) -> Result<Option<&'c Vec<[u32; 3]>>, Box<Diagnostic>> {
    match (rest, &cloth.uv_triangles) {
        (Rest::Positions, _) => Ok(None),
        (Rest::Uv, Some(uv)) => Ok(Some(uv)),
        (Rest::Uv, None) => {
            let message = format!("`rest = \"uv\"`, but not every corner in `{file}` has a texture vertex");
            let finding = Diagnostic::error(codes::MESH_WITHOUT_UV, message).at(SourceRef::file(file));
            Err(Box::new(
                finding.hint("export the mesh with texture coordinates in metres, or use rest = \"positions\""),
            ))
        }
    }
}

/// Lays every triangle into the plane and keeps those with an area.
fn sort(positions: &[Vec3], cloth: &ObjMesh, uv: Option<&Vec<[u32; 3]>>, frame: &Frame) -> Sorted {
    let mut out = Sorted {
        triangles: Vec::with_capacity(cloth.triangles.len()),
        shapes: Vec::with_capacity(cloth.triangles.len()),
        turned: Vec::with_capacity(cloth.triangles.len()),
        flat: Tally::default(),
    };
    for (k, t) in cloth.triangles.iter().enumerate() {
        let shape = match uv.and_then(|uv| uv.get(k)) {
            Some(uv) => uv.map(|i| cloth.texcoords.get(i as usize).map_or_else(Vec2::zeros, |p| Vec2::new(p[0], p[1]))),
            None => frame.lay(t.map(|i| positions[i as usize])),
        };
        let area = doubled_area(shape);
        let longest = (0..3).map(|i| (shape[(i + 1) % 3] - shape[i]).norm_squared()).fold(0.0, f64::max);
        if area.abs() <= THIN * longest {
            out.flat.add(k);
            continue;
        }
        out.triangles.push(*t);
        out.turned.push(area < 0.0);
        out.shapes.push(shape);
    }
    out
}

/// Warnings about triangles that were left out or lie mirrored.
fn notes(file: &str, turned: &[bool], flat: &Tally) -> Vec<Diagnostic> {
    let backwards = turned.iter().filter(|t| **t).count();
    let left_out = format!("triangles without area at rest were left out: number {flat}");
    let mirrored = "triangles lie mirrored in the texture plane; the cloth is seen from its back there";
    [(flat.count(), codes::TRIANGLES_FLAT, left_out.as_str()), (backwards, codes::UV_MIRRORED, mirrored)]
        .into_iter()
        .filter(|(count, ..)| *count > 0)
        .map(|(count, code, words)| {
            Diagnostic::warning(code, format!("`{file}`: {count} {words}")).at(SourceRef::file(file))
        })
        .collect()
}

/// One place per vertex, when all triangles agree to the bit.
fn layout(count: usize, triangles: &[[u32; 3]], shapes: &[[Vec2; 3]]) -> Option<Vec<Vec2>> {
    let mut rest: Vec<Option<Vec2>> = vec![None; count];
    for (t, shape) in triangles.iter().zip(shapes) {
        for (v, p) in t.iter().zip(shape) {
            match rest.get_mut(*v as usize)? {
                Some(there) if there != p => return None,
                slot => *slot = Some(*p),
            }
        }
    }
    Some(rest.into_iter().map(|p| p.unwrap_or_else(Vec2::zeros)).collect())
}

fn doubled_area([a, b, c]: [Vec2; 3]) -> f64 {
    (b - a).perp(&(c - a))
}

/// A picture of a curved mesh for people: seen along its frame, or from the front.
fn picture(frame: &Frame, positions: &[Vec3]) -> Vec<Vec2> {
    match frame {
        Frame::Plane { weft, warp, .. } => positions.iter().map(|p| Vec2::new(p.dot(weft), p.dot(warp))).collect(),
        Frame::Curved => positions.iter().map(|p| Vec2::new(p.x, p.y)).collect(),
    }
}

/// How 3D positions become rest places.
enum Frame {
    /// The whole mesh is flat: one layout for all.
    Plane { origin: Vec3, weft: Vec3, warp: Vec3 },
    /// Each triangle has a frame of its own.
    Curved,
}

impl Frame {
    fn lay(&self, [a, b, c]: [Vec3; 3]) -> [Vec2; 3] {
        match self {
            Self::Plane { origin, weft, warp } => {
                [a, b, c].map(|p| Vec2::new((p - origin).dot(weft), (p - origin).dot(warp)))
            }
            Self::Curved => {
                let normal = (b - a).cross(&(c - a));
                let Some(normal) = normal.try_normalize(0.0) else { return [Vec2::zeros(); 3] };
                let (weft, warp) = axes(normal);
                [a, b, c].map(|p| Vec2::new((p - a).dot(&weft), (p - a).dot(&warp)))
            }
        }
    }
}

/// Weft and warp on a triangle or plane: the warp runs up. On one that lies nearly level it runs to the back (+y of a
/// file with z up), the weft to the wearer's left (+x).
fn axes(normal: Vec3) -> (Vec3, Vec3) {
    let along = |d: Vec3| d - normal * d.dot(&normal);
    let up = along(Vec3::y());
    let warp = if up.norm() > 0.3 { up } else { along(-Vec3::z()) };
    let warp = warp.normalize();
    (warp.cross(&normal), warp)
}

fn frame_of(positions: &[Vec3], triangles: &[[u32; 3]]) -> Frame {
    let normal: Vec3 = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|i| positions[i as usize]);
            (b - a).cross(&(c - a))
        })
        .sum();
    let (Some(normal), Some(origin)) = (normal.try_normalize(0.0), triangles.first().map(|t| positions[t[0] as usize]))
    else {
        return Frame::Curved;
    };
    let used = || triangles.iter().flatten().map(|i| positions[*i as usize] - origin);
    let size = used().map(|d| d.norm()).fold(0.0, f64::max);
    if used().any(|d| d.dot(&normal).abs() > FLAT * size) {
        return Frame::Curved;
    }
    let (weft, warp) = axes(normal);
    Frame::Plane { origin, weft, warp }
}

/// Says where the grain lies when the file does not.
pub fn grain_note(file: &str) -> Diagnostic {
    let message = format!("`{file}` says nothing about the grain: the warp runs up, on level cloth to the back");
    Diagnostic::info(codes::GRAIN_GUESSED, message)
        .at(SourceRef::file(file))
        .hint("give `vt` in metres (u weft, v warp) and rest = \"uv\" to lay the grain otherwise")
}
