//! Draping: descents until a Newton step would win nothing more.

use crate::hierarchy::Level;
use crate::optimize::descent::{Descent, FEW, LARGE, TAU_FREE};
use crate::optimize::report;
use crate::optimize::strain_limit_homotopy::Locks;
use crate::report::watch::Part;
use crate::{ClothError, EffectReport, Outcome, Scene, Settings, StopReason, Vec3, Watch};

/// Blocks in a row without any step after which nothing more can be won.
const MOST_STUCK: u32 = 12;
/// Saddles that are left, at most: beyond that the cloth is called at rest on one.
const MOST_PUSHES: u32 = 8;
/// Rounds in which contacts that gave way are moved out at rest, and how many times the net force at rest large cloth may have in
/// the first: what that stirs comes to rest together with what still moves.
const MOST_BORNE: u32 = 2;
const NEARLY_BORNE: f64 = 2000.0;
/// Way over the size of the scene after which the cloth is given up as falling.
const FAR: f64 = 3.0;
/// What a Newton step would win over the elastic energy, above which cloth did not begin in balance …
const FAR_FROM_REST: f64 = 1.0;
/// … and above which coarser cloth finds the way first: a start that is only strained wins just less than all of it.
const COARSE_FIRST: f64 = 0.5;
/// Steps in a block of a small coarser level.
const FEW_ON_COARSE: usize = 12;
/// Part of all work that coarser levels take.
const COARSE_WORK: f64 = 0.2;
/// Tolerances of a coarser level over those of the finer, and of the first that is large, too: there what is left over takes the
/// finer cloth many times as long.
const COARSE: f64 = 3.0;
const LARGE_COARSE: f64 = 0.1;

/// Settles the cloth.
pub(crate) fn drape(scene: &Scene, settings: &Settings, watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    let (mut before, mut done) = (Vec::new(), 0.0);
    let mut begun = None;
    if let Some(level) = leading_level(scene, settings, &mut begun)? {
        // Its factor is larger than all of the coarser levels.
        drop(begun.take());
        if let Some((x, effects)) = on_coarser(&level, settings, watch)? {
            (before, done) = (effects, COARSE_WORK);
            drop(level);
            begun = led(scene, x, settings)?;
        }
    }
    let mut descent = match begun {
        Some(descent) => descent,
        None => begin(scene, settings)?,
    };
    let reason = descent.settle(&mut Part::new(watch, [done, 1.0], &<[Vec3]>::to_vec))?;
    let mut outcome = report::outcome(&mut descent, scene, reason);
    outcome.add_costs(&before);
    Ok(outcome)
}

/// Coarser cloth that is to find the way first. Where only a factor can tell, `begun` keeps what was begun for it.
fn leading_level<'a>(
    scene: &Scene,
    settings: &'a Settings,
    begun: &mut Option<Descent<'a>>,
) -> Result<Option<Level>, ClothError> {
    if !Level::may_be_below_folds(scene) {
        return Ok(None);
    }
    let far = surely_far(scene, settings)? || begun.insert(begin(scene, settings)?).decrement > COARSE_FIRST;
    Ok(far.then(|| Level::below_folds(scene)).flatten())
}

/// Does large cloth begin so far from rest that no factor is needed to tell?
fn surely_far(scene: &Scene, settings: &Settings) -> Result<bool, ClothError> {
    let mut descent = Descent::begin(scene, settings, false)?;
    descent.preload();
    // As the metric of the first block does.
    descent.take_up();
    Ok(descent.surely_wins(COARSE_FIRST))
}

/// From where the cloth is, with a first look at how far it is from rest.
fn begin<'a>(scene: &Scene, settings: &'a Settings) -> Result<Descent<'a>, ClothError> {
    let mut descent = Descent::begin(scene, settings, false)?;
    let loaded = descent.preload();
    // Not in balance, so the loads were not those that it rested with.
    if descent.far_from_rest() && loaded {
        descent.unload();
    }
    Ok(descent)
}

