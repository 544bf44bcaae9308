//! 2D to 3D: pieces placed around the body and sewn by the dynamic system (Liu, Chen, Shi 2003, §1.3.2).

mod arranged;
mod attach;
pub(crate) mod codes;
mod cone;
mod folded;
mod forecast;
mod held_bands;
mod ignored_parts;
mod known;
pub(crate) mod load;
mod part_of_ring;
pub mod place;
mod plan_check;
mod raise;

use crate::codes::SETTING_OUT_OF_RANGE;
use crate::sewing::turned::Lengths;
use crate::solve::body_parts::contact_filter;
use crate::solve::place::on_body;
use crate::solve::{Follow, Layout, effects, failure, failure_in, scene};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;
use toile_cloth::{ExplicitSteps, Outcome, PieceMove, Pin, Settings, Stitches};
use toile_garment::garment::Shape;
use toile_garment::seam::{Seam, SeamKind};
use toile_garment::units::{Duration, Length};
use toile_garment::{Aspect, Diagnostic, Garment, MeshVertex, Piece, SeamId, Vec3};
use toile_stage_api::{Cost, Errors, Forecast, Knob, Meaning, Stage, StageContext, StageError, StageInfo};

/// Places the pieces around the body and closes seams and darts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stitch;

/// Parameters of `stitch`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StitchParams {
    /// Body: OBJ in metres, feet at y = 0; a side file of the same name with `.toml` may name its landmarks.
    #[serde(default)]
    #[schemars(extend("format" = "input-file"))]
    pub body: Option<PathBuf>,
    /// Fabric of all pieces without one of their own.
    #[schemars(extend("format" = "input-file"))]
    pub fabric: PathBuf,
    /// Fabrics by the material of pieces, or by the name of a piece, which wins.
    #[serde(default)]
    #[schemars(schema_with = "fabric_files")]
    pub fabrics: BTreeMap<String, PathBuf>,
    /// Distance between the body and pieces placed around it.
    #[serde(default = "clearance")]
    pub clearance: Length,
    /// A stitched pair nearer than this counts as sewn.
    #[serde(default = "sewing_distance")]
    pub sewing_distance: Length,
    /// Distance at which cloth is held off the body.
    #[serde(default = "body_gap")]
    pub body_gap: Length,
    /// Distance at which cloth is held off cloth; at least the fabric's thickness is used.
    #[serde(default = "self_gap")]
    pub self_gap: Length,
    /// Longest time the sewing may take in the simulated world.
    #[serde(default = "max_time")]
    pub max_time: Duration,
    /// In-plane model.
    #[serde(default)]
    pub model: crate::drape::ModelName,
    /// How the seams are closed: by a descent without time, or in the paper's dynamic system.
    #[serde(default)]
    pub integrator: crate::drape::IntegratorName,
}

/// Every value of the table is a file.
fn fabric_files(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    schemars::json_schema!({
        "type": "object",
        "additionalProperties": { "type": "string", "format": "input-file" }
    })
}

fn clearance() -> Length {
    Length(0.02)
}

fn sewing_distance() -> Length {
    Length(1e-3)
}

fn self_gap() -> Length {
    crate::drape::DrapeParams::default().self_gap
}

fn body_gap() -> Length {
    Length(1e-3)
}

fn max_time() -> Duration {
    Duration(6.0)
}

/// Sewing itself goes without weight; what is sewn is let down under it, m/s².
const WEIGHT: Vec3 = Vec3::new(0.0, -9.81, 0.0);

impl Stage for Stitch {
    type Params = StitchParams;
    const INFO: StageInfo = StageInfo::new(
        "stitch",
        "places the pieces around the body and sews seams and darts",
        &[Aspect::Pieces, Aspect::Mesh, Aspect::Seams],
        &[Aspect::Stitched, Aspect::Fabric, Aspect::Body],
        2,
    );

