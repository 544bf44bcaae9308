//! The energies that a model of the cloth calls for.

use crate::energy::Energy;
use crate::energy::bending::Flexion;
use crate::energy::bending_curve::BendingCurve;
use crate::energy::coupled::Coupled;
use crate::energy::elastic_band::Bands;
use crate::energy::fold_line::Creases;
use crate::energy::rest_curvature::RestCurvature;
use crate::energy::shear::Shear;
use crate::energy::shear_curve::ShearCurve;
use crate::energy::structural::Structural;
use crate::energy::weight::Weight;
use crate::scene::topology::Topology;
use crate::{Model, Scene, Settings};

/// The energies of a model, and the weight.
pub(crate) fn model(scene: &Scene, s: &Settings, topology: &Topology, mass: &[f64]) -> Vec<Box<dyn Energy>> {
    let mut list: Vec<Box<dyn Energy>> = match s.model {
        Model::Springs => {
            vec![Box::new(Structural::new(scene, topology, s)), Box::new(Shear::new(scene, topology))]
        }
        Model::Coupled => vec![Box::new(Coupled::new(scene, s))],
    };
    list.push(Box::new(Flexion::new(scene, topology)));
    if let Some(curve) = ShearCurve::new(scene, s) {
        list.push(Box::new(curve));
    }
    if let Some(curve) = BendingCurve::new(scene, topology, s) {
        list.push(Box::new(curve));
    }
    if let Some(curl) = RestCurvature::new(scene, topology) {
        list.push(Box::new(curl));
    }
    if !scene.bands.is_empty() {
        list.push(Box::new(Bands::new(scene)));
    }
    if !scene.folds.is_empty() {
        list.push(Box::new(Creases::new(scene, topology)));
    }
    list.push(Box::new(Weight::new(scene, mass, s.gravity_scale)));
    list
}
