//! Animate: the draped garment moves in time on a moving body (the paper's third phase of collisions, §2.3).

mod body;
mod certificate;
pub(crate) mod codes;
mod forecast;
mod params;
mod store;
mod unused;

pub use params::{AnimateParams, SteppingName};

use crate::codes::SETTING_OUT_OF_RANGE;
use crate::solve::{self, Follow, Layout, failure, scene};
use store::Store;
use toile_cloth::{Motion, Scene, Trip};
use toile_garment::animation::MotionCertificate;
use toile_garment::garment::EffectRecord;
use toile_garment::{Aspect, Code, Diagnostic, Garment, Vec3};
use toile_stage_api::{Cost, Errors, Forecast, Stage, StageContext, StageError, StageInfo};

/// Distance between the drape's body and the first frame from which a person should look, metres.
const FAR: f64 = 0.2;

/// Refuses values that no motion can have.
fn check(params: &AnimateParams) -> Result<(), StageError> {
    let no_frame = (params.frames == Some(0)).then(|| {
        let hint = "write how many frames the result has, or leave it out";
        Diagnostic::error(SETTING_OUT_OF_RANGE, "`frames` is 0; a motion has one frame or more").hint(hint)
    });
    let mut errors = Errors::default();
    errors.parameters(solve::ranges::gravity(params.gravity).into_iter().chain(no_frame).collect());
    errors.finish()
}

/// Moves the garment.
#[derive(Clone, Copy, Debug, Default)]
pub struct Animate;

impl Stage for Animate {
    type Params = AnimateParams;
    const INFO: StageInfo = StageInfo::new(
        "animate",
        "moves the draped garment in time, on a body that moves, and gives frames",
        &[Aspect::Mesh, Aspect::Drape, Aspect::Fabric],
        &[Aspect::Animation],
        1,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        let mut errors = Errors::default();
        errors.keep(check(params));
        let settings = toile_cloth::setting_faults(&params.settings(cx.threads));
        let of_motion = params.dynamics().faults().into_iter().chain(params.motion(Vec::new(), true).faults());
        errors.extend(settings.into_iter().chain(of_motion).map(failure));
        errors.finish()?;
        cx.report.findings.extend(unused::settings(params));
        forecast.effects.extend(forecast::effects(params));
        // Without a number of frames the film is taken to last a second.
        let film = params.frames.map_or(1.0, |n| f64::from(n) / params.fps);
        Ok(forecast.by_triangles(0.1, film, 12.0))
    }

    fn run(
        &self,
        params: &AnimateParams,
        mut garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        check(params)?;
        cx.report.findings.extend(unused::settings(params));
        let layout = Layout::of(&garment);
        let drape = garment.drape.take().ok_or_else(|| StageError::Internal("no draped shape".to_owned()))?;
        let gravity = Vec3::new(0.0, -params.gravity.0, 0.0);
        let start = scene(&garment, &layout, layout.join(&drape.positions), gravity).map_err(StageError::Parameter)?;
        let welded = toile_cloth::weld(&start, &start.positions);
        let frames = match &params.body {
            Some(path) => body::frames(path, params, &garment, cx)?,
            None => Vec::new(),
        };
        let rests = garment.certificate.as_ref().is_some_and(|c| c.settled);
        let motion = params.motion(frames, rests);
        let settings = params.settings(cx.threads);
        let mut store = Store::new(&welded.scene, &settings);
        let trip = film(&welded.scene, params, &motion, &mut store, cx)?;
        tell_strain(&store, &garment, cx);
        let gate = garment.certificate.as_ref().and_then(|c| c.limits.get("strain_max")).copied();
        let certificate = store.certificate(params, gate.unwrap_or(f64::INFINITY));
        let mut animation = store.finish(params.fps, trip.settled, &layout, &welded)?;
        tell_failures(&certificate, params, cx);
        if let Some(c) = &mut garment.certificate {
            c.self_crossings = c.self_crossings.max(animation.self_crossings);
            c.body_crossings = c.body_crossings.max(animation.body_crossings);
            c.penetration_max_mm = c.penetration_max_mm.max(animation.penetration_max_mm);
            c.passed &= certificate.passed;
        }
        animation.certificate = Some(certificate);
        garment.drape = Some(drape);
        tell(params, &motion, &trip, &animation, &mut garment, cx);
        if let Some(pattern) = &params.sequence {
            store::write(pattern, &animation, &garment, cx)?;
        }
        garment.animation = Some(animation);
        Ok(garment)
    }
}

