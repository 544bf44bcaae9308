//! Pressed folds: E = ½ k L (θ − θ₀)² over every mesh edge of a fold line (docs/lines.md).
//!
//! θ is the angle by which the two triangles at the edge are folded back from flat. Its derivatives are those of Tamstorf
//! and Grinspun 2013 (Discrete bending forces and their Jacobians).

use crate::energy::{Energy, clique};
use crate::linear::hessian::Hessian;
use crate::scene::lines::FoldLine;
use crate::scene::topology::{Hinge, Topology};
use crate::{Scene, Vec3};
use nalgebra::Matrix3;

/// One mesh edge of a fold: ends 0 and 1 in the order of the triangle with corner 2, and the other corner 3.
struct Crease {
    vertices: [u32; 4],
    angle: f64,
    /// Moment per angle, N·m.
    stiffness: f64,
}

/// The creases of all fold lines.
pub(crate) struct Creases {
    creases: Vec<Crease>,
}

impl Creases {
    /// The fold lines of a scene.
    pub fn new(scene: &Scene, topology: &Topology) -> Self {
        let mut edges: Vec<([u32; 2], &FoldLine)> =
            scene.folds.iter().flat_map(|f| f.edges().map(move |e| (e, f))).collect();
        edges.sort_by_key(|e| e.0);
        edges.dedup_by_key(|e| e.0);
        let of = |hinges: &[Hinge]| {
            let [h] = hinges else { return None };
            let at = edges.binary_search_by_key(&h.edge(), |e| e.0).ok()?;
            Some(crease(scene, h, edges[at].1))
        };
        // The hinges of one edge follow each other. Where a fold is sewn down, the seam holds it, and there are several.
        let by_edge = topology.hinges.chunk_by(|p, q| p.edge() == q.edge());
        Self { creases: by_edge.filter_map(of).collect() }
    }
}

fn crease(scene: &Scene, h: &Hinge, fold: &FoldLine) -> Crease {
    let (face, side) = (&scene.triangles[h.faces[0] as usize], usize::from(h.sides[0]));
    let mut vertices = h.vertices;
    if face.vertices[side] != vertices[0] {
        vertices.swap(0, 1);
    }
    Crease { vertices, angle: fold.angle, stiffness: fold.stiffness * face.rest_length(side) }
}

/// The shape of a crease: its edge, the ways from end 0 to both corners, and their normals of the length of twice the area.
struct Fold {
    edge: Vec3,
    length: f64,
    to: [Vec3; 2],
    normals: [Vec3; 2],
}

impl Fold {
    fn new(c: &Crease, x: &[Vec3]) -> Self {
        let [a, b, p, q] = c.vertices.map(|v| x[v as usize]);
        let (edge, to) = (b - a, [p - a, q - a]);
        Self { edge, length: edge.norm(), to, normals: [edge.cross(&to[0]), to[1].cross(&edge)] }
    }

    /// Returns `true` where both triangles have an area.
    fn stands(&self) -> bool {
        let least = 1e-12 * self.length * self.length;
        self.normals.iter().all(|n| n.norm() > least)
    }

    fn angle(&self) -> f64 {
        let [n, m] = &self.normals;
        libm::atan2(n.cross(m).dot(&self.edge) / self.length, n.dot(m))
    }

    /// Share of the way along the edge at which the foot of a corner's altitude lies.
    fn foot(&self, side: usize) -> f64 {
        self.to[side].dot(&self.edge) / (self.length * self.length)
    }

    /// Gradient of the angle by the four vertices, 1/m.
    fn gradient(&self) -> [Vec3; 4] {
        let [p, q] = self.normals.map(|n| n * (-self.length / n.norm_squared()));
        let [s, t] = [self.foot(0), self.foot(1)];
        [-p * (1.0 - s) - q * (1.0 - t), -p * s - q * t, p, q]
    }

