//! Contact as a smooth energy of the true distances, for descents (docs/static.md).
//!
//! Two primitives nearer than their gap ĝ store κ a b(d), b = −(d − ĝ)² ln(d/ĝ): nothing at the gap, with no kink, and
//! infinite at touch (the barrier of incremental potential contact, Li et al. 2020, equation 6). Lists of what is near
//! are made anew when the cloth has moved by the slack.

mod deferred_detection;
mod gap_update;

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::body_candidates::Against;
use crate::collision::narrow_phase::candidates::{Gap, Near, Way};
use crate::collision::narrow_phase::pair_kind::{PairKey, PairKind};
use crate::collision::self_candidates::Own;
use crate::contact::list_validity::Listed;
use crate::contact::parameters::Frame;
use crate::linear::hessian::{FIXED, Hessian};
use crate::report::cost::{Costs, Lap, Work};

/// Edges and faces are held off the body, and edges off edges, at this share of the vertices' gap.
const EDGE_SHARE: f64 = 0.5;
/// A contact nearer than this share of its gap is pressed harder than the barrier is made for: there it becomes as stiff
/// as holds the same load at `EASY` of the gap, by at most `HARDER` at a time and `HARDEST` in all.
const TIGHT: f64 = 0.1;
const EASY: f64 = 0.4;
const HARDER: f64 = 16.0;
const HARDEST: f64 = 1e4;
/// Slack of the lists over the mean edge: small enough that neighbours of neighbours stay out.
const LEAST_SLACK: f64 = 0.02;
const MOST_SLACK: f64 = 0.1;

/// Two primitives nearer than their gap.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    pub vertices: [u32; 4],
    pub weights: [f64; 4],
    pub normal: Vec3,
    pub distance: f64,
    /// Normal force, N.
    pub load: f64,
    /// Its growth as the distance shrinks, N/m.
    pub slope: f64,
    /// m².
    pub area: f64,
    /// Distance from which it pushes, m, and by how much it is harder than others.
    pub gap: f64,
    pub hard: f64,
    pub friction: f64,
    pub key: PairKey,
}

/// What happened, for the report.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    pub lists: u64,
    pub own_most: usize,
    pub body_most: usize,
    pub nearest_body: f64,
    pub limited: u64,
    /// Evaluations, and those in which cloth touched cloth, and the body.
    pub looks: u64,
    pub own_looks: u64,
    pub body_looks: u64,
    /// Ways on which cloth was not looked for beside cloth, and those of them that were taken back.
    pub ahead: u64,
    pub back: u64,
    /// Not part of any result.
    pub costs: Costs,
}

impl Tally {
    fn count(&mut self, own: usize, body: usize) {
        self.own_most = self.own_most.max(own);
        self.body_most = self.body_most.max(body);
        self.looks += 1;
        self.own_looks += u64::from(own > 0);
        self.body_looks += u64::from(body > 0);
    }
}

/// Is cloth near cloth listed?
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Sight {
    /// As what is near the body.
    #[default]
    Kept,
    /// It is not looked for.
    Away,
    /// Not now: a list is due.
    Lost,
}

pub(crate) struct Barrier {
    pub frame: Frame,
    pub body: Option<Body>,
    /// What finds cloth near cloth, where it is looked for.
    own: Option<Own>,
    pub near: Near,
    sight: Sight,
    pub against: Against,
    /// How far each vertex is from where the lists of the body were made, m.
    moved: Vec<f64>,
    listed: Listed,
    /// Vertices feel the body from at least here, m: further off than their gaps, so that they slide round it.
    pub stand_off: f64,
    area: Vec<f64>,
    /// Hardening of the contacts, per vertex.
    hard: Vec<f64>,
    /// Gaps to the body as they were before any gave way.
    wanted: Vec<f64>,
    /// Vertices that began with the load under which they rest.
    loaded: Vec<bool>,
    pub touches: Vec<Touch>,
    /// Distances of the listed pairs at the last evaluation, in the order of the lists, kind by kind; of pairs with the body
    /// that do not push maybe less.
    pub distances: [Vec<f64>; 5],
    pub tally: Tally,
}

