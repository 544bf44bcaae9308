//! Resolution of intersections: cloth that crosses itself at a few places is drawn out of itself.
//!
//! Two parts of the cloth that cross meet in a curve, the intersection contour. Every edge that passes through a triangle
//! is moved against it in the direction in which the contour becomes shorter, until no contour is left. The method is
//! that of Volino, Magnenat-Thalmann 2006 (Resolving surface collisions through intersection contour minimization).

use crate::Vec3;
use crate::collision::crossings::count;
use crate::collision::crossings::pair::segment_meets;
use crate::collision::narrow_phase::distance::point_triangle;
use crate::prepare::tuning::{
    CONTOUR_PAIRS_MAX, CONTOUR_PAIRS_SHARE_MAX, CONTOUR_ROUNDS, CONTOUR_SINE_MIN, CONTOUR_SMOOTHING, CONTOUR_STEP_EDGES,
};
use crate::scene::topology::Topology;
use std::collections::BTreeSet;

/// Draws cloth out of itself; held vertices stay. Returns the pairs of triangles that still cross.
pub(crate) fn resolve_intersections(x: &mut [Vec3], topology: &Topology, held: &[bool]) -> Vec<[u32; 2]> {
    let most = (CONTOUR_PAIRS_SHARE_MAX.get() * topology.faces.len() as f64).max(CONTOUR_PAIRS_MAX.get()) as usize;
    let mut found = count::self_crossings(x, &topology.faces);
    let is_hopeful = |found: &count::Crossings| found.count > 0 && found.count <= most;
    if !is_hopeful(&found) {
        return found.pairs;
    }
    let around = Surroundings::of(x.len(), topology);
    for _ in 0..CONTOUR_ROUNDS.get() {
        let Some(moves) = (Contours { x, topology, around: &around, held }).moves(&found.pairs) else { break };
        x.iter_mut().zip(moves).for_each(|(x, by)| *x += by);
        found = count::self_crossings(x, &topology.faces);
        if !is_hopeful(&found) {
            break;
        }
    }
    found.pairs
}

/// The faces and vertices around each edge and vertex of the cloth.
struct Surroundings {
    /// The faces of every edge.
    faces: Vec<Vec<u32>>,
    /// The neighbours of every vertex. A border vertex has only those along the border, so that hems keep their place.
    neighbours: Vec<Vec<u32>>,
}

impl Surroundings {
    fn of(vertex_count: usize, topology: &Topology) -> Self {
        let mut faces = vec![Vec::new(); topology.edges.len()];
        for (f, edges) in (0u32..).zip(&topology.face_edges) {
            edges.iter().for_each(|e| faces[*e as usize].push(f));
        }
        let [mut all, mut border] = [vec![Vec::new(); vertex_count], vec![Vec::new(); vertex_count]];
        for (edge, faces) in topology.edges.iter().zip(&faces) {
            for (v, w) in [(edge[0], edge[1]), (edge[1], edge[0])] {
                all[v as usize].push(w);
                if faces.len() == 1 {
                    border[v as usize].push(w);
                }
            }
        }
        let neighbours = all.into_iter().zip(border).map(|(all, border)| if border.is_empty() { all } else { border });
        Self { faces, neighbours: neighbours.collect() }
    }
}

/// Cloth that crosses itself.
struct Contours<'a> {
    /// Places of the vertices, m.
    x: &'a [Vec3],
    topology: &'a Topology,
    around: &'a Surroundings,
    held: &'a [bool],
}

/// An edge that passes through a triangle.
struct Piercing {
    /// Vertices of the edge and of the triangle.
    vertices: [u32; 5],
    /// Their weights in the vector from the triangle to the edge at the place where they meet.
    weights: [f64; 5],
    /// The move of the edge against the triangle that shortens the contour, m.
    by: Vec3,
}

