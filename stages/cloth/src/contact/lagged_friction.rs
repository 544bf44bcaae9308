//! Coulomb friction for descents: every contact holds its place by a tangential spring until the spring force reaches
//! μ times the normal force, then slides with that force (docs/contact.md). Normal force, normal and place are those
//! of the last refresh; what slid is taken over into the new place, so real stick stays and nothing creeps.

use crate::Vec3;
use crate::collision::narrow_phase::pair_kind::PairKey;
use crate::contact::barrier::active_contact::ActiveContact;
use crate::contact::tuning::{
    FRICTION_BALANCE_SWEEPS, FRICTION_BALANCE_TOLERANCE, FRICTION_WARM_START, SLIP_SHARE_PER_REFRESH, STICK_REACH,
};
use crate::linear::hessian::{FIXED, Hessian};
use nalgebra::Matrix3;

/// The tangential spring of one contact.
#[derive(Clone)]
struct TangentialSpring {
    vertices: [u32; 4],
    weights: [f64; 4],
    normal: Vec3,
    /// Value of Σ w x at which the spring is free, m.
    anchor: Vec3,
    /// Stiffness, N/m.
    stiffness: f64,
    /// Largest force, N: the coefficient of friction times the normal force.
    limit: f64,
    key: PairKey,
}

/// The friction of all contacts.
#[derive(Clone, Default)]
pub(crate) struct LaggedFriction {
    springs: Vec<TangentialSpring>,
    /// Number of contacts that slid before the last refresh.
    pub sliding: usize,
    /// Largest slip at the last refresh, m.
    pub largest_slip: f64,
    /// Largest number of contacts with friction so far.
    pub most_contacts: usize,
}

impl TangentialSpring {
    fn new(contact: &ActiveContact, contact_stiffness: f64) -> Self {
        let limit = contact.friction * contact.normal_force;
        let reach = STICK_REACH.get() * contact.activation_distance;
        Self {
            vertices: contact.vertices,
            weights: contact.weights,
            normal: contact.normal,
            anchor: Vec3::zeros(),
            stiffness: (contact_stiffness * contact.area).max(limit / reach),
            limit,
            key: contact.key,
        }
    }

    /// The value of Σ w x.
    #[inline]
    fn position(&self, x: &[Vec3]) -> Vec3 {
        let mut p = Vec3::zeros();
        for k in 0..4 {
            if self.weights[k] != 0.0 {
                p += x[self.vertices[k] as usize] * self.weights[k];
            }
        }
        p
    }

    /// Vertices of the spring that are unknowns, and their weights.
    fn unknown_vertices<'a>(&'a self, unknown: &'a [u32]) -> impl Iterator<Item = (usize, f64)> + 'a {
        let all = self.vertices.iter().map(|v| *v as usize).zip(self.weights);
        all.filter(|(v, w)| *w != 0.0 && unknown[*v] != FIXED)
    }

    /// The force within the limit that, in place of `force`, leaves the least net force on the vertices of the
    /// spring.
    fn balancing_force(&self, force: Vec3, net_forces: &[Vec3], unknown: &[u32]) -> Vec3 {
        let add = |(r, ww): (Vec3, f64), (v, w): (usize, f64)| (r + net_forces[v] * w, ww + w * w);
        let (r, ww) = self.unknown_vertices(unknown).fold((Vec3::zeros(), 0.0), add);
        if ww <= 0.0 {
            return force;
        }
        (force - (r - self.normal * self.normal.dot(&r)) / ww).cap_magnitude(self.limit)
    }

    /// Tangential elongation of the spring, m.
    #[inline]
    fn elongation(&self, x: &[Vec3]) -> Vec3 {
        let d = self.position(x) - self.anchor;
        d - self.normal * self.normal.dot(&d)
    }
}

fn has_friction(contact: &ActiveContact) -> bool {
    contact.friction > 0.0 && contact.normal_force > 0.0
}

impl LaggedFriction {
    /// Would a refresh from these contacts give any friction?
    pub fn is_caused_by(contacts: &[ActiveContact]) -> bool {
        contacts.iter().any(has_friction)
    }

