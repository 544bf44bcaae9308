//! Stitch penalty: the sewing force of equation 5 of the paper as an energy, with a cap.
//!
//! The pull of a stitch is linear inside a small reach and constant beyond, so that pieces far apart are not torn
//! together.

use crate::linear::hessian::Hessian;
use crate::scene::measures::mean_edge;
use crate::{Scene, Vec3};
use nalgebra::Matrix3;

/// The second end of a thread.
#[derive(Clone, Copy)]
enum End {
    Vertex(u32),
    Place(Vec3),
}

/// A thread from a vertex.
struct Thread {
    vertex: u32,
    to: End,
    /// Length of seam it stands for, m.
    length: f64,
}

impl Thread {
    #[inline]
    fn gap(&self, x: &[Vec3]) -> Vec3 {
        let end = match self.to {
            End::Vertex(v) => x[v as usize],
            End::Place(p) => p,
        };
        end - x[self.vertex as usize]
    }
}

/// The threads of all stitches.
pub(crate) struct Seams {
    threads: Vec<Thread>,
    /// Pull per length of seam, N/m.
    pub force: f64,
    /// Gap at which the full pull acts, m.
    pub reach: f64,
}

impl Seams {
    /// Threads of all stitches, and of `drawn` vertices to the places where they will be held.
    pub fn new(scene: &Scene, drawn: &[(u32, Vec3)]) -> Self {
        let edge = mean_edge(scene);
        let sewn = scene.stitches.iter().filter(|s| s[0] != s[1]).map(|s| (s[0], End::Vertex(s[1])));
        let held = drawn.iter().map(|(v, at)| (*v, End::Place(*at)));
        let threads = sewn.chain(held).map(|(vertex, to)| Thread { vertex, to, length: edge }).collect();
        Self { threads, force: 0.0, reach: 1e-3 }
    }

    pub fn is_empty(&self) -> bool {
        self.threads.is_empty()
    }

    pub fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        for t in &self.threads {
            if let End::Vertex(v) = t.to {
                pairs.push([t.vertex, v]);
            }
        }
    }

    /// Both ends of all threads, each mapped as a vertex or as a place.
    pub fn ends<T>(&self, vertex: impl Fn(u32) -> T, place: impl Fn(Vec3) -> T) -> Vec<[T; 2]> {
        let to = |end| match end {
            End::Vertex(v) => vertex(v),
            End::Place(p) => place(p),
        };
        self.threads.iter().map(|t| [vertex(t.vertex), to(t.to)]).collect()
    }

    /// Adds the forces at `x`, N, and returns the energy, J.
    pub fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut energy = 0.0;
        for t in &self.threads {
            let d = t.gap(x);
            let (l, most) = (d.norm(), self.force * t.length);
            let pull = if l <= self.reach {
                energy += 0.5 * most / self.reach * l * l;
                d * (most / self.reach)
            } else {
                energy += most * (l - 0.5 * self.reach);
                d * (most / l)
            };
            f[t.vertex as usize] += pull;
            if let End::Vertex(v) = t.to {
                f[v as usize] -= pull;
            }
        }
        energy
    }

    /// Adds the second derivatives, N/m.
    pub fn add_hessian(&self, x: &[Vec3], h: &mut Hessian) {
        for t in &self.threads {
            let d = t.gap(x);
            let (l, most) = (d.norm(), self.force * t.length);
            let block = if l <= self.reach {
                Matrix3::identity() * (most / self.reach)
            } else {
                (Matrix3::identity() - d * d.transpose() / (l * l)) * (most / l)
            };
            match t.to {
                End::Vertex(v) => h.spread(&[t.vertex, v], &[1.0, -1.0], &block),
                End::Place(_) => h.add(t.vertex, &block),
            }
        }
    }

    /// Largest gap, m.
    pub fn widest(&self, x: &[Vec3]) -> f64 {
        self.threads.iter().map(|t| t.gap(x).norm()).fold(0.0, f64::max)
    }
}
