//! Where the cloth lies so smoothly that it cannot meet itself: around a vertex whose triangles all look nearly the same
//! way, and go on doing so along a step, no two of them can come near each other (curvature test of Volino and
//! Magnenat-Thalmann 1994, along a whole step). Nearly all pairs that a box tree finds are such neighbours.

use crate::collision::broad_phase::bvh::narrow;
use crate::collision::broad_phase::packed_lists::{Lists, stars, untied};
use crate::scene::topology::Topology;
use crate::{Element, Vec3};

/// Least cosine between the normals of a patch and their mean, and least part of a triangle's area seen along it: what
/// is within keeps at least 0.4 of an altitude, more than any gap (`frame` in problem.rs).
const ALIKE: f64 = 0.5;
/// Largest sum of rest angles around a border vertex, rad: at the end of a slit the two sides could overlap.
const MOST_ROUND_BORDER: f64 = 1.4 * std::f64::consts::PI;
/// … and around any other; more is a surplus that must ruffle.
const MOST_ROUND: f64 = 2.2 * std::f64::consts::PI;

/// Bits of a pair of neighbours for the corners of the first: the second has it as a corner too; the second is at one of its neighbours.
const AT: u8 = 0b1;
const AROUND: u8 = 0b1000;

/// Normals of a triangle that bound those along a step: at its beginning, half mixed, at its end.
type Normals = [Vec3; 3];

/// Where the corners of the triangles are, and how they move.
struct Moves<'a> {
    x: &'a [Vec3],
    step: &'a [Vec3],
    faces: &'a [[u32; 3]],
}

impl Moves<'_> {
    #[inline]
    fn normals(&self, f: u32) -> Normals {
        let t = &self.faces[f as usize];
        let ([a, b, c], [p, q, r]) = (crate::pick3(self.x, t), crate::pick3(self.step, t));
        let (e, f) = (b - a, c - a);
        let (g, h) = (e + (q - p), f + (r - p));
        [e.cross(&f), (e.cross(&h) + g.cross(&f)) * 0.5, g.cross(&h)]
    }
}

/// A direction and one number more, in single precision: most of the cloth lies so smoothly that this tells enough.
type Quick = [f32; 4];

/// What single precision may be wrong by, of numbers of 1 or less.
const ROUNDING: f32 = 1e-5;

#[inline]
fn quick(n: &Vec3, last: f64) -> Quick {
    // What is left of a direction counts only beyond the rounding.
    let [x, y, z, _] = narrow(n);
    #[allow(clippy::cast_possible_truncation)]
    [x, y, z, last as f32]
}

#[inline]
fn dot(a: &Quick, b: &Quick) -> f32 {
    (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])
}

/// The direction of the first of a triangle's normals, and what it must have along a mean for all of them to have enough:
/// they differ little in most steps.
#[inline]
fn first([n, m, o]: &Normals, double: f64) -> Quick {
    let (length, off) = (n.norm_squared().sqrt(), larger((m - n).norm_squared(), (o - n).norm_squared()).sqrt());
    if length <= 0.0 {
        return [0.0, 0.0, 0.0, f32::INFINITY];
    }
    let one = 1.0 / length;
    quick(&(n * one), (ALIKE * larger(length + off, double) + off) * one)
}

#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Has a normal enough along a mean, of a triangle with twice this rest area?
#[inline]
fn enough(n: &Vec3, mean: &Vec3, double: f64) -> bool {
    let along = n.dot(mean);
    along >= 0.0 && along * along >= ALIKE * ALIKE * larger(n.norm_squared(), double * double)
}

/// Smooth patches around the vertices.
#[derive(Debug)]
pub(crate) struct Calm {
    /// Triangles at a vertex, and its neighbours.
    star: Lists,
    ring: Lists,
    /// Triangles with higher numbers that are at a corner of a triangle or a neighbour of one, and what each of them has to do
    /// with it: [`AT`] its corners, [`AROUND`] its corners.
    near: Lists,
    /// Twice the rest area, per triangle.
    double: Vec<f64>,
    /// May the patch be calm at all?
    able: Vec<bool>,
    /// … with those around its vertex's neighbours?
    wholly: Vec<bool>,
    firsts: Vec<Quick>,
    /// Of every triangle, what its normals add to a mean.
    sums: Vec<Quick>,
    /// The mean of the normals at a vertex, −1, and how far another mean may be off it with enough of all of them along it.
    means: Vec<Quick>,
    spare: Vec<f32>,
    /// Vertices whose triangles, and whose neighbours' triangles, were alike at the last look.
    one: Vec<bool>,
    two: Vec<bool>,
}

