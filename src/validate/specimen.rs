//! A specimen that falls: 30 cm of cloth on a disc of 18 cm.

use std::sync::atomic::AtomicBool;
use toile_garment::Report;
use toile_garment::fabric::{Fabric, StretchLaw};
use toile_stage_api::{StageContext, StageError};
use toile_stages::fabric_test::cusick::cusick;
use toile_stages::fabric_test::{Cusick, CusickParams};

/// m/s², as in fabric files.
const GRAVITY: f64 = 9.81;
/// Stiffness against stretch along both yarns, N/m, and against shear, N/m per radian: usual ones of woven cloth.
const STRETCH: f64 = 3000.0;
const SHEAR: f64 = 40.0;
/// Thickness, m, and friction: they hardly matter, since a specimen seldom meets itself.
const THICKNESS: f64 = 0.4e-3;
const FRICTION: f64 = 0.3;
/// Largest strain.
const STRAIN_LIMIT: f64 = 0.05;
/// Shortest edge of the mesh, m.
const FINEST_EDGE: f64 = 4e-3;
/// Falls of which a search takes the mean.
const FALLS_OF_A_SEARCH: u32 = 2;

/// The numbers of a cloth, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// Areal mass, kg/m².
    pub areal_mass: f64,
    /// Bending rigidity, N·m.
    pub bending: f64,
    /// Bending hysteresis 2HB, N.
    pub hysteresis: f64,
    /// Curvature without load, 1/m; above 0 where the first face is hollow.
    pub rest_curvature: f64,
}

/// How specimens fall.
pub(super) struct Specimen<'a> {
    pub areal_mass: f64,
    /// Longest edge of the mesh, m.
    pub edge: f64,
    pub cancel: &'a AtomicBool,
}

impl Numbers {
    /// The numbers of a cloth of this bending length (m), coercive curvature HB/B (1/m) and curvature at rest (1/m).
    #[must_use]
    pub fn new(areal_mass: f64, bending_length: f64, coercive_curvature: f64, rest_curvature: f64) -> Self {
        let bending = areal_mass * GRAVITY * bending_length * bending_length * bending_length;
        Self { areal_mass, bending, hysteresis: 2.0 * coercive_curvature * bending, rest_curvature }
    }

    /// Peirce's bending length, m.
    #[must_use]
    pub fn bending_length(&self) -> f64 {
        libm::cbrt(self.bending / (self.areal_mass * GRAVITY))
    }

    /// The same cloth with its other face upwards.
    #[must_use]
    pub fn turned(self) -> Self {
        Self { rest_curvature: -self.rest_curvature, ..self }
    }

    fn fabric(&self) -> Fabric {
        let stretch = StretchLaw::Linear { stiffness: STRETCH };
        Fabric {
            name: "specimen".to_owned(),
            areal_mass: self.areal_mass,
            thickness: THICKNESS,
            friction: FRICTION,
            stretch_warp: stretch.clone(),
            stretch_weft: stretch,
            poisson: 0.0,
            shear: SHEAR,
            bend_warp: self.bending,
            bend_weft: self.bending,
            shear_curve: None,
            bend_bias: None,
            bend_curve_warp: None,
            bend_curve_weft: None,
            bend_hysteresis: (self.hysteresis > 0.0).then_some(self.hysteresis),
            bend_holds_friction: false,
            rest_curvature_warp: Some(self.rest_curvature),
            rest_curvature_weft: Some(self.rest_curvature),
            strain_limit_warp: STRAIN_LIMIT,
            strain_limit_weft: STRAIN_LIMIT,
            strain_limit_bias: None,
            springs: None,
            look: None,
            sources: std::collections::BTreeMap::new(),
        }
    }
}

impl Specimen<'_> {
    /// Mean drape coefficient of a few falls.
    pub fn coefficient(&self, numbers: &Numbers) -> Result<f64, StageError> {
        let falls = self.falls(numbers, FALLS_OF_A_SEARCH)?;
        Ok(falls.iter().map(|f| f.drape_coefficient).sum::<f64>() / falls.len().max(1) as f64)
    }

    /// So many falls.
    pub fn falls(&self, numbers: &Numbers, count: u32) -> Result<Vec<Cusick>, StageError> {
        let (fabric, edge) = (numbers.fabric(), self.edge_for(numbers));
        (0..count).map(|repeat| self.fall(&fabric, edge, repeat)).collect()
    }

    /// Edge of the mesh, m: coarser than the bending length, cloth does not fold freely.
    fn edge_for(&self, numbers: &Numbers) -> f64 {
        self.edge.min(numbers.bending_length().max(FINEST_EDGE))
    }

    fn fall(&self, fabric: &Fabric, edge: f64, repeat: u32) -> Result<Cusick, StageError> {
        // What the standard says of other specimens does not concern captures that were made with this one.
        let mut report = Report::default();
        let mut cx = StageContext {
            report: &mut report,
            progress: &mut (),
            files: &mut (),
            cancel: self.cancel,
            seed: 0,
            threads: 1,
        };
        cusick(fabric, &CusickParams { edge, repeat, ..CusickParams::default() }, &mut cx)
    }
}
