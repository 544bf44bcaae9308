//! Facts on which the rules of effects decide. Files tell them before any work, and so does a scene.

use crate::{Material, Scene, Settings};

/// The facts, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// The cloth, in words.
    pub cloth: String,
    /// The body, in words; `None` where there is none.
    pub body: Option<String>,
    /// Largest coefficient of friction of the fabrics.
    pub friction: f64,
    /// Smallest strain limit of the fabrics; infinite where none has a limit.
    pub strain_limit: f64,
    /// Largest share of friction in bending: HB/B times the bending length.
    pub bend_friction: f64,
    /// Strongest curvature of the fabrics without load, 1/m.
    pub rest_curvature: f64,
    /// Number of measured curves of shear and bending that the fabrics have.
    pub curves: usize,
    /// Pressure behind the cloth, Pa.
    pub pressure: f64,
}

impl Facts {
    /// Facts of fabrics under the settings, with cloth and body in words.
    #[must_use]
    pub fn new(materials: &[Material], settings: &Settings, cloth: String, body: Option<String>) -> Self {
        let most = |of: fn(&Material) -> f64| materials.iter().map(of).fold(0.0, f64::max);
        Self {
            cloth,
            body,
            friction: most(|m| m.friction),
            strain_limit: materials.iter().flat_map(|m| m.strain_limit).fold(f64::INFINITY, f64::min),
            bend_friction: most(Material::bend_friction_share),
            rest_curvature: most(|m| m.bending.rest_curvature[0].abs().max(m.bending.rest_curvature[1].abs())),
            curves: materials.iter().map(Material::measured_curves).sum(),
            pressure: settings.pressure,
        }
    }

    /// Facts of a scene.
    pub(crate) fn of_scene(scene: &Scene, settings: &Settings) -> Self {
        let cloth = format!("{} triangles", scene.triangles.len());
        let body = scene.body.as_ref().map(|_| "a body".to_owned());
        Self::new(&scene.materials, settings, cloth, body)
    }
}
