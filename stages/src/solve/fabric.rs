//! A fabric of the garment as a material of the solver.

use toile_cloth::{Bending, Curve, Material};
use toile_garment::fabric::{Fabric, StretchLaw};

/// The solver's material for a fabric.
#[must_use]
pub fn material(fabric: &Fabric) -> Material {
    Material {
        areal_mass: fabric.areal_mass,
        thickness: fabric.thickness,
        friction: fabric.friction,
        warp: curve(&fabric.stretch_warp),
        weft: curve(&fabric.stretch_weft),
        shear: fabric.shear,
        shear_curve: samples(&fabric.shear_curve),
        poisson: fabric.poisson,
        bending: Bending {
            warp: fabric.bend_warp,
            weft: fabric.bend_weft,
            bias: fabric.bend_bias,
            curve: [samples(&fabric.bend_curve_warp), samples(&fabric.bend_curve_weft)],
            friction: fabric.bend_friction(),
            rest_curvature: [fabric.rest_curvature_warp, fabric.rest_curvature_weft].map(|k| k.unwrap_or(0.0)),
        },
        springs: fabric.springs.map(|s| [s.yarn, s.bias]),
        strain_limit: [
            fabric.strain_limit_warp,
            fabric.strain_limit_weft,
            fabric.strain_limit_bias.unwrap_or(f64::INFINITY),
        ],
    }
}

fn samples(points: &Option<Vec<[f64; 2]>>) -> Option<Curve> {
    points.clone().map(Curve::Samples)
}

fn curve(law: &StretchLaw) -> Curve {
    match law {
        StretchLaw::Linear { stiffness } => Curve::Linear { stiffness: *stiffness },
        StretchLaw::Exponential { k0, beta } => Curve::Exponential { k0: *k0, beta: *beta },
        StretchLaw::Samples { points } => Curve::Samples(points.clone()),
    }
}
