//! The runs of a comparison, and what they are measured by.

use super::codes::COMPARE_NO_DRAPE;
use super::methods::{Method, Way, reference};
use crate::engine::Exit;
use crate::halt::Halt;
use crate::study::measure::{distance, nearer};
use crate::study::pictures::distances;
use crate::study::{Bench, Ran};
use serde::{Deserialize, Serialize};
use toile_garment::{Diagnostic, Garment};
use toile_stage_api::Registry;
use toile_stages::drape::judge;
use toile_stages::fit::Surface;
use toile_stages::flatten::is_symmetric;

/// Version of the form of `compare.json`.
pub const VERSION: u32 = 1;

/// Distances of two surfaces, mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distance {
    /// Mean over the area.
    pub mean_mm: f64,
    /// Distance within which 95 % of the area lies.
    pub p95_mm: f64,
    /// Largest.
    pub max_mm: f64,
}

/// Figures of a shape, by the law of the fabric for coupled triangles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Elastic energy and energy of the weight, over those of the reference, mJ.
    pub energy_above_mj: f64,
    /// Largest strain along warp or weft.
    pub strain_max: f64,
    /// Largest strain over its limit in the fabric.
    pub strain_over_limit: f64,
    /// Crossing pairs of cloth triangles.
    pub self_crossings: u64,
    /// Crossing pairs of a cloth and a body triangle.
    pub body_crossings: u64,
}

/// A method and what it gave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of the method.
    pub name: String,
    /// Its source in the literature.
    pub source: String,
    /// A sentence about it.
    pub about: String,
    /// Why it has no shape.
    pub failure: Option<String>,
    /// CPU seconds up to the sewn garment.
    pub sewing_cpu_seconds: f64,
    /// CPU seconds of the drape.
    pub drape_cpu_seconds: f64,
    /// Widest open seam of the drape, mm.
    pub open_seam_mm: Option<f64>,
    /// Did it come to rest by its own rule?
    pub at_rest: bool,
    /// Largest net force on a vertex at the end over the mean weight of a vertex, by its own law; `None` without a drape.
    pub net_force: Option<f64>,
    /// Figures of its shape.
    pub figures: Option<Figures>,
    /// Distance of its shape from the reference.
    pub own_folds: Option<Distance>,
    /// Distance from the reference that came to rest once more, after the method began at the reference, too.
    pub same_folds: Option<Distance>,
}

/// A comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Version of this form.
    pub toile_compare: u32,
    /// Program version.
    pub toile: String,
    /// Product line and version.
    pub pipeline: String,
    /// Threads of the runs.
    pub threads: usize,
    /// Triangles of all pieces.
    pub triangles: usize,
    /// The methods.
    pub rows: Vec<Row>,
}

/// A row with its garment, for the pictures.
pub struct Shown {
    /// The row.
    pub row: Row,
    /// The garment in the shape that the method gave it.
    pub garment: Option<Garment>,
    /// Distance of its vertices from the reference, mm.
    pub distances: Option<Vec<Vec<f64>>>,
    /// The run, where it has a drape of its own.
    ran: Option<Ran>,
}

/// Keeps rows, with the triangles of the garment.
pub type Keep<'a> = &'a mut dyn FnMut(&[Shown], usize) -> Result<(), Halt>;

/// The listener to a comparison: every step in words, and all rows so far whenever there is a new one, with the
/// triangles of the garment.
pub struct Listener<'a> {
    /// Hears of every step.
    pub say: &'a mut dyn FnMut(&str),
    /// Keeps the rows.
    pub keep: Keep<'a>,
}

/// Runs the methods one after the other.
///
/// # Errors
/// When the pipeline is wrong, the program's own method gives no drape, the disk refuses, or the user stops.
pub fn compare(
    bench: &Bench<'_>,
    methods: &[&Method],
    registry: &mut Registry,
    listener: Listener<'_>,
) -> Result<(), Halt> {
    let Listener { say, keep } = listener;
    say("the reference");
    let reference = bench.run(&reference(), registry)?;
    let again = bench.carry(&reference, &reference, registry)?;
    let measure = Measure::new(&reference, again.as_ref()).ok_or_else(|| no_reference(&reference))?;
    let mut all = Vec::new();
    for method in methods {
        say(method.name);
        let setting = method.setting();
        let before = all.iter().find_map(|s: &Shown| s.ran.as_ref().filter(|r| r.done.setting == setting));
        let mut shown = match (method.way, before) {
            (Way::SewnOnly, Some(ran)) => sewn_only(method, ran),
            (Way::SewnOnly, None) => sewn_only(method, &bench.run(&setting, registry)?),
            (Way::Draped(..), _) => draped(method, bench.run(&setting, registry)?),
        };
        measure.add(&mut shown);
        if let Some(ran) = &shown.ran {
            say(&format!("{} from the reference", method.name));
            let carried = bench.carry(ran, &reference, registry)?;
            let surface = carried.as_ref().and_then(Surface::of);
            shown.row.same_folds = surface.map(|s| Distance::of(distance(&s, &measure.again)));
        }
        all.push(shown);
        keep(&all, reference.done.triangles)?;
    }
    Ok(())
}

