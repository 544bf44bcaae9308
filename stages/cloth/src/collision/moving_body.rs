//! A body on its way: its triangles move in straight lines through a step, and count as moving in all searches.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::body_candidates::Against;
use crate::collision::body_motion::Travel;
use crate::collision::broad_phase::bvh::{Aabb, Tree, meet_moving};
use crate::collision::narrow_phase::candidates::{Moving, Way};
use crate::collision::narrow_phase::distance::{point_triangle, segments};
use crate::collision::narrow_phase::pair_kind::{PairKey, PairKind};
use std::sync::Arc;

impl Body {
    /// From now on the body may move. Every edge can press then.
    pub fn set_out(&mut self) {
        let tree = Tree::moving(&self.positions, &self.topology.faces);
        self.travel = Some(Travel::at_rest(tree, self.positions.len()));
        self.sides.any(&self.topology);
        self.planes = Arc::default();
    }

    /// Displacements that the next step is to take.
    pub fn depart(&mut self, step: &[Vec3]) {
        if let Some(t) = &mut self.travel {
            t.step.copy_from_slice(step);
            t.going = true;
        }
    }

    /// Takes a part of the displacements.
    pub fn arrive(&mut self, part: f64) {
        let Some(t) = &mut self.travel else { return };
        Arc::make_mut(&mut self.positions).iter_mut().zip(&t.step).for_each(|(p, d)| *p += d * part);
        t.step.fill(Vec3::zeros());
        t.going = false;
        self.bounds = Aabb::of(&self.positions);
    }

    pub fn travels(&self) -> bool {
        self.travel.as_ref().is_some_and(|t| t.going)
    }

    /// Displacement of a vertex in the step that is tried.
    #[inline]
    pub fn moves(&self, w: u32) -> Vec3 {
        match &self.travel {
            Some(t) => t.step[w as usize],
            None => Vec3::zeros(),
        }
    }

    /// Value of a field over the body's vertices at the body's point of a near pair; nothing for pairs of cloth.
    pub fn at_pair(&self, key: &PairKey, x: &[Vec3], field: &[Vec3]) -> Vec3 {
        let [a, b, c, d] = key.1;
        let value = |w: u32| field[w as usize];
        match key.0 {
            PairKind::VertexBodyTriangle => {
                let [p, q, r] = self.triangle(b);
                let s = point_triangle(&x[a as usize], &p, &q, &r);
                let [p, q, r] = self.topology.faces[b as usize].map(value);
                p * s[0] + q * s[1] + r * s[2]
            }
            PairKind::EdgeBodyEdge => {
                let (p, q) = (&self.positions[c as usize], &self.positions[d as usize]);
                let t = segments(&x[a as usize], &x[b as usize], p, q)[1];
                value(c) * (1.0 - t) + value(d) * t
            }
            PairKind::TriangleBodyVertex => value(d),
            _ => Vec3::zeros(),
        }
    }
}

impl Against {
    /// Cloth–body pairs that come nearer than `reach` while both move; what moves along together does not meet.
    pub fn fill_travelling(&mut self, way: &Way<'_>, body: &mut Body, reach: f64) {
        let Way { x, step, topology, .. } = *way;
        self.clear();
        let Some(travel) = &mut body.travel else { return };
        travel.tree.refit_moving(&body.positions, &travel.step, &body.topology.faces, 0.0);
        for f in (0u32..).take(topology.faces.len()) {
            let a = Moving::of(topology, f, x, step);
            let (bounds, moves) = (a.owned.bounds(reach), Aabb::of_three(&a.by));
            travel.tree.meeting_moving(&bounds, &moves, |g| {
                let b = Moving::of(&body.topology, g, &body.positions, &travel.step);
                self.add_points(&a, &b, g, reach);
                self.add_edges(&a, &b, reach);
            });
        }
    }

    fn add_points(&mut self, a: &Moving, b: &Moving, g: u32, reach: f64) {
        let (face, moves) = (b.owned.bounds(reach), Aabb::of_three(&b.by));
        for k in (0..3).filter(|k| a.owned.owns_vertex(*k)) {
            if meet_moving(&face, &moves, &Aabb::of_one(&a.owned.at[k]), &Aabb::of_one(&a.by[k])) {
                self.add_point(a.owned.corners[k], g, 0.0);
            }
        }
        let (face, moves) = (a.owned.bounds(reach), Aabb::of_three(&a.by));
        for k in (0..3).filter(|k| b.owned.owns_vertex(*k)) {
            if meet_moving(&face, &moves, &Aabb::of_one(&b.owned.at[k]), &Aabb::of_one(&b.by[k])) {
                self.add_face(&a.owned, b.owned.corners[k], 0.0);
            }
        }
    }

    fn add_edges(&mut self, a: &Moving, b: &Moving, reach: f64) {
        for j in (0..3).filter(|j| b.owned.owns_edge(*j)) {
            let (bounds, moves) = (b.owned.edge_box(j).grown(reach), b.edge_move(j));
            for i in (0..3).filter(|i| a.owned.owns_edge(*i)) {
                if meet_moving(&bounds, &moves, &a.owned.edge_box(i), &a.edge_move(i)) {
                    self.add_edge(&a.owned, i, b.owned.edge(j), &b.owned.run(j), 0.0);
                }
            }
        }
    }
}