/// From where coarser cloth led it; `None` where it would cross something there.
fn led<'a>(scene: &Scene, positions: Vec<Vec3>, settings: &'a Settings) -> Result<Option<Descent<'a>>, ClothError> {
    match Descent::begin(&Scene { positions, ..scene.clone() }, settings, false) {
        Ok(led) => Ok(Some(led)),
        Err(ClothError::StartCrosses { .. }) => Ok(None),
        Err(e) => Err(e),
    }
}

/// Positions, and what the effects cost on the way there.
type Led = (Vec<Vec3>, Vec<EffectReport>);

/// Where the cloth comes to lie on a coarser level, if it does not fall off it.
fn on_coarser(level: &Level, settings: &Settings, watch: &mut dyn Watch) -> Result<Option<Led>, ClothError> {
    let share = coarse_share(level.scene.positions.len(), settings);
    let coarse = Settings {
        decrement_tolerance: share * settings.decrement_tolerance,
        move_tolerance: share * settings.move_tolerance,
        residual_tolerance: f64::INFINITY,
        ..settings.clone()
    };
    let below = drape(&level.scene, &coarse, &mut Part::new(watch, [0.0, COARSE_WORK], &|x| level.spread(x)));
    match below {
        Ok(rest) if matches!(rest.stop_reason, StopReason::Settled | StopReason::MaxSteps) => {
            let x = level.spread(&rest.positions);
            watch.look(&x, level.scene.triangles.len());
            Ok(Some((x, rest.effects)))
        }
        Ok(_) | Err(ClothError::StartCrosses { .. } | ClothError::Unstable { .. }) => Ok(None),
        Err(e) => Err(e),
    }
}

/// Tolerances of a coarser level of so many vertices over those of the finer.
fn coarse_share(vertices: usize, finer: &Settings) -> f64 {
    match (vertices > LARGE, finer.of_coarser_level()) {
        (true, true) => 1.0,
        (true, false) => LARGE_COARSE,
        (false, _) => COARSE,
    }
}

