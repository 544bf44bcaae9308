//! Contact with a guarantee (docs/contact.md).
//!
//! For every vertex the distance from the primitives around it to the nearest primitive not joined to them bounds how
//! far it may move before the distances are taken again: 0.45 of a cloth–cloth distance (both may move), 0.9 of a
//! cloth–body distance. As long as every vertex stays in its ball nothing can cross, whatever the forces are.
//! Linear springs inside the contact thickness keep the distances open, so the balls stay large.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::body_candidates::BodyCandidates;
use crate::collision::broad_phase::bvh::BoxTree;
use crate::collision::narrow_phase::candidates::{ClothCandidates, LinearMotion, PairGeometry};
use crate::contact::parameters::ContactParameters;

const OWN_SHARE: f64 = 0.45;
const BODY_SHARE: f64 = 0.9;
/// Edges and faces are held off the body at this share of the vertices' gap, so that over a curved body the vertices carry.
const EDGE_SHARE: f64 = 0.5;
/// Steps between two measurements of the distances, at least.
const PATIENCE: u32 = 5;
/// Share of its gap below which a contact is hard: it takes any approach out of the velocities.
const HARD: f64 = 0.25;
/// Distances are counted from here, m: far above rounding, also to `f32`.
const FLOOR: f64 = 2e-6;
/// Contacts on one vertex above which each is softened.
const CROWD: f64 = 6.0;

/// Two near primitives, one plane between them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub vertices: [u32; 4],
    pub weights: [f64; 4],
    pub normal: Vec3,
    /// Body side of the gap, m.
    offset: f64,
    /// Distance below which it pushes, m.
    gap: f64,
    /// N/m.
    stiffness: f64,
    /// Normal force of the last evaluation, N.
    pub load: f64,
    /// Distance at the last evaluation, m.
    distance: f64,
    pub friction: f64,
}

/// What happened, for the report.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    pub lists: u64,
    pub measures: u64,
    pub held_back: u64,
    pub own_most: usize,
    pub body_most: usize,
    pub body_nearest: f64,
    pub slipped: u64,
}

pub(crate) struct Contact {
    frame: ContactParameters,
    body: Option<Body>,
    tree: Option<BoxTree>,
    near: ClothCandidates,
    against: BodyCandidates,
    /// Positions when the lists were made, and how far anything may move from there.
    listed: Vec<Vec3>,
    slack: f64,
    reach: f64,
    /// Centres and squared radii of the balls.
    centre: Vec<Vec3>,
    radius: Vec<f64>,
    own_distance: Vec<f64>,
    body_distance: Vec<f64>,
    body_plane: Vec<Vec3>,
    body_offset: Vec<f64>,
    crowd: Vec<f64>,
    pub pairs: Vec<Pair>,
    own_pairs: usize,
    since: u32,
    /// Stiffness per effective mass, 1/s², …
    rate: f64,
    /// … or of all contacts alike where it is above 0, N/m.
    penalty: f64,
    pub tally: Tally,
}

impl Contact {
    pub fn new(x: &[Vec3], frame: ContactParameters, body: Option<Body>, [rate, penalty]: [f64; 2]) -> Self {
        let n = x.len();
        let tree = frame.has_self_contact.then(|| BoxTree::new(x, &frame.topology.faces));
        let mut contact = Self {
            frame,
            body,
            tree,
            near: ClothCandidates::default(),
            against: BodyCandidates::default(),
            listed: Vec::new(),
            slack: 0.0,
            reach: 0.0,
            centre: x.to_vec(),
            radius: vec![0.0; n],
            own_distance: vec![0.0; n],
            body_distance: vec![0.0; n],
            body_plane: vec![Vec3::zeros(); n],
            body_offset: vec![0.0; n],
            crowd: vec![0.0; n],
            pairs: Vec::new(),
            own_pairs: 0,
            since: PATIENCE,
            rate,
            penalty,
            tally: Tally { body_nearest: f64::INFINITY, ..Tally::default() },
        };
        contact.measure(x, 0.0);
        contact
    }

    pub fn body(&self) -> Option<&Body> {
        self.body.as_ref()
    }

    /// Lets `new` be reached from `x` only as far as nothing can cross; takes the difference out of `v`.
    pub fn guard(&mut self, x: &[Vec3], new: &mut [Vec3], v: &mut [Vec3], dt: f64) {
        self.since = self.since.saturating_add(1);
        if self.holds(new) {
            return;
        }
        if self.since > PATIENCE {
            let pace = crate::farthest(x, new);
            self.measure(x, pace);
            self.since = 0;
        }
        for i in 0..new.len() {
            let d = new[i] - self.centre[i];
            let (l, r) = (d.norm(), self.radius[i]);
            if l > r {
                // Slightly inside, so that rounding cannot put it out.
                let kept = self.centre[i] + d * (r / l * (1.0 - 1e-12));
                v[i] += (kept - new[i]) / dt;
                new[i] = kept;
                self.tally.held_back += 1;
            }
        }
    }

