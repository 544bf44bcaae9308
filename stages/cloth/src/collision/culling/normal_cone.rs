//! Culling of self-contact by normal cones.
//!
//! Where all triangles around a vertex have nearly the same normal along a step, no two of them can come near each
//! other. This is the curvature test of Volino and Magnenat-Thalmann (1994), along a whole step. Nearly all pairs
//! that a tree of boxes finds are such neighbours.

use crate::collision::broad_phase::packed_lists::{PackedLists, faces_at_vertices, untagged};
use crate::collision::broad_phase::swept_box::rounded;
use crate::collision::tuning::{
    NORMAL_CONE_BORDER_ANGLE, NORMAL_CONE_COSINE, NORMAL_CONE_CULLING, NORMAL_CONE_INNER_ANGLE,
};
use crate::scene::topology::Topology;
use crate::{Element, Vec3};

/// Bit of a pair of neighbours: the second has the first corner of the first as a corner too. The bits of the other
/// corners follow.
const AT_CORNER: u8 = 0b1;
/// Bit of a pair of neighbours: the second is at a neighbour of the first corner of the first.
const AROUND_CORNER: u8 = 0b1000;

/// Area-weighted normals of a triangle that bound those along a step: at its beginning, mixed, and at its end.
type Normals = [Vec3; 3];

/// Positions and moves of the corners of the triangles.
struct CornerMoves<'a> {
    x: &'a [Vec3],
    step: &'a [Vec3],
    faces: &'a [[u32; 3]],
}

impl CornerMoves<'_> {
    #[inline]
    fn normals(&self, f: u32) -> Normals {
        let t = &self.faces[f as usize];
        let ([a, b, c], [p, q, r]) = (crate::pick3(self.x, t), crate::pick3(self.step, t));
        let (e, f) = (b - a, c - a);
        let (g, h) = (e + (q - p), f + (r - p));
        [e.cross(&f), (e.cross(&h) + g.cross(&f)) * 0.5, g.cross(&h)]
    }
}

/// A direction and one more number, in single precision. It suffices for most of the cloth, which is smooth.
type RoundedNormal = [f32; 4];

/// Bound of the rounding in single precision, of numbers of 1 or less.
const ROUNDING_OF_NORMALS: f32 = 1e-5;

#[inline]
fn rounded_normal(n: &Vec3, last: f64) -> RoundedNormal {
    // A direction counts only beyond the rounding.
    let [x, y, z, _] = rounded(n);
    #[allow(clippy::cast_possible_truncation)]
    [x, y, z, last as f32]
}

#[inline]
fn dot(a: &RoundedNormal, b: &RoundedNormal) -> f32 {
    (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])
}

/// The direction of the first of a triangle's normals, and the least component along a mean with which all three have
/// enough. Normals differ little in most steps.
#[inline]
fn first_normal([n, m, o]: &Normals, double_area: f64) -> RoundedNormal {
    let (length, off) = (n.norm_squared().sqrt(), larger((m - n).norm_squared(), (o - n).norm_squared()).sqrt());
    if length <= 0.0 {
        return [0.0, 0.0, 0.0, f32::INFINITY];
    }
    let one = 1.0 / length;
    rounded_normal(&(n * one), (NORMAL_CONE_COSINE.get() * larger(length + off, double_area) + off) * one)
}

#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Does a normal have enough of its length along a mean? `double_area` is twice the rest area of the triangle, m².
#[inline]
fn is_along(n: &Vec3, mean: &Vec3, double_area: f64) -> bool {
    let along = n.dot(mean);
    let cosine = NORMAL_CONE_COSINE.get();
    along >= 0.0 && along * along >= cosine * cosine * larger(n.norm_squared(), double_area * double_area)
}

/// Normal cones of the patches around the vertices.
#[derive(Debug)]
pub(crate) struct NormalCones {
    /// The triangles at each vertex.
    faces_at: PackedLists,
    /// The neighbours of each vertex.
    neighbours: PackedLists,
    /// For each triangle, the near triangles with higher numbers: those at one of its corners ([`AT_CORNER`]) or at a
    /// neighbour of one ([`AROUND_CORNER`]).
    near: PackedLists,
    /// Twice the rest area of each triangle, m².
    double_area: Vec<f64>,
    /// Can the patch at a vertex be smooth at all?
    may_be_smooth: Vec<bool>,
    /// Can the patch at a vertex and the patches at its neighbours be smooth at all?
    may_be_smooth_around: Vec<bool>,
    /// First normal of each triangle, with the least component that it must have along a mean.
    first_normals: Vec<RoundedNormal>,
    /// Contribution of the normals of each triangle to a mean.
    sums: Vec<RoundedNormal>,
    /// The mean of the normals at each vertex, and −1.
    means: Vec<RoundedNormal>,
    /// How far another mean may be from the mean at each vertex with all its triangles still along it.
    margins: Vec<f32>,
    /// Vertices whose triangles have nearly the same normal along the last motion.
    smooth_at: Vec<bool>,
    /// Vertices at which, and at whose neighbours, the triangles have nearly the same normal along the last motion.
    smooth_around: Vec<bool>,
}

