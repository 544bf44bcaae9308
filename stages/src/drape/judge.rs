//! Figures of a shape by one law, whatever method made it: so methods can be compared.

use super::{DrapeParams, weld};
use crate::solve::{Layout, failure, scene};
use toile_cloth::{Figures, Scene, Vec3};
use toile_garment::Garment;
use toile_garment::garment::Shape;
use toile_stage_api::StageError;

/// Figures of a shape by the coupled law of the fabric and the gravity of `drape`.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Strains, elastic energy and crossings.
    pub figures: Figures,
    /// Energy of the weight over the floor, J.
    pub weight: f64,
}

/// Judges a shape of a garment.
///
/// # Errors
/// When fabrics are missing or the mesh is unusable.
pub fn judge(garment: &Garment, shape: &Shape) -> Result<Judged, StageError> {
    let params = DrapeParams::default();
    let (layout, settings) = (Layout::of(garment), params.settings(1));
    let positions = layout.join(&shape.positions);
    let gravity = Vec3::new(0.0, -params.gravity.0, 0.0);
    let start = scene(garment, &layout, positions.clone(), gravity).map_err(StageError::Parameter)?;
    let sewn = weld(start, &positions, &settings).0.scene;
    let figures = toile_cloth::certify(&sewn, &settings, &sewn.positions).map_err(failure)?;
    Ok(Judged { figures, weight: weight(&sewn) })
}

/// Energy of the weight over the floor, J.
fn weight(scene: &Scene) -> f64 {
    let of_triangle = |e: &toile_cloth::Element| {
        let middle = e.vertices.iter().map(|v| scene.positions[*v as usize]).sum::<Vec3>() / 3.0;
        let mass = e.area().abs() * scene.materials[e.material as usize].areal_mass;
        -mass * scene.gravity.dot(&middle)
    };
    scene.triangles.iter().map(of_triangle).sum()
}
