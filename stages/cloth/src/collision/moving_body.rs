//! Moving bodies: during a step all triangles move in straight lines, and every search counts them as moving.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::body_candidates::BodyCandidates;
use crate::collision::body_motion::BodyMotion;
use crate::collision::broad_phase::aabb::{Aabb, meet_moving};
use crate::collision::broad_phase::bvh::BoxTree;
use crate::collision::narrow_phase::candidates::{LinearMotion, MovingFace};
use crate::collision::narrow_phase::distance::{point_triangle, segments};
use crate::collision::narrow_phase::pair_kind::{PairKey, PairKind};
use std::sync::Arc;

impl Body {
    /// Prepares the body for motion. Every edge can press from then on.
    pub fn begin_motion(&mut self) {
        let tree = BoxTree::moving(&self.positions, &self.topology.faces);
        self.motion = Some(BodyMotion::at_rest(tree, self.positions.len()));
        self.features.restore_all(&self.topology);
        self.coplanar = Arc::default();
    }

    /// Sets the displacements of the next step, m.
    pub fn set_step(&mut self, step: &[Vec3]) {
        if let Some(t) = &mut self.motion {
            t.step.copy_from_slice(step);
            t.is_moving = true;
        }
    }

    /// Moves the body by a part of the displacements.
    pub fn take_step(&mut self, part: f64) {
        let Some(t) = &mut self.motion else { return };
        Arc::make_mut(&mut self.positions).iter_mut().zip(&t.step).for_each(|(p, d)| *p += d * part);
        t.step.fill(Vec3::zeros());
        t.is_moving = false;
        self.bounds = Aabb::of(&self.positions);
    }

    /// Does the body move in the current step?
    pub fn is_moving(&self) -> bool {
        self.motion.as_ref().is_some_and(|t| t.is_moving)
    }

    /// Displacement of a vertex in the current step, m.
    #[inline]
    pub fn displacement(&self, w: u32) -> Vec3 {
        match &self.motion {
            Some(t) => t.step[w as usize],
            None => Vec3::zeros(),
        }
    }

    /// Value of a field over the body's vertices at the body's point of a pair; zero for pairs of cloth alone.
    pub fn interpolate_at_pair(&self, key: &PairKey, x: &[Vec3], field: &[Vec3]) -> Vec3 {
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

impl BodyCandidates {
    /// Lists the pairs of cloth and body that come nearer than `reach` while both move, m. Parts that move as one do
    /// not meet.
    pub fn list_moving(&mut self, motion: &LinearMotion<'_>, body: &mut Body, reach: f64) {
        let LinearMotion { x, step, topology, .. } = *motion;
        self.remove_all();
        let Some(motion) = &mut body.motion else { return };
        motion.tree.refit_moving(&body.positions, &motion.step, &body.topology.faces, 0.0);
        for f in (0u32..).take(topology.faces.len()) {
            let a = MovingFace::of(topology, f, x, step);
            let (bounds, moves) = (a.face.bounds(reach), Aabb::of_three(&a.by));
            motion.tree.meeting_moving(&bounds, &moves, |g| {
                let b = MovingFace::of(&body.topology, g, &body.positions, &motion.step);
                self.add_points(&a, &b, g, reach);
                self.add_edges(&a, &b, reach);
            });
        }
    }

    fn add_points(&mut self, a: &MovingFace, b: &MovingFace, g: u32, reach: f64) {
        let (face, moves) = (b.face.bounds(reach), Aabb::of_three(&b.by));
        for k in (0..3).filter(|k| a.face.owns_vertex(*k)) {
            if meet_moving(&face, &moves, &Aabb::of_one(&a.face.at[k]), &Aabb::of_one(&a.by[k])) {
                self.add_point(a.face.corners[k], g, 0.0);
            }
        }
        let (face, moves) = (a.face.bounds(reach), Aabb::of_three(&a.by));
        for k in (0..3).filter(|k| b.face.owns_vertex(*k)) {
            if meet_moving(&face, &moves, &Aabb::of_one(&b.face.at[k]), &Aabb::of_one(&b.by[k])) {
                self.add_face(&a.face, b.face.corners[k], 0.0);
            }
        }
    }

    fn add_edges(&mut self, a: &MovingFace, b: &MovingFace, reach: f64) {
        for j in (0..3).filter(|j| b.face.owns_edge(*j)) {
            let (bounds, moves) = (b.face.edge_box(j).grown(reach), b.edge_move(j));
            for i in (0..3).filter(|i| a.face.owns_edge(*i)) {
                if meet_moving(&bounds, &moves, &a.face.edge_box(i), &a.edge_move(i)) {
                    self.add_edge(&a.face, i, b.face.edge(j), &b.face.edge_vector(j), 0.0);
                }
            }
        }
    }
}
