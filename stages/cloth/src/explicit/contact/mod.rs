//! Contact of the explicit scheme, with a guarantee that nothing crosses (docs/contact.md).
//!
//! For every vertex, the distance from the primitives around it to the nearest primitive not joined to them bounds its
//! motion until distances are measured again. It may move by 0.45 of a cloth–cloth distance, as both sides may move,
//! and by 0.9 of a cloth–body distance. As long as every vertex stays in this ball nothing can cross, whatever the
//! forces are.
//!
//! Linear springs inside the contact thickness keep the distances open, so the balls stay large. The penalty c_p exp(1/d) of
//! equation 6 can be chosen instead. Its stiffness has no bound that an explicit step could keep, so the balls hold cloth
//! then.

pub(crate) mod pair;
pub(crate) mod penalty;
pub(crate) mod stiffness;

use crate::collision::body::Body;
use crate::collision::body_candidates::BodyCandidates;
use crate::collision::broad_phase::bvh::BoxTree;
use crate::collision::narrow_phase::candidates::{ClothCandidates, LinearMotion};
use crate::contact::parameters::ContactParameters;
use crate::explicit::contact::pair::{ContactPair, take_body_gap, take_cloth_gap};
use crate::explicit::contact::stiffness::{ContactStiffness, set_stiffness};
use crate::explicit::tuning::{
    BODY_BALL_SHARE, CLOTH_BALL_SHARE, CONTACT_PAIR_GAPS, DISTANCE_FLOOR, DISTANCE_FLOOR_SHARE,
    DISTANCE_MEASURE_STEPS_MIN, EXPLICIT_EDGE_GAP_SHARE, HARD_CONTACT, HARD_CONTACT_RELEASE_SHARE,
    HARD_CONTACT_RELEASE_SPEED, HARD_CONTACT_SHARE, PAIR_LIST_SLACK_MAX, PAIR_LIST_SLACK_MIN, PAIR_LIST_STEPS,
    PAIR_REACH_GAPS, PAIR_REACH_MAX, PAIR_REACH_MIN, PAIR_REACH_STEPS,
};
use crate::{ContactPenalty, Vec3};

/// Share of a ball's radius at which a vertex is put back: slightly inside, so that rounding cannot put it out.
const INSIDE_BALL: f64 = 1.0 - 1e-12;
/// Least divisor of a distance vector, m, so that a distance of 0 has a finite normal.
const NORMAL_DIVISOR_MIN: f64 = 1e-300;

/// Counts for the report of a run.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactTally {
    /// Lists of near pairs made.
    pub lists: u64,
    /// Measurements of all distances.
    pub measures: u64,
    /// Moves that were cut at the edge of their ball.
    pub held_back: u64,
    /// Largest number of cloth–cloth pairs.
    pub own_most: usize,
    /// Largest number of cloth–body pairs.
    pub body_most: usize,
    /// Least distance of a vertex to the body, m.
    pub body_nearest: f64,
    /// Contacts that slipped, summed over the steps.
    pub slipped: u64,
}

/// Lists of primitives that are near each other.
struct NearLists {
    tree: Option<BoxTree>,
    cloth: ClothCandidates,
    body: BodyCandidates,
    /// Positions when the lists were made, m.
    made_at: Vec<Vec3>,
    /// Motion of a vertex for which the lists hold, m.
    slack: f64,
    /// Distance up to which the lists are complete, m.
    reach: f64,
}

/// Balls in which the vertices may move.
struct Balls {
    centre: Vec<Vec3>,
    /// Radii, m.
    radius: Vec<f64>,
}

/// Distances of all vertices when they were last measured.
struct Distances {
    /// Distance to other cloth, m.
    cloth: Vec<f64>,
    /// Distance to the body, m.
    body: Vec<f64>,
    /// Nearest plane of the body: unit normal, and offset along it, m.
    body_plane: Vec<(Vec3, f64)>,
}

/// Contact of a cloth with a body and with itself.
pub(crate) struct PenaltyContact {
    frame: ContactParameters,
    body: Option<Body>,
    lists: NearLists,
    balls: Balls,
    distances: Distances,
    pub pairs: Vec<ContactPair>,
    /// Number of pairs of cloth and cloth; they are the first.
    own_pairs: usize,
    steps_since_measure: u32,
    stiffness: ContactStiffness,
    penalty: ContactPenalty,
    /// Work array of one number per vertex.
    work: Vec<f64>,
    pub tally: ContactTally,
}

impl PenaltyContact {
    /// Makes contact for cloth at `x` and measures all distances.
    pub fn new(
        x: &[Vec3],
        frame: ContactParameters,
        body: Option<Body>,
        stiffness: ContactStiffness,
        penalty: ContactPenalty,
    ) -> Self {
        let n = x.len();
        let tree = frame.has_self_contact.then(|| BoxTree::new(x, &frame.topology.faces));
        let mut contact = Self {
            frame,
            body,
            lists: NearLists {
                tree,
                cloth: ClothCandidates::default(),
                body: BodyCandidates::default(),
                made_at: Vec::new(),
                slack: 0.0,
                reach: 0.0,
            },
            balls: Balls { centre: x.to_vec(), radius: vec![0.0; n] },
            distances: Distances { cloth: vec![0.0; n], body: vec![0.0; n], body_plane: vec![(Vec3::zeros(), 0.0); n] },
            pairs: Vec::new(),
            own_pairs: 0,
            steps_since_measure: DISTANCE_MEASURE_STEPS_MIN.get(),
            stiffness,
            penalty,
            work: vec![0.0; n],
            tally: ContactTally { body_nearest: f64::INFINITY, ..ContactTally::default() },
        };
        contact.measure(x, 0.0);
        contact
    }

