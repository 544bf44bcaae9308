//! One stage of a time step: the body moves as far as the cloth in its way lets it, the cloth gives way, and so on until the body
//! is where it belongs. Then the descent goes on to its end.

use crate::collision::narrow_phase::candidates::PairGeometry;
use crate::collision::narrow_phase::pair_kind::PairKind;
use crate::contact::barrier::Barrier;
use crate::contact::tuning::EDGE_GAP_SHARE;
use crate::dynamics::attachments::Attachment;
use crate::dynamics::tuning::{
    BODY_IDLE_PARTS_MOST, BODY_PART_LEAST, BODY_PARTS_MOST, GIVING_WAY_STEPS, OFF_COURSE_EDGES, STAGE_BLOCK_END_PART,
    STAGE_FACTORISATIONS_MOST, STAGE_NEARLY_ENDED, STAGE_SHORT_STEP_SHARE, STAGE_STUCK_BLOCKS_MOST,
    STAGE_STUCK_TAU_FACTOR, UNTORN_PART_LEAST,
};
use crate::energy::inertia::Inertia;
use crate::optimize::descent::{Change, Descent};
use crate::optimize::driver::{Blocks, Detection, drive};
use crate::optimize::mechanism::{Mechanism, StepVerdict, Verdict};
use crate::optimize::mechanisms::pinned_targets::with_cloth_beside;
use crate::optimize::tuning::{BLOCK_STEPS, PIN_ENERGY_RISE_MOST};
use crate::report::watch::{Silent, Watch};
use crate::{ClothError, Place, StopReason, Vec3};

/// A descent that goes on from stage to stage.
pub(crate) struct Stepper<'a> {
    pub descent: Descent<'a>,
    pub attachments: Vec<Attachment>,
    /// Neither held nor without mass.
    pub free: Vec<bool>,
    /// m/s.
    pub tolerance: f64,
    pub unfinished: u64,
    pub parted: u64,
}

/// The end of a descent in a stage: the longest move of a step that still counts, m, and the τ of the regularisation, s².
type StageGoal = (f64, f64);

/// A stage on its way: its end, and the step of implicit Euler that may take its place.
struct Stage {
    goal: StageGoal,
    /// The step of implicit Euler, until it is taken.
    plain: Option<Inertia>,
    /// Has it taken the place of the stage?
    rough: bool,
}