impl Barrier {
    /// `area`: of cloth, per vertex, m²; `own`: what finds cloth near cloth, where it is looked for.
    pub fn new(frame: Frame, body: Option<Body>, area: Vec<f64>, own: Option<Own>) -> Self {
        Self {
            wanted: frame.body_gap.clone(),
            frame,
            body,
            own,
            near: Near::default(),
            sight: Sight::default(),
            against: Against::default(),
            moved: Vec::new(),
            listed: Listed::default(),
            stand_off: 0.0,
            hard: vec![1.0; area.len()],
            loaded: vec![false; area.len()],
            area,
            touches: Vec::new(),
            distances: Default::default(),
            tally: Tally { nearest_body: f64::INFINITY, ..Tally::default() },
        }
    }

    /// Makes sure that the lists cover all places on the way from `x` along `step` (by the same part for all vertices),
    /// and a little beside it; makes them anew where needed. Returns whether they were.
    pub fn cover(&mut self, x: &[Vec3], step: &[Vec3]) -> bool {
        let way = Way::new(x, step, &self.frame.topology, &self.frame.groups);
        let travels = self.body.as_ref().is_some_and(Body::travels);
        if self.listed.covers(x, way.longest, 0.0) && !travels && self.sight != Sight::Lost {
            return false;
        }
        self.tally.lists += 1;
        let mut lap = Lap::start();
        let edge = self.frame.edge;
        let slack = (3.0 * way.longest).clamp(LEAST_SLACK * edge, MOST_SLACK * edge);
        if let Some(own) = self.own.as_mut().filter(|_| self.sight != Sight::Away) {
            own.list(&mut self.near, &way, thick(&self.frame.own_gap), slack, edge);
            self.sight = Sight::Kept;
            self.tally.costs.spend(Work::SelfContact, &mut lap);
        }
        if let Some(body) = &mut self.body {
            let gap = thick(&self.frame.body_gap);
            // Edges and faces push from nearer than vertices do.
            let (reach, wide) = (EDGE_SHARE * gap + slack, gap.max(self.stand_off) + slack);
            if body.travel.is_some() {
                self.against.fill_travelling(&way, body, wide);
            } else {
                self.against.fill(&way, body, [reach, wide], edge);
                self.tally.nearest_body = self.tally.nearest_body.min(self.against.nearest());
            }
            self.against.points.sort_unstable_by_key(|p| p.vertices);
            self.tally.costs.spend(Work::BodyContact, &mut lap);
        }
        self.listed.made(x, slack);
        true
    }

    /// Makes the lists anew; what the wide search found stays.
    pub fn relist(&mut self, x: &[Vec3]) {
        self.listed.forget();
        self.cover(x, &vec![Vec3::zeros(); x.len()]);
    }

    /// Gaps have changed: makes the lists for them.
    pub fn cover_anew(&mut self, x: &[Vec3]) {
        self.own.iter_mut().for_each(Own::forget);
        self.relist(x);
    }

    /// Tells that `x` was reached.
    pub fn took(&mut self, x: &[Vec3]) {
        self.listed.took(x);
    }

    /// Energy at `x`, J; adds the forces to `f` and remembers the contacts.
    pub fn evaluate(&mut self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut lap = Lap::start();
        self.touches.clear();
        self.own(x);
        let own = self.touches.len();
        let mut energy = press(&mut self.touches, self.frame.press, f);
        self.tally.costs.spend(Work::SelfContact, &mut lap);
        self.against_body(x);
        energy += press(&mut self.touches[own..], self.frame.press, f);
        self.tally.costs.spend(Work::BodyContact, &mut lap);
        self.tally.count(own, self.touches.len() - own);
        energy
    }