    const KNOBS: &'static [Knob] = &[Knob::new(Meaning::Model, "model"), Knob::new(Meaning::Integrator, "integrator")];

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        let mut errors = Errors::default();
        errors.keep(check_clearance(params));
        errors.extend(toile_cloth::setting_faults(&settings(params, cx.threads)).into_iter().map(failure));
        let mut of_files = Errors::default();
        let unread = load::inputs(params, &mut forecast.garment, &mut of_files, cx);
        let in_doubt = forecast.in_doubt || !of_files.is_empty();
        errors.keep(of_files.finish());
        let garment = &mut forecast.garment;
        known::set_aside(&mut garment.plan, &unread);
        forecast.unread = unread.names;
        errors.parameters(plan_faults(garment, params.clearance.0, in_doubt));
        // On a body without a mesh nothing has a place.
        garment.body.take_if(|body| body.triangles.is_empty() || unread.all);
        errors.finish()?;
        Ok(forecast::cost(forecast))
    }

    fn run(
        &self,
        params: &StitchParams,
        mut garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        let mut errors = Errors::default();
        errors.keep(check_clearance(params));
        load::inputs(params, &mut garment, &mut errors, cx);
        errors.finish()?;
        let wrong = attach::faults(&garment);
        if !wrong.is_empty() {
            return Err(StageError::Parameter(wrong));
        }
        let arranged = arranged::arranged(&mut garment, cx.report).map_err(StageError::Parameter)?;
        let mut placed = place::place(&garment, &arranged, params.clearance.0).map_err(StageError::Parameter)?;
        refuse_hopeless(&garment, &placed, cx)?;
        if let Some(by) = raise::change_of_height(&garment, &placed) {
            for i in ignored_parts::beside_arms(&garment, &placed) {
                placed[i].iter_mut().for_each(|p| p.y += by);
            }
            cx.report.push(raise::finding(by));
        }
        let thickness = garment.fabrics.values().map(|f| f.thickness).fold(params.self_gap.0, f64::max);
        let holds = attach::holds(&garment, &placed, params.body_gap.0, thickness).map_err(StageError::Parameter)?;
        garment.pins.extend(holds.lasting);
        cx.report.findings.extend(held_bands::findings(&garment));
        let turned = garment.seams.iter().filter_map(|seam| turned(seam, &placed));
        cx.report.findings.extend(turned);
        let settings = settings(params, cx.threads);
        let layout = Layout::of(&garment);
        let ignores = ignored_parts::ignored_parts(&garment, &placed);
        cx.report.findings.extend(ignored_parts::finding(&ignores));
        if !ignores.is_empty() {
            let beside = ignored_parts::beside_arms(&garment, &placed);
            let coned = cone::lay_on_cone(&garment, &mut placed, &beside);
            cx.report.findings.extend(cone::finding(&coned));
        }
        if cx.progress.looks() {
            let placed = Shape { positions: placed.clone(), ignores: ignores.clone(), ..Shape::default() };
            let garment = Garment { stitched: Some(placed), ..garment.clone() };
            cx.progress.look(&garment, "as the pieces are placed");
        }
        let mut start = scene(&garment, &layout, layout.join(&placed), WEIGHT).map_err(StageError::Parameter)?;
        start.contact_filter = contact_filter(&garment, &layout, &ignores);
        start.pins.extend(holds.while_sewing.iter().map(|p| Pin { vertex: layout.index(p.vertex), at: p.at }));
        // A band is sewn on stretched, and pulls in the drape.
        start.bands.clear();
        start.folds.iter_mut().for_each(|f| f.stiffness *= FOLD_FIRMNESS_WHILE_SEWN);
        let moves = toile_cloth::free_pieces(&mut start, &settings).map_err(|e| failure_in(e, &garment, &placed))?;
        cx.report.findings.extend(moves.iter().filter_map(|m| moved_off(&garment, &layout, m, When::AtStart)));
        let shape =
            |x: &[Vec3]| Shape { positions: layout.split(x), sewn: true, welded: false, ignores: ignores.clone() };
        let shown = |x: &[Vec3]| Garment { stitched: Some(shape(x)), ..garment.clone() };
        let last = arranged::sewn_last(&garment, &layout);
        let sewn = toile_cloth::sew_in_order(&start, &settings, &last, &mut Follow::showing(cx, &shown));
        let (outcome, moves) = sewn.map_err(|e| failure_in(e, &garment, &placed))?;
        cx.report.findings.extend(moves.iter().filter_map(|m| moved_off(&garment, &layout, m, When::SewnOn)));
        tell(&garment, &outcome, settings.stitches.closed_distance, cx);
        garment.bands.extend(holds.bands);
        garment.effects = effects(&outcome.effects);
        garment.stitched = Some(shape(&outcome.positions));
        Ok(garment)
    }
}