impl NormalCones {
    /// Prepares the test for `n` vertices.
    pub fn new(cloth: &[Element], n: usize, topology: &Topology) -> Self {
        let faces = &topology.faces;
        let faces_at = faces_at_vertices(n, faces);
        let around = |v: u32| faces_at.of(v).iter().flat_map(|f| faces[*f as usize]);
        let neighbours = PackedLists::new(n, n, |v, add| around(v).filter(|w| *w != v).for_each(add));
        let faces_around =
            PackedLists::new(n, faces.len(), |v, add| faces_around(&faces_at, &neighbours, v).copied().for_each(add));
        let near = PackedLists::tagged(faces.len(), faces.len(), |f, add| {
            for (k, v) in faces[f as usize].iter().enumerate() {
                faces_at.of(*v).iter().filter(|g| **g > f).for_each(|g| add(*g, AT_CORNER << k));
                faces_around.of(*v).iter().filter(|g| **g > f).for_each(|g| add(*g, AROUND_CORNER << k));
            }
        });
        let may_be_smooth = may_be_smooth(cloth, topology, &faces_at, &neighbours);
        let double_area = cloth.iter().map(|t| 2.0 * t.area().abs()).collect();
        let may_be_smooth_around = (0u32..)
            .zip(&may_be_smooth)
            .map(|(v, a)| *a && neighbours.of(v).iter().all(|w| may_be_smooth[*w as usize]))
            .collect();
        let [first_normals, sums] = [(); 2].map(|()| vec![RoundedNormal::default(); topology.faces.len()]);
        let (means, margins) = (vec![RoundedNormal::default(); n], vec![0.0; n]);
        let [smooth_at, smooth_around] = [(); 2].map(|()| vec![false; n]);
        Self {
            faces_at,
            neighbours,
            near,
            double_area,
            may_be_smooth,
            may_be_smooth_around,
            first_normals,
            sums,
            means,
            margins,
            smooth_at,
            smooth_around,
        }
    }

    /// Tests all patches at `x` and along `step`.
    pub fn set_motion(&mut self, x: &[Vec3], step: &[Vec3], topology: &Topology) {
        if !NORMAL_CONE_CULLING.is_on() {
            return;
        }
        let moves = CornerMoves { x, step, faces: &topology.faces };
        let normals = self.first_normals.iter_mut().zip(&mut self.sums);
        for (f, ((one, sum), double_area)) in (0u32..).zip(normals.zip(&self.double_area)) {
            let n = moves.normals(f);
            *one = first_normal(&n, *double_area);
            *sum = rounded_normal(&(n[0] + n[2]), 0.0);
        }
        for (v, k) in (0u32..).zip(0..self.smooth_at.len()) {
            self.smooth_at[k] = self.may_be_smooth[k] && self.is_smooth_at(v, &moves);
        }
        for (v, k) in (0u32..).zip(0..self.smooth_around.len()) {
            self.smooth_around[k] =
                self.may_be_smooth_around[k] && self.smooth_at[k] && self.is_smooth_around(v, &moves);
        }
    }

    /// Do the triangles at a vertex have nearly the same normal?
    #[inline]
    fn is_smooth_at(&mut self, v: u32, moves: &CornerMoves<'_>) -> bool {
        let faces_at = self.faces_at.of(v);
        let mut mean = RoundedNormal::default();
        for f in faces_at {
            let sum = &self.sums[*f as usize];
            (0..4).for_each(|k| mean[k] += sum[k]);
        }
        let l = dot(&mean, &mean).sqrt();
        let one = if l > 0.0 { 1.0 / l } else { 0.0 };
        (0..3).for_each(|k| mean[k] *= one);
        mean[3] = -1.0;
        let mut margin: f32 = if l > 0.0 { 1.0 } else { -1.0 };
        for f in faces_at {
            let s = dot(&self.first_normals[*f as usize], &mean);
            margin = if s < margin { s } else { margin };
        }
        margin -= ROUNDING_OF_NORMALS;
        (self.means[v as usize], self.margins[v as usize]) = (mean, margin);
        margin >= 0.0 || self.has_like_normals(v, v, &mut None, moves)
    }