fn film(
    scene: &Scene,
    params: &AnimateParams,
    motion: &Motion,
    store: &mut Store<'_>,
    cx: &mut StageContext<'_>,
) -> Result<Trip, StageError> {
    let settings = params.settings(cx.threads);
    let mut take = |f: &toile_cloth::Frame<'_>| store.take(f);
    toile_cloth::animate(scene, &settings, &params.dynamics(), motion, &mut Follow::new(cx), &mut take).map_err(failure)
}

/// Figures of the motion's certificate that are beyond their gates.
fn tell_failures(certificate: &MotionCertificate, params: &AnimateParams, cx: &mut StageContext<'_>) {
    for (name, value, limit) in certificate.failures() {
        let message = format!("`{name}` of the motion is {value:.3e}, over its gate of {limit:.3e}");
        let hint = if params.fixed_step {
            "leave out with.fixed_step, so that steps are as long as the cloth bears"
        } else {
            "shorten the time step (with.step)"
        };
        cx.report.push(Diagnostic::warning(codes::MOTION_GATE, message).hint(hint));
    }
}

/// Does the motion stretch the cloth more than the certificate allows the drape?
fn tell_strain(store: &Store<'_>, garment: &Garment, cx: &mut StageContext<'_>) {
    let (strain, frame) = store.strained();
    let limit = garment.certificate.as_ref().and_then(|c| c.limits.get("strain_max"));
    if let Some(limit) = limit.filter(|l| strain > **l) {
        let message =
            format!("frame {frame} stretches the cloth by {:.1} %, over {:.1} %", 100.0 * strain, 100.0 * limit);
        let found = Diagnostic::warning(codes::FRAMES_OVERSTRETCHED, message);
        cx.report.push(found.hint("does the body jerk there? let it move off more slowly, or hold more of the cloth"));
    }
}

fn tell(
    params: &AnimateParams,
    motion: &Motion,
    trip: &Trip,
    animation: &toile_garment::animation::Animation,
    garment: &mut Garment,
    cx: &mut StageContext<'_>,
) {
    add_effects(&mut garment.effects, trip);
    let mut warn = |code: Code, message: String, hint: &str| {
        cx.report.push(Diagnostic::warning(code, message).hint(hint));
    };
    if params.until_settled && !trip.settled {
        let message = format!(
            "the cloth still moves at {:.0} mm/s after {} frames (goal {:.0} mm/s)",
            trip.speed * 1e3,
            trip.frames,
            params.dynamics().rest_speed * 1e3
        );
        warn(codes::MOTION_NOT_SETTLED, message, "give it more time (with.frames) or calm it (with.calming)");
    }
    if trip.unfinished > 0 {
        let message =
            format!("{} of {} stages of time steps were not solved to the end", trip.unfinished, 2 * trip.steps);
        warn(codes::MOTION_NOT_SOLVED, message, "shorten the time step (with.step)");
    }
    if trip.lead_in_distance > FAR {
        let message = format!(
            "the body's first frame is up to {:.0} mm from the pose the garment was draped on; it is led there in {:.1} s",
            trip.lead_in_distance * 1e3,
            motion.lead_in
        );
        warn(
            codes::BODY_LED,
            message,
            "begin the motion in the pose of the body that `stitch` reads, or lengthen with.lead_in",
        );
    }
    if animation.self_crossings + animation.body_crossings > 0 {
        let message = format!(
            "in some frame {} pairs of cloth triangles and {} of cloth and body cross",
            animation.self_crossings, animation.body_crossings
        );
        warn(codes::FRAMES_CROSS, message, "does the body's motion cross itself? shorten the time step (with.step)");
    }
}

/// Effects that the drape had too get the evidence of the motion beside that of the drape.
fn add_effects(effects: &mut Vec<EffectRecord>, trip: &Trip) {
    for e in solve::effects(&trip.effects) {
        match effects.iter_mut().find(|k| k.name == e.name) {
            Some(known) => {
                known.on |= e.on;
                known.evidence = format!("{}; in motion: {}", known.evidence, e.evidence);
                known.cpu_seconds += e.cpu_seconds;
            }
            None => effects.push(e),
        }
    }
}