    /// The body that the cloth meets.
    pub fn body(&self) -> Option<&Body> {
        self.body.as_ref()
    }

    /// The contact parameters of the scene.
    pub fn frame(&self) -> &ContactParameters {
        &self.frame
    }

    /// Lets `new` be reached from `x` only as far as nothing can cross, and takes the difference out of `v`.
    pub fn hold_in_balls(&mut self, x: &[Vec3], new: &mut [Vec3], v: &mut [Vec3], dt: f64) {
        self.steps_since_measure = self.steps_since_measure.saturating_add(1);
        if self.balls.contain(new) {
            return;
        }
        if self.steps_since_measure > DISTANCE_MEASURE_STEPS_MIN.get() {
            let pace = crate::farthest(x, new);
            self.measure(x, pace);
            self.steps_since_measure = 0;
        }
        for i in 0..new.len() {
            let d = new[i] - self.balls.centre[i];
            let (l, r) = (d.norm(), self.balls.radius[i]);
            if l > r {
                let kept = self.balls.centre[i] + d * (r / l * INSIDE_BALL);
                v[i] += (kept - new[i]) / dt;
                new[i] = kept;
                self.tally.held_back += 1;
            }
        }
    }

    /// Measures all distances at `x`, and makes new balls and contact pairs. `pace` is the longest move of a step, m.
    pub fn measure(&mut self, x: &[Vec3], pace: f64) {
        let moved = crate::farthest(&self.lists.made_at, x);
        if self.lists.made_at.is_empty() || moved > self.lists.slack {
            self.make_lists(x, pace);
        }
        self.tally.measures += 1;
        self.distances.cloth.fill(self.lists.reach);
        self.distances.body.fill(self.lists.reach);
        self.pairs.clear();
        self.take_cloth_gaps(x);
        self.own_pairs = self.pairs.len();
        self.take_body_gaps(x);
        self.take_vertices_on_body(x);
        self.balls.fit(x, &self.distances);
        self.tally.own_most = self.tally.own_most.max(self.own_pairs);
        self.tally.body_most = self.tally.body_most.max(self.pairs.len() - self.own_pairs);
        set_stiffness(&mut self.pairs, self.stiffness, &self.frame.inverse_mass, &mut self.work);
    }

    /// Lists all primitives that may come near each other before the cloth has moved by the slack.
    fn make_lists(&mut self, x: &[Vec3], pace: f64) {
        self.tally.lists += 1;
        let edge = self.frame.mean_edge;
        let thick = self.frame.body_gap.iter().chain(&self.frame.self_gap).fold(0.0f64, |a, b| a.max(*b));
        let lists = &mut self.lists;
        lists.slack =
            (PAIR_LIST_STEPS.get() * pace).clamp(PAIR_LIST_SLACK_MIN.get() * edge, PAIR_LIST_SLACK_MAX.get() * edge);
        lists.reach = (PAIR_REACH_GAPS.get() * thick)
            .max(PAIR_REACH_MIN.get() * edge)
            .max((PAIR_REACH_STEPS.get() * pace).min(PAIR_REACH_MAX.get() * edge));
        // The slack stands for the motion here.
        let still = vec![Vec3::zeros(); x.len()];
        let way = LinearMotion::new(x, &still, &self.frame.topology, &self.frame.stitch_groups);
        if let Some(tree) = &mut lists.tree {
            let reach = lists.reach + 2.0 * lists.slack;
            tree.refit(x, &self.frame.topology.faces, 0.5 * reach);
            lists.cloth.remove_all();
            tree.meeting_pairs_at_rest(|f, g| lists.cloth.add_pair(f, g, &way, reach));
        }
        if let Some(body) = &self.body {
            let reach = lists.reach + lists.slack;
            lists.body.list(&way, body, [reach, reach], edge);
        }
        lists.made_at.clear();
        lists.made_at.extend_from_slice(x);
    }

    /// Takes the gaps of cloth to cloth: vertices to faces, and edges to edges.
    fn take_cloth_gaps(&mut self, x: &[Vec3]) {
        let (distance, pairs, reach) = (&mut self.distances.cloth, &mut self.pairs, self.lists.reach);
        for g in self.lists.cloth.point_gaps(x) {
            take_cloth_gap(distance, pairs, &self.frame, reach, &g, 1.0);
        }
        let share = EXPLICIT_EDGE_GAP_SHARE.get();
        for g in self.lists.cloth.edge_gaps(x) {
            take_cloth_gap(distance, pairs, &self.frame, reach, &g, share);
        }
    }