    /// Do the triangles at the neighbours of a vertex have nearly the same normal as those at it?
    #[inline]
    fn is_smooth_around(&self, v: u32, moves: &CornerMoves<'_>) -> bool {
        let (all, mut mean) = (&self.means[v as usize], None);
        self.neighbours.of(v).iter().all(|w| {
            let (mut off, margin) = (self.means[*w as usize], self.margins[*w as usize]);
            (0..4).for_each(|k| off[k] -= all[k]);
            margin >= 0.0 && dot(&off, &off) <= margin * margin || self.has_like_normals(*w, v, &mut mean, moves)
        })
    }

    /// Do the triangles at `w` have nearly the same normal as those at `v`? Their mean normal is computed when it is
    /// first needed.
    fn has_like_normals(&self, w: u32, v: u32, mean: &mut Option<Vec3>, moves: &CornerMoves<'_>) -> bool {
        let all = &self.means[v as usize];
        self.faces_at.of(w).iter().all(|f| {
            let first = &self.first_normals[*f as usize];
            let (margin, double_area) = (dot(first, all), self.double_area[*f as usize]);
            // The first of the normals alone may deviate too far.
            let off = margin + first[3] < NORMAL_CONE_COSINE.get() as f32 - ROUNDING_OF_NORMALS;
            margin >= ROUNDING_OF_NORMALS
                || !off && {
                    let mean = mean.get_or_insert_with(|| self.mean(v, moves));
                    moves.normals(*f).iter().all(|n| is_along(n, mean, double_area))
                }
        })
    }

    /// The mean direction of the normals at a vertex; not a number where there is none.
    fn mean(&self, v: u32, moves: &CornerMoves<'_>) -> Vec3 {
        let sum: Vec3 = self.faces_at.of(v).iter().map(|f| moves.normals(*f)).map(|n| n[0] + n[2]).sum();
        sum / sum.norm()
    }

    /// The pairs of neighbours that [`Self::unsafe_neighbours`] may emit.
    pub fn all_neighbours(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        (0u32..).take(self.double_area.len()).flat_map(|f| self.near.of(f).iter().map(move |g| [f, untagged(*g).0]))
    }

    /// Emits the neighbouring triangles that do not lie in one smooth patch along the last motion, and whether they
    /// share a corner.
    pub fn unsafe_neighbours(&self, topology: &Topology, mut emit: impl FnMut(u32, u32, bool)) {
        for (f, corners) in (0u32..).zip(&topology.faces) {
            if corners.iter().all(|v| self.smooth_around[*v as usize]) {
                continue;
            }
            let smooth = (0..3).fold(0, |smooth, k| {
                let v = corners[k] as usize;
                smooth | corner_bits(self.smooth_at[v], self.smooth_around[v], k)
            });
            for (g, tag) in self.near.of(f).iter().map(|g| untagged(*g)).filter(|(_, tag)| tag & smooth == 0) {
                emit(f, g, tag & (7 * AT_CORNER) != 0);
            }
        }
    }
}

/// The triangles at the neighbours of a vertex, some of them more than once.
fn faces_around<'a>(faces_at: &'a PackedLists, neighbours: &'a PackedLists, v: u32) -> impl Iterator<Item = &'a u32> {
    neighbours.of(v).iter().flat_map(|w| faces_at.of(*w))
}

/// The bits of corner `k`, for smooth patches at it and around it.
#[inline]
fn corner_bits(at: bool, around: bool, k: usize) -> u8 {
    (u8::from(at) * AT_CORNER + u8::from(around) * AROUND_CORNER) << k
}

