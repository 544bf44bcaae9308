//! A garment as a scene: vertices of all pieces in one list, rest shapes on the grain.

use super::codes;
use super::fabric::material;
use super::lines;
use std::collections::BTreeSet;
use toile_cloth::{Bending, BodyMesh, ContactFilter, Element, Load, Material, Pin, Scene};
use toile_garment::mesh::PieceMesh;
use toile_garment::seam::Seam;
use toile_garment::sewing::LayerSpec;
use toile_garment::{Diagnostic, Garment, MeshVertex, Piece, Vec2, Vec3};

/// Where each piece's vertices stand in the solver's list: pieces by name, so that the order in which a file lists them
/// changes no bit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Pieces in the solver's order.
    order: Vec<usize>,
    /// First vertex and number of vertices, piece by piece.
    spans: Vec<(u32, u32)>,
    count: u32,
}

impl Layout {
    /// The layout of a meshed garment: vertices of a piece in order.
    #[must_use]
    pub fn of(garment: &Garment) -> Self {
        let mut order: Vec<usize> = (0..garment.pieces.len()).collect();
        order.sort_by(|a, b| garment.pieces[*a].name.cmp(&garment.pieces[*b].name));
        let mut spans = vec![(0, 0); order.len()];
        let mut count = 0_u32;
        for i in &order {
            let n = garment.pieces[*i].mesh.as_ref().map_or(0, |m| m.rest.len());
            let n = u32::try_from(n).unwrap_or(u32::MAX);
            spans[*i] = (count, n);
            count = count.saturating_add(n);
        }
        Self { order, spans, count }
    }

    /// The solver's index of a mesh vertex.
    #[must_use]
    pub fn index(&self, v: MeshVertex) -> u32 {
        self.spans.get(v.piece.index()).map_or(u32::MAX, |s| s.0.saturating_add(v.vertex))
    }

    /// The values of all vertices, such as their positions, in the solver's order.
    #[must_use]
    pub fn join<T: Copy>(&self, per_piece: &[Vec<T>]) -> Vec<T> {
        self.order.iter().filter_map(|i| per_piece.get(*i)).flatten().copied().collect()
    }

    /// The solver's positions per piece.
    #[must_use]
    pub fn split(&self, all: &[Vec3]) -> Vec<Vec<Vec3>> {
        self.spans.iter().map(|(from, n)| all[*from as usize..(*from + *n) as usize].to_vec()).collect()
    }

    /// Seams in the order in which their stitches stand in the scene: by their first vertices.
    #[must_use]
    pub fn seams<'a>(&self, garment: &'a Garment) -> Vec<&'a Seam> {
        let key = |s: &&Seam| s.stitches.iter().map(|s| [self.index(s.a), self.index(s.b)]).min();
        let mut seams: Vec<&Seam> = garment.seams.iter().collect();
        seams.sort_by_key(key);
        seams
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
    for piece in layout.order.iter().map(|i| &garment.pieces[*i]) {
        let Some(fabric) = garment.fabric_of(piece) else {
            errors.push(no_fabric(piece));
            continue;
        };
        let it = interlined(garment, piece, material(fabric));
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
    triangles.shrink_to_fit();
    let seams = layout.seams(garment);
    let stitches = seams.iter().flat_map(|s| &s.stitches);
    Ok(Scene {
        positions,
        triangles: triangles.into(),
        materials,
        pins: garment.pins.iter().map(|p| Pin { vertex: layout.index(p.vertex), at: p.at }).collect(),
        loads: garment.loads.iter().map(|l| Load { vertex: layout.index(l.vertex), force: l.force }).collect(),
        stitches: stitches.map(|s| [layout.index(s.a), layout.index(s.b)]).collect(),
        body: garment
            .body
            .as_ref()
            .filter(|b| !b.triangles.is_empty())
            .map(|b| BodyMesh { positions: b.positions.clone(), triangles: b.triangles.clone() }.into()),
        gravity,
        layers: layers(garment, layout),
        contact_filter: ContactFilter::default(),
        bands: garment.bands.iter().map(|b| lines::band(b, layout)).collect(),
        folds: garment.pieces.iter().flat_map(|p| lines::folds(garment, p, layout)).collect(),
    })
}

/// The fabric of a piece with the interlinings that it has. Both layers bend about a plane of their own.
pub(super) fn interlined(garment: &Garment, piece: &Piece, fabric: Material) -> Material {
    let has = |pieces: &[String]| pieces.iter().any(|n| n.eq_ignore_ascii_case(&piece.name));
    garment.plan.interlinings.iter().filter(|i| has(&i.pieces)).fold(fabric, |m, i| Material {
        areal_mass: m.areal_mass + i.areal_mass,
        bending: Bending {
            warp: m.bending.warp + i.bending,
            weft: m.bending.weft + i.bending,
            bias: m.bending.bias.map(|b| b + i.bending),
            ..m.bending
        },
        ..m
    })
}

fn no_fabric(piece: &Piece) -> Diagnostic {
    let material = piece.material.as_deref().unwrap_or("");
    Diagnostic::error(codes::FABRIC_MISSING, format!("piece `{}` (material `{material}`) has no fabric", piece.name))
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
    for piece in &garment.pieces {
        let (first, n) = layout.spans[piece.id.index()];
        layers[first as usize..(first + n) as usize].fill(layer_of(garment, piece));
    }
    layers
}

/// The layer of a piece: the rank of the order that the sewing file gives it. 0 is the layer of pieces that no table names;
/// the orders over it are 1, 2 and so on, those below it -1, -2 and so on.
#[must_use]
pub fn layer_of(garment: &Garment, piece: &Piece) -> i32 {
    let specs = &garment.plan.layers;
    let named = |l: &&LayerSpec| l.pieces.iter().any(|n| n.eq_ignore_ascii_case(&piece.name));
    let order = specs.iter().rev().find(named).map_or(0, |l| l.order);
    let up_to = |o: &i32| if order > 0 { (1..=order).contains(o) } else { (order..0).contains(o) };
    let ranks: BTreeSet<i32> = specs.iter().map(|l| l.order).filter(up_to).collect();
    i32::try_from(ranks.len()).unwrap_or(i32::MAX) * order.signum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::rectangle;

    #[test]
    fn only_the_order_of_layers_counts_not_the_size_of_their_numbers() {
        let names = ["vest", "shirt", "jacket", "coat", "lining"];
        let orders = [0, 10, 20, 100_000, -7];
        let pieces: Vec<Piece> = (0..5).map(|i| rectangle(i, names[i], 100.0, 100.0)).collect();
        let mut garment = Garment { pieces, ..Garment::default() };
        let spec = |i: usize| LayerSpec { pieces: vec![names[i].to_owned()], order: orders[i], source: None };
        garment.plan.layers = (1..5).map(spec).collect();
        let ranks: Vec<i32> = garment.pieces.iter().map(|p| layer_of(&garment, p)).collect();
        assert_eq!(ranks, [0, 1, 2, 3, -1]);
    }
}