impl Descent<'_> {
    /// Goes on until at rest.
    pub fn settle(&mut self, watch: &mut dyn Watch) -> Result<StopReason, ClothError> {
        let mut way = Way::default();
        loop {
            let reason = self.descend(watch, &mut way)?;
            if self.is_proved() {
                return Ok(reason);
            }
        }
    }

    /// Goes on until at rest as far as is proved.
    fn descend(&mut self, watch: &mut dyn Watch, way: &mut Way) -> Result<StopReason, ClothError> {
        let (mut stuck, mut rounds) = (0, Rounds::default());
        let start = self.x.clone();
        let far = FAR * self.goal.size(&start);
        self.goal.set_rough(true);
        let few = if self.is_coarser() { FEW_ON_COARSE } else { FEW };
        let mut locks = self.locks_at_start();
        loop {
            if self.is_torn() {
                return Ok(StopReason::HeldBack);
            }
            self.lead();
            self.metric()?;
            self.look();
            let changed;
            (locks, changed) = self.turn_locks(locks);
            if changed {
                continue;
            }
            if locks != Locks::Asleep && self.bears_early(&mut rounds) {
                continue;
            }
            if !matches!(locks, Locks::Wide(_)) && self.resting() {
                match self.surely_resting(&mut rounds) {
                    Some(reason) => return Ok(reason),
                    None => continue,
                }
            }
            if stuck == 0 && (self.tau < self.free || self.firm > 0.0) && self.nearly_resting() {
                // Is it so with the cloth's own metric, too? Not where that has just led nowhere.
                (self.tau, self.firm) = (TAU_FREE, 0.0);
                continue;
            }
            if watch.cancelled() {
                return Err(ClothError::Cancelled { step: self.steps });
            }
            watch.progress(self.steps, &self.words());
            watch.done(way.part(self.to_go()));
            if start.iter().zip(&self.x).any(|(p, q)| (p - q).norm_squared() > far * far) {
                return Ok(StopReason::Unheld);
            }
            if self.steps >= self.settings.max_descents {
                return Ok(StopReason::MaxSteps);
            }
            if self.is_long_locked(locks) {
                locks = self.widen_locks();
            }
            let Some(b) = self.block_ahead(few) else { continue };
            stuck = if b.steps == 0 { stuck + 1 } else { 0 };
            if stuck > MOST_STUCK {
                return Ok(if self.pins_placed() { StopReason::MaxSteps } else { StopReason::HeldBack });
            }
            self.adapt(b);
        }
    }

    /// At rest by all that is told: is it so with all of the cloth's bending, with contacts that bear their load where they
    /// should, by the second derivatives here, and is it no saddle? `None` if not; then the cloth has been told what is missing.
    fn surely_resting(&mut self, rounds: &mut Rounds) -> Option<StopReason> {
        if self.goal.is_rough() {
            self.goal.set_rough(false);
            return None;
        }
        let gives = rounds.borne < MOST_BORNE && !self.is_coarser();
        // What is moved out stays so.
        if gives && !self.is_proved() {
            self.goal.set_rough(true);
            return None;
        }
        if gives && self.bear() {
            rounds.borne += 1;
            self.goal.set_rough(true);
            return None;
        }
        if !self.is_fresh() {
            self.renew();
            return None;
        }
        if rounds.pushes == MOST_PUSHES || !self.leave_saddle() {
            return Some(StopReason::Settled);
        }
        rounds.pushes += 1;
        self.goal.set_rough(true);
        None
    }

    /// Large cloth that nearly rests moves contacts that gave way out for the first time; says whether anything has changed.
    fn bears_early(&mut self, rounds: &mut Rounds) -> bool {
        let s = self.settings;
        let early = self.is_large()
            && !self.is_coarser()
            && rounds.borne == 0
            && self.decrement <= s.decrement_tolerance
            && self.longest <= s.move_tolerance
            && self.residual <= NEARLY_BORNE * s.residual_tolerance;
        if !early {
            return false;
        }
        if !self.is_proved() {
            return true;
        }
        rounds.borne = 1;
        self.bear()
    }

    /// Does finer cloth go on from here?
    pub(crate) fn is_coarser(&self) -> bool {
        self.settings.of_coarser_level()
    }

    /// Would a Newton step win more than all that is stored?
    pub fn far_from_rest(&mut self) -> bool {
        if self.metric().is_err() {
            return true;
        }
        self.look();
        self.decrement > FAR_FROM_REST
    }

    /// How many times too large the worst of what must be small at rest is.
    fn to_go(&self) -> f64 {
        let s = self.settings;
        let all = [
            self.decrement / s.decrement_tolerance,
            self.longest / s.move_tolerance,
            self.residual / s.residual_tolerance,
        ];
        all.into_iter().fold(1.0, f64::max)
    }

    fn nearly_resting(&self) -> bool {
        self.decrement < self.settings.decrement_tolerance && self.residual < 10.0 * self.settings.residual_tolerance
    }

    fn words(&self) -> String {
        format!(
            "energy {:.4e} J, a Newton step would win {:.1e} of the elastic energy (goal {:.0e}) and move {:.3} mm (goal {:.1})",
            self.energy,
            self.decrement,
            self.settings.decrement_tolerance,
            self.longest * 1e3,
            self.settings.move_tolerance * 1e3
        )
    }
}

/// What was done at rest so far.
#[derive(Default)]
struct Rounds {
    /// Saddles left.
    pushes: u32,
    /// Times that contacts which gave way were moved out.
    borne: u32,
}

/// How far a descent has come: by the digits of what must become small.
#[derive(Debug, Default)]
struct Way {
    first: f64,
    part: f64,
}

impl Way {
    fn part(&mut self, to_go: f64) -> f64 {
        self.first = self.first.max(to_go);
        let digits = if self.first > 1.0 { 1.0 - libm::log(to_go) / libm::log(self.first) } else { 1.0 };
        self.part = self.part.max(digits.clamp(0.0, 1.0));
        self.part
    }
}