    /// Hardens the contacts of free vertices that are pressed nearly shut, as the last evaluation saw them; says whether any
    /// is.
    ///
    /// A load of tens of kPa (tight cloth over a sharp bend) would close a gap to a micrometre, where no step is short
    /// enough.
    pub fn harden(&mut self, unknown: &[u32]) -> bool {
        let mut any = false;
        for t in self.touches.iter().filter(|t| t.distance < TIGHT * t.gap) {
            let more = (barrier(t.distance, t.gap).1 / barrier(EASY * t.gap, t.gap).1).min(HARDER);
            let hard = (t.hard * more).min(HARDEST);
            for (v, w) in t.vertices.iter().zip(&t.weights) {
                if *w != 0.0 && unknown[*v as usize] != FIXED && self.hard[*v as usize] < hard {
                    self.hard[*v as usize] = hard;
                    any = true;
                }
            }
        }
        any
    }

    fn own(&mut self, x: &[Vec3]) {
        let [points, edges, ..] = &mut self.distances;
        points.clear();
        edges.clear();
        let (weighs, touches) = ((&*self.area, &*self.hard, 0.0), &mut self.touches);
        points
            .extend(self.near.point_gaps(x).map(|g| touch(touches, &self.frame, weighs, PairKind::VertexTriangle, &g)));
        edges.extend(self.near.edge_gaps(x).map(|g| touch(touches, &self.frame, weighs, PairKind::EdgeEdge, &g)));
    }

    fn against_body(&mut self, x: &[Vec3]) {
        let Some(body) = &self.body else { return };
        let [_, _, points, edges, faces] = &mut self.distances;
        for list in [&mut *points, &mut *edges, &mut *faces] {
            list.clear();
        }
        let (lists, nearest) = (&self.against, &mut self.tally.nearest_body);
        if lists.is_empty() {
            return;
        }
        lists.moved(x, &mut self.moved);
        let gap = thick(&self.frame.body_gap);
        let (near, wide, moved) = (EDGE_SHARE * gap, gap.max(self.stand_off), &*self.moved);
        let (frame, weighs, touches) = (&self.frame, (&*self.area, &*self.hard, self.stand_off), &mut self.touches);
        edges.extend(lists.edges.iter().map(|p| {
            p.farther(2, moved, near)
                .unwrap_or_else(|| touch(touches, frame, weighs, PairKind::EdgeBodyEdge, &p.edge_gap(x, body).0))
        }));
        faces.extend(lists.faces.iter().map(|p| {
            p.farther(3, moved, near)
                .unwrap_or_else(|| touch(touches, frame, weighs, PairKind::TriangleBodyVertex, &p.face_gap(x, body).0))
        }));
        // Every triangle pushes by itself: the nearest alone would jump from side to side in a crease.
        points.extend(lists.points.iter().map(|p| {
            p.farther(1, moved, wide).unwrap_or_else(|| {
                let distance = touch(touches, frame, weighs, PairKind::VertexBodyTriangle, &p.point_gap(x, body).0);
                *nearest = nearest.min(distance);
                distance
            })
        }));
    }

    /// Adds the second derivatives of the last evaluation, the curvature of the distances left out (it only turns
    /// contacts, and is negative).
    pub fn add_hessian(&self, h: &mut Hessian) {
        for t in &self.touches {
            let slope = t.slope.min(self.frame.steepest);
            h.spread(&t.vertices, &t.weights, &(t.normal * t.normal.transpose() * slope));
        }
    }
}

/// The largest of some gaps, m.
fn thick(gaps: &[f64]) -> f64 {
    gaps.iter().fold(0.0f64, |a, b| a.max(*b))
}

/// The least gap of some vertices, m.
fn least(gaps: &[f64], vertices: &[u32]) -> f64 {
    vertices.iter().fold(f64::INFINITY, |g, v| g.min(gaps[*v as usize]))
}

/// Energy of contacts, J; adds their forces.
fn press(touches: &mut [Touch], stiffness: f64, f: &mut [Vec3]) -> f64 {
    let mut energy = 0.0;
    for t in touches {
        let k = stiffness * t.area * t.hard;
        let (b, slope, bow) = barrier(t.distance, t.gap);
        energy += k * b;
        t.load = -k * slope;
        t.slope = k * bow;
        let push = t.normal * t.load;
        for i in 0..4 {
            if t.weights[i] != 0.0 {
                f[t.vertices[i] as usize] += push * t.weights[i];
            }
        }
    }
    energy
}

