//! Lower bounds of the distance between cloth triangles and a body at rest.
//!
//! A bound holds until the triangle has moved by it. So cloth far from the body is measured once for many lists.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::narrow_phase::candidates::LinearMotion;
use crate::collision::tuning::BODY_DISTANCE_BOUNDS;

/// Lower bounds of the distances of cloth triangles from a body, and the motion that uses them up.
#[derive(Clone, Debug, Default)]
pub(crate) struct BodyDistanceBounds {
    /// Lower bound of each triangle's distance at the last list, m.
    bounds: Vec<f64>,
    /// Distance of each vertex from its position at the last list, m.
    moved: Vec<f64>,
    /// Length of the move of each vertex in the step, m.
    pub step_lengths: Vec<f64>,
}

/// The length of a vector, m. It is infinite where the vector is not a number, so that no bound from then holds any
/// more.
#[inline]
fn length(v: &Vec3) -> f64 {
    let length = v.norm();
    if length.is_nan() { f64::INFINITY } else { length }
}

/// The largest value at three corners.
#[inline]
fn largest(of: &[f64], corners: &[u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|v| of[v as usize]);
    let ab = if a > b { a } else { b };
    if ab > c { ab } else { c }
}

impl BodyDistanceBounds {
    /// Takes a motion of the cloth, which was at `from` at the last list.
    pub fn set_motion(&mut self, motion: &LinearMotion<'_>, from: &[Vec3]) {
        self.moved.clear();
        self.moved.extend(motion.x.iter().zip(from).map(|(p, q)| length(&(p - q))));
        if !BODY_DISTANCE_BOUNDS.is_on()
            || self.moved.len() < motion.x.len()
            || self.bounds.len() != motion.topology.faces.len()
        {
            self.moved.resize(motion.x.len(), 0.0);
            self.bounds.clear();
            self.bounds.resize(motion.topology.faces.len(), f64::NEG_INFINITY);
        }
        self.step_lengths.clear();
        self.step_lengths.extend(motion.step.iter().map(length));
    }

    /// A lower bound of the distance of triangle `f` from the body during the motion, m. It is close to the distance
    /// where that is under `reach`.
    #[inline]
    pub fn distance_bound(&mut self, f: u32, motion: &LinearMotion<'_>, reach: f64, body: &Body) -> f64 {
        let corners = &motion.topology.faces[f as usize];
        let step_length = largest(&self.step_lengths, corners);
        let bound = &mut self.bounds[f as usize];
        *bound -= largest(&self.moved, corners);
        if *bound - step_length <= reach {
            let clear = body.distance_bound(&Aabb::of_three(&crate::pick3(motion.x, corners)));
            *bound = if clear.is_nan() { f64::NEG_INFINITY } else { clear };
        }
        *bound - step_length
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BodyMesh;
    use crate::scene::topology::Topology;

    fn tetrahedron() -> Body {
        let corner = |x, y, z| Vec3::new(x, y, z) * 0.1;
        let positions =
            vec![corner(0.0, 0.0, 0.0), corner(1.0, 0.0, 0.0), corner(0.0, 1.0, 0.0), corner(0.0, 0.0, 1.0)];
        Body::new(&BodyMesh { positions, triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] }).expect("a body")
    }

    /// A solve that fails and returns to sound positions finds the body there.
    #[test]
    fn cloth_that_was_not_a_number_is_measured_anew() {
        let (body, topology, mut bounds) =
            (tetrahedron(), Topology::new(3, vec![[0, 1, 2]]), BodyDistanceBounds::default());
        let sound = vec![Vec3::new(0.01, 0.01, 0.101), Vec3::new(0.02, 0.01, 0.101), Vec3::new(0.01, 0.02, 0.101)];
        let step = vec![Vec3::zeros(); 3];
        let mut bound = |x: &[Vec3], from: &[Vec3]| {
            let motion = LinearMotion::new(x, &step, &topology, &[0, 1, 2]);
            bounds.set_motion(&motion, from);
            bounds.distance_bound(0, &motion, 0.02, &body)
        };
        let first = bound(&sound, &[]);
        assert!(first < 0.02);
        for corners in [vec![0], vec![1], vec![2], vec![0, 1, 2]] {
            let mut lost = sound.clone();
            corners.iter().for_each(|c: &usize| lost[*c] = Vec3::repeat(f64::NAN));
            bound(&lost, &sound);
            assert_eq!(bound(&sound, &lost), first, "{corners:?}");
        }
    }

    /// The bound of a triangle that wanders about a tetrahedron never exceeds its distance.
    #[test]
    fn a_bound_never_exceeds_the_distance() {
        let body = tetrahedron();
        let (topology, mut bounds, mut from, mut passed) =
            (Topology::new(3, vec![[0, 1, 2]]), BodyDistanceBounds::default(), vec![], 0);
        let place = |t: f64| {
            let at = Vec3::new(libm::cos(t), libm::sin(3.0 * t), libm::sin(t)) * 0.1;
            vec![at, at + Vec3::new(0.02, 0.01, 0.0), at + Vec3::new(0.0, 0.02, 0.01)]
        };
        for i in 0..500u32 {
            let (x, next) = (place(f64::from(i) * 0.02), place(f64::from(i) * 0.02 + 0.015));
            let step: Vec<Vec3> = next.iter().zip(&x).map(|(q, p)| q - p).collect();
            let motion = LinearMotion::new(&x, &step, &topology, &[0, 1, 2]);
            bounds.set_motion(&motion, &from);
            let bound = bounds.distance_bound(0, &motion, 0.02, &body);
            for part in [0.0, 0.5, 1.0] {
                let at: Vec<Vec3> = x.iter().zip(&step).map(|(p, d)| p + d * part).collect();
                let nearest = |p: &Vec3| (0..4).map(|g| body.point_gap(p, g)).fold(f64::INFINITY, f64::min);
                let middle = (at[0] + at[1] + at[2]) / 3.0;
                assert!(at.iter().chain([&middle]).all(|p| bound <= nearest(p)), "{i}: {bound}");
            }
            passed += u32::from(bound > 0.02);
            from.clone_from(&x);
        }
        assert!((100..500).contains(&passed), "{passed}");
    }
}
