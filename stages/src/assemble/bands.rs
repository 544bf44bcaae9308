//! Elastic bands on the meshes: the vertices along them, one for each point that is sewn.

use super::codes;
use super::runs::run_vertices;
use crate::sewing::resolve::{Side, elastic_side};
use crate::sewing::sewn_points::SewnPoints;
use crate::sewing::shapes::Shapes;
use toile_garment::garment::ElasticBand;
use toile_garment::seam::Seam;
use toile_garment::sewing::{BandLength, ElasticSpec};
use toile_garment::{Diagnostic, Garment, MeshVertex};

/// The bands of the plan. One that is sewn to edges apart from each other lies in several parts.
///
/// # Errors
/// All bands whose edges are not there or not in the mesh.
pub fn bands(garment: &Garment, shapes: &Shapes, seams: &[Seam]) -> Result<Vec<ElasticBand>, Vec<Diagnostic>> {
    let mut points = SewnPoints::new(garment, seams);
    let (mut bands, mut errors) = (Vec::new(), Vec::new());
    for spec in &garment.plan.elastics {
        match elastic_side(garment, shapes, spec).and_then(|side| parts(garment, shapes, spec, &side, &mut points)) {
            Ok(parts) => bands.extend(banded(spec, parts)),
            Err(e) => errors.push(e),
        }
    }
    if errors.is_empty() { Ok(bands) } else { Err(errors) }
}

/// A stretch of edges without a break: its vertices, and the length of cloth from each to the next, m.
struct Part {
    vertices: Vec<MeshVertex>,
    lengths: Vec<f64>,
}

fn parts(
    garment: &Garment,
    shapes: &Shapes,
    spec: &ElasticSpec,
    side: &Side,
    points: &mut SewnPoints,
) -> Result<Vec<Part>, Diagnostic> {
    let mut parts: Vec<Part> = Vec::new();
    for span in &side.spans {
        let piece = &garment.pieces[span.piece.index()];
        let run = run_vertices(piece, &shapes[span.piece.index()], span).zip(piece.mesh.as_ref());
        let (run, mesh) = run.ok_or_else(|| {
            let message = format!("elastic `{}`: its ends on piece `{}` are no mesh vertices", spec.name, piece.name);
            Diagnostic::error(codes::BAND_NOT_IN_MESH, message)
                .at(spec.source.clone())
                .hint("let it run along whole edges, from corner to corner")
        })?;
        let of = |v: u32| MeshVertex { piece: piece.id, vertex: v };
        let last = parts.last().and_then(|p| p.vertices.last()).copied();
        if !last.is_some_and(|last| points.are_one(last, of(run[0]))) {
            parts.push(Part { vertices: vec![of(run[0])], lengths: Vec::new() });
        }
        let Some(part) = parts.last_mut() else { continue };
        for w in run.windows(2) {
            part.lengths.push((mesh.rest[w[1] as usize] - mesh.rest[w[0] as usize]).norm());
            part.vertices.push(of(w[1]));
        }
    }
    if let [ring] = parts.as_mut_slice()
        && ring.vertices.len() > 3
        && points.are_one(ring.vertices[0], ring.vertices[ring.vertices.len() - 1])
    {
        ring.vertices.pop();
    }
    Ok(parts)
}

/// The band over all parts, as long as the file says.
fn banded(spec: &ElasticSpec, parts: Vec<Part>) -> impl Iterator<Item = ElasticBand> {
    let cloth: f64 = parts.iter().flat_map(|p| &p.lengths).sum();
    let share = match spec.length {
        BandLength::Length(length) => length / cloth,
        BandLength::Share(share) => share,
    };
    parts.into_iter().map(move |part| ElasticBand {
        name: spec.name.clone(),
        vertices: part.vertices,
        rest: part.lengths.iter().map(|l| l * share).collect(),
        stretch: spec.stretch,
    })
}
