//! One stage of a time step: the body comes as far as the cloth in its way lets it, the cloth gives way, and so on until
//! the body is where it belongs; then the descent is led to its end.

use crate::collision::narrow_phase::candidates::Gap;
use crate::collision::narrow_phase::pair_kind::PairKind;
use crate::contact::barrier::Barrier;
use crate::dynamics::attachments::Hook;
use crate::energy::inertia::Inert;
use crate::optimize::descent::{Descent, FEW};
use crate::{ClothError, Place, Vec3};

/// Steps of the descent between two parts of the body's way.
const GIVES_WAY: usize = 6;
/// Factors in a stage, at most.
const MOST_FACTORS: usize = 25;
/// A step shorter than this share of the tolerance need not be taken whole: the digits of the energy no longer tell it.
const TRIFLE: f64 = 1e-3;
/// A part of the remaining way smaller than this is none …
const NO_WAY: f64 = 2e-3;
/// … and so many in a row mean that the cloth cannot give way.
const PATIENCE: usize = 60;
/// Way of held vertices off their course over the mean edge, from which the cloth beside them is taken along.
const OFF_COURSE: f64 = 0.05;
/// What their way may raise the stretch by, over what is stored and what it takes to bring all of the cloth along; beyond
/// that they go a part of it and the cloth gives way, …
const TEARS: f64 = 10.0;
/// … no smaller one than this, so many times in a stage.
const LEAST_PART: f64 = 1.0 / 64.0;
const MOST_PARTS: u32 = 64;

/// A descent that is led from stage to stage.
pub(crate) struct Stepper<'a> {
    pub descent: Descent<'a>,
    pub hooks: Vec<Hook>,
    /// Neither held nor without mass.
    pub free: Vec<bool>,
    /// m/s.
    pub tolerance: f64,
    pub unfinished: u64,
    pub parted: u64,
}

