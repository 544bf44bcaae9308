//! Elastic bands on edges that are held for good: they can draw nothing in.

use super::codes;
use crate::sewing::sewn_points::SewnPoints;
use toile_garment::garment::ElasticBand;
use toile_garment::{Diagnostic, Garment, MeshVertex};

/// A warning on every band all of whose vertices are held, or sewn to what is held.
pub fn findings(garment: &Garment) -> Vec<Diagnostic> {
    let mut points = SewnPoints::new(garment, &garment.seams);
    let mut is_held = |v: MeshVertex| garment.pins.iter().any(|p| p.vertex == v || points.are_one(p.vertex, v));
    let mut held: Vec<&ElasticBand> = Vec::new();
    for band in &garment.bands {
        if !band.vertices.is_empty() && band.vertices.iter().all(|v| is_held(*v)) {
            held.push(band);
        }
    }
    held.dedup_by(|a, b| a.name == b.name);
    held.into_iter().map(|band| finding(garment, band)).collect()
}

fn finding(garment: &Garment, band: &ElasticBand) -> Diagnostic {
    let spec = garment.plan.elastics.iter().find(|e| e.name == band.name);
    let message = format!("elastic `{}` draws nothing in: its edges are held on the body for good", band.name);
    let hint = "attach the edges with strength = \"while-sewing\", so that the band has them afterwards";
    Diagnostic::warning(codes::BAND_HELD, message).at(spec.and_then(|s| s.source.clone())).hint(hint)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{one, rectangle};
    use toile_garment::garment::Pin;
    use toile_garment::mesh::PieceMesh;
    use toile_garment::{PieceId, Vec2, Vec3};

    #[test]
    fn a_band_on_a_held_edge_is_told_and_one_with_a_free_vertex_is_not() {
        let of = |vertex| MeshVertex { piece: PieceId(0), vertex };
        let rest = [(0.0, 0.0), (0.1, 0.0), (0.2, 0.0)].map(|(x, y)| Vec2::new(x, y)).to_vec();
        let mesh = Some(PieceMesh { rest, triangles: vec![[0, 1, 2]], ..PieceMesh::default() });
        let mut garment = one(toile_garment::Piece { mesh, ..rectangle(0, "skirt", 100.0, 100.0) });
        garment.bands = vec![ElasticBand { vertices: vec![of(0), of(1), of(2)], ..ElasticBand::named("waist") }];
        garment.pins = [0, 1].map(|v| Pin { vertex: of(v), at: Vec3::zeros() }).to_vec();
        assert!(findings(&garment).is_empty());
        garment.pins.push(Pin { vertex: of(2), at: Vec3::zeros() });
        let told = findings(&garment);
        assert_eq!((told.len(), told[0].code.as_str()), (1, "band-held"));
        assert!(told[0].hint.as_ref().is_some_and(|h| h.contains("while-sewing")));
    }
}
