//! The parametric body: one closed mesh that meets given girths and heights.
//!
//! The body is a field: swept sections and eggs joined with fillets. It is polygonised on one side of its plane of
//! symmetry and remeshed to even triangles. Then it is adjusted until a tape on the mesh gives the wanted measures.

pub(crate) mod codes;
pub(crate) mod curve;
mod field;
mod figure;
mod fit;
mod found;
mod landmarks;
mod measures;
mod net;
mod plausible;
mod polygonise;
mod remesh;
pub(crate) mod section;
mod segments;
mod sizes;
pub(crate) mod where_on;

pub use found::{Found, GirthLine, MESH_UNITS, MeshUnit, Pose, Slices, Stance, measured, with_segments};
pub use measures::{BodyGirths, BodyMeasures};
pub use plausible::{check as check_side_file, impossible};
pub use section::{Section, girth_at, hull, section_at, section_near, sections};
pub use sizes::{SIZE_TABLES, Size, SizeTable, like, range};

use figure::Figure;
use fit::{Fitted, Taken, fit, take, wanted};
use net::Net;
use std::collections::BTreeMap;
use toile_garment::body::Body;
use toile_garment::{Diagnostic, Vec3};

/// Largest relative difference between a wanted and a measured girth or height.
const TOLERANCE: f64 = 0.01;

/// The body with these measures: closed, oriented outwards, every edge in two triangles, left as right; metres.
///
/// # Errors
/// Findings `body-measure-out-of-range` and `body-measures-contradict` where the measures are impossible, and
/// `body-measure-not-met` or `body-not-clean` where no figure of this kind meets them within 1 %.
pub fn parametric(m: &BodyMeasures) -> Result<Body, Vec<Diagnostic>> {
    let found = m.check();
    if !found.is_empty() {
        return Err(found);
    }
    let scale = m.scale();
    if scale == 1.0 {
        return drawn(m);
    }
    let mut body = drawn(&m.times(1.0 / scale))?;
    let shrunk = |x: f64| to_micrometres(x * scale);
    body.positions.iter_mut().chain(body.landmarks.values_mut()).for_each(|p| *p = p.map(shrunk));
    body.measures.values_mut().for_each(|x| *x = shrunk(*x));
    for s in body.segments.values_mut() {
        (s.from, s.to) = (s.from.map(shrunk), s.to.map(shrunk));
        (s.half_width, s.half_depth) = (shrunk(s.half_width), shrunk(s.half_depth));
    }
    Ok(body)
}

/// The body of a person as large as an adult.
fn drawn(m: &BodyMeasures) -> Result<Body, Vec<Diagnostic>> {
    let Fitted { figure, mut net } = fit(m);
    for p in &mut net.positions {
        *p = p.map(to_micrometres);
    }
    let taken = take(m, &figure, &net);
    let (positions, triangles) = net.whole();
    let mut findings = missed(m, &taken);
    findings.extend(shape_findings(&figure, &net, &positions, &triangles));
    if !findings.is_empty() {
        return Err(findings);
    }
    let landmarks = landmarks::landmarks(&figure, m);
    let segments = segments::segments(&figure, m, &positions, &triangles);
    Ok(Body {
        name: m.name.clone(),
        positions,
        triangles,
        measures: measures_of(m, &taken),
        landmarks: landmarks.into_iter().map(|(name, p)| (name, p.map(to_micrometres))).collect(),
        segments,
        digest: String::new(),
    })
}

fn to_micrometres(x: f64) -> f64 {
    // Adding zero turns −0 into 0.
    (x * 1e6).round() / 1e6 + 0.0
}

/// The measures a tape finds on the mesh; heights and lengths of construction as asked for.
fn measures_of(m: &BodyMeasures, taken: &Taken) -> BTreeMap<String, f64> {
    let mut all: BTreeMap<String, f64> =
        m.entries().into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    for (name, value) in GIRTHS.iter().zip(taken.girths).chain(HEIGHTS.iter().zip(taken.heights)) {
        all.insert((*name).to_owned(), to_micrometres(value));
    }
    all.remove("floor");
    all
}

const GIRTHS: [&str; 8] = [
    "hip_girth",
    "waist_girth",
    "under_bust_girth",
    "bust_girth",
    "neck_girth",
    "upper_arm_girth",
    "wrist_girth",
    "thigh_girth",
];
const HEIGHTS: [&str; 5] = ["stature", "crotch_height", "shoulder_height", "bust_height", "floor"];

fn missed(m: &BodyMeasures, taken: &Taken) -> Vec<Diagnostic> {
    let wanted = wanted(m);
    let girths = GIRTHS.iter().zip(taken.girths.into_iter().zip(wanted.girths));
    let heights = HEIGHTS.iter().zip(taken.heights.into_iter().zip(wanted.heights));
    girths
        .chain(heights)
        .filter(|(_, (have, want))| (have - want).abs() > TOLERANCE * want.max(0.1))
        .map(|(name, (have, want))| {
            let (have, want) = (have * 1000.0, want * 1000.0);
            let message =
                format!("{name} = {want:.1} mm cannot be reached with the other measures: the nearest is {have:.1} mm");
            Diagnostic::error(codes::BODY_MEASURE_NOT_MET, message).hint("bring the measures closer to each other")
        })
        .collect()
}

/// Is the surface one ball without handles, nowhere folded against the figure's own surface?
fn shape_findings(figure: &Figure, net: &Net, positions: &[Vec3], triangles: &[[u32; 3]]) -> Option<Diagnostic> {
    // A closed triangle mesh has 3/2 edges a triangle, so a ball has V − T/2 = 2.
    let ball = positions.len() == triangles.len() / 2 + 2;
    let folded = net
        .alive()
        .filter(|t| {
            let middle = (net.place(t[0]) + net.place(t[1]) + net.place(t[2])) / 3.0;
            let (normal, slope) = (net.normal(*t), figure.at(middle).slope);
            normal.dot(&slope) <= 0.3 * normal.norm() * slope.norm()
        })
        .count();
    if ball && folded == 0 {
        return None;
    }
    let reason = if ball { format!("{folded} triangles fold") } else { "limbs grow together".to_owned() };
    let message = format!("these measures give no clean body: {reason}");
    Some(Diagnostic::error(codes::BODY_NOT_CLEAN, message).hint("bring the measures closer to a usual size"))
}
