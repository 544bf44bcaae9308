//! How far the triangles of the cloth are from a body at rest, at least. What is told of one holds until it has moved by as
//! much, so that cloth far from the body is asked about once in many lists.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::broad_phase::bvh::Aabb;
use crate::collision::narrow_phase::candidates::Way;

/// Lower bounds of distances, and what uses them up.
#[derive(Clone, Debug, Default)]
pub(crate) struct Far {
    /// Per triangle, m, where the cloth was at the last look.
    free: Vec<f64>,
    /// How far the vertices have moved since, and how far they go in the step, m.
    moved: Vec<f64>,
    pub goes: Vec<f64>,
}

/// Endless where it is no number, as where the cloth was beyond numbers at the last look: then nothing is told of it any more.
#[inline]
fn length(v: &Vec3) -> f64 {
    let length = v.norm();
    if length.is_nan() { f64::INFINITY } else { length }
}

#[inline]
fn most(of: &[f64], corners: &[u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|v| of[v as usize]);
    let ab = if a > b { a } else { b };
    if ab > c { ab } else { c }
}

impl Far {
    /// Takes the way of the cloth, which was at `from` at the last look; every triangle is asked about until the next.
    pub fn take(&mut self, way: &Way<'_>, from: &[Vec3]) {
        self.moved.clear();
        self.moved.extend(way.x.iter().zip(from).map(|(p, q)| length(&(p - q))));
        if self.moved.len() < way.x.len() || self.free.len() != way.topology.faces.len() {
            self.moved.resize(way.x.len(), 0.0);
            self.free.clear();
            self.free.resize(way.topology.faces.len(), f64::NEG_INFINITY);
        }
        self.goes.clear();
        self.goes.extend(way.step.iter().map(length));
    }

    /// How far triangle `f` stays from the body on the way, m: at least, and near the truth where that is under `reach`.
    #[inline]
    pub fn stays(&mut self, f: u32, way: &Way<'_>, reach: f64, body: &Body) -> f64 {
        let corners = &way.topology.faces[f as usize];
        let goes = most(&self.goes, corners);
        let free = &mut self.free[f as usize];
        *free -= most(&self.moved, corners);
        if *free - goes <= reach {
            let clear = body.clear_of(&Aabb::of_three(&crate::pick3(way.x, corners)));
            *free = if clear.is_nan() { f64::NEG_INFINITY } else { clear };
        }
        *free - goes
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

    /// A run that goes wrong comes back to where it was sound, and must find the body there.
    #[test]
    fn cloth_that_was_beyond_numbers_is_asked_about_anew() {
        let (body, topology, mut far) = (tetrahedron(), Topology::new(3, vec![[0, 1, 2]]), Far::default());
        let sound = vec![Vec3::new(0.01, 0.01, 0.101), Vec3::new(0.02, 0.01, 0.101), Vec3::new(0.01, 0.02, 0.101)];
        let step = vec![Vec3::zeros(); 3];
        let mut told = |x: &[Vec3], from: &[Vec3]| {
            let way = Way::new(x, &step, &topology, &[0, 1, 2]);
            far.take(&way, from);
            far.stays(0, &way, 0.02, &body)
        };
        let first = told(&sound, &[]);
        assert!(first < 0.02);
        for corners in [vec![0], vec![1], vec![2], vec![0, 1, 2]] {
            let mut lost = sound.clone();
            corners.iter().for_each(|c: &usize| lost[*c] = Vec3::repeat(f64::NAN));
            told(&lost, &sound);
            assert_eq!(told(&sound, &lost), first, "{corners:?}");
        }
    }

    /// Of a triangle that wanders about a tetrahedron never more is told than is true.
    #[test]
    fn never_more_than_the_distance_is_told() {
        let body = tetrahedron();
        let (topology, mut far, mut from, mut passed) = (Topology::new(3, vec![[0, 1, 2]]), Far::default(), vec![], 0);
        let place = |t: f64| {
            let at = Vec3::new(libm::cos(t), libm::sin(3.0 * t), libm::sin(t)) * 0.1;
            vec![at, at + Vec3::new(0.02, 0.01, 0.0), at + Vec3::new(0.0, 0.02, 0.01)]
        };
        for i in 0..500u32 {
            let (x, next) = (place(f64::from(i) * 0.02), place(f64::from(i) * 0.02 + 0.015));
            let step: Vec<Vec3> = next.iter().zip(&x).map(|(q, p)| q - p).collect();
            let way = Way::new(&x, &step, &topology, &[0, 1, 2]);
            far.take(&way, &from);
            let told = far.stays(0, &way, 0.02, &body);
            for part in [0.0, 0.5, 1.0] {
                let at: Vec<Vec3> = x.iter().zip(&step).map(|(p, d)| p + d * part).collect();
                let nearest = |p: &Vec3| (0..4).map(|g| body.point_gap(p, g)).fold(f64::INFINITY, f64::min);
                let middle = (at[0] + at[1] + at[2]) / 3.0;
                assert!(at.iter().chain([&middle]).all(|p| told <= nearest(p)), "{i}: {told}");
            }
            passed += u32::from(told > 0.02);
            from.clone_from(&x);
        }
        assert!((100..500).contains(&passed), "{passed}");
    }
}
