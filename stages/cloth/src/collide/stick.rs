//! Coulomb friction for descents: every contact holds its place by a tangential spring until the spring force reaches
//! μ times the normal force, then slides with that force (docs/static.md). Normal force, normal and place are those
//! of the last refresh; what slid is taken over into the new place, so real stick stays and nothing creeps.

use super::barrier::{BODY_POINT, Touch};
use crate::Vec3;
use crate::linear::hessian::Hessian;
use nalgebra::Matrix3;

/// Contacts give way along the body by no more than this share of their gap before they slide.
const REACH: f64 = 0.03;

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
    key: (u8, [u32; 4]),
}

/// All contacts that rub.
#[derive(Default)]
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

    /// Tangential elongation of the spring.
    #[inline]
    fn slide(&self, x: &[Vec3]) -> Vec3 {
        let d = self.at(x) - self.place;
        d - self.normal * self.normal.dot(&d)
    }
}

impl Stick {
    /// New normal forces and places from the contacts at `x`, whose own stiffness is `press` (N/m³) over their area.
    pub fn refresh(&mut self, x: &[Vec3], touches: &[Touch], press: f64) {
        let mut holds: Vec<Hold> =
            touches.iter().filter(|t| t.friction > 0.0 && t.load > 0.0).map(|t| Hold::new(t, press)).collect();
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
                slide *= reach / l;
            }
            h.place = h.at(x) - slide;
        }
        self.most = self.most.max(holds.len());
        self.holds = holds;
    }

    /// Strains the holds of vertices on the body until each pulls with the force given, N; vertices ascending.
    pub fn take_up(&mut self, pulls: &[(u32, Vec3)]) {
        for h in self.holds.iter_mut().filter(|h| h.key.0 == BODY_POINT) {
            if let Ok(i) = pulls.binary_search_by_key(&h.vertices[0], |p| p.0) {
                h.place += pulls[i].1 / h.stiffness;
            }
        }
    }

    /// The body moved: what holds to it is held elsewhere now; `shift` tells by how much for each pair.
    pub fn carry(&mut self, shift: impl Fn(&(u8, [u32; 4])) -> Vec3) {
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
