//! Drape: the sewn garment settles under gravity (Liu, Chen, Shi 2003, §2.2–2.3), and is certified.

mod certificate;
mod forecast;
mod gated;
mod judge;
mod lines;
mod params;
mod ranges;
mod repeats;
mod stiffer_first;
mod tightness;
mod undraped;
mod unheld;
mod unused;

pub use gated::GatedFigure;
pub use judge::{Judged, judge};
pub use params::{
    AccuracyName, CorrectionName, DrapeParams, EffectsParam, IntegratorName, ModelName, PenaltyName, SwitchName,
};
pub(crate) use unused::act_elsewhere;

use crate::codes::SETTING_OUT_OF_RANGE;
use crate::solve::body_parts::contact_filter;
use crate::solve::codes::START_CROSSES;
use crate::solve::{Follow, Layout, MESH_ANEW, effects, failure, failure_in, scene};
use toile_cloth::{ClothError, Outcome, Scene, Settings, StopReason, Welded};
use toile_garment::garment::{Certificate, Shape};
use toile_garment::{Aspect, Code, Diagnostic, Garment, Vec3};
use toile_stage_api::{Cost, Errors, Forecast, Knob, Meaning, Stage, StageContext, StageError, StageInfo};

codes! {
    pub(crate) list CODES;

    /// The drape did not come to rest within its steps or its time, nothing holds it, or something holds it back from
    /// where it is led. The message says which and what helps; the certificate says how far it was.
    DRAPE_NOT_SETTLED = "drape-not-settled";

    /// Edges are so short beside the others of their triangles that no step could be taken: their ends were draped as
    /// one vertex, and parted again afterwards.
    EDGES_TINY = "edges-tiny";

    /// An elastic band on the garment at rest: its length before it is stretched and now, and its tension.
    ELASTIC_AT_REST = "elastic-at-rest";

    /// A pressed fold of the garment lies open by more than half of its angle somewhere.
    FOLD_OPEN = "fold-open";

    /// The fabric gives `bending_hysteresis` beside bending lengths of [fast]. They were measured on cloth whose yarns
    /// rub, so they hold this friction already, and it was not used again.
    HYSTERESIS_UNUSED = "hysteresis-unused";

    /// A seam stands open so wide after sewing that no drape can close it, so the garment was not draped. It is written as it
    /// was sewn, and the certificate fails. Correct the seams that `seam-open` names. `open_seams` of `drape` says from
    /// which gap on.
    NOT_DRAPED = "not-draped";

    /// How far apart the garment comes to rest from starts that differ by 1 µm (`--repeats`). `plan` advises to measure it
    /// where nothing holds the cloth.
    RESTS_APART = "rests-apart";

    /// A parameter acts in another integrator only, so it does nothing here. The message names it and the integrator.
    SETTING_UNUSED = "setting-unused";

    /// The top of the garment sank on the body by more than its gate: nothing holds the garment where it was sewn. Hold an
    /// edge with [[attach]], or make it narrower there.
    SLID = "slid";

    /// The fabric gives constants of springs ([springs]), and the model of the drape is not `springs`: it went by the
    /// fabric's laws.
    SPRINGS_UNUSED = "springs-unused";

    /// Pieces fell, because nothing holds them. They were left where they were sewn, and the rest of the garment came to
    /// rest without them. The certificate fails.
    UNHELD = "unheld";

    /// The strain of the drape is above its gate. The message names the piece and the place, the strains along warp, weft
    /// and bias, and the girths of body and cloth there.
    TOO_TIGHT = "too-tight";
}

/// Widest stitch that the drape joins, m. Stitches whose cloth would cross then stay open, too.
const JOINED_GAP_MOST: f64 = 5e-3;
/// A held vertex this near its place is there, m.
const PIN_PLACED: f64 = 1e-5;

/// Settles the garment and certifies the result.
#[derive(Clone, Copy, Debug, Default)]
pub struct Drape;