    /// Takes new normal forces and anchors from the contacts at `x`. `stiffness` is that of contacts over area, N/m³.
    pub fn refresh(&mut self, x: &[Vec3], contacts: &[ActiveContact], stiffness: f64) {
        let rubbing = contacts.iter().filter(|t| has_friction(t));
        let mut springs: Vec<TangentialSpring> = rubbing.map(|t| TangentialSpring::new(t, stiffness)).collect();
        springs.sort_by_key(|h| h.key);
        (self.sliding, self.largest_slip) = (0, 0.0);
        let share = SLIP_SHARE_PER_REFRESH.get();
        let mut old = self.springs.iter().peekable();
        for h in &mut springs {
            while old.next_if(|o| o.key < h.key).is_some() {}
            let mut elongation = old.next_if(|o| o.key == h.key).map_or_else(Vec3::zeros, |o| o.elongation(x));
            elongation -= h.normal * h.normal.dot(&elongation);
            let (l, reach) = (elongation.norm(), h.limit / h.stiffness);
            if l > reach {
                self.sliding += 1;
                self.largest_slip = self.largest_slip.max(l - reach);
                elongation *= (l + share * (reach - l)) / l;
            }
            h.anchor = h.position(x) - elongation;
        }
        self.most_contacts = self.most_contacts.max(springs.len());
        self.springs = springs;
    }

    /// Strains the springs so that they balance these forces on all vertices as far as their limits allow.
    ///
    /// The method is projected Gauss–Seidel on the balance of forces.
    pub fn balance(&mut self, mut forces: Vec<Vec3>, unknown: &[u32]) {
        if !FRICTION_WARM_START.is_on() {
            return;
        }
        let mut spring_forces = vec![Vec3::zeros(); self.springs.len()];
        let largest_limit = self.springs.iter().map(|h| h.limit).fold(0.0, f64::max);
        let tolerance = FRICTION_BALANCE_TOLERANCE.get() * largest_limit;
        for _ in 0..FRICTION_BALANCE_SWEEPS.get() {
            let mut largest_change: f64 = 0.0;
            for (h, force) in self.springs.iter().zip(&mut spring_forces) {
                let new = h.balancing_force(*force, &forces, unknown);
                largest_change = largest_change.max((new - *force).norm());
                h.unknown_vertices(unknown).for_each(|(v, w)| forces[v] += (new - *force) * w);
                *force = new;
            }
            if largest_change <= tolerance {
                break;
            }
        }
        self.springs.iter_mut().zip(&spring_forces).for_each(|(h, force)| h.anchor += force / h.stiffness);
    }

    /// Moves the anchors after the body has moved; `shift` gives the displacement of each pair, m.
    pub fn move_anchors(&mut self, shift: impl Fn(&PairKey) -> Vec3) {
        self.springs.iter_mut().for_each(|h| h.anchor += shift(&h.key));
    }

    /// Adds the forces to `f`, N, and returns the energy, J.
    pub fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut energy = 0.0;
        for h in &self.springs {
            let u = h.elongation(x);
            let l = u.norm();
            let reach = h.limit / h.stiffness;
            let force = if l <= reach {
                energy += 0.5 * h.stiffness * l * l;
                u * h.stiffness
            } else {
                energy += h.limit * (l - 0.5 * reach);
                u * (h.limit / l)
            };
            for k in 0..4 {
                if h.weights[k] != 0.0 {
                    f[h.vertices[k] as usize] -= force * h.weights[k];
                }
            }
        }
        energy
    }

    /// Adds the second derivatives at `x`, N/m.
    pub fn add_hessian(&self, x: &[Vec3], hessian: &mut Hessian) {
        for c in &self.springs {
            let plane = Matrix3::identity() - c.normal * c.normal.transpose();
            let u = c.elongation(x);
            let l = u.norm();
            let block = if l * c.stiffness <= c.limit {
                plane * c.stiffness
            } else {
                (plane - u * u.transpose() / (l * l)) * (c.limit / l)
            };
            hessian.spread(&c.vertices, &c.weights, &block);
        }
    }
}