impl Contours<'_> {
    /// The move of every vertex in one round, m; `None` where no edge passes through a triangle.
    ///
    /// It is the sum of what all piercings ask of it, but no more than their mean where their weights exceed one. The
    /// vertices of triangles that cross are smoothed besides, because a contour in a sharp fold has no way out.
    fn moves(&self, pairs: &[[u32; 2]]) -> Option<Vec<Vec3>> {
        let piercings = self.piercings(pairs);
        let mut sums = vec![(Vec3::zeros(), 0.0); self.x.len()];
        for piercing in &piercings {
            let weights = piercing.vertices.into_iter().zip(piercing.weights);
            let free = || weights.clone().filter(|(v, _)| !self.held[*v as usize]);
            let squares: f64 = free().map(|(_, w)| w * w).sum();
            for (v, w) in free() {
                let (by, weight) = &mut sums[v as usize];
                *by += piercing.by * (w / squares);
                *weight += w.abs();
            }
        }
        let mut moves: Vec<Vec3> = sums.into_iter().map(|(by, weight)| by / f64::max(weight, 1.0)).collect();
        let crossing = pairs.iter().flatten().flat_map(|f| self.topology.faces[*f as usize]);
        for v in crossing.filter(|v| !self.held[*v as usize]).collect::<BTreeSet<u32>>() {
            moves[v as usize] += self.to_the_middle(v) * CONTOUR_SMOOTHING.get();
        }
        (!piercings.is_empty()).then_some(moves)
    }

    /// The vector from a vertex to the mean of its neighbours, m.
    fn to_the_middle(&self, v: u32) -> Vec3 {
        let neighbours = &self.around.neighbours[v as usize];
        let sum: Vec3 = neighbours.iter().map(|w| self.x[*w as usize]).sum();
        sum / neighbours.len() as f64 - self.x[v as usize]
    }

    /// The edges that pass through triangles, among pairs of triangles that cross.
    fn piercings(&self, pairs: &[[u32; 2]]) -> Vec<Piercing> {
        let both = pairs.iter().flat_map(|[f, g]| [(*f, *g), (*g, *f)]);
        let near = both.flat_map(|(f, g)| self.topology.face_edges[f as usize].map(|e| (e, g)));
        // An edge belongs to several faces.
        let once: BTreeSet<(u32, u32)> = near.collect();
        once.into_iter().filter_map(|(edge, face)| self.piercing(edge, face)).collect()
    }

    /// `None` where the edge does not pass through the triangle, or lies nearly in its plane.
    fn piercing(&self, edge: u32, face: u32) -> Option<Piercing> {
        let (ends, corners) = (self.topology.edges[edge as usize], self.topology.faces[face as usize]);
        let ([p, q], triangle) = (ends.map(|v| self.x[v as usize]), crate::pick3(self.x, &corners));
        if ends.iter().any(|v| corners.contains(v)) || !segment_meets(&p, &q, &triangle) {
            return None;
        }
        let (normal, length) = (crate::unit_normal(triangle)?, (q - p).norm());
        let along = (q - p) / length;
        let sine = along.dot(&normal);
        if sine.abs() < CONTOUR_SINE_MIN.get() {
            return None;
        }
        let into: Vec3 = self.around.faces[edge as usize].iter().filter_map(|f| self.contour(*f, ends, &normal)).sum();
        // The gradient of the contour's length. A move along the edge itself does not count.
        let gradient = into - normal * (along.dot(&into) / sine);
        let share = ((triangle[0] - p).dot(&normal) / (sine * length)).clamp(0.0, 1.0);
        let [a, b, c] = point_triangle(&(p + (q - p) * share), &triangle[0], &triangle[1], &triangle[2]);
        Some(Piercing {
            vertices: [ends[0], ends[1], corners[0], corners[1], corners[2]],
            weights: [1.0 - share, share, -a, -b, -c],
            by: gradient / f64::max(gradient.norm(), 1.0) * (CONTOUR_STEP_EDGES.get() * length),
        })
    }

    /// Unit vector along the contour in a face beside the edge, from the edge into the face. `normal` is that of the
    /// pierced triangle.
    fn contour(&self, face: u32, ends: [u32; 2], normal: &Vec3) -> Option<Vec3> {
        let corners = self.topology.faces[face as usize];
        let own = crate::unit_normal(crate::pick3(self.x, &corners))?;
        let line = normal.cross(&own).try_normalize(CONTOUR_SINE_MIN.get())?;
        let apex = corners.into_iter().find(|v| !ends.contains(v))?;
        let [p, q] = ends.map(|v| self.x[v as usize]);
        let side = own.cross(&(q - p));
        Some(line * (line.dot(&side) * side.dot(&(self.x[apex as usize] - p))).signum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Element, Scene};

    /// Cells along a side of a sheet, and the length of a cell, m.
    const CELLS: u32 = 12;
    const CELL: f64 = 0.01;

    fn at(i: u32, j: u32) -> usize {
        (j * (CELLS + 1) + i) as usize
    }

    /// Flat sheets at some heights, m, one after the other.
    fn sheets(heights: &[f64]) -> (Vec<Vec3>, Topology) {
        let mut scene = Scene::default();
        let mut triangles = Vec::new();
        for z in heights {
            let first = u32::try_from(scene.positions.len()).expect("few vertices");
            let rows = (0..=CELLS).flat_map(|j| (0..=CELLS).map(move |i| [f64::from(i) * CELL, f64::from(j) * CELL]));
            scene.positions.extend(rows.map(|[x, y]| Vec3::new(x, y, *z)));
            for (i, j) in (0..CELLS).flat_map(|j| (0..CELLS).map(move |i| (i, j))) {
                let a = first + j * (CELLS + 1) + i;
                for vertices in [[a, a + 1, a + CELLS + 2], [a, a + CELLS + 2, a + CELLS + 1]] {
                    let rest = vertices.map(|v| [scene.positions[v as usize].x, scene.positions[v as usize].y]);
                    triangles.push(Element { vertices, rest, material: 0 });
                }
            }
        }
        let topology = Topology::of_elements(scene.positions.len(), &triangles);
        (scene.positions, topology)
    }

    /// Pulls the fifth vertex of a row through the cloth beside it.
    fn pinch(x: &mut [Vec3], row: u32) {
        x[at(5, row)] += Vec3::new(0.022, 0.004, 0.004);
        x[at(6, row)] += Vec3::new(0.0, 0.0, 0.008);
    }

    fn crossings(x: &[Vec3], topology: &Topology) -> usize {
        count::self_crossings(x, &topology.faces).count
    }

    #[test]
    fn a_pinch_is_resolved_and_the_rest_stays() {
        let (mut x, topology) = sheets(&[0.0]);
        pinch(&mut x, 5);
        assert!(crossings(&x, &topology) > 0);
        let corner = x[0];
        let held = vec![false; x.len()];
        assert!(resolve_intersections(&mut x, &topology, &held).is_empty());
        assert_eq!(crossings(&x, &topology), 0);
        assert_eq!(x[0], corner);
    }

    /// Two pinches at once in cloth of few triangles make more pairs than the share allows in large cloth.
    #[test]
    fn two_pinches_in_small_cloth_are_resolved() {
        let (mut x, topology) = sheets(&[0.0]);
        pinch(&mut x, 5);
        pinch(&mut x, 9);
        assert!(crossings(&x, &topology) > 8);
        let held = vec![false; x.len()];
        assert!(resolve_intersections(&mut x, &topology, &held).is_empty());
    }

    /// Two sheets lie on each other, and a vertex of the lower one was drawn through the upper one. Only the cloth around
    /// it moves, less than a cell.
    #[test]
    fn a_lining_is_drawn_out_of_its_shell() {
        let (mut x, topology) = sheets(&[0.0, 0.001]);
        x[at(5, 5)].z += 0.004;
        let start = x.clone();
        assert!(crossings(&x, &topology) > 0);
        let held = vec![false; x.len()];
        assert!(resolve_intersections(&mut x, &topology, &held).is_empty());
        let moved: Vec<f64> = x.iter().zip(&start).map(|(p, q)| (p - q).norm()).collect();
        assert!(moved.iter().all(|by| *by < CELL), "{moved:?}");
        assert!(moved.iter().filter(|by| **by > 0.0).count() < 30, "{moved:?}");
    }

    /// A held vertex stays, and the cloth that it passed through makes way.
    #[test]
    fn cloth_makes_way_for_a_held_vertex() {
        let (mut x, topology) = sheets(&[0.0, 0.001]);
        x[at(5, 5)].z += 0.004;
        let (place, mut held) = (x[at(5, 5)], vec![false; x.len()]);
        held[at(5, 5)] = true;
        assert!(resolve_intersections(&mut x, &topology, &held).is_empty());
        assert_eq!(x[at(5, 5)], place);
    }
}
