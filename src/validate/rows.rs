//! Lets measured cloth fall, and judges each law by the captures that did not set it.

use super::band::Band;
use super::captures::{Captured, Face};
use super::laws::{LAWS, Law};
use super::specimen::{Numbers, Specimen};
use crate::engine::Meter;
use rayon::prelude::*;
use serde::Serialize;
use std::sync::atomic::AtomicBool;
use toile_stage_api::StageError;

/// Version of the form of a validation.
pub const VERSION: u32 = 1;
/// Areal mass of a cloth whose mass the table does not tell, kg/m². Drapes depend on stiffness over weight.
const USUAL_MASS: f64 = 0.15;

/// How to let cloth fall.
#[derive(Clone, Copy, Debug)]
pub struct Order<'a> {
    /// Longest edge of the mesh, m. It is shorter where the bending length is.
    pub edge: f64,
    /// Falls of a specimen.
    pub falls: u32,
    /// Set when the user asks to stop.
    pub cancel: &'a AtomicBool,
}

/// The figures that were read of a face.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Readings {
    /// Drape coefficient, %.
    pub coefficient: Band,
    /// Mean height of the hem over the disc, mm.
    pub height: Option<Band>,
}

/// A face of a cloth by one law.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The cloth.
    pub fabric: String,
    /// The face; empty where the table tells none.
    pub face: String,
    /// Name of the law.
    pub law: &'static str,
    /// A capture of this face set the law.
    pub was_set: bool,
    /// Bending length, mm.
    pub bending_length_mm: f64,
    /// Bending rigidity, µN·m.
    pub bending_un_m: f64,
    /// Curvature without load, 1/m, above 0 where this face is hollow.
    pub rest_curvature_per_m: f64,
    /// The captures that did not set the law; `None` where there are no others.
    pub captured: Option<Readings>,
    /// The falls.
    pub simulated: Readings,
}

/// The cost of a law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Name of the law.
    pub law: &'static str,
    /// CPU seconds of setting it and of all falls.
    pub cpu_seconds: f64,
    /// Number of cloths.
    pub cloths: usize,
}

/// Measured drapes beside predicted ones.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Validation {
    /// Version of this form.
    pub toile_validate: u32,
    /// Version of the program.
    pub toile: String,
    /// Name of the table of captures.
    pub captures: String,
    /// Longest edge of the mesh, mm.
    pub edge_mm: f64,
    /// Falls of a specimen.
    pub falls: u32,
    /// One row for each face and law.
    pub rows: Vec<Row>,
    /// The cost of each law.
    pub costs: Vec<Cost>,
}

impl Row {
    /// Bands of the drape coefficient overlap; `None` where nothing can be judged.
    #[must_use]
    pub fn coefficient_agrees(&self) -> Option<bool> {
        self.captured.as_ref()?.coefficient.agrees_with(&self.simulated.coefficient)
    }

    /// The mean drape coefficient lies within the captures.
    #[must_use]
    pub fn coefficient_is_held(&self) -> Option<bool> {
        self.captured.as_ref()?.coefficient.holds(&self.simulated.coefficient)
    }

    /// Bands of the height of the hem overlap.
    #[must_use]
    pub fn height_agrees(&self) -> Option<bool> {
        self.captured.as_ref()?.height?.agrees_with(&self.simulated.height?)
    }
}

impl Validation {
    /// Is a prediction judged by anything?
    #[must_use]
    pub fn judges(&self) -> bool {
        let is_judged = |row: &Row| row.coefficient_agrees().or(row.coefficient_is_held()).or(row.height_agrees());
        self.rows.iter().any(|row| is_judged(row).is_some())
    }
}

/// Rows and costs of all laws. `say` hears of every cloth that is through.
///
/// # Errors
/// When a specimen does not come to rest, or a stop on request.
pub fn validate(
    table: &[Captured],
    order: &Order<'_>,
    say: &mut dyn FnMut(&str),
) -> Result<(Vec<Row>, Vec<Cost>), StageError> {
    let (mut rows, mut costs) = (Vec::new(), Vec::new());
    for law in &LAWS {
        let meter = Meter::start();
        let concerned: Vec<&Captured> = table.iter().filter(|c| law.concerns(c)).collect();
        // A few at a time, so that one hears of them.
        for some in concerned.chunks(2 * rayon::current_num_threads()) {
            let found: Vec<Vec<Row>> =
                some.par_iter().map(|cloth| rows_of(cloth, law, order)).collect::<Result<_, _>>()?;
            rows.extend(found.into_iter().flatten());
            some.iter().for_each(|cloth| say(&format!("{}, {}", cloth.fabric, law.name)));
        }
        costs.push(Cost { law: law.name, cpu_seconds: meter.cpu_seconds().unwrap_or(0.0), cloths: concerned.len() });
    }
    // The laws of one face stand below each other.
    let place = |row: &Row| table.iter().position(|c| c.fabric == row.fabric);
    let face = |row: &Row| place(row).and_then(|c| table[c].faces.iter().position(|f| f.name == row.face));
    rows.sort_by_key(|row| (place(row), face(row)));
    Ok((rows, costs))
}

fn rows_of(cloth: &Captured, law: &Law, order: &Order<'_>) -> Result<Vec<Row>, StageError> {
    let areal_mass = cloth.areal_mass.unwrap_or(USUAL_MASS);
    let specimen = Specimen { areal_mass, edge: order.edge, cancel: order.cancel };
    let numbers = law.set(cloth, &specimen)?;
    let mut rows: Vec<Row> = Vec::new();
    for (k, face) in cloth.faces.iter().enumerate() {
        let own = if law.curls && k % 2 == 1 { numbers.turned() } else { numbers };
        // Cloth that lies flat without load has two equal faces.
        let simulated = match rows.first() {
            Some(first) if !law.curls => first.simulated,
            _ => simulated(&specimen, &own, order.falls)?,
        };
        rows.push(Row {
            fabric: cloth.fabric.clone(),
            face: face.name.clone(),
            law: law.name,
            was_set: k < law.faces_that_set(),
            bending_length_mm: 1e3 * own.bending_length(),
            bending_un_m: 1e6 * own.bending,
            rest_curvature_per_m: own.rest_curvature,
            captured: captured(face),
            simulated,
        });
    }
    Ok(rows)
}

/// All captures of a face but the first, which sets laws. So all laws are judged by the same captures.
fn captured(face: &Face) -> Option<Readings> {
    let others = &face.captures[1..];
    let coefficients: Vec<f64> = others.iter().map(|c| 100.0 * c.coefficient).collect();
    let heights: Vec<f64> = others.iter().filter_map(|c| c.height).map(|h| 1e3 * h).collect();
    Some(Readings { coefficient: Band::of(&coefficients)?, height: Band::of(&heights) })
}

fn simulated(specimen: &Specimen<'_>, numbers: &Numbers, count: u32) -> Result<Readings, StageError> {
    let falls = specimen.falls(numbers, count)?;
    let coefficients: Vec<f64> = falls.iter().map(|f| 100.0 * f.drape_coefficient).collect();
    let heights: Vec<f64> = falls.iter().map(|f| -1e3 * f.drop_mean).collect();
    let coefficient = Band::of(&coefficients).ok_or_else(|| StageError::Internal("no fall".into()))?;
    Ok(Readings { coefficient, height: Band::of(&heights) })
}