    /// Is every vertex in its ball?
    fn holds(&self, new: &[Vec3]) -> bool {
        new.iter().zip(&self.centre).zip(&self.radius).all(|((p, q), r)| (p - q).norm_squared() <= r * r)
    }

    /// Takes all distances at `x`: new balls, new contact planes.
    pub fn measure(&mut self, x: &[Vec3], pace: f64) {
        let moved = crate::farthest(&self.listed, x);
        if self.listed.is_empty() || moved > self.slack {
            self.list(x, pace);
        }
        self.tally.measures += 1;
        self.centre.copy_from_slice(x);
        self.own_distance.fill(self.reach);
        self.body_distance.fill(self.reach);
        self.pairs.clear();
        self.own_points(x);
        self.own_edges(x);
        self.own_pairs = self.pairs.len();
        self.body_edges(x);
        self.body_faces(x);
        self.body_points(x);
        for i in 0..x.len() {
            let room = |d: f64| (d - FLOOR).max(0.1 * d);
            self.radius[i] = (OWN_SHARE * room(self.own_distance[i])).min(BODY_SHARE * room(self.body_distance[i]));
        }
        self.soften();
    }

    fn list(&mut self, x: &[Vec3], pace: f64) {
        self.tally.lists += 1;
        let h = self.frame.mean_edge;
        let thick = self.frame.body_gap.iter().chain(&self.frame.self_gap).fold(0.0f64, |a, b| a.max(*b));
        self.slack = (40.0 * pace).clamp(0.12 * h, 0.5 * h);
        self.reach = (1.5 * thick).max(0.2 * h).max((30.0 * pace).min(0.8 * h));
        // The slack stands for the motion here.
        let still = vec![Vec3::zeros(); x.len()];
        let way = LinearMotion::new(x, &still, &self.frame.topology, &self.frame.stitch_groups);
        if let Some(tree) = &mut self.tree {
            let reach = self.reach + 2.0 * self.slack;
            tree.refit(x, &self.frame.topology.faces, 0.5 * reach);
            self.near.remove_all();
            tree.meeting_pairs_at_rest(|f, g| self.near.add_pair(f, g, &way, reach));
        }
        if let Some(body) = &self.body {
            let reach = self.reach + self.slack;
            self.against.list(&way, body, [reach, reach], h);
        }
        self.listed.clear();
        self.listed.extend_from_slice(x);
    }

    fn own_points(&mut self, x: &[Vec3]) {
        for g in self.near.point_gaps(x) {
            own_pair(&mut self.own_distance, &mut self.pairs, &self.frame, self.reach, &g, 1.0);
        }
    }

    fn own_edges(&mut self, x: &[Vec3]) {
        for g in self.near.edge_gaps(x) {
            own_pair(&mut self.own_distance, &mut self.pairs, &self.frame, self.reach, &g, EDGE_SHARE);
        }
    }

    fn body_points(&mut self, x: &[Vec3]) {
        let Some(body) = &self.body else { return };
        let n = x.len();
        self.crowd.clear();
        self.crowd.resize(n, f64::INFINITY);
        for (g, place) in self.against.point_gaps(x, body) {
            let l = g.separation.norm();
            let i = g.vertices[0] as usize;
            if l < self.crowd[i] {
                self.crowd[i] = l;
                self.body_plane[i] = g.separation / l.max(1e-300);
                self.body_offset[i] = self.body_plane[i].dot(&place);
            }
        }
        for i in 0..n {
            let (l, gap) = (self.crowd[i], self.frame.body_gap[i]);
            self.body_distance[i] = self.body_distance[i].min(l);
            self.tally.body_nearest = self.tally.body_nearest.min(l);
            if l < 2.0 * gap {
                let v = u32::try_from(i).unwrap_or(u32::MAX);
                self.pairs.push(Pair {
                    vertices: [v; 4],
                    weights: [1.0, 0.0, 0.0, 0.0],
                    normal: self.body_plane[i],
                    offset: self.body_offset[i],
                    gap,
                    stiffness: 0.0,
                    load: 0.0,
                    distance: l,
                    friction: self.frame.friction[i],
                });
            }
        }
    }

    fn body_edges(&mut self, x: &[Vec3]) {
        let Some(body) = &self.body else { return };
        for (g, place) in self.against.edge_gaps(x, body) {
            let [a, b, ..] = g.vertices;
            body_pair(
                &mut self.body_distance,
                &mut self.pairs,
                &self.frame,
                [a, b, a, a],
                g.weights,
                g.separation,
                &place,
            );
        }
    }

    fn body_faces(&mut self, x: &[Vec3]) {
        let Some(body) = &self.body else { return };
        for (g, place) in self.against.face_gaps(x, body) {
            let [a, b, c, _] = g.vertices;
            body_pair(
                &mut self.body_distance,
                &mut self.pairs,
                &self.frame,
                [a, b, c, a],
                g.weights,
                g.separation,
                &place,
            );
        }
    }