impl Stepper<'_> {
    /// Solves a stage that starts with the displacements `guess`; `body` holds the vertices of the body at its end. Where the
    /// cloth runs into something, or the stage does not come to its end, the step `plain` of implicit Euler is solved instead.
    /// Returns whether that was so.
    ///
    /// # Errors
    /// Cloth that is caught by the body, or instability.
    pub fn solve(
        &mut self,
        inertia: Inertia,
        plain: Option<Inertia>,
        mut guess: Vec<Vec3>,
        body: Option<&[Vec3]>,
        now: f64,
    ) -> Result<bool, ClothError> {
        let mut stage = Stage { goal: self.goal(&inertia), plain, rough: false };
        self.descent.refresh_lagged_forces();
        self.set_inertia(inertia);
        if self.descent.factorisations() == 0 && !self.attachments.is_empty() {
            self.descent.regularization.tau = stage.goal.1;
            self.descent.check_energy()?;
            self.descent.precondition()?;
        }
        let (mut idle, mut parts) = (0, 0);
        loop {
            let part = self.come(guess, body, parts < BODY_PARTS_MOST.get(), &mut stage);
            if part >= 1.0 || body.is_none() {
                break;
            }
            self.parted += 1;
            parts += 1;
            idle = if part < BODY_PART_LEAST.get() { idle + 1 } else { 0 };
            if idle > BODY_IDLE_PARTS_MOST.get() {
                return Err(ClothError::Caught { seconds: now, place: self.tightest() });
            }
            if idle > 0 {
                self.descent.stiffen_tight_contacts();
            }
            self.relax(stage.goal, 1, GIVING_WAY_STEPS.get())?;
            guess = vec![Vec3::zeros(); self.descent.x.len()];
        }
        let steps = self.descent.block_steps(BLOCK_STEPS.get());
        let mut ended = self.relax(stage.goal, STAGE_FACTORISATIONS_MOST.get(), steps)?;
        if !ended && let Some(p) = self.take_plain(&mut stage) {
            self.set_inertia(p);
            ended = self.relax(stage.goal, STAGE_FACTORISATIONS_MOST.get(), steps)?;
        }
        self.unfinished += u64::from(!ended);
        Ok(stage.rough)
    }

    /// The step of implicit Euler takes the place of the stage, if it has not yet.
    fn take_plain(&self, stage: &mut Stage) -> Option<Inertia> {
        let plain = stage.plain.take()?;
        (stage.goal, stage.rough) = (self.goal(&plain), true);
        Some(plain)
    }

    fn goal(&self, inertia: &Inertia) -> StageGoal {
        (self.tolerance * inertia.h, 1.0 / inertia.rate)
    }

    fn set_inertia(&mut self, inertia: Inertia) {
        self.descent.change(|o, _| {
            o.terms.inertia = Some(inertia);
            Change::Energy
        });
    }

    /// Moves cloth, held vertices and body together as far as nothing crosses, and with `care` as far as nothing tears. Where
    /// that is only a part of the way, the step of implicit Euler takes the place of the stage. Returns the part.
    fn come(&mut self, mut step: Vec<Vec3>, to: Option<&[Vec3]>, care: bool, stage: &mut Stage) -> f64 {
        let off_course = self.take_along(&mut step, to);
        let untorn = off_course.filter(|_| care).map_or(1.0, |far| self.untorn(&step, far));
        step.iter_mut().for_each(|s| *s *= untorn);
        let way = self.depart(&mut step, to, untorn);
        let free = match self.descent.objective().terms.barrier {
            Some(_) => {
                self.descent.evaluate();
                let x = self.descent.x.clone();
                self.descent.detection().map_or(1.0, |b| b.max_step_fraction(&x, &step))
            }
            None => 1.0,
        };
        let part = free * untorn;
        let plain = if part < 1.0 { self.take_plain(stage) } else { None };
        self.arrive(&step, way.as_deref(), free, plain);
        part
    }

    /// Prepares collision detection for a step of the cloth and the body's way `to` its place, of which `share` is taken.
    /// Returns the body's displacements.
    fn depart(&mut self, step: &mut [Vec3], to: Option<&[Vec3]>, share: f64) -> Option<Vec<Vec3>> {
        let (x, free) = (self.descent.x.clone(), &self.free);
        let barrier = self.descent.detection()?;
        let way: Option<Vec<Vec3>> = to.zip(barrier.body.as_mut()).map(|(to, b)| {
            let way: Vec<Vec3> = to.iter().zip(b.positions.iter()).map(|(p, q)| (p - q) * share).collect();
            b.set_step(&way);
            way
        });
        barrier.update_lists(&x, step);
        if let Some(way) = &way {
            give_way(barrier, &x, step, way, free);
            barrier.update_lists(&x, step);
        }
        way
    }

    /// Takes a part of a step of cloth and body, and the inertia of another stage if there is one.
    fn arrive(&mut self, step: &[Vec3], way: Option<&[Vec3]>, part: f64, inertia: Option<Inertia>) {
        let from = self.descent.x.clone();
        self.descent.x.iter_mut().zip(step).for_each(|(x, s)| *x += s * part);
        self.descent.change(|o, x| {
            if let Some(barrier) = &mut o.terms.barrier {
                if let (Some(way), Some(body)) = (way, &mut barrier.body) {
                    if let Some(friction) = &mut o.terms.friction {
                        friction.move_anchors(|key| body.interpolate_at_pair(key, &from, way) * part);
                    }
                    body.take_step(part);
                }
                barrier.step_taken(x);
            }
            if inertia.is_some() {
                o.terms.inertia = inertia;
            }
            Change::Energy
        });
    }

    /// Leads the held vertices to where they hang. Where that is off the course of the cloth, what is beside them goes along,
    /// as far as the stiffness hands it on: led alone, they would tear at it. Where that course itself tears at cloth that is
    /// led, it is none. How far off they were, m, where that is much.
    fn take_along(&mut self, step: &mut [Vec3], to: Option<&[Vec3]>) -> Option<f64> {
        let ways = self.ways(to);
        let much = OFF_COURSE_EDGES.get() * self.descent.objective().edge;
        let is_off_course = ways.iter().any(|(_, way)| way.norm() > much);
        if is_off_course && self.stretches(step, crate::longest(step)) {
            step.fill(Vec3::zeros());
        }
        let mut off = vec![Vec3::zeros(); step.len()];
        ways.iter().for_each(|(v, way)| off[*v] = way - step[*v]);
        let far = crate::longest(&off);
        let along = is_off_course && far > much;
        if along {
            let x = self.descent.x.clone();
            if let Some(b) = self.descent.detection() {
                b.update_lists(&x, &off);
            }
            off = with_cloth_beside(&mut self.descent, &off);
        }
        step.iter_mut().zip(&off).for_each(|(s, o)| *s += o);
        along.then_some(far)
    }

    /// Held vertices, and how far each is from where it hangs.
    fn ways(&self, to: Option<&[Vec3]>) -> Vec<(usize, Vec3)> {
        let d = &self.descent;
        let body = d.objective().body();
        let faces = body.map_or(&[][..], |b| &b.topology.faces);
        let way = |h: &Attachment| to.map_or_else(Vec3::zeros, |to| h.place(faces, to) - d.x[h.vertex as usize]);
        self.attachments.iter().map(|h| (h.vertex as usize, way(h))).collect()
    }

    /// The part of a step after which the cloth is not torn; `far`: see [`Self::stretches`].
    fn untorn(&self, step: &[Vec3], far: f64) -> f64 {
        let mut part = 1.0;
        while part > UNTORN_PART_LEAST.get() && self.stretches(&step.iter().map(|s| s * part).collect::<Vec<_>>(), far)
        {
            part *= 0.5;
        }
        part
    }

    /// Does a step stretch the cloth more than bringing all of it so `far` (m) in this stage could?
    fn stretches(&self, step: &[Vec3], far: f64) -> bool {
        let objective = self.descent.objective();
        let speed = objective.terms.inertia.as_ref().map_or(0.0, |i| far / i.h);
        let stored = objective.elastic(&self.descent.x);
        let x: Vec<Vec3> = self.descent.x.iter().zip(step).map(|(x, s)| x + s).collect();
        objective.elastic(&x) - stored
            > PIN_ENERGY_RISE_MOST.get() * (stored + 0.5 * objective.unknowns.mass.iter().sum::<f64>() * speed * speed)
    }

    /// Descends until a step moves no vertex by more than the goal; `false` if that was not reached.
    fn relax(&mut self, (near, tau): StageGoal, factorisations: usize, steps: usize) -> Result<bool, ClothError> {
        let mut rule = StageEnd { near, tau, rounds_left: factorisations, stuck: 0 };
        let blocks = Blocks { steps, detection: Detection::EveryStep };
        let reason = drive(&mut self.descent, blocks, &mut [&mut rule], &mut Silent)?;
        Ok(reason == StopReason::Settled)
    }

    /// Where two things are nearest to each other.
    fn tightest(&self) -> Place {
        let touches = self.descent.objective().terms.barrier.iter().flat_map(|b| &b.contacts);
        let v = touches.min_by(|a, b| a.distance.total_cmp(&b.distance)).map_or(0, |t| t.vertices[0]);
        let faces = self.descent.objective().terms.barrier.iter().flat_map(|b| &b.parameters.topology.faces);
        let triangle = (0u32..).zip(faces).find(|(_, f)| f.contains(&v)).map_or(0, |(i, _)| i);
        Place { triangle, at: self.descent.x[v as usize] }
    }
}