/// Vertices whose triangles form one fan, all turned the same way, without more cloth than fits around them.
fn may_be_smooth(
    cloth: &[Element],
    topology: &Topology,
    faces_at: &PackedLists,
    neighbours: &PackedLists,
) -> Vec<bool> {
    let mut round = vec![0.0; faces_at.len()];
    for t in cloth {
        (0..3).for_each(|k| round[t.vertices[k] as usize] += t.rest_angle(k).abs());
    }
    let edges = regular_vertices(topology);
    (0u32..)
        .zip(&round)
        .map(|(v, round)| {
            // A closed fan has as many neighbours as triangles, an open fan has one more.
            let (faces, neighbours) = (faces_at.of(v).len(), neighbours.of(v).len());
            let most = match neighbours.wrapping_sub(faces) {
                0 => NORMAL_CONE_INNER_ANGLE.get(),
                1 => NORMAL_CONE_BORDER_ANGLE.get(),
                _ => return false,
            };
            *round <= most && faces > 0 && edges[v as usize]
        })
        .collect()
}

/// Vertices none of whose edges has more than two triangles, or two that are turned against each other.
fn regular_vertices(topology: &Topology) -> Vec<bool> {
    let n = topology.faces.iter().flatten().max().map_or(0, |v| *v as usize + 1);
    let mut fine = vec![true; n];
    let mut count = vec![0u8; topology.edges.len()];
    for edges in &topology.face_edges {
        edges.iter().for_each(|e| count[*e as usize] = count[*e as usize].saturating_add(1));
    }
    for (ends, c) in topology.edges.iter().zip(&count) {
        if *c > 2 {
            ends.iter().for_each(|v| fine[*v as usize] = false);
        }
    }
    for h in &topology.hinges {
        let [f, g] = [0, 1].map(|k| topology.faces[h.faces[k] as usize][usize::from(h.sides[k])]);
        if f == g {
            h.vertices[..2].iter().for_each(|v| fine[*v as usize] = false);
        }
    }
    fine
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    /// A strip of squares along x, each cut in two. `bend` turns every next square down, rad.
    fn strip(bend: f64) -> (Scene, Topology) {
        let mut scene = Scene::default();
        let (mut at, mut turned) = (Vec3::zeros(), 0.0);
        for i in 0..7u32 {
            for y in [0.0, 1.0] {
                scene.positions.push(at + Vec3::new(0.0, y, 0.0));
            }
            at += Vec3::new(libm::cos(turned), 0.0, -libm::sin(turned));
            turned += bend;
            if i < 6 {
                let (p, x) = (2 * i, f64::from(i));
                for (t, rest) in [
                    ([p, p + 2, p + 3], [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0]]),
                    ([p, p + 3, p + 1], [[x, 0.0], [x + 1.0, 1.0], [x, 1.0]]),
                ] {
                    scene.triangles.push(Element { vertices: t, rest, material: 0 });
                }
            }
        }
        let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
        (scene, topology)
    }

    fn cones(bend: f64, step: impl Fn(usize) -> Vec3) -> (NormalCones, Topology) {
        let (scene, topology) = strip(bend);
        let mut cones = NormalCones::new(&scene.triangles, scene.positions.len(), &topology);
        let step: Vec<Vec3> = (0..scene.positions.len()).map(step).collect();
        cones.set_motion(&scene.positions, &step, &topology);
        (cones, topology)
    }

    /// Do two neighbours lie in one smooth patch?
    fn is_smooth(cones: &NormalCones, t: &Topology, f: u32, g: u32) -> bool {
        let mut is_unsafe = false;
        cones.unsafe_neighbours(t, |p, q, _| is_unsafe |= [p, q] == [f, g]);
        cones.all_neighbours().any(|pair| pair == [f, g]) && !is_unsafe
    }

    #[test]
    fn flat_cloth_is_calm_and_folded_cloth_is_not() {
        let (flat, t) = cones(0.0, |_| Vec3::zeros());
        assert!(is_smooth(&flat, &t, 4, 6) && is_smooth(&flat, &t, 4, 5));
        assert!(!is_smooth(&flat, &t, 0, 11), "far apart in the cloth: anything may happen");
        let (folded, t) = cones(1.3, |_| Vec3::zeros());
        assert!(!is_smooth(&folded, &t, 3, 6));
    }

    /// The strip is flat at both ends of the step, but turned over in between: at half way the triangles have no
    /// area.
    #[test]
    fn a_step_that_turns_the_cloth_over_is_not_calm() {
        let (scene, _) = strip(0.0);
        let over = |i: usize| Vec3::new(-2.0 * scene.positions[i].x, 0.0, 0.0);
        let (turned, t) = cones(0.0, over);
        assert!(!is_smooth(&turned, &t, 4, 5));
        let (moved, t) = cones(0.0, |_| Vec3::new(5.0, 3.0, -2.0));
        assert!(is_smooth(&moved, &t, 4, 5));
    }
}
