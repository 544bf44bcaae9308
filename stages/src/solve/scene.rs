//! A garment as a scene: vertices of all pieces in one list, rest shapes on the grain.

use super::fabric::material;
use toile_cloth::{BodyMesh, Element, Load, Material, Pin, Scene};
use toile_garment::mesh::PieceMesh;
use toile_garment::{Diagnostic, Garment, MeshVertex, Piece, Vec2, Vec3};

/// Where each piece's vertices stand in the solver's list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    first: Vec<u32>,
    count: u32,
}

impl Layout {
    /// The layout of a meshed garment: pieces in order, vertices in order.
    #[must_use]
    pub fn of(garment: &Garment) -> Self {
        let mut first = Vec::with_capacity(garment.pieces.len());
        let mut count = 0_u32;
        for piece in &garment.pieces {
            first.push(count);
            let n = piece.mesh.as_ref().map_or(0, |m| m.rest.len());
            count = count.saturating_add(u32::try_from(n).unwrap_or(u32::MAX));
        }
        Self { first, count }
    }

    /// The solver's index of a mesh vertex.
    #[must_use]
    pub fn index(&self, v: MeshVertex) -> u32 {
        self.first.get(v.piece.index()).map_or(u32::MAX, |f| f.saturating_add(v.vertex))
    }

    /// All positions in the solver's order.
    #[must_use]
    pub fn join(&self, per_piece: &[Vec<Vec3>]) -> Vec<Vec3> {
        per_piece.iter().flatten().copied().collect()
    }

    /// The solver's positions per piece.
    #[must_use]
    pub fn split(&self, all: &[Vec3]) -> Vec<Vec<Vec3>> {
        let ends = self.first.iter().skip(1).copied().chain([self.count]);
        self.first.iter().zip(ends).map(|(a, b)| all[*a as usize..b as usize].to_vec()).collect()
    }
}

/// The scene of a garment at given positions (solver's order).
///
/// # Errors
/// When a piece has no fabric.
pub fn scene(
    garment: &Garment,
    layout: &Layout,
    positions: Vec<Vec3>,
    gravity: Vec3,
) -> Result<Scene, Vec<Diagnostic>> {
    let mut materials: Vec<Material> = Vec::new();
    let mut triangles = Vec::new();
    let mut errors = Vec::new();
    for piece in &garment.pieces {
        let Some(fabric) = garment.fabric_of(piece) else {
            errors.push(no_fabric(piece));
            continue;
        };
        let it = material(fabric);
        let known = materials.iter().position(|m| *m == it);
        let index = known.unwrap_or_else(|| {
            materials.push(it);
            materials.len() - 1
        });
        triangles.extend(elements(piece, layout, u32::try_from(index).unwrap_or(u32::MAX)));
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let stitches = garment.seams.iter().flat_map(|s| &s.stitches);
    Ok(Scene {
        positions,
        triangles,
        materials,
        pins: garment.pins.iter().map(|p| Pin { vertex: layout.index(p.vertex), at: p.at }).collect(),
        loads: garment.loads.iter().map(|l| Load { vertex: layout.index(l.vertex), force: l.force }).collect(),
        stitches: stitches.map(|s| [layout.index(s.a), layout.index(s.b)]).collect(),
        body: garment
            .body
            .as_ref()
            .filter(|b| !b.triangles.is_empty())
            .map(|b| BodyMesh { positions: b.positions.clone(), triangles: b.triangles.clone() }),
        gravity,
        layers: layers(garment, layout),
    })
}

fn no_fabric(piece: &Piece) -> Diagnostic {
    let material = piece.material.as_deref().unwrap_or("");
    Diagnostic::error("fabric-missing", format!("piece `{}` (material `{material}`) has no fabric", piece.name))
        .at(piece.source.clone())
        .hint("give the stage a fabric: with.fabric = \"…toml\"")
}

/// Triangles of a piece with rest corners in (weft, warp) metres.
fn elements<'a>(piece: &'a Piece, layout: &'a Layout, material: u32) -> impl Iterator<Item = Element> + 'a {
    piece.mesh.iter().flat_map(move |mesh| {
        let (weft, warp) = cloth_axes(piece, mesh);
        mesh.triangles.iter().enumerate().filter_map(move |(i, t)| {
            Some(Element {
                vertices: t.map(|v| layout.index(MeshVertex { piece: piece.id, vertex: v })),
                rest: mesh.rest_triangle(i)?.map(|p| [p.dot(&weft), p.dot(&warp)]),
                material,
            })
        })
    })
}

/// Weft and warp in the frame of the rest corners: corners of their own already stand on the grain.
fn cloth_axes(piece: &Piece, mesh: &PieceMesh) -> (Vec2, Vec2) {
    let warp = if mesh.rest_corners.is_some() { Vec2::y() } else { piece.warp() };
    (Vec2::new(warp.y, -warp.x), warp)
}

fn layers(garment: &Garment, layout: &Layout) -> Vec<i32> {
    if garment.plan.layers.is_empty() {
        return Vec::new();
    }
    let mut layers = vec![0; layout.count as usize];
    for spec in &garment.plan.layers {
        for piece in garment.pieces.iter().filter(|p| spec.pieces.iter().any(|n| n.eq_ignore_ascii_case(&p.name))) {
            let n = piece.mesh.as_ref().map_or(0, |m| m.rest.len());
            let first = layout.first[piece.id.index()] as usize;
            layers[first..first + n].fill(spec.order);
        }
    }
    layers
}