    /// Stiffness from the masses; where many contacts meet on one vertex each is softened, so that together they stay
    /// under the step's limit.
    fn soften(&mut self) {
        self.tally.own_most = self.tally.own_most.max(self.own_pairs);
        self.tally.body_most = self.tally.body_most.max(self.pairs.len() - self.own_pairs);
        self.crowd.clear();
        self.crowd.resize(self.radius.len(), 0.0);
        for p in &self.pairs {
            for k in 0..4 {
                if p.weights[k] != 0.0 {
                    self.crowd[p.vertices[k] as usize] += p.weights[k].abs();
                }
            }
        }
        for p in &mut self.pairs {
            let most = (0..4).map(|k| self.crowd[p.vertices[k] as usize]).fold(0.0, f64::max);
            let mobility: f64 =
                (0..4).map(|k| p.weights[k] * p.weights[k] * self.frame.inverse_mass[p.vertices[k] as usize]).sum();
            p.stiffness = if mobility <= 0.0 {
                0.0
            } else if self.penalty > 0.0 {
                self.penalty
            } else {
                self.rate / mobility * (CROWD / most.max(CROWD))
            };
        }
    }

    /// Adds the contact forces at `x` and remembers the normal loads for friction.
    pub fn add_forces(&mut self, x: &[Vec3], f: &mut [Vec3]) {
        for p in &mut self.pairs {
            let g = p.distance(x);
            p.load = 0.0;
            p.distance = g;
            if g < p.gap {
                p.load = p.stiffness * (p.gap - g);
                let push = p.normal * p.load;
                for k in 0..4 {
                    f[p.vertices[k] as usize] += push * p.weights[k];
                }
            }
        }
    }

    /// Where the springs alone cannot hold (a tight seam over an edge of the body), impulses do: no pair nearer than
    /// its hard distance goes on approaching. The impulses count as normal load for friction.
    pub fn stop_approach(&mut self, v: &mut [Vec3], dt: f64) {
        let inverse_mass = &self.frame.inverse_mass;
        for p in self.pairs.iter_mut().filter(|p| p.load > 0.0) {
            let mut speed = 0.0;
            let mut mobility = 0.0;
            for k in 0..4 {
                let (w, i) = (p.weights[k], p.vertices[k] as usize);
                speed += w * p.normal.dot(&v[i]);
                mobility += w * w * inverse_mass[i];
            }
            let room = (p.distance - HARD * p.gap) / dt;
            // Below the hard distance it is let out slowly, so that no energy comes of it.
            let least = if room >= 0.0 { -room } else { (-0.05 * room).min(0.1) };
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

    /// J.
    pub fn energy(&self, x: &[Vec3]) -> f64 {
        self.pairs
            .iter()
            .map(|p| 0.5 * p.stiffness * (p.gap - p.distance(x)).max(0.0) * (p.gap - p.distance(x)).max(0.0))
            .sum()
    }

    pub fn frame(&self) -> &ContactParameters {
        &self.frame
    }
}

impl Pair {
    #[inline]
    fn distance(&self, x: &[Vec3]) -> f64 {
        let w = &self.weights;
        let [a, b, c, d] = crate::pick4(x, &self.vertices);
        self.normal.dot(&(a * w[0] + b * w[1] + c * w[2] + d * w[3])) - self.offset
    }
}

#[inline]
fn own_pair(
    distance: &mut [f64],
    pairs: &mut Vec<Pair>,
    frame: &ContactParameters,
    reach: f64,
    g: &PairGeometry,
    share: f64,
) {
    let PairGeometry { vertices, weights, separation: d, .. } = *g;
    let l = d.norm();
    if l >= reach {
        return;
    }
    let mut gap = f64::INFINITY;
    for v in vertices {
        let i = v as usize;
        distance[i] = distance[i].min(l);
        gap = gap.min(frame.self_gap[i]);
    }
    gap *= share;
    if l < 2.0 * gap && l > 0.0 {
        let friction = frame.friction[vertices[0] as usize];
        pairs.push(Pair {
            vertices,
            weights,
            normal: d / l,
            offset: 0.0,
            gap,
            stiffness: 0.0,
            load: 0.0,
            distance: f64::INFINITY,
            friction,
        });
    }
}

#[inline]
fn body_pair(
    distance: &mut [f64],
    pairs: &mut Vec<Pair>,
    frame: &ContactParameters,
    vertices: [u32; 4],
    weights: [f64; 4],
    d: Vec3,
    place: &Vec3,
) {
    let l = d.norm();
    let mut gap = f64::INFINITY;
    for v in vertices {
        let i = v as usize;
        distance[i] = distance[i].min(l);
        gap = gap.min(EDGE_SHARE * frame.body_gap[i]);
    }
    if l < 2.0 * gap && l > 0.0 {
        let normal = d / l;
        let friction = frame.friction[vertices[0] as usize];
        let offset = normal.dot(place);
        pairs.push(Pair {
            vertices,
            weights,
            normal,
            offset,
            gap,
            stiffness: 0.0,
            load: 0.0,
            distance: f64::INFINITY,
            friction,
        });
    }
}
