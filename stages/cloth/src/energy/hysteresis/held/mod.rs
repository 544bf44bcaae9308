//! Frictional springs of bent cloth, with return mapping.

#[cfg(test)]
pub(crate) mod tests;

use crate::energy::bending::{Patch, patches};
use crate::energy::tuning::FRICTION_BUILD_UP;
use crate::linear::hessian::Hessian;
use crate::scene::topology::Topology;
use crate::{Material, Scene, Vec3};
use nalgebra::Vector3;

/// The frictional spring of one direction of one triangle. Its coordinate is s = n · Σ row x = √A κ.
#[derive(Clone)]
struct Hold {
    vertices: [u32; 6],
    row: [f64; 6],
    /// Unit normal of the triangle at the last refresh.
    normal: Vec3,
    /// Value of s at which the spring is free.
    place: f64,
    /// Largest friction √A HB, J.
    most: f64,
    /// Change of s over which the largest friction is reached.
    reach: f64,
    /// Square root √A of the area, m.
    size: f64,
}

/// All triangles whose fabric has friction in bending.
#[derive(Clone)]
pub(crate) struct Hysteresis {
    holds: Vec<Hold>,
    slip: usize,
    largest: f64,
}

/// Returns `true` for a fabric with friction in bending.
fn rubs(m: &Material) -> bool {
    m.bend_friction_share() > 0.0
}

impl Hold {
    fn new(patch: &Patch, row: usize, area: f64, m: &Material) -> Self {
        let size = area.sqrt();
        Self {
            vertices: patch.vertices,
            row: patch.rows[row],
            normal: Vec3::zeros(),
            place: 0.0,
            most: size * m.bending.friction,
            reach: size * FRICTION_BUILD_UP.get() / m.bending_length(),
            size,
        }
    }

    #[inline]
    fn at(&self, x: &[Vec3]) -> f64 {
        let bend: Vec3 = self.vertices.iter().zip(self.row).map(|(v, w)| x[*v as usize] * w).sum();
        self.normal.dot(&bend)
    }

    /// Takes the normal at `x` and moves the free place to within reach. Returns the slide as a height over the
    /// triangle, m.
    fn refresh(&mut self, x: &[Vec3]) -> f64 {
        let corners = [0, 1, 2].map(|k| x[self.vertices[k] as usize]);
        self.normal = crate::unit_normal(corners).unwrap_or_else(Vec3::zeros);
        let s = self.at(x);
        let held = self.place.clamp(s - self.reach, s + self.reach);
        let slip = (held - self.place).abs();
        self.place = held;
        0.5 * slip * self.size
    }
}

impl Hysteresis {
    /// `None` where no fabric has friction in bending.
    pub fn new(scene: &Scene, topology: &Topology) -> Option<Self> {
        if !scene.materials.iter().any(rubs) {
            return None;
        }
        // Rows of √A κ: rigidities of 1 along weft and warp. Yarns hardly rub where the cloth is twisted along them.
        let even = vec![Vector3::new(1.0, 1.0, 0.0); scene.materials.len()];
        let mut holds = Vec::new();
        for (face, patch) in patches(scene, topology, &even) {
            let e = &scene.triangles[face];
            let m = &scene.materials[e.material as usize];
            let used = (0..3).filter(|r| rubs(m) && patch.rows[*r].iter().any(|w| *w != 0.0));
            holds.extend(used.map(|r| Hold::new(&patch, r, e.area().abs(), m)));
        }
        Some(Self { holds, slip: 0, largest: 0.0 })
    }

    /// Number of springs that slid at the last refresh.
    pub fn slip(&self) -> usize {
        self.slip
    }

    /// Largest slide at the last refresh as a height over the triangle, m.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// Number of springs.
    pub fn len(&self) -> usize {
        self.holds.len()
    }

    /// Lets all springs slide to `x`.
    pub fn refresh(&mut self, x: &[Vec3]) {
        (self.slip, self.largest) = (0, 0.0);
        for h in &mut self.holds {
            let slip = h.refresh(x);
            self.slip += usize::from(slip > 0.0);
            self.largest = self.largest.max(slip);
        }
    }

    /// Adds the forces at `x`, N, and returns the energy, J.
    pub fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut energy = 0.0;
        for h in &self.holds {
            let u = h.at(x) - h.place;
            let moment = if u.abs() <= h.reach {
                energy += 0.5 * h.most / h.reach * u * u;
                h.most / h.reach * u
            } else {
                energy += h.most * (u.abs() - 0.5 * h.reach);
                h.most.copysign(u)
            };
            let pull = h.normal * moment;
            for (v, w) in h.vertices.iter().zip(h.row) {
                f[*v as usize] -= pull * w;
            }
        }
        energy
    }

    /// Adds the second derivatives at `x`: none where the friction is at its largest.
    pub fn add_hessian(&self, x: &[Vec3], hessian: &mut Hessian) {
        for h in self.holds.iter().filter(|h| (h.at(x) - h.place).abs() <= h.reach) {
            let block = h.normal * h.normal.transpose() * (h.most / h.reach);
            for i in 0..6 {
                hessian.add(h.vertices[i], &(block * (h.row[i] * h.row[i])));
                for j in (0..i).filter(|j| h.row[i] * h.row[*j] != 0.0) {
                    hessian.couple(h.vertices[i], h.vertices[j], &(block * (h.row[i] * h.row[j])));
                }
            }
        }
    }
}