    /// Change of the gradient while the four vertices move by `d`.
    fn gradient_change(&self, d: &[Vec3; 4]) -> [Vec3; 4] {
        let (edge, to) = (d[1] - d[0], [d[2] - d[0], d[3] - d[0]]);
        let way = self.edge.dot(&edge) / self.length;
        let normals =
            [edge.cross(&self.to[0]) + self.edge.cross(&to[0]), to[1].cross(&self.edge) + self.to[1].cross(&edge)];
        let squared = self.length * self.length;
        let mut corner = [Vec3::zeros(); 2];
        let mut turned = [Vec3::zeros(); 2];
        let mut feet = [[0.0; 2]; 2];
        for k in 0..2 {
            let (n, size) = (&self.normals[k], self.normals[k].norm_squared());
            corner[k] = n * (-self.length / size);
            turned[k] = n * (-way / size) - (normals[k] - n * (2.0 * n.dot(&normals[k]) / size)) * (self.length / size);
            let foot = self.foot(k);
            let moved = (to[k].dot(&self.edge) + self.to[k].dot(&edge) - 2.0 * foot * self.edge.dot(&edge)) / squared;
            feet[k] = [foot, moved];
        }
        let start = |k: usize| corner[k] * feet[k][1] - turned[k] * (1.0 - feet[k][0]);
        let end = |k: usize| -corner[k] * feet[k][1] - turned[k] * feet[k][0];
        [start(0) + start(1), end(0) + end(1), turned[0], turned[1]]
    }
}

/// Angle of every mesh edge along a fold line of a scene at `x`, rad, and the edge's length at rest, m.
#[must_use]
pub fn fold_angles(scene: &Scene, fold: &FoldLine, x: &[Vec3]) -> Vec<[f64; 2]> {
    let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
    let alone = Scene { folds: vec![FoldLine { stiffness: 1.0, ..fold.clone() }], ..scene.clone() };
    Creases::new(&alone, &topology).creases.iter().map(|c| [Fold::new(c, x).angle(), c.stiffness]).collect()
}

impl Energy for Creases {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        for c in &self.creases {
            let fold = Fold::new(c, x);
            if fold.stands() {
                let moment = c.stiffness * (fold.angle() - c.angle);
                for (v, g) in c.vertices.iter().zip(fold.gradient()) {
                    f[*v as usize] -= g * moment;
                }
            }
        }
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        let of = |c: &Crease| {
            let fold = Fold::new(c, x);
            let open = if fold.stands() { fold.angle() - c.angle } else { 0.0 };
            0.5 * c.stiffness * open * open
        };
        self.creases.iter().map(of).sum()
    }

    fn add_stiffness(&self, x: &[Vec3], k: &mut [f64]) {
        for c in &self.creases {
            let g = Fold::new(c, x).gradient().map(|g| g.norm());
            let sum: f64 = g.iter().sum();
            for (v, g) in c.vertices.iter().zip(g) {
                k[*v as usize] += c.stiffness * g * sum;
            }
        }
    }

    fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        self.creases.iter().for_each(|c| clique(&c.vertices, pairs));
    }

    fn add_hessian(&self, x: &[Vec3], convex: bool, h: &mut Hessian) {
        for c in &self.creases {
            let fold = Fold::new(c, x);
            if !fold.stands() {
                continue;
            }
            let g = fold.gradient();
            let mut blocks = g.map(|a| g.map(|b| a * b.transpose() * c.stiffness));
            if !convex {
                add_curvature(&fold, c.stiffness * (fold.angle() - c.angle), &mut blocks);
            }
            for (i, row) in blocks.iter().enumerate() {
                h.add(c.vertices[i], &row[i]);
                for (j, block) in row[..i].iter().enumerate() {
                    h.couple(c.vertices[i], c.vertices[j], block);
                }
            }
        }
    }
}

/// Adds the second derivatives of the angle times a moment.
fn add_curvature(fold: &Fold, moment: f64, blocks: &mut [[Matrix3<f64>; 4]; 4]) {
    for j in 0..4 {
        for axis in 0..3 {
            let mut d = [Vec3::zeros(); 4];
            d[j][axis] = 1.0;
            for (i, change) in fold.gradient_change(&d).into_iter().enumerate() {
                let mut column = blocks[i][j].column_mut(axis);
                column += change * moment;
            }
        }
    }
}