impl Stage for Drape {
    type Params = DrapeParams;
    const INFO: StageInfo = StageInfo::new(
        "drape",
        "settles the sewn garment under gravity and certifies the result",
        &[Aspect::Mesh, Aspect::Stitched, Aspect::Fabric],
        &[Aspect::Drape],
        2,
    );

    const KNOBS: &'static [Knob] = &[
        Knob::new(Meaning::Tolerance, "accuracy"),
        Knob::new(Meaning::Model, "model"),
        Knob::new(Meaning::Integrator, "integrator"),
        Knob::new(Meaning::Correction, "correction"),
        Knob::new(Meaning::Penalty, "penalty"),
        Knob::new(Meaning::SelfContact, "effects.self-contact"),
        Knob::new(Meaning::Repeats, "repeats"),
    ];

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        let mut errors = Errors::default();
        errors.extend(toile_cloth::setting_faults(&params.settings(cx.threads)).into_iter().map(failure));
        errors.keep(ranges::check(params));
        errors.finish()?;
        cx.report.findings.extend(unused::settings(params));
        forecast.advice.extend(repeats::advice(params, &forecast.garment));
        forecast.effects = forecast::effects(params, forecast);
        let once = forecast.by_triangles(0.01, forecast::seconds(forecast), 4.3);
        let rests = f64::from(1 + params.repeats) + stiffer_first::more_rests(params);
        Ok(once.map(|c| Cost { seconds: c.seconds * rests, ..c }))
    }

    fn run(
        &self,
        params: &DrapeParams,
        mut garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        ranges::check(params)?;
        cx.report.findings.extend(unused::settings(params));
        let layout = Layout::of(&garment);
        let stitched = garment.stitched.take().ok_or_else(|| StageError::Internal("no stitched shape".to_owned()))?;
        let gravity = Vec3::new(0.0, -params.gravity.0, 0.0);
        let mut start =
            scene(&garment, &layout, layout.join(&stitched.positions), gravity).map_err(StageError::Parameter)?;
        start.contact_filter = contact_filter(&garment, &layout, &stitched.ignores);
        let settings = params.settings(cx.threads);
        let told = |e| failure_in(e, &garment, &stitched.positions);
        let sewn = if stitched.sewn { start.positions.clone() } else { close(&start, params, cx).map_err(told)? };
        let (mut welded, open) = weld(start, &sewn, &settings);
        drop(sewn);
        let mut sewn_scene = std::mem::take(&mut welded.scene);
        let shape = |x: &[Vec3]| Shape {
            positions: layout.split(&welded.spread(x)),
            sewn: true,
            welded: open == 0,
            ..Shape::default()
        };
        let shown = |x: &[Vec3]| Garment { drape: Some(shape(x)), ..garment.clone() };
        let wide = undraped::wide_open(&garment, &stitched, params.open_seams).filter(|_| stitched.sewn);
        cx.report.findings.extend(wide.map(|(seam, gap)| undraped::finding(seam, gap)));
        let draped = match wide {
            Some((_, gap)) => Ok((undraped::outcome(&sewn_scene, gap), vec![false; sewn_scene.positions.len()])),
            None => stiffer_first::lead(&mut sewn_scene, params, &settings, cx)
                .and_then(|()| unheld::drape(&mut sewn_scene, &settings, &mut Follow::showing(cx, &shown))),
        };
        let (outcome, held) = draped.map_err(|e| failure_of_open_stitches(&e, open).unwrap_or_else(|| told(e)))?;
        let repeats = if wide.is_some() { 0 } else { params.repeats };
        let stored: Vec<Vec3> = outcome.positions.iter().map(to_f32).collect();
        let figures = toile_cloth::certify(&sewn_scene, &settings, &stored).map_err(failure)?;
        let now = layout.split(&welded.spread(&stored));
        let slip = slip(&garment, &stitched, &now);
        let (bands, folds) = (lines::bands(&garment, &layout, &now), lines::folds(&garment, &layout, &now));
        let unheld = unheld::names(&garment, &layout, &welded.map, &held);
        cx.report.findings.extend(unheld::finding(&unheld));
        let certificate = certificate::certificate(&garment, params, &outcome, &figures, &now, slip);
        garment.certificate = Some(certificate.with_unheld(unheld));
        if let Some(certificate) = &mut garment.certificate {
            (certificate.bands, certificate.folds) = (bands, folds);
        }
        cx.report.findings.extend(garment.certificate.iter().flat_map(|c| lines::findings(&garment, c)));
        (garment.drape, garment.drape_before_edit) = (Some(shape(&stored)), None);
        garment.reactions = reactions(&garment, &layout, &welded.map, &outcome);
        garment.stitched = Some(stitched);
        let rests = repeats::measure(&sewn_scene, &settings, &outcome, repeats, cx).map_err(failure)?;
        cx.report.findings.extend(rests.as_ref().map(repeats::finding));
        if let Some(certificate) = &mut garment.certificate {
            certificate.rests = rests;
        }
        let certificate = garment.certificate.as_ref();
        let tight = certificate.and_then(|c| tightness::finding(&garment, c, figures.tightest.as_ref()));
        cx.report.findings.extend(tight);
        cx.report.findings.extend(certificate.and_then(slid));
        let way = way_of_pins(&garment, &layout, &welded.spread(&stored));
        tell(&mut garment, &outcome, way, cx);
        cx.report.findings.extend(unused::findings(&garment, params));
        Ok(garment)
    }
}

