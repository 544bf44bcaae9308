//! Elastic bands on the meshes: the vertices along them, one for each point that is sewn.

use super::codes;
use super::runs::run_vertices;
use crate::sewing::resolve::{Side, elastic_side};
use crate::sewing::sewn_points::SewnPoints;
use crate::sewing::shapes::Shapes;
use toile_garment::garment::ElasticBand;
use toile_garment::seam::Seam;
use toile_garment::sewing::{BandLength, ElasticSpec};
use toile_garment::{Diagnostic, Garment, MeshVertex, Report};

/// A band longer than its cloth by this share is meant to be longer.
const SLACK: f64 = 1e-6;

/// The bands of the plan. One that is sewn to edges apart from each other lies in several parts.
///
/// # Errors
/// All bands whose edges are not there or not in the mesh.
pub fn bands(
    garment: &Garment,
    shapes: &Shapes,
    seams: &[Seam],
    report: &mut Report,
) -> Result<Vec<ElasticBand>, Vec<Diagnostic>> {
    let mut points = SewnPoints::new(garment, seams);
    let (mut bands, mut errors) = (Vec::new(), Vec::new());
    for spec in &garment.plan.elastics {
        match elastic_side(garment, shapes, spec).and_then(|side| parts(garment, shapes, spec, &side, &mut points)) {
            Ok(parts) => {
                report.findings.extend(slack(spec, &parts));
                bands.extend(banded(spec, parts));
            }
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

/// The length of cloth that a band is sewn to, m, and that of the band as a share of it.
fn lengths(spec: &ElasticSpec, parts: &[Part]) -> (f64, f64) {
    let cloth: f64 = parts.iter().flat_map(|p| &p.lengths).sum();
    let share = match spec.length {
        BandLength::Length(length) => length / cloth,
        BandLength::Share(share) => share,
    };
    (cloth, share)
}

/// A warning on a band that is longer than its cloth.
fn slack(spec: &ElasticSpec, parts: &[Part]) -> Option<Diagnostic> {
    let (cloth, share) = lengths(spec, parts);
    let message = format!(
        "elastic `{}` never pulls: it is {:.0} mm long, and the cloth that it is sewn to {:.0} mm",
        spec.name,
        cloth * share * 1e3,
        cloth * 1e3
    );
    let found = Diagnostic::warning(codes::BAND_SLACK, message).at(spec.source.clone());
    (share > 1.0 + SLACK).then(|| found.hint("give it a shorter `length`, such as \"80 %\""))
}

/// The band over all parts, as long as the file says.
fn banded(spec: &ElasticSpec, parts: Vec<Part>) -> impl Iterator<Item = ElasticBand> {
    let (_, share) = lengths(spec, &parts);
    parts.into_iter().map(move |part| ElasticBand {
        name: spec.name.clone(),
        vertices: part.vertices,
        rest: part.lengths.iter().map(|l| l * share).collect(),
        stretch: spec.stretch,
    })
}

#[cfg(test)]
mod tests {
    use crate::assemble::Assemble;
    use crate::testing::{one, rectangle, run};
    use crate::triangulate::Triangulate;
    use toile_garment::sewing::{BandLength, ElasticSpec, RunSpec};

    #[test]
    fn a_band_longer_than_its_cloth_is_told() {
        for (length, is_told) in [(BandLength::Share(1.6), true), (BandLength::Length(0.31), true)]
            .into_iter()
            .chain([(BandLength::Share(1.0), false), (BandLength::Length(0.2), false)])
        {
            let mut garment = one(rectangle(0, "cuff", 300.0, 60.0));
            let along = vec![RunSpec::Edge { piece: "cuff".into(), edge: "0".into() }];
            let band = ElasticSpec { name: "hem".into(), along, length, stretch: 30.0, source: None };
            garment.plan.elastics = vec![band];
            let (garment, _) = run(&Triangulate, &Default::default(), garment).expect("mesh");
            let (_, report) = run(&Assemble, &Default::default(), garment).expect("bands");
            let told = report.findings.iter().any(|f| f.code == "band-slack" && f.message.contains("300 mm"));
            assert_eq!(told, is_told, "{length:?}: {:?}", report.findings);
        }
    }
}