/// b, b′, b″ of the barrier.
#[inline]
fn barrier(d: f64, gap: f64) -> (f64, f64, f64) {
    let (s, l) = (d - gap, libm::log(d / gap));
    (-s * s * l, -2.0 * s * l - s * s / d, -2.0 * l - 4.0 * s / d + s * s / (d * d))
}

/// Remembers the pair if it is nearer than its gap (area and hardening per vertex, and the distance that vertices stand off
/// the body, given); gives the distance.
#[inline]
fn touch(
    touches: &mut Vec<Touch>,
    frame: &Frame,
    (area, hard, stand_off): (&[f64], &[f64], f64),
    kind: PairKind,
    g: &Gap,
) -> f64 {
    let Gap { vertices: key, weights, d, aside } = *g;
    let distance = d.norm();
    let cloth = match kind {
        PairKind::VertexTriangle | PairKind::EdgeEdge => 4,
        PairKind::VertexBodyTriangle => 1,
        PairKind::EdgeBodyEdge => 2,
        _ => 3,
    };
    let gaps = if kind.is_cloth_only() { &frame.own_gap } else { &frame.body_gap };
    let share = if matches!(kind, PairKind::VertexTriangle | PairKind::VertexBodyTriangle) { 1.0 } else { EDGE_SHARE };
    let gap = share * least(gaps, &key[..cloth]);
    let gap = if kind == PairKind::VertexBodyTriangle { gap.max(stand_off) } else { gap };
    if distance < gap && distance > 0.0 && !aside {
        let mut vertices = [key[0]; 4];
        vertices[..cloth].copy_from_slice(&key[..cloth]);
        let area = share * vertices[..cloth].iter().map(|v| area[*v as usize]).sum::<f64>() / cloth as f64;
        touches.push(Touch {
            vertices,
            weights,
            normal: d / distance,
            distance,
            load: 0.0,
            slope: 0.0,
            area,
            gap,
            hard: vertices[..cloth].iter().map(|v| hard[*v as usize]).fold(1.0, f64::max),
            friction: frame.friction[key[0] as usize],
            key: (kind, key),
        });
    }
    distance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_barrier_starts_without_a_kink_and_its_derivatives_agree() {
        let gap = 1e-3;
        for d in [1e-5, 2e-4, 5e-4, 9e-4] {
            let h = 1e-9;
            let (low, high) = (barrier(d - h, gap), barrier(d + h, gap));
            let (_, slope, bow) = barrier(d, gap);
            assert!(((high.0 - low.0) / (2.0 * h) / slope - 1.0).abs() < 1e-4, "{d}");
            assert!(((high.1 - low.1) / (2.0 * h) / bow - 1.0).abs() < 1e-4, "{d}");
            assert!(slope < 0.0 && bow > 0.0);
        }
        let (b, slope, bow) = barrier(gap, gap);
        assert_eq!((b, slope, bow), (0.0, 0.0, 0.0));
    }

    /// A vertex pressed on the body with 45 kPa comes to stand off it, not at a micrometre.
    #[test]
    fn a_hard_pressed_contact_hardens_until_it_stands_off() {
        let (gap, load) = (5e-4, 45e3);
        let mut b = Barrier::new(frame(gap), None, vec![1.0], None);
        assert!(stands(gap, load) < 2e-6);
        for round in 0..8 {
            let d = stands(gap, load / b.hard[0]);
            b.touches.clear();
            let found = touch(
                &mut b.touches,
                &b.frame,
                (&b.area, &b.hard, 0.0),
                PairKind::VertexBodyTriangle,
                &Gap { vertices: [0; 4], weights: [1.0, 0.0, 0.0, 0.0], d: Vec3::new(0.0, d, 0.0), aside: false },
            );
            assert_eq!(found, d);
            if !b.harden(&[0]) {
                assert!(round > 0 && d > TIGHT * gap, "{round} {d}");
                return;
            }
        }
        panic!("never hard enough");
    }

    /// Cloth that presses with 400 Pa comes to lie where its gap says, with the load it had.
    #[test]
    fn a_contact_that_gave_way_pushes_from_farther_off() {
        let (gap, load) = (1e-3, 400.0);
        let mut b = Barrier::new(frame(gap), None, vec![1.0], None);
        let d = stands(gap, load);
        assert!(d < 0.7 * gap);
        let at = Gap { vertices: [0; 4], weights: [1.0, 0.0, 0.0, 0.0], d: Vec3::new(0.0, d, 0.0), aside: false };
        touch(&mut b.touches, &b.frame, (&b.area, &b.hard, 0.0), PairKind::VertexBodyTriangle, &at);
        let x = [Vec3::new(0.0, d, 0.0)];
        assert!(!b.bear(&x, &[FIXED]) && b.bear(&x, &[0]));
        assert!((stands(b.frame.body_gap[0], load) / gap - 1.0).abs() < 1e-6);
        b.touches.clear();
        let at = Gap { d: Vec3::new(0.0, gap, 0.0), ..at };
        touch(&mut b.touches, &b.frame, (&b.area, &b.hard, 0.0), PairKind::VertexBodyTriangle, &at);
        assert!(!b.bear(&x, &[0]), "it lies where it should");
    }

    /// Pairs that are left out because nothing moved far enough push nothing: wherever the cloth gets to within its lists, energy
    /// and forces are those of lists made there, to the last bits of other sums.
    #[test]
    fn what_is_not_looked_at_would_not_push() {
        let (gap, edge) = (2e-3, 0.02);
        let topology = || crate::scene::topology::Topology::new(4, vec![[0, 1, 2], [1, 3, 2]]);
        let mesh = crate::BodyMesh {
            positions: [[0.0, 0.0, 0.0], [0.06, 0.0, 0.0], [0.03, 0.05, 0.0], [0.03, 0.02, -0.05]]
                .map(Vec3::from)
                .to_vec(),
            triangles: vec![[0, 1, 2], [1, 0, 3], [2, 1, 3], [0, 2, 3]],
        };
        let fresh = || {
            let frame = Frame::plain(topology(), vec![gap; 4], vec![0.0; 4], edge);
            Barrier::new(frame, Body::new(&mesh), vec![1e-4; 4], None)
        };
        let at = |k: f64| {
            let z = 2.4e-3 - 1.2e-3 * k;
            [[0.02, -0.004, z], [0.04, -0.004, z + 1e-3], [0.02, 0.01, z], [0.04, 0.012, z + 2e-3]].map(Vec3::from)
        };
        let (start, end) = (at(0.0), at(1.0));
        let step: Vec<Vec3> = end.iter().zip(&start).map(|(p, q)| p - q).collect();
        let mut kept = fresh();
        assert!(kept.cover(&start, &step));
        let mut pushed = 0;
        for k in 0..=20 {
            let x = at(f64::from(k) / 20.0);
            let mut anew = fresh();
            anew.cover(&x, &[Vec3::zeros(); 4]);
            let (mut f, mut g) = ([Vec3::zeros(); 4], [Vec3::zeros(); 4]);
            let (a, b) = (kept.evaluate(&x, &mut f), anew.evaluate(&x, &mut g));
            assert!((a - b).abs() <= 1e-14 * a.abs() && kept.touches.len() == anew.touches.len(), "{k}: {a} {b}");
            assert!(f.iter().zip(&g).all(|(p, q)| (p - q).norm() <= 1e-14 * (1.0 + p.norm())));
            pushed += usize::from(a > 0.0);
        }
        assert!((5..20).contains(&pushed), "{pushed}");
    }

    /// N/m³: a gap of 1 mm is half closed by 240 Pa.
    const PRESS: f64 = 2e5;

    /// Where a barrier that starts at `gap` carries a load, Pa.
    fn stands(gap: f64, load: f64) -> f64 {
        gap_update::halved([0.0, gap], |d| -barrier(d, gap).1 * PRESS > load)
    }

    fn frame(gap: f64) -> Frame {
        Frame::plain(crate::scene::topology::Topology::default(), vec![gap], vec![gap], 0.01)
    }
}