impl Stepper<'_> {
    /// Solves a stage that starts with the displacements `guess`; `body`: where the body is at its end. Where the cloth runs
    /// into something, or the stage does not come to its end, `plain` is solved instead; says whether that was so.
    pub fn solve(
        &mut self,
        inert: Inert,
        plain: Option<Inert>,
        guess: Vec<Vec3>,
        body: Option<&[Vec3]>,
        now: f64,
    ) -> Result<bool, ClothError> {
        let (tolerance, mut plain) = (self.tolerance, plain);
        let near = |i: &Inert| tolerance * i.h;
        let mut goal = (near(&inert), 1.0 / inert.rate);
        self.descent.goal.inert = Some(inert);
        self.descent.refresh_lagged();
        self.descent.start_anew();
        if self.descent.factors() == 0 && !self.hooks.is_empty() {
            self.descent.tau = goal.1;
            self.descent.metric()?;
        }
        let mut guess = guess;
        let (mut idle, mut rough, mut parts) = (0, false, 0);
        loop {
            let part = self.come(guess, body, parts < MOST_PARTS);
            if part < 1.0
                && let Some(p) = plain.take()
            {
                (goal, rough) = ((near(&p), 1.0 / p.rate), true);
                self.descent.goal.inert = Some(p);
            }
            self.descent.start_anew();
            if part >= 1.0 || body.is_none() {
                break;
            }
            self.parted += 1;
            parts += 1;
            idle = if part < NO_WAY { idle + 1 } else { 0 };
            if idle > PATIENCE {
                return Err(ClothError::Caught { seconds: now, place: self.tightest() });
            }
            if idle > 0 {
                self.harden();
            }
            self.relax(goal, 1, GIVES_WAY)?;
            guess = vec![Vec3::zeros(); self.descent.x.len()];
        }
        let length = self.descent.block_length(FEW);
        let mut ended = self.relax(goal, MOST_FACTORS, length)?;
        if !ended && let Some(p) = plain.take() {
            (goal, rough) = ((near(&p), 1.0 / p.rate), true);
            self.descent.goal.inert = Some(p);
            self.descent.start_anew();
            ended = self.relax(goal, MOST_FACTORS, length)?;
        }
        self.unfinished += u64::from(!ended);
        Ok(rough)
    }

    /// Where the body hardly comes on, contacts that are pressed nearly shut become stiffer.
    fn harden(&mut self) {
        let goal = &mut self.descent.goal;
        if goal.barrier.as_mut().is_some_and(|b| b.harden(&goal.unknown)) {
            self.descent.start_anew();
        }
    }

    /// Moves cloth, held vertices and body together, as far as nothing crosses, and with `care` as far as nothing tears; the
    /// part of the way that was taken.
    fn come(&mut self, guess: Vec<Vec3>, to: Option<&[Vec3]>, care: bool) -> f64 {
        let mut step = guess;
        let led = self.take_along(&mut step, to);
        let untorn = led.filter(|_| care).map_or(1.0, |far| self.untorn(&step, far));
        step.iter_mut().for_each(|s| *s *= untorn);
        let d = &mut self.descent;
        let Some(barrier) = &mut d.goal.barrier else {
            d.x.iter_mut().zip(&step).for_each(|(x, s)| *x += s);
            return untorn;
        };
        let way: Option<Vec<Vec3>> = to.zip(barrier.body.as_mut()).map(|(to, b)| {
            let way: Vec<Vec3> = to.iter().zip(b.positions.iter()).map(|(p, q)| (p - q) * untorn).collect();
            b.depart(&way);
            way
        });
        barrier.cover(&d.x, &step);
        if let Some(way) = &way {
            aside(barrier, &d.x, &mut step, way, &self.free);
            barrier.cover(&d.x, &step);
        }
        d.evaluate();
        let Some(barrier) = &mut d.goal.barrier else { return untorn };
        let part = barrier.free_part(&d.x, &step);
        if let (Some(way), Some(body)) = (&way, &mut barrier.body) {
            if let Some(stick) = &mut d.goal.stick {
                stick.carry(|key| body.at_pair(key, &d.x, way) * part);
            }
            body.arrive(part);
        }
        d.x.iter_mut().zip(&step).for_each(|(x, s)| *x += s * part);
        barrier.took(&d.x);
        part * untorn
    }

    /// Leads the held vertices to where they hang. Where that is off the course of the cloth, what is beside them goes along,
    /// as far as the stiffness hands it on: led alone, they would tear at it. Where that course itself tears at cloth that is
    /// led, it is none. How far off they were, m, where that is much.
    fn take_along(&mut self, step: &mut [Vec3], to: Option<&[Vec3]>) -> Option<f64> {
        let ways = self.ways(to);
        let much = OFF_COURSE * self.descent.goal.edge;
        let led = ways.iter().any(|(_, way)| way.norm() > much);
        if led && self.stretches(step, crate::longest(step)) {
            step.fill(Vec3::zeros());
        }
        let mut off = vec![Vec3::zeros(); step.len()];
        ways.iter().for_each(|(v, way)| off[*v] = way - step[*v]);
        let far = crate::longest(&off);
        let along = led && far > much;
        if along {
            let d = &mut self.descent;
            if let Some(b) = &mut d.goal.barrier {
                b.cover(&d.x, &off);
            }
            off = d.carried(&off);
        }
        step.iter_mut().zip(&off).for_each(|(s, o)| *s += o);
        along.then_some(far)
    }

    /// Held vertices, and how far each is from where it hangs.
    fn ways(&self, to: Option<&[Vec3]>) -> Vec<(usize, Vec3)> {
        let d = &self.descent;
        let body = d.goal.barrier.as_ref().and_then(|b| b.body.as_ref());
        let faces = body.map_or(&[][..], |b| &b.topology.faces);
        let way = |h: &Hook| to.map_or_else(Vec3::zeros, |to| h.place(faces, to) - d.x[h.vertex as usize]);
        self.hooks.iter().map(|h| (h.vertex as usize, way(h))).collect()
    }

    /// The part of a step after which the cloth is not torn; `far`: see [`Self::stretches`].
    fn untorn(&self, step: &[Vec3], far: f64) -> f64 {
        let mut part = 1.0;
        while part > LEAST_PART && self.stretches(&step.iter().map(|s| s * part).collect::<Vec<_>>(), far) {
            part *= 0.5;
        }
        part
    }

    /// Does a step stretch the cloth more than bringing all of it so `far` (m) in this stage could?
    fn stretches(&self, step: &[Vec3], far: f64) -> bool {
        let goal = &self.descent.goal;
        let speed = goal.inert.as_ref().map_or(0.0, |i| far / i.h);
        let stored = goal.elastic(&self.descent.x);
        let x: Vec<Vec3> = self.descent.x.iter().zip(step).map(|(x, s)| x + s).collect();
        goal.elastic(&x) - stored > TEARS * (stored + 0.5 * goal.mass.iter().sum::<f64>() * speed * speed)
    }

    /// Descends until a step is shorter than `near`; `false` if that was not reached.
    fn relax(&mut self, (near, tau): (f64, f64), factors: usize, length: usize) -> Result<bool, ClothError> {
        let d = &mut self.descent;
        let mut stuck = 0;
        for _ in 0..factors {
            d.tau = if stuck > 1 { 0.1 * tau } else { tau };
            d.metric()?;
            for _ in 0..length {
                match d.step(1.0) {
                    Some(part) if d.longest <= if part > 0.5 { near } else { TRIFLE * near } => return Ok(true),
                    Some(part) if part < 0.2 => break,
                    Some(_) => stuck = 0,
                    None => {
                        // Nothing is left to win in the digits of the energy.
                        if d.longest <= 10.0 * near {
                            return Ok(true);
                        }
                        stuck += 1;
                        d.start_anew();
                        break;
                    }
                }
            }
            if stuck > 3 {
                break;
            }
        }
        Ok(false)
    }

    /// Where two things are nearest to each other.
    fn tightest(&self) -> Place {
        let touches = self.descent.goal.barrier.iter().flat_map(|b| &b.touches);
        let v = touches.min_by(|a, b| a.distance.total_cmp(&b.distance)).map_or(0, |t| t.vertices[0]);
        let faces = self.descent.goal.barrier.iter().flat_map(|b| &b.frame.topology.faces);
        let triangle = (0u32..).zip(faces).find(|(_, f)| f.contains(&v)).map_or(0, |(i, _)| i);
        Place { triangle, at: self.descent.x[v as usize] }
    }
}

