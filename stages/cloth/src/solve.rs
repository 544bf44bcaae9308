//! The ways into the solver: sew, drape and animate, each by the solver that the settings ask for.

use crate::explicit::run;
use crate::prepare::canonical_frame::CanonicalScene;
use crate::prepare::degenerate_edges::CollapsedEdges;
use crate::prepare::islands;
use crate::report::watch::Part;
use crate::scene::validate;
use crate::{
    ClothError, ContactFilter, Dynamics, Frame, Integrator, Motion, Outcome, PieceMove, Scene, Settings, Trip, Vec3,
    Watch,
};
use crate::{dynamics, explicit, optimize, sewing};

/// All of the work.
const WHOLE: [f64; 2] = [0.0, 1.0];
/// Part of all work until cloth rests beside the parts of the body that it ignores, for the progress display.
const FILTERED_WORK: f64 = 0.8;

/// Closes the stitches until every pair is closer than the sewing distance. Pairs that came close are joined exactly (gap 0).
/// The equilibrium solver sews by a penalty with force continuation. What stays open is welded where cloth crosses nothing
/// then; the outcome tells the gaps that are left.
///
/// # Errors
/// An unusable scene or setting, a start that crosses, instability, or a stop on request.
pub fn sew(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    validate::scene(scene)?;
    let canonical = CanonicalScene::of(scene);
    let sewn = sew_canonical(&canonical.scene, settings, &mut Part::new(watch, WHOLE, &|x| canonical.given(x)));
    shown(canonical.back(sewn)?, scene, watch)
}

/// [`sew`], but the pieces of the vertices in `last` are sewn on when all others are sewn, as a collar is. The scheme of the
/// paper sews all pieces at once. Gives also the moves of pieces that what was sewn before would have crossed.
///
/// # Errors
/// As [`sew`].
pub fn sew_in_order(
    scene: &Scene,
    settings: &Settings,
    last: &[bool],
    watch: &mut dyn Watch,
) -> Result<(Outcome, Vec<PieceMove>), ClothError> {
    let is_ordered = last.iter().any(|l| *l) && !last.iter().all(|l| *l);
    if !is_ordered || settings.integrator == Integrator::CentralDifference {
        return Ok((sew(scene, settings, watch)?, Vec::new()));
    }
    sewing::sew_in_order(scene, settings, last, watch, sew)
}

fn sew_canonical(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    match settings.integrator {
        Integrator::Static | Integrator::Implicit => sewing::sew(scene, settings, watch),
        Integrator::CentralDifference => run::run(scene, settings, true, watch),
    }
}

/// Settles the cloth: the same system without sewing force. Stitches still in the scene are held where they are
/// closed; weld first.
///
/// # Errors
/// As [`sew`].
pub fn drape(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    validate::scene(scene)?;
    if !scene.contact_filter.ignores_any() {
        return drape_islands(scene, settings, watch);
    }
    // Cloth comes to rest beside what it ignores, and meets the whole body from there.
    let same = <[Vec3]>::to_vec;
    let filtered = drape_islands(scene, settings, &mut Part::new(watch, [0.0, FILTERED_WORK], &same))?;
    let whole =
        Scene { positions: filtered.positions.clone(), contact_filter: ContactFilter::default(), ..scene.clone() };
    let mut watch = Part::new(watch, [FILTERED_WORK, 1.0], &same);
    Ok(drape_islands(&whole, settings, &mut watch)?.after(&filtered))
}

/// Settles the parts of the cloth that never meet side by side.
fn drape_islands(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    if let Some(groups) = islands::islands(scene, settings) {
        let each = Settings { threads: settings.threads / groups.len(), ..settings.clone() };
        let whole = |scene: &Scene, watch: &mut dyn Watch| drape_group(scene, &each, watch);
        if let Some(outcome) = islands::each(scene, &groups, settings.threads, watch, whole)? {
            return Ok(outcome);
        }
    }
    drape_group(scene, settings, watch)
}

/// Moves the cloth in time from the scene's positions; `each` is given every frame. Stitches must have been welded. Steps
/// are implicit unless the settings ask for central differences.
///
/// # Errors
/// An unusable scene, setting or body frame; a start that crosses; cloth caught by the body; explicit steps that are too
/// long; a stop on request.
pub fn animate(
    scene: &Scene,
    settings: &Settings,
    dynamics: &Dynamics,
    motion: &Motion,
    watch: &mut dyn Watch,
    each: &mut dyn FnMut(&Frame<'_>),
) -> Result<Trip, ClothError> {
    dynamics.check()?;
    motion.check(scene.body.as_deref(), scene.positions.len())?;
    match settings.integrator {
        Integrator::Static | Integrator::Implicit => dynamics::film(scene, settings, dynamics, motion, watch, each),
        Integrator::CentralDifference => explicit::motion::animate(scene, settings, dynamics, motion, watch, each),
    }
}

/// Settles parts of the cloth that may meet each other.
fn drape_group(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    let canonical = CanonicalScene::of(scene);
    let given = |x: &[Vec3]| canonical.given(x);
    let mut part = Part::new(watch, WHOLE, &given);
    let draped = match CollapsedEdges::of(&canonical.scene) {
        Some(narrow) => {
            let apart = |x: &[Vec3]| narrow.parted(x);
            let mut part = Part::new(&mut part, WHOLE, &apart);
            drape_canonical(&narrow.scene, settings, &mut part).map(|o| narrow.back(o))
        }
        None => drape_canonical(&canonical.scene, settings, &mut part),
    };
    shown(canonical.back(draped)?, scene, watch)
}

/// Shows what came of it.
fn shown(outcome: Outcome, scene: &Scene, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    watch.done(1.0);
    watch.look(&outcome.positions, scene.triangles.len());
    Ok(outcome)
}

fn drape_canonical(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    match settings.integrator {
        Integrator::Static => optimize::drape(scene, settings, watch),
        Integrator::Implicit => dynamics::settle(scene, settings, watch),
        Integrator::CentralDifference => run::run(scene, settings, false, watch),
    }
}

/// All that is wrong with settings alone, before there is a scene.
#[must_use]
pub fn setting_faults(settings: &Settings) -> Vec<ClothError> {
    validate::setting_faults(settings)
}