/// Makes sewn vertices one, and counts the stitches that stay open.
fn weld(mut start: Scene, sewn: &[Vec3], settings: &Settings) -> (Welded, usize) {
    let joined = toile_cloth::joinable_stitches(&start, settings, sewn, JOINED_GAP_MOST);
    let open = start.stitches.len() - joined.len();
    start.stitches = joined;
    (toile_cloth::weld(&start, sewn), open)
}

/// The failure of a drape that cannot take a step and has open stitches. They are its cause: cloth lies between their
/// sides.
fn failure_of_open_stitches(error: &ClothError, open: usize) -> Option<StageError> {
    let message = format!("{open} stitches stay open after sewing, and cloth would cross if they were joined");
    let hint = "correct the seams that `seam-open` or `seam-reversed` name, or place their pieces nearer";
    let is_their_failure = open > 0 && matches!(error, ClothError::Unstable { .. });
    is_their_failure.then(|| StageError::input(Diagnostic::error(START_CROSSES, message).hint(hint)))
}

/// How far the top of a sewn garment that nothing holds sank on its body, m.
fn slip(garment: &Garment, stitched: &Shape, rest: &[Vec<Vec3>]) -> f64 {
    let top = |x: &[Vec<Vec3>]| x.iter().flatten().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let hangs = stitched.sewn && garment.body.is_some() && !garment.seams.is_empty() && garment.pins.is_empty();
    if hangs { (top(&stitched.positions) - top(rest)).max(0.0) } else { 0.0 }
}

/// Positions with all stitches closed: a cloth mesh that came without `stitch` is sewn here.
fn close(start: &Scene, params: &DrapeParams, cx: &mut StageContext<'_>) -> Result<Vec<Vec3>, ClothError> {
    let gap = |s: &[u32; 2]| (start.positions[s[0] as usize] - start.positions[s[1] as usize]).norm();
    let widest = start.stitches.iter().map(gap).fold(0.0, f64::max);
    let settings = Settings {
        threads: cx.threads,
        model: params.model.into(),
        integrator: params.integrator.into(),
        ..Settings::sewing()
    };
    if widest <= settings.stitches.closed_distance {
        return Ok(start.positions.clone());
    }
    Ok(toile_cloth::sew(start, &settings, &mut Follow::new(cx))?.positions)
}