/// How many times firmer folds are while they are sewn: a sewer holds pleats pressed until they are closed. With 1 the
/// pleats of the trousers open below their seams, and their drape has 18 % more energy. With 100 it has 3 % less than with
/// 30, and sewing and draping the pleated skirt take half as long again. On a finer mesh the energies are in another order
/// (`docs/lab/2026-11-30-pleats-pressed-while-sewn.md`).
const FOLD_FIRMNESS_WHILE_SEWN: f64 = 30.0;

/// Largest clearance, m: a piece farther out than this is placed around nothing.
const CLEARANCE_MOST: f64 = 0.5;

/// Refuses a clearance that is none.
fn check_clearance(params: &StitchParams) -> Result<(), StageError> {
    if (0.0..=CLEARANCE_MOST).contains(&params.clearance.0) {
        return Ok(());
    }
    let message = format!("`clearance` is {}; it must lie in 0 to {} mm", params.clearance, 1e3 * CLEARANCE_MOST);
    Err(StageError::parameter(Diagnostic::error(SETTING_OUT_OF_RANGE, message)))
}

/// The faults of the plan of sewing, as far as it can be told without a mesh. While something in the files is in doubt,
/// nothing is said that follows from the whole, and of a body without a mesh only the names.
fn plan_faults(garment: &Garment, clearance: f64, in_doubt: bool) -> Vec<Diagnostic> {
    if garment.body.as_ref().is_some_and(|body| body.triangles.is_empty()) {
        return attach::unknown_targets(garment);
    }
    let placed = place::faults(garment, clearance);
    let foreseen = if placed.is_empty() && !in_doubt { arranged::foreseen(garment) } else { Vec::new() };
    placed.into_iter().chain(foreseen).chain(attach::faults(garment)).collect()
}

/// Refuses what cannot be sewn from its places. A viewer of the run is shown the start.
fn refuse_hopeless(garment: &Garment, placed: &[Vec<Vec3>], cx: &mut StageContext<'_>) -> Result<(), StageError> {
    let faults = plan_check::faults(garment, placed);
    if faults.is_empty() {
        return Ok(());
    }
    if cx.progress.looks() {
        let shape = Shape { positions: placed.to_vec(), ..Shape::default() };
        cx.progress.look(&Garment { stitched: Some(shape), ..garment.clone() }, "as its pieces are placed");
    }
    Err(StageError::Parameter(faults))
}

/// When a piece is moved.
#[derive(Clone, Copy, PartialEq)]
enum When {
    /// Before the first step.
    AtStart,
    /// Before it is sewn on, when all other pieces are sewn.
    SewnOn,
}

/// A finding on a piece that lay in the body or in another piece, and was moved.
fn moved_off(garment: &Garment, layout: &Layout, moved: &PieceMove, when: When) -> Option<Diagnostic> {
    let first = |p: &&Piece| layout.index(MeshVertex { piece: p.id, vertex: 0 });
    let piece = garment.pieces.iter().filter(|p| first(p) <= moved.vertex).max_by_key(first)?;
    let by = moved.by * 1e3;
    let (lay, and_then) = match when {
        When::AtStart => ("started", ""),
        When::SewnOn => ("lay", " before it was sewn on"),
    };
    let message = format!(
        "piece `{}` {lay} in the body or in another piece; it was moved by {:.0} mm, ({:.0}, {:.0}, {:.0}) mm, until it was \
         free{and_then}",
        piece.name,
        by.norm(),
        by.x,
        by.y,
        by.z
    );
    let finding = Diagnostic::info(codes::START_MOVED, message).at(piece.source.clone());
    Some(if when == When::AtStart { finding.hint("place it there in the sewing file") } else { finding })
}

