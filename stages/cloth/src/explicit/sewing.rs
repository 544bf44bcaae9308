//! Sewing: a force linear in the gap on every open stitch (paper equation 5), capped so that pieces far apart do not
//! fly; a pair that came close is joined: from then on both vertices move as one (docs/sewing.md).

use crate::scene::measures::mean_edge;
use crate::{Scene, Settings, Vec3};

/// After this long the cap of the force begins to double …
const PATIENCE: f64 = 0.5;
/// … every so many seconds, so that a tight seam closes in the end.
const DOUBLING: f64 = 0.15;
/// … so often at most.
const MOST_DOUBLINGS: f64 = 11.0;
/// When the force has grown to its most, pairs nearer than this share of an edge are joined all the same: the pull is
/// then as strong as it must be, and only the body or the cloth between them can keep them apart.
const LAST_RESORT: f64 = 0.7;
/// Time left for that, s.
const HOPE: f64 = 0.5;
/// Share of its gap that a joined pair closes in a step.
const ZIP: f64 = 0.1;
/// A joined pair nearer than this is put on one point, m.
const SNAP: f64 = 1e-9;

struct Stitch {
    ends: [u32; 2],
    /// N/m.
    stiffness: f64,
    /// N.
    cap: f64,
    open: bool,
}

pub(crate) struct Sewing {
    stitches: Vec<Stitch>,
    /// Vertices joined so far, each group in ascending order.
    joined: Vec<Vec<u32>>,
    open: usize,
    vertex_count: usize,
    distance: f64,
    /// From how far a pair is joined when no force closes it, m.
    last_resort: f64,
    ramp: f64,
    /// Does it pull, or does it only keep closed what is closed?
    pulls: bool,
    pub time: f64,
}

impl Sewing {
    /// `rows`: stiffness row sums of the vertices, N/m; `mass`: their inertia, kg.
    pub fn new(scene: &Scene, s: &Settings, rows: &[f64], mass: &[f64], pulls: bool) -> Self {
        let stitches: Vec<Stitch> = scene
            .stitches
            .iter()
            .filter(|p| p[0] != p[1])
            .map(|p| {
                let [a, b] = p.map(|v| v as usize);
                Stitch {
                    ends: *p,
                    stiffness: s.sewing_stiffness * rows[a].min(rows[b]),
                    cap: s.sewing_acceleration * mass[a].min(mass[b]),
                    open: true,
                }
            })
            .collect();
        let open = stitches.len();
        let mut sewing = Self {
            stitches,
            joined: Vec::new(),
            open,
            vertex_count: scene.positions.len(),
            distance: s.sewing_distance,
            last_resort: s.sewing_distance.max(LAST_RESORT * mean_edge(scene)),
            ramp: s.sewing_ramp,
            pulls,
            time: 0.0,
        };
        sewing.join(&scene.positions);
        sewing
    }

    pub fn open(&self) -> usize {
        self.open
    }

    /// Is this the sewing phase?
    pub fn pulls(&self) -> bool {
        self.pulls
    }

    pub fn pulling(&self) -> bool {
        self.pulls && self.open > 0
    }

    /// Has the force grown as far as it will?
    pub fn strained(&self) -> bool {
        self.time > PATIENCE + DOUBLING * MOST_DOUBLINGS
    }

    /// Has the grown force had its time without closing everything?
    pub fn hopeless(&self) -> bool {
        self.time > PATIENCE + DOUBLING * MOST_DOUBLINGS + HOPE
    }

    /// Joins pairs that came near.
    pub fn join(&mut self, x: &[Vec3]) {
        if self.open == 0 {
            return;
        }
        let mut news = false;
        let distance = if self.strained() { self.last_resort } else { self.distance };
        for s in self.stitches.iter_mut().filter(|s| s.open) {
            if (x[s.ends[0] as usize] - x[s.ends[1] as usize]).norm() <= distance {
                s.open = false;
                self.open -= 1;
                news = true;
            }
        }
        if news {
            self.regroup();
        }
    }

    fn regroup(&mut self) {
        let closed: Vec<[u32; 2]> = self.stitches.iter().filter(|s| !s.open).map(|s| s.ends).collect();
        let root = crate::scene::weld::groups(self.vertex_count, &closed);
        let mut members: Vec<(u32, u32)> = closed.iter().flatten().map(|v| (root[*v as usize], *v)).collect();
        members.sort_unstable();
        members.dedup();
        self.joined = members.chunk_by(|a, b| a.0 == b.0).map(|c| c.iter().map(|m| m.1).collect()).collect();
    }

    pub fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        if !self.pulling() {
            return;
        }
        let ramp = if self.ramp > 0.0 { (self.time / self.ramp).min(1.0) } else { 1.0 };
        let doublings = ((self.time - PATIENCE) / DOUBLING).clamp(0.0, MOST_DOUBLINGS);
        let growth = libm::exp2(doublings);
        // In the end c_s grows too, to five times: as far as the time step allows.
        let firmer = 1.0 + 4.0 * doublings / MOST_DOUBLINGS;
        for s in self.stitches.iter().filter(|s| s.open) {
            let [a, b] = s.ends.map(|v| v as usize);
            let d = x[b] - x[a];
            let l = d.norm();
            if l > 0.0 {
                let pull = d * (ramp * (firmer * s.stiffness * l).min(s.cap * growth) / l);
                f[a] += pull;
                f[b] -= pull;
            }
        }
    }

    /// Joined vertices share their velocity.
    pub fn share_velocity(&self, v: &mut [Vec3], inverse_mass: &[f64]) {
        for g in &self.joined {
            let mean = mean(g, v, inverse_mass);
            for i in g {
                v[*i as usize] = mean;
            }
        }
    }

    /// Joined vertices close what is left of their gap.
    pub fn zip(&self, x: &mut [Vec3], inverse_mass: &[f64]) {
        for g in &self.joined {
            let place = mean(g, x, inverse_mass);
            for i in g {
                let d = place - x[*i as usize];
                let l = d.norm_squared();
                if l <= SNAP * SNAP {
                    x[*i as usize] = place;
                } else {
                    x[*i as usize] += d * ZIP;
                }
            }
        }
    }

    /// Is no pair further apart than it should be?
    pub fn closed(&self, x: &[Vec3]) -> bool {
        self.stitches.iter().all(|s| (x[s.ends[0] as usize] - x[s.ends[1] as usize]).norm() <= self.distance)
    }
}

/// Mass-weighted mean of a group; a held member decides alone.
fn mean(group: &[u32], values: &[Vec3], inverse_mass: &[f64]) -> Vec3 {
    if let Some(held) = group.iter().find(|i| inverse_mass[**i as usize] == 0.0) {
        return values[*held as usize];
    }
    let (mut sum, mut mass) = (Vec3::zeros(), 0.0);
    for i in group {
        let m = 1.0 / inverse_mass[*i as usize];
        sum += values[*i as usize] * m;
        mass += m;
    }
    sum / mass
}