/// The positions as the GLB will store them: the certificate speaks of the stored numbers.
#[allow(clippy::cast_possible_truncation)]
fn to_f32(p: &Vec3) -> Vec3 {
    p.map(|c| f64::from(c as f32))
}

fn reactions(garment: &Garment, layout: &Layout, map: &[u32], outcome: &Outcome) -> Vec<Vec3> {
    let force =
        |vertex: u32| outcome.reactions.iter().find(|r| r.vertex == vertex).map_or_else(Vec3::zeros, |r| r.force);
    let places: Vec<Option<u32>> =
        garment.pins.iter().map(|p| map.get(layout.index(p.vertex) as usize).copied()).collect();
    // Pins that sewing made one share its force.
    let sharing = |v: u32| places.iter().filter(|p| **p == Some(v)).count() as f64;
    places.iter().map(|p| p.map_or_else(Vec3::zeros, |v| force(v) / sharing(v))).collect()
}

/// Longest way of a held vertex to its place, m.
fn way_of_pins(garment: &Garment, layout: &Layout, x: &[Vec3]) -> f64 {
    let way = |at: Vec3, vertex: u32| x.get(vertex as usize).map_or(0.0, |p| (at - p).norm());
    garment.pins.iter().map(|p| way(p.at, layout.index(p.vertex))).fold(0.0, f64::max)
}

fn tell(garment: &mut Garment, outcome: &Outcome, way: f64, cx: &mut StageContext<'_>) {
    garment.effects = effects(&outcome.effects);
    if outcome.joined > 0 {
        let message = format!(
            "{} edges are shorter than 1/500 of their triangles: the ends of each were draped as one vertex, and parted again",
            outcome.joined
        );
        cx.report.push(Diagnostic::info(EDGES_TINY, message).hint(MESH_ANEW));
    }
    // Seams that stand open are told with their place.
    if !matches!(outcome.stop_reason, StopReason::Settled | StopReason::SeamsOpen) {
        cx.report.push(
            Diagnostic::warning(
                DRAPE_NOT_SETTLED,
                format!(
                    "the drape is not at rest: {}; the forces left are up to {:.2} times the weight of the cloth there{}{}",
                    outcome.stop_reason.words(),
                    outcome.residual_rel,
                    speed(outcome),
                    still_led(way)
                ),
            )
            .hint(remedy(outcome.stop_reason)),
        );
    }
}

/// A finding on a garment that slid down its body.
fn slid(certificate: &Certificate) -> Option<Diagnostic> {
    let most = certificate.limits.get("slip_mm").copied().unwrap_or(f64::INFINITY);
    let message = format!("the garment slid: its top lies {:.0} mm below where it was sewn", certificate.slip_mm);
    let finding = Diagnostic::warning(SLID, message);
    (certificate.slip_mm > most)
        .then(|| finding.hint("hold an edge with [[attach]], or make the garment narrower where it should hold"))
}

/// Only motion in time has a speed.
fn speed(outcome: &Outcome) -> String {
    if outcome.seconds > 0.0 { format!(", fastest {:.1} mm/s", outcome.speed_max * 1e3) } else { String::new() }
}

/// Words for held vertices that are still on their way, m.
fn still_led(way: f64) -> String {
    if way > PIN_PLACED {
        format!(", held vertices up to {:.1} mm from their places", way * 1e3)
    } else {
        String::new()
    }
}

fn remedy(reason: StopReason) -> &'static str {
    match reason {
        StopReason::Unheld => "hold the garment: attach its waist in the sewing file, or give it a body it can hang on",
        StopReason::HeldBack => {
            "look where the drape is stretched most: give it a wider way there or less friction, or lead it less far"
        }
        StopReason::MaxSeconds => "give it more time (with.max_time)",
        _ => {
            "look in the report where the cloth is stretched most; a coarser mesh, with.accuracy = \"draft\", or pieces placed nearer the body may help"
        }
    }
}
