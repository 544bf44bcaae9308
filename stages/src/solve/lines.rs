//! Elastic bands and pressed folds of a garment in the solver's words.

use super::scene::interlined;
use super::{Layout, material};
use toile_cloth::{Band, FoldLine, Material};
use toile_garment::garment::ElasticBand;
use toile_garment::mesh::PieceMesh;
use toile_garment::piece::PressedFold;
use toile_garment::{Garment, MeshVertex, Piece, Vec2};

/// Width of cloth that a pressed fold bends over, m. It is chosen: the fold then holds its angle against the weight of cloth
/// that hangs from it. The moment per length and angle is the cloth's bending rigidity over this width.
const FOLD_WIDTH: f64 = 1e-3;
/// A vertex of a line lies on it within this distance, m.
const ON_LINE: f64 = 2e-6;

/// A band as the solver needs it.
#[must_use]
pub fn band(band: &ElasticBand, layout: &Layout) -> Band {
    let vertices = band.vertices.iter().map(|v| layout.index(*v)).collect();
    Band { vertices, rest: band.rest.clone(), stiffness: band.stretch }
}

/// The pressed folds of a piece as the solver needs them.
pub fn folds<'a>(garment: &'a Garment, piece: &'a Piece, layout: &'a Layout) -> impl Iterator<Item = FoldLine> + 'a {
    let cloth = garment.fabric_of(piece).map(|f| interlined(garment, piece, material(f))).zip(piece.mesh.as_ref());
    cloth.into_iter().flat_map(move |(cloth, mesh)| {
        piece.folds.iter().map(move |fold| FoldLine {
            vertices: fold_vertices(mesh, &fold.line)
                .into_iter()
                .map(|v| layout.index(MeshVertex { piece: piece.id, vertex: v }))
                .collect(),
            angle: fold.angle,
            stiffness: bending_across(&cloth, piece, fold) / FOLD_WIDTH,
        })
    })
}

/// Mesh vertices on a line, in its order.
#[must_use]
pub fn fold_vertices(mesh: &PieceMesh, line: &[Vec2]) -> Vec<u32> {
    let mut out = Vec::new();
    for ends in line.windows(2) {
        let way = ends[1] - ends[0];
        let length = way.norm();
        let mut on: Vec<(f64, u32)> = Vec::new();
        for (v, p) in (0u32..).zip(&mesh.rest) {
            let (along, off) = ((p - ends[0]).dot(&way) / length, (p - ends[0]).perp(&way).abs() / length);
            if off < ON_LINE && (-ON_LINE..=length + ON_LINE).contains(&along) {
                on.push((along, v));
            }
        }
        on.sort_by(|a, b| a.0.total_cmp(&b.0));
        out.extend(on.into_iter().map(|(_, v)| v));
    }
    out.dedup();
    out
}

/// Bending rigidity of cloth across a line, N·m: that of an orthotropic plate in this direction, as a whole.
fn bending_across(cloth: &Material, piece: &Piece, fold: &PressedFold) -> f64 {
    let way = fold.line.last().zip(fold.line.first()).map_or_else(Vec2::x, |(b, a)| b - a);
    let along_warp = way.normalize().dot(&piece.warp());
    // A line along the warp bends the weft.
    let (weft, warp) = (along_warp * along_warp, 1.0 - along_warp * along_warp);
    cloth.bending.weft * weft * weft + 4.0 * cloth.bending.twist() * weft * warp + cloth.bending.warp * warp * warp
}