/// A finding on a seam that is named the wrong way round, as its pieces are placed.
fn turned(seam: &Seam, placed: &[Vec<Vec3>]) -> Option<Diagnostic> {
    let at = |v: MeshVertex| placed.get(v.piece.index())?.get(v.vertex as usize).copied();
    let ends: Option<Vec<[Vec3; 2]>> = seam.stitches.iter().map(|s| Some([at(s.a)?, at(s.b)?])).collect();
    let told = Lengths::of_turned(&ends?)?;
    Some(told.finding(&format!("seam `{}`", seam.name)).at(seam.source.clone()))
}

fn settings(params: &StitchParams, threads: usize) -> Settings {
    let base = Settings::sewing();
    Settings {
        model: params.model.into(),
        integrator: params.integrator.into(),
        stitches: Stitches { closed_distance: params.sewing_distance.0, ..base.stitches },
        body_gap: params.body_gap.0,
        self_gap: params.self_gap.0,
        explicit: ExplicitSteps { max_seconds: params.max_time.0, ..base.explicit },
        threads,
        ..base
    }
}

/// Findings on a sewing that did not close.
fn tell(garment: &Garment, outcome: &Outcome, distance: f64, cx: &mut StageContext<'_>) {
    if outcome.repaired.0 > 0 {
        cx.report.push(Diagnostic::info(
            codes::START_REPAIRED,
            format!(
                "{} vertices started inside the body and were pushed out, by up to {:.1} mm",
                outcome.repaired.0,
                outcome.repaired.1 * 1e3
            ),
        ));
    }
    if outcome.seam_gap_max <= distance {
        return;
    }
    for open in open_seams(garment, outcome) {
        let seam = &garment.seams[open.seam.index()];
        let name = &seam.name;
        let at = open.at * 1e3;
        cx.report.push(
            Diagnostic::warning(
                codes::SEAM_OPEN,
                format!(
                    "seam `{name}` is still {:.1} mm open after sewing, {} stitches of it, widest at ({:.0}, {:.0}, {:.0}) mm{}",
                    open.gap * 1e3,
                    open.count,
                    at.x,
                    at.y,
                    at.z,
                    on_body(garment, open.at)
                ),
            )
            .at(seam.source.clone())
            .hint(remedy_of_open(garment, seam)),
        );
    }
}

/// The remedy for a seam that stays open although the threads pulled with their full force. Most of them are wrong, or
/// turned round.
fn remedy_of_open(garment: &Garment, seam: &Seam) -> String {
    let spec = garment.plan.seams.iter().find(|s| s.name == seam.name);
    let sure = spec.and_then(|s| s.proposed);
    let sure = sure.map_or(String::new(), |p| format!(" It was proposed with proposed = {p:.2}."));
    let place = seam.source.as_ref().map_or(String::new(), |s| format!(" at {s}"));
    let what = if seam.kind == SeamKind::Seam { "seam right, and the right way round (reverse)" } else { "dart right" };
    format!(
        "is this {what}?{sure} Correct it in the sewing file{place}; if it is right, place its pieces nearer to where they \
         are sewn"
    )
}

/// Stitches of one seam that did not close.
struct OpenSeam {
    seam: SeamId,
    count: usize,
    gap: f64,
    /// Where the widest gap is.
    at: Vec3,
}

fn open_seams(garment: &Garment, outcome: &Outcome) -> Vec<OpenSeam> {
    let layout = Layout::of(garment);
    let mut open: Vec<OpenSeam> = Vec::new();
    let mut first = 0;
    for seam in layout.seams(garment) {
        let mine = first..first + seam.stitches.len();
        first = mine.end;
        // The list starts with the widest gap.
        let mut wide = outcome.open_stitches.iter().filter(|(k, _)| mine.contains(&(*k as usize)));
        if let Some((k, gap)) = wide.next() {
            let stitch = seam.stitches[*k as usize - mine.start];
            let at = outcome.positions[layout.index(stitch.a) as usize];
            open.push(OpenSeam { seam: seam.id, count: 1 + wide.count(), gap: *gap, at });
        }
    }
    open
}