impl Calm {
    /// Of `n` vertices.
    pub fn new(cloth: &[Element], n: usize, topology: &Topology) -> Self {
        let faces = &topology.faces;
        let star = stars(n, faces);
        let around = |v: u32| star.of(v).iter().flat_map(|f| faces[*f as usize]);
        let ring = Lists::new(n, n, |v, add| around(v).filter(|w| *w != v).for_each(add));
        let wide = Lists::new(n, faces.len(), |v, add| wide(&star, &ring, v).copied().for_each(add));
        let near = Lists::tied(faces.len(), faces.len(), |f, add| {
            for (k, v) in faces[f as usize].iter().enumerate() {
                star.of(*v).iter().filter(|g| **g > f).for_each(|g| add(*g, AT << k));
                wide.of(*v).iter().filter(|g| **g > f).for_each(|g| add(*g, AROUND << k));
            }
        });
        let able = able(cloth, topology, &star, &ring);
        let double = cloth.iter().map(|t| 2.0 * t.area().abs()).collect();
        let wholly = (0u32..).zip(&able).map(|(v, a)| *a && ring.of(v).iter().all(|w| able[*w as usize])).collect();
        let [firsts, sums] = [(); 2].map(|()| vec![Quick::default(); topology.faces.len()]);
        let (means, spare) = (vec![Quick::default(); n], vec![0.0; n]);
        let [one, two] = [(); 2].map(|()| vec![false; n]);
        Self { star, ring, near, double, able, wholly, firsts, sums, means, spare, one, two }
    }

    /// Looks at the cloth at `x` and along `step`.
    pub fn look(&mut self, x: &[Vec3], step: &[Vec3], topology: &Topology) {
        let moves = Moves { x, step, faces: &topology.faces };
        let quicks = self.firsts.iter_mut().zip(&mut self.sums);
        for (f, ((one, sum), double)) in (0u32..).zip(quicks.zip(&self.double)) {
            let n = moves.normals(f);
            *one = first(&n, *double);
            *sum = quick(&(n[0] + n[2]), 0.0);
        }
        for (v, k) in (0u32..).zip(0..self.one.len()) {
            self.one[k] = self.able[k] && self.look_at(v, &moves);
        }
        for (v, k) in (0u32..).zip(0..self.two.len()) {
            self.two[k] = self.wholly[k] && self.one[k] && self.look_around(v, &moves);
        }
    }

    /// Are the triangles at a vertex alike?
    #[inline]
    fn look_at(&mut self, v: u32, moves: &Moves<'_>) -> bool {
        let star = self.star.of(v);
        let mut mean = Quick::default();
        for f in star {
            let sum = &self.sums[*f as usize];
            (0..4).for_each(|k| mean[k] += sum[k]);
        }
        let l = dot(&mean, &mean).sqrt();
        let one = if l > 0.0 { 1.0 / l } else { 0.0 };
        (0..3).for_each(|k| mean[k] *= one);
        mean[3] = -1.0;
        let mut spare: f32 = if l > 0.0 { 1.0 } else { -1.0 };
        for f in star {
            let s = dot(&self.firsts[*f as usize], &mean);
            spare = if s < spare { s } else { spare };
        }
        spare -= ROUNDING;
        (self.means[v as usize], self.spare[v as usize]) = (mean, spare);
        spare >= 0.0 || self.alike(v, v, &mut None, moves)
    }

    /// Do the triangles around a vertex look the same way as those at it?
    #[inline]
    fn look_around(&self, v: u32, moves: &Moves<'_>) -> bool {
        let (all, mut mean) = (&self.means[v as usize], None);
        self.ring.of(v).iter().all(|w| {
            let (mut off, spare) = (self.means[*w as usize], self.spare[*w as usize]);
            (0..4).for_each(|k| off[k] -= all[k]);
            spare >= 0.0 && dot(&off, &off) <= spare * spare || self.alike(*w, v, &mut mean, moves)
        })
    }

    /// Do the triangles at `w` look the same way as those at `v`, whose `mean` normal is worked out when it is first needed?
    fn alike(&self, w: u32, v: u32, mean: &mut Option<Vec3>, moves: &Moves<'_>) -> bool {
        let all = &self.means[v as usize];
        self.star.of(w).iter().all(|f| {
            let quick = &self.firsts[*f as usize];
            let (spare, double) = (dot(quick, all), self.double[*f as usize]);
            // The first of its normals alone may be too far off.
            let off = spare + quick[3] < ALIKE as f32 - ROUNDING;
            spare >= ROUNDING
                || !off && {
                    let mean = mean.get_or_insert_with(|| self.mean(v, moves));
                    moves.normals(*f).iter().all(|n| enough(n, mean, double))
                }
        })
    }