fn no_reference(ran: &Ran) -> Halt {
    let why = ran.done.failure.clone().unwrap_or_else(|| "it gave no surface".to_owned());
    let message = format!("the garment has no drape to compare with: {why}");
    let finding = Diagnostic::error(COMPARE_NO_DRAPE, message).hint("`toile run` with the same pipeline says more");
    Halt::new(vec![finding], Exit::Unstable)
}

/// The drape by which all are measured.
struct Measure {
    surface: Surface,
    /// The same after it came to rest once more.
    again: Surface,
    is_symmetric: bool,
    /// Elastic energy and energy of the weight, J.
    energy: f64,
}

impl Measure {
    fn new(reference: &Ran, again: Option<&Garment>) -> Option<Self> {
        let garment = reference.garment.as_ref()?;
        let judged = judge(garment, garment.drape.as_ref()?).ok()?;
        let energy = judged.figures.energy + judged.weight;
        let surface = Surface::of(garment)?;
        let again = again.and_then(Surface::of).unwrap_or_else(|| surface.clone());
        Some(Self { surface, again, is_symmetric: is_symmetric(garment), energy })
    }

    /// Measures the garment of a row.
    fn add(&self, shown: &mut Shown) {
        let Some(garment) = &shown.garment else { return };
        shown.row.figures = self.figures(garment);
        let surface = Surface::of(garment);
        shown.row.own_folds = surface.map(|s| Distance::of(nearer(&s, &self.surface, self.is_symmetric).1));
        shown.distances = distances(garment, &self.surface, self.is_symmetric);
    }

    fn figures(&self, garment: &Garment) -> Option<Figures> {
        let judged = judge(garment, garment.drape.as_ref()?).ok()?;
        let f = &judged.figures;
        Some(Figures {
            energy_above_mj: 1e3 * (f.energy + judged.weight - self.energy),
            strain_max: f.strain_max,
            strain_over_limit: f.strain_over_limit,
            self_crossings: f.self_crossings as u64,
            body_crossings: f.body_crossings as u64,
        })
    }
}

impl Distance {
    fn of([mean_mm, p95_mm, max_mm]: [f64; 3]) -> Self {
        Self { mean_mm, p95_mm, max_mm }
    }
}

/// A method without a result yet, with what its run cost.
fn row(method: &Method, ran: &Ran) -> Row {
    let done = &ran.done;
    Row {
        name: method.name.to_owned(),
        source: method.source.to_owned(),
        about: method.about.to_owned(),
        failure: done.failure.clone(),
        sewing_cpu_seconds: done.cpu_seconds - done.drape_cpu_seconds,
        drape_cpu_seconds: done.drape_cpu_seconds,
        open_seam_mm: None,
        at_rest: false,
        net_force: None,
        figures: None,
        own_folds: None,
        same_folds: None,
    }
}

fn draped(method: &Method, ran: Ran) -> Shown {
    let certificate = ran.done.certificate.as_ref();
    let row = Row {
        open_seam_mm: certificate.map(|c| c.seam_gap_max_mm.max(c.dart_gap_max_mm)),
        at_rest: certificate.is_some_and(|c| c.settled),
        net_force: certificate.map(|c| c.residual_rel),
        ..row(method, &ran)
    };
    Shown { row, garment: ran.garment.clone(), distances: None, ran: Some(ran) }
}

/// The garment of a run before its drape.
fn sewn_only(method: &Method, ran: &Ran) -> Shown {
    let row = Row { drape_cpu_seconds: 0.0, ..row(method, ran) };
    let sewn = ran.garment.as_ref().and_then(|g| {
        let drape = Some(g.stitched.clone()?);
        Some(Garment { drape, certificate: None, ..g.clone() })
    });
    Shown { row, garment: sewn, distances: None, ran: None }
}
