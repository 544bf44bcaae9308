//! Coulomb friction for descents: every contact holds its place by a tangential spring until the spring force reaches
//! μ times the normal force, then slides with that force (docs/static.md). Normal force, normal and place are those
//! of the last refresh; what slid is taken over into the new place, so real stick stays and nothing creeps.

use crate::Vec3;
use crate::collision::narrow_phase::pair_kind::PairKey;
use crate::contact::barrier::Touch;
use crate::linear::hessian::{FIXED, Hessian};
use nalgebra::Matrix3;

/// Contacts give way along the body by no more than this share of their gap before they slide.
const REACH: f64 = 0.03;

/// Share of what a contact slid that a refresh takes over: steps on the way overshoot, and what is taken over stays. The pull is
/// the same.
const TAKEN: f64 = 0.5;

/// Rounds in which the loads of a start in balance are shared out, at most, and the change over the largest limit that ends
/// them.
const SWEEPS: usize = 2000;
const SHARED: f64 = 1e-5;

#[derive(Clone)]
struct Hold {
    vertices: [u32; 4],
    weights: [f64; 4],
    normal: Vec3,
    /// Value of Σ w x at which the spring is free.
    place: Vec3,
    /// N/m.
    stiffness: f64,
    /// Largest force, N.
    most: f64,
    key: PairKey,
}

/// All contacts that rub.
#[derive(Clone, Default)]
pub(crate) struct Stick {
    holds: Vec<Hold>,
    /// Holds that slid, and the largest slide, m, at the last refresh.
    pub slid: usize,
    pub largest: f64,
    pub most: usize,
}

impl Hold {
    fn new(t: &Touch, press: f64) -> Self {
        let most = t.friction * t.load;
        Self {
            vertices: t.vertices,
            weights: t.weights,
            normal: t.normal,
            place: Vec3::zeros(),
            stiffness: (press * t.area).max(most / (REACH * t.gap)),
            most,
            key: t.key,
        }
    }

    #[inline]
    fn at(&self, x: &[Vec3]) -> Vec3 {
        let mut p = Vec3::zeros();
        for k in 0..4 {
            if self.weights[k] != 0.0 {
                p += x[self.vertices[k] as usize] * self.weights[k];
            }
        }
        p
    }

    /// Its vertices that are not held otherwise, and their weights.
    fn free<'a>(&'a self, unknown: &'a [u32]) -> impl Iterator<Item = (usize, f64)> + 'a {
        let all = self.vertices.iter().map(|v| *v as usize).zip(self.weights);
        all.filter(|(v, w)| *w != 0.0 && unknown[*v] != FIXED)
    }

    /// The pull within its limit that, in place of `pull`, leaves least of the forces on its vertices.
    fn bears(&self, pull: Vec3, forces: &[Vec3], unknown: &[u32]) -> Vec3 {
        let add = |(r, ww): (Vec3, f64), (v, w): (usize, f64)| (r + forces[v] * w, ww + w * w);
        let (r, ww) = self.free(unknown).fold((Vec3::zeros(), 0.0), add);
        if ww <= 0.0 {
            return pull;
        }
        (pull - (r - self.normal * self.normal.dot(&r)) / ww).cap_magnitude(self.most)
    }

    /// Tangential elongation of the spring.
    #[inline]
    fn slide(&self, x: &[Vec3]) -> Vec3 {
        let d = self.at(x) - self.place;
        d - self.normal * self.normal.dot(&d)
    }
}

/// Does a contact rub?
fn rubs(t: &Touch) -> bool {
    t.friction > 0.0 && t.load > 0.0
}

impl Stick {
    /// Would a refresh from these contacts hold anything?
    pub fn would_hold(touches: &[Touch]) -> bool {
        touches.iter().any(rubs)
    }

    /// New normal forces and places from the contacts at `x`, whose own stiffness is `press` (N/m³) over their area.
    pub fn refresh(&mut self, x: &[Vec3], touches: &[Touch], press: f64) {
        let mut holds: Vec<Hold> = touches.iter().filter(|t| rubs(t)).map(|t| Hold::new(t, press)).collect();
        holds.sort_by_key(|h| h.key);
        (self.slid, self.largest) = (0, 0.0);
        let mut old = self.holds.iter().peekable();
        for h in &mut holds {
            while old.next_if(|o| o.key < h.key).is_some() {}
            let mut slide = old.next_if(|o| o.key == h.key).map_or_else(Vec3::zeros, |o| o.slide(x));
            slide -= h.normal * h.normal.dot(&slide);
            let (l, reach) = (slide.norm(), h.most / h.stiffness);
            if l > reach {
                self.slid += 1;
                self.largest = self.largest.max(l - reach);
                slide *= (l + TAKEN * (reach - l)) / l;
            }
            h.place = h.at(x) - slide;
        }
        self.most = self.most.max(holds.len());
        self.holds = holds;
    }

    /// Strains the holds until their pulls, none over its limit, leave as little as they can of these forces on all vertices
    /// (projected Gauss–Seidel on the balance).
    pub fn take_up(&mut self, mut forces: Vec<Vec3>, unknown: &[u32]) {
        let mut pulls = vec![Vec3::zeros(); self.holds.len()];
        let near = SHARED * self.holds.iter().map(|h| h.most).fold(0.0, f64::max);
        for _ in 0..SWEEPS {
            let mut largest: f64 = 0.0;
            for (h, pull) in self.holds.iter().zip(&mut pulls) {
                let new = h.bears(*pull, &forces, unknown);
                largest = largest.max((new - *pull).norm());
                h.free(unknown).for_each(|(v, w)| forces[v] += (new - *pull) * w);
                *pull = new;
            }
            if largest <= near {
                break;
            }
        }
        self.holds.iter_mut().zip(&pulls).for_each(|(h, pull)| h.place += pull / h.stiffness);
    }

    /// The body moved: what holds to it is held elsewhere now; `shift` tells by how much for each pair.
    pub fn carry(&mut self, shift: impl Fn(&PairKey) -> Vec3) {
        self.holds.iter_mut().for_each(|h| h.place += shift(&h.key));
    }

    /// Energy, J; adds the forces.
    pub fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut energy = 0.0;
        for h in &self.holds {
            let u = h.slide(x);
            let l = u.norm();
            let reach = h.most / h.stiffness;
            let force = if l <= reach {
                energy += 0.5 * h.stiffness * l * l;
                u * h.stiffness
            } else {
                energy += h.most * (l - 0.5 * reach);
                u * (h.most / l)
            };
            for k in 0..4 {
                if h.weights[k] != 0.0 {
                    f[h.vertices[k] as usize] -= force * h.weights[k];
                }
            }
        }
        energy
    }

    /// Adds the second derivatives at `x`.
    pub fn add_hessian(&self, x: &[Vec3], h: &mut Hessian) {
        for c in &self.holds {
            let plane = Matrix3::identity() - c.normal * c.normal.transpose();
            let u = c.slide(x);
            let l = u.norm();
            let block = if l * c.stiffness <= c.most {
                plane * c.stiffness
            } else {
                (plane - u * u.transpose() / (l * l)) * (c.most / l)
            };
            h.spread(&c.vertices, &c.weights, &block);
        }
    }
}