    /// Takes the gaps of edges and faces of the cloth to the body.
    fn take_body_gaps(&mut self, x: &[Vec3]) {
        let Some(body) = &self.body else { return };
        let (distance, pairs) = (&mut self.distances.body, &mut self.pairs);
        for (g, place) in self.lists.body.edge_gaps(x, body) {
            let [a, b, ..] = g.vertices;
            take_body_gap(distance, pairs, &self.frame, ([a, b, a, a], g.weights), g.separation, &place);
        }
        for (g, place) in self.lists.body.face_gaps(x, body) {
            let [a, b, c, _] = g.vertices;
            take_body_gap(distance, pairs, &self.frame, ([a, b, c, a], g.weights), g.separation, &place);
        }
    }

    /// Takes the nearest place on the body for every vertex.
    fn take_vertices_on_body(&mut self, x: &[Vec3]) {
        let Some(body) = &self.body else { return };
        let nearest = &mut self.work;
        nearest.clear();
        nearest.resize(x.len(), f64::INFINITY);
        for (g, place) in self.lists.body.point_gaps(x, body) {
            let l = g.separation.norm();
            let i = g.vertices[0] as usize;
            if l < nearest[i] {
                nearest[i] = l;
                let normal = g.separation / l.max(NORMAL_DIVISOR_MIN);
                self.distances.body_plane[i] = (normal, normal.dot(&place));
            }
        }
        for (i, l) in nearest.iter().copied().enumerate() {
            self.distances.body[i] = self.distances.body[i].min(l);
            self.tally.body_nearest = self.tally.body_nearest.min(l);
            if l < CONTACT_PAIR_GAPS.get() * self.frame.body_gap[i] {
                let vertex = u32::try_from(i).unwrap_or(u32::MAX);
                self.pairs.push(ContactPair::of_vertex(vertex, self.distances.body_plane[i], l, &self.frame));
            }
        }
    }

    /// Adds the contact forces at `x`, N, and keeps the normal loads for friction (equation 6).
    pub fn add_forces(&mut self, x: &[Vec3], f: &mut [Vec3]) {
        for p in &mut self.pairs {
            let g = p.distance_at(x);
            p.load = 0.0;
            p.distance = g;
            if g < p.gap {
                p.load = self.penalty.force(p.stiffness, p.gap, g);
                let push = p.normal * p.load;
                for k in 0..4 {
                    f[p.vertices[k] as usize] += push * p.weights[k];
                }
            }
        }
    }

    /// Stops by impulses the approach of any pair that is nearer than its hard distance.
    ///
    /// Springs alone cannot hold a tight seam over an edge of the body. The impulses count as normal load for friction.
    pub fn stop_approach(&mut self, v: &mut [Vec3], dt: f64) {
        if !HARD_CONTACT.is_on() {
            return;
        }
        let inverse_mass = &self.frame.inverse_mass;
        let (hard, release, fastest) =
            (HARD_CONTACT_SHARE.get(), HARD_CONTACT_RELEASE_SHARE.get(), HARD_CONTACT_RELEASE_SPEED.get());
        for p in self.pairs.iter_mut().filter(|p| p.load > 0.0) {
            let mut speed = 0.0;
            let mut mobility = 0.0;
            for k in 0..4 {
                let (w, i) = (p.weights[k], p.vertices[k] as usize);
                speed += w * p.normal.dot(&v[i]);
                mobility += w * w * inverse_mass[i];
            }
            let room = (p.distance - hard * p.gap) / dt;
            // Below the hard distance it is let out slowly, so that this brings in no energy.
            let least = if room >= 0.0 { -room } else { (-release * room).min(fastest) };
            if speed < least && mobility > 0.0 {
                let impulse = (least - speed) / mobility;
                p.load += impulse / dt;
                for k in 0..4 {
                    let i = p.vertices[k] as usize;
                    v[i] += p.normal * (impulse * p.weights[k] * inverse_mass[i]);
                }
            }
        }
    }

    /// Energy of the contact springs at `x`, J.
    pub fn energy(&self, x: &[Vec3]) -> f64 {
        self.pairs.iter().map(|p| self.penalty.energy(p.stiffness, p.gap, p.distance_at(x))).sum()
    }
}

impl Balls {
    /// Returns `true` if every vertex is in its ball.
    fn contain(&self, new: &[Vec3]) -> bool {
        new.iter().zip(&self.centre).zip(&self.radius).all(|((p, q), r)| (p - q).norm_squared() <= r * r)
    }

    /// Makes the balls around `x` as large as the distances allow.
    fn fit(&mut self, x: &[Vec3], distances: &Distances) {
        let (cloth, body) = (CLOTH_BALL_SHARE.get(), BODY_BALL_SHARE.get());
        let (floor, least) = (DISTANCE_FLOOR.get(), DISTANCE_FLOOR_SHARE.get());
        let room = |d: f64| (d - floor).max(least * d);
        self.centre.copy_from_slice(x);
        for i in 0..x.len() {
            self.radius[i] = (cloth * room(distances.cloth[i])).min(body * room(distances.body[i]));
        }
    }
}