/// Lets the cloth's displacements give way to the body's: nothing comes nearer to it than its gap by the guess alone.
fn aside(barrier: &Barrier, x: &[Vec3], step: &mut [Vec3], way: &[Vec3], free: &[bool]) {
    let Some(body) = &barrier.body else { return };
    let near = &barrier.against;
    let points = near.point_gaps(x, body).map(|(g, _)| (PairKind::VertexBodyTriangle, 1, 1.0, g));
    let edges = near.edge_gaps(x, body).map(|(g, _)| (PairKind::EdgeBodyEdge, 2, 0.5, g));
    let faces = near.face_gaps(x, body).map(|(g, _)| (PairKind::TriangleBodyVertex, 3, 0.5, g));
    for (kind, count, share, Gap { vertices, weights, d, .. }) in points.chain(edges).chain(faces) {
        let distance = d.norm();
        let gaps = vertices[..count].iter().map(|v| barrier.frame.body_gap[*v as usize]);
        let room = 0.9 * (distance - share * gaps.fold(f64::INFINITY, f64::min)).max(0.0);
        let normal = d / distance.max(1e-300);
        let mine: Vec3 = (0..count).map(|k| step[vertices[k] as usize] * weights[k]).sum();
        let nearer = (body.at_pair(&(kind, vertices), x, way) - mine).dot(&normal);
        if nearer > room {
            for v in vertices[..count].iter().filter(|v| free[**v as usize]) {
                step[*v as usize] += normal * (nearer - room);
            }
        }
    }
}
