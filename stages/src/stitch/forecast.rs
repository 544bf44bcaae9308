//! The forecast of `stitch`: CPU time and memory, from the mesh, the body and the seams.

use toile_stage_api::{Cost, Forecast};

/// The cost of sewing; `None` while no stage has told the size of the mesh.
///
/// It is fitted to 31 garments of 1,000 to 20,000 triangles, together with that of `drape`; three in four are within a
/// factor of 1.5 (`docs/lab/2026-12-01-forecasts-by-free-edges.md`). The cloth meets the triangles of the body below it,
/// however coarse it is itself, and every seam takes steps to close.
pub(super) fn cost(forecast: &Forecast) -> Option<Cost> {
    let (body, seams) = (forecast.body_thousands(), forecast.garment.plan.seams.len() as f64);
    let (mesh, gathered) = (forecast.mesh?, forecast.edges.map_or(0.0, |edges| edges.gathered));
    let below = body * seams * mesh.area();
    let growing = 0.016 * libm::pow(mesh.triangles * 1e-3, 0.75) + 0.12 * gathered;
    forecast.by_triangles(0.006 * body + 0.0038 * below, growing, 4.3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{body_of, seam};
    use toile_garment::Garment;
    use toile_garment::body::Body;
    use toile_garment::sewing::SewingPlan;
    use toile_stage_api::MeshSize;

    /// CPU seconds for cloth of this many triangles with edges of 30 mm.
    fn seconds(triangles: f64, seams: usize, body_triangles: usize) -> f64 {
        let body = Body { triangles: vec![[0, 1, 2]; body_triangles], ..body_of(&[]) };
        let plan = SewingPlan { seams: vec![seam("side", Vec::new(), Vec::new()); seams], ..SewingPlan::default() };
        let garment = Garment { body: Some(body), plan, ..Garment::default() };
        let mesh = Some(MeshSize { triangles, edge: 0.03 });
        cost(&Forecast { garment, mesh, ..Forecast::default() }).expect("a mesh").seconds
    }

    #[test]
    fn trousers_take_longer_to_sew_than_a_skirt_of_the_same_cloth() {
        let (skirt, trousers) = (seconds(3000.0, 4, 48_000), seconds(3000.0, 16, 48_000));
        assert!(trousers > 2.0 * skirt, "{trousers} and {skirt}");
        // Where no body lies below the cloth, its seams close as they are.
        assert_eq!(seconds(3000.0, 4, 0), seconds(3000.0, 16, 0));
    }

    #[test]
    fn a_finer_body_costs_more_however_coarse_the_cloth_is() {
        assert!(seconds(3000.0, 16, 48_000) > 2.0 * seconds(3000.0, 16, 12_000));
        assert_eq!(cost(&Forecast::default()), None);
    }
}