/// The rule of a descent in a stage: it ends when a step hardly moves the cloth, and gives up after some factorisations.
struct StageEnd {
    /// Longest move that ends the descent, m.
    near: f64,
    /// τ of the inertia, s²: the shift is the inertia of the time step then.
    tau: f64,
    rounds_left: usize,
    /// Blocks in a row that ended with a step that gained nothing.
    stuck: u32,
}

impl Mechanism for StageEnd {
    fn begin_round(&mut self, d: &mut Descent<'_>, _: &mut dyn Watch) -> Result<Verdict, ClothError> {
        if self.rounds_left == 0 || self.stuck > STAGE_STUCK_BLOCKS_MOST.get() {
            return Ok(Verdict::Stop(StopReason::MaxSteps));
        }
        self.rounds_left -= 1;
        // A contact that is far tighter than its gap cuts every step to a few hundredths. What is left of it lowers the
        // energy no more, and the cloth would hang on it while the body goes on.
        if self.stuck > 0 {
            d.stiffen_tight_contacts();
        }
        d.regularization.tau = if self.stuck > 1 { STAGE_STUCK_TAU_FACTOR.get() * self.tau } else { self.tau };
        Ok(Verdict::Go)
    }

    fn after_step(&mut self, d: &mut Descent<'_>, taken: Option<f64>) -> StepVerdict {
        let longest = d.newton.longest;
        match taken {
            Some(part) if longest <= if part > 0.5 { self.near } else { STAGE_SHORT_STEP_SHARE.get() * self.near } => {
                StepVerdict::Stop(StopReason::Settled)
            }
            Some(part) if part < STAGE_BLOCK_END_PART.get() => StepVerdict::EndBlock,
            Some(_) => {
                self.stuck = 0;
                StepVerdict::Go
            }
            // Nothing is left to gain in the digits of the energy.
            None if longest <= STAGE_NEARLY_ENDED.get() * self.near => StepVerdict::Stop(StopReason::Settled),
            None => {
                self.stuck += 1;
                d.change(|_, _| Change::Energy);
                StepVerdict::EndBlock
            }
        }
    }
}