    /// The mean direction of the normals at a vertex; no number where there is none.
    fn mean(&self, v: u32, moves: &Moves<'_>) -> Vec3 {
        let sum: Vec3 = self.star.of(v).iter().map(|f| moves.normals(*f)).map(|n| n[0] + n[2]).sum();
        sum / sum.norm()
    }

    /// Pairs of triangles so near in the cloth that [`Self::restless`] tells of them.
    pub fn all_neighbours(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        (0u32..).take(self.double.len()).flat_map(|f| self.near.of(f).iter().map(move |g| [f, untied(*g).0]))
    }

    /// Neighbouring triangles that do not lie in one calm patch, as the last look saw them, and whether they have a corner in
    /// common.
    pub fn restless(&self, topology: &Topology, mut emit: impl FnMut(u32, u32, bool)) {
        for (f, corners) in (0u32..).zip(&topology.faces) {
            if corners.iter().all(|v| self.two[*v as usize]) {
                continue;
            }
            let calm = (0..3).fold(0, |calm, k| {
                let v = corners[k] as usize;
                calm | bits(self.one[v], self.two[v], k)
            });
            for (g, tie) in self.near.of(f).iter().map(|g| untied(*g)).filter(|(_, tie)| tie & calm == 0) {
                emit(f, g, tie & (7 * AT) != 0);
            }
        }
    }
}

/// The triangles at the neighbours of a vertex, some of them more than once.
fn wide<'a>(star: &'a Lists, ring: &'a Lists, v: u32) -> impl Iterator<Item = &'a u32> {
    ring.of(v).iter().flat_map(|w| star.of(*w))
}

/// [`AT`] and [`AROUND`] of corner `k`.
#[inline]
fn bits(at: bool, around: bool, k: usize) -> u8 {
    (u8::from(at) * AT + u8::from(around) * AROUND) << k
}

/// Vertices whose triangles form one fan, all turned the same way, without more cloth than fits round them.
fn able(cloth: &[Element], topology: &Topology, star: &Lists, ring: &Lists) -> Vec<bool> {
    let mut round = vec![0.0; star.len()];
    for t in cloth {
        (0..3).for_each(|k| round[t.vertices[k] as usize] += t.rest_angle(k).abs());
    }
    let edges = sides(topology);
    (0u32..)
        .zip(&round)
        .map(|(v, round)| {
            // A closed fan has as many neighbours as triangles, an open one has one more.
            let (faces, neighbours) = (star.of(v).len(), ring.of(v).len());
            let most = match neighbours.wrapping_sub(faces) {
                0 => MOST_ROUND,
                1 => MOST_ROUND_BORDER,
                _ => return false,
            };
            *round <= most && faces > 0 && edges[v as usize]
        })
        .collect()
}

/// Vertices none of whose edges has more than two triangles, or two turned against each other.
fn sides(topology: &Topology) -> Vec<bool> {
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

    /// A strip of squares, each cut in two, along x; `bend` turns every next square down, rad.
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

    fn calm(bend: f64, step: impl Fn(usize) -> Vec3) -> (Calm, Topology) {
        let (scene, topology) = strip(bend);
        let mut calm = Calm::new(&scene.triangles, scene.positions.len(), &topology);
        let step: Vec<Vec3> = (0..scene.positions.len()).map(step).collect();
        calm.look(&scene.positions, &step, &topology);
        (calm, topology)
    }

    /// Do two neighbours lie in one calm patch?
    fn parts(calm: &Calm, t: &Topology, f: u32, g: u32) -> bool {
        let mut restless = false;
        calm.restless(t, |p, q, _| restless |= [p, q] == [f, g]);
        calm.all_neighbours().any(|pair| pair == [f, g]) && !restless
    }

    #[test]
    fn flat_cloth_is_calm_and_folded_cloth_is_not() {
        let (flat, t) = calm(0.0, |_| Vec3::zeros());
        assert!(parts(&flat, &t, 4, 6) && parts(&flat, &t, 4, 5));
        assert!(!parts(&flat, &t, 0, 11), "far apart in the cloth: anything may happen");
        let (folded, t) = calm(1.3, |_| Vec3::zeros());
        assert!(!parts(&folded, &t, 3, 6));
    }

    /// Flat at both ends of the step, but turned over in between: the triangles pass through nothing at half way.
    #[test]
    fn a_step_that_turns_the_cloth_over_is_not_calm() {
        let (scene, _) = strip(0.0);
        let over = |i: usize| Vec3::new(-2.0 * scene.positions[i].x, 0.0, 0.0);
        let (turned, t) = calm(0.0, over);
        assert!(!parts(&turned, &t, 4, 5));
        let (moved, t) = calm(0.0, |_| Vec3::new(5.0, 3.0, -2.0));
        assert!(parts(&moved, &t, 4, 5));
    }
}
