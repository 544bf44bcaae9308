//! The sewing force (equation 5 of the paper), linear in the gap of every open stitch.
//!
//! The force is capped so that pieces far apart do not fly. A pair that came close is joined: from then on both
//! vertices move as one (docs/sewing.md).

use crate::explicit::tuning::{
    JOINED_CLOSING_SHARE, JOINED_SNAP_DISTANCE, LAST_RESORT_DISTANCE, LAST_RESORT_JOINING, LAST_RESORT_TIME,
    SEWING_CAP_DELAY, SEWING_CAP_DOUBLING, SEWING_CAP_DOUBLINGS, SEWING_FORCE_GROWTH, SEWING_STIFFNESS_GROWTH,
};
use crate::scene::measures::mean_edge;
use crate::{Scene, Settings, Vec3};

/// A stitched pair of vertices.
struct Stitch {
    ends: [u32; 2],
    /// Coefficient c_s of equation 5, N/m.
    stiffness: f64,
    /// Largest force before growth, N.
    cap: f64,
    open: bool,
}

/// The sewing forces of a scene, and the groups of vertices that are joined.
pub(crate) struct SewingForces {
    stitches: Vec<Stitch>,
    /// Vertices joined so far, each group in ascending order.
    joined: Vec<Vec<u32>>,
    open: usize,
    vertex_count: usize,
    /// Distance at which a pair is joined, m.
    distance: f64,
    /// Distance at which a pair is joined once the force has grown to its most, m.
    last_distance: f64,
    /// Time over which the force grows to full, s.
    ramp: f64,
    pulls: bool,
    /// Time since sewing began, s.
    pub time: f64,
}

impl SewingForces {
    /// Makes the forces of a scene. Without `pulls`, pairs that are closed are only kept closed.
    ///
    /// `stiffness_rows`: row sums of the stiffness at the vertices, N/m; `inertia`: their inertia, kg.
    pub fn new(scene: &Scene, s: &Settings, stiffness_rows: &[f64], inertia: &[f64], pulls: bool) -> Self {
        let stitches: Vec<Stitch> = scene
            .stitches
            .iter()
            .filter(|p| p[0] != p[1])
            .map(|p| {
                let [a, b] = p.map(|v| v as usize);
                Stitch {
                    ends: *p,
                    stiffness: s.stitches.stiffness * stiffness_rows[a].min(stiffness_rows[b]),
                    cap: s.stitches.acceleration * inertia[a].min(inertia[b]),
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
            distance: s.stitches.closed_distance,
            last_distance: s.stitches.closed_distance.max(LAST_RESORT_DISTANCE.get() * mean_edge(scene)),
            ramp: s.stitches.ramp,
            pulls,
            time: 0.0,
        };
        sewing.join(&scene.positions);
        sewing
    }

    /// Number of stitches that are open.
    pub fn open(&self) -> usize {
        self.open
    }

    /// Returns `true` in the sewing phase.
    pub fn pulls(&self) -> bool {
        self.pulls
    }

    /// Returns `true` while a force acts: in the sewing phase with open stitches.
    pub fn is_pulling(&self) -> bool {
        self.pulls && self.open > 0
    }

    /// Returns `true` once the force has grown as far as it will.
    pub fn is_fully_grown(&self) -> bool {
        self.time > SEWING_CAP_DELAY.get() + SEWING_CAP_DOUBLING.get() * SEWING_CAP_DOUBLINGS.get()
    }

    /// Returns `true` once the grown force has had its time without closing everything.
    pub fn is_hopeless(&self) -> bool {
        let grown = SEWING_CAP_DELAY.get() + SEWING_CAP_DOUBLING.get() * SEWING_CAP_DOUBLINGS.get();
        self.time > grown + LAST_RESORT_TIME.get()
    }

    /// Joins pairs that came near.
    pub fn join(&mut self, x: &[Vec3]) {
        if self.open == 0 {
            return;
        }
        let mut changed = false;
        let last = self.is_fully_grown() && LAST_RESORT_JOINING.is_on();
        let distance = if last { self.last_distance } else { self.distance };
        for s in self.stitches.iter_mut().filter(|s| s.open) {
            if (x[s.ends[0] as usize] - x[s.ends[1] as usize]).norm() <= distance {
                s.open = false;
                self.open -= 1;
                changed = true;
            }
        }
        if changed {
            self.regroup();
        }
    }

    /// Makes the groups of joined vertices anew from the closed stitches.
    fn regroup(&mut self) {
        let closed: Vec<[u32; 2]> = self.stitches.iter().filter(|s| !s.open).map(|s| s.ends).collect();
        let root = crate::scene::weld::groups(self.vertex_count, &closed);
        let mut members: Vec<(u32, u32)> = closed.iter().flatten().map(|v| (root[*v as usize], *v)).collect();
        members.sort_unstable();
        members.dedup();
        self.joined = members.chunk_by(|a, b| a.0 == b.0).map(|c| c.iter().map(|m| m.1).collect()).collect();
    }

    /// Adds the sewing forces at `x` to `f`, N (equation 5).
    pub fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        if !self.is_pulling() {
            return;
        }
        let ramp = if self.ramp > 0.0 { (self.time / self.ramp).min(1.0) } else { 1.0 };
        let most = SEWING_CAP_DOUBLINGS.get();
        let elapsed = ((self.time - SEWING_CAP_DELAY.get()) / SEWING_CAP_DOUBLING.get()).clamp(0.0, most);
        let doublings = if SEWING_FORCE_GROWTH.is_on() { elapsed } else { 0.0 };
        let growth = libm::exp2(doublings);
        let stiffening = 1.0 + SEWING_STIFFNESS_GROWTH.get() * doublings / most;
        for s in self.stitches.iter().filter(|s| s.open) {
            let [a, b] = s.ends.map(|v| v as usize);
            let d = x[b] - x[a];
            let l = d.norm();
            if l > 0.0 {
                let pull = d * (ramp * (stiffening * s.stiffness * l).min(s.cap * growth) / l);
                f[a] += pull;
                f[b] -= pull;
            }
        }
    }

    /// Gives joined vertices one velocity: their mass-weighted mean.
    pub fn share_velocity(&self, v: &mut [Vec3], inverse_mass: &[f64]) {
        for g in &self.joined {
            let mean = mean(g, v, inverse_mass);
            for i in g {
                v[*i as usize] = mean;
            }
        }
    }

    /// Moves joined vertices towards one point by a share of what is left of their gap.
    pub fn close_joined(&self, x: &mut [Vec3], inverse_mass: &[f64]) {
        let (share, snap) = (JOINED_CLOSING_SHARE.get(), JOINED_SNAP_DISTANCE.get());
        for g in &self.joined {
            let place = mean(g, x, inverse_mass);
            for i in g {
                let d = place - x[*i as usize];
                let l = d.norm_squared();
                if l <= snap * snap {
                    x[*i as usize] = place;
                } else {
                    x[*i as usize] += d * share;
                }
            }
        }
    }

    /// Returns `true` if no pair is further apart than the sewing distance (stop condition a of the paper).
    pub fn is_closed(&self, x: &[Vec3]) -> bool {
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