/// Guess projection: the displacements of the cloth give way to those of the body, so that the guess alone brings nothing nearer
/// to the body than its gap.
fn give_way(barrier: &Barrier, x: &[Vec3], step: &mut [Vec3], way: &[Vec3], free: &[bool]) {
    let Some(body) = &barrier.body else { return };
    let near = &barrier.lists.body;
    let points = near.point_gaps(x, body).map(|(g, _)| (PairKind::VertexBodyTriangle, 1, 1.0, g));
    let edge_share = EDGE_GAP_SHARE.get();
    let edges = near.edge_gaps(x, body).map(|(g, _)| (PairKind::EdgeBodyEdge, 2, edge_share, g));
    let faces = near.face_gaps(x, body).map(|(g, _)| (PairKind::TriangleBodyVertex, 3, edge_share, g));
    for (kind, count, share, PairGeometry { vertices, weights, separation: d, .. }) in points.chain(edges).chain(faces)
    {
        let distance = d.norm();
        let gaps = vertices[..count].iter().map(|v| barrier.parameters.body_gap[*v as usize]);
        let room = 0.9 * (distance - share * gaps.fold(f64::INFINITY, f64::min)).max(0.0);
        let normal = d / distance.max(1e-300);
        let mine: Vec3 = (0..count).map(|k| step[vertices[k] as usize] * weights[k]).sum();
        let nearer = (body.interpolate_at_pair(&(kind, vertices), x, way) - mine).dot(&normal);
        if nearer > room {
            for v in vertices[..count].iter().filter(|v| free[**v as usize]) {
                step[*v as usize] += normal * (nearer - room);
            }
        }
    }
}
