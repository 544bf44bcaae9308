//! Pressure across the cloth, along the normal of every triangle (docs/pressure.md).
//!
//! On cloth with a rim no potential has these forces, so they are constant between two refreshes.

use crate::scene::measures::{areas, held};
use crate::scene::topology::components;
use crate::{Scene, Vec3};
use nalgebra::Matrix3;

/// The pressure on a cloth.
pub(crate) struct Pressure {
    /// Pressure, Pa.
    pressure: f64,
    faces: Vec<[u32; 3]>,
    /// Force on every vertex at the last refresh, N.
    push: Vec<Vec3>,
    /// Relief for cloth that is free to move or to turn.
    relief: Option<Relief>,
    refreshes: u64,
}

impl Pressure {
    /// `None` without pressure.
    pub fn new(scene: &Scene, pressure: f64) -> Option<Self> {
        (pressure != 0.0).then(|| {
            let faces = scene.triangles.iter().map(|t| t.vertices).collect();
            let push = vec![Vec3::zeros(); scene.positions.len()];
            Self { pressure, faces, push, relief: Relief::new(scene), refreshes: 0 }
        })
    }

    /// Takes the normals of the triangles at `x`.
    pub fn refresh(&mut self, x: &[Vec3]) {
        self.refreshes += 1;
        self.push.fill(Vec3::zeros());
        for t in &self.faces {
            let [a, b, c] = crate::pick3(x, t);
            // A third of the force on the triangle, whose area is half the product.
            let third = (b - a).cross(&(c - a)) * (self.pressure / 6.0);
            t.iter().for_each(|v| self.push[*v as usize] += third);
        }
        if let Some(relief) = &self.relief {
            relief.balance(x, &mut self.push);
        }
    }

    /// Adds the forces of the last refresh, N, and returns their energy, J.
    pub fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut energy = 0.0;
        for ((p, x), f) in self.push.iter().zip(x).zip(f) {
            *f += p;
            energy -= p.dot(x);
        }
        energy
    }

    /// The pressure in words, for the report.
    pub fn words(&self) -> String {
        format!(
            "{} Pa along the normals of {} triangles, taken {} times",
            self.pressure,
            self.faces.len(),
            self.refreshes
        )
    }
}

/// Relief of inertia: forces that would only carry cloth away or turn it are spread over its area and taken back.
///
/// A tube with open ends lacks the push on its caps. Where nothing else acts on it, it would slide along its axis for good.
struct Relief {
    /// Area of every vertex at rest, m².
    area: Vec<f64>,
    /// Vertices of each part of the cloth that is free to move or to turn, and the one that is held, if any.
    parts: Vec<(Vec<u32>, Option<u32>)>,
}

impl Relief {
    /// `None` where a body, a load or gravity acts on the cloth. A part that is held in two places is left out.
    fn new(scene: &Scene) -> Option<Self> {
        let acted_on = !scene.loads.is_empty() || scene.body.is_some();
        if acted_on || scene.gravity.norm() > 0.0 {
            return None;
        }
        let part = components(scene.positions.len(), scene.triangles.iter().map(|t| &t.vertices));
        let area = areas(scene);
        let mut vertices: Vec<u32> = (0u32..).zip(&area).filter(|(_, a)| **a > 0.0).map(|(v, _)| v).collect();
        vertices.sort_by_key(|v| (part[*v as usize], *v));
        let pins: Vec<u32> = held(scene).iter().map(|p| p.0).collect();
        let free = |own: &[u32]| {
            let mut held = pins.iter().filter(|p| part[**p as usize] == part[own[0] as usize]);
            let first = held.next().copied();
            held.next().is_none().then(|| (own.to_vec(), first))
        };
        let parts = vertices.chunk_by(|v, w| part[*v as usize] == part[*w as usize]).filter_map(free).collect();
        Some(Self { area, parts })
    }

    /// Takes the sum and the moment of the forces of every part away, or the moment about the vertex that is held.
    fn balance(&self, x: &[Vec3], push: &mut [Vec3]) {
        for (part, held) in &self.parts {
            let each = || part.iter().map(|v| (*v as usize, self.area[*v as usize]));
            let area: f64 = each().map(|(_, a)| a).sum();
            let middle = match held {
                Some(v) => x[*v as usize],
                None => each().map(|(v, a)| x[v] * a).sum::<Vec3>() / area,
            };
            let sum: Vec3 = each().filter(|_| held.is_none()).map(|(v, _)| push[v]).sum();
            let (mut moment, mut inertia) = (Vec3::zeros(), Matrix3::zeros());
            for (v, a) in each() {
                let arm = x[v] - middle;
                moment += arm.cross(&push[v]);
                inertia += (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose()) * a;
            }
            let turn = inertia.try_inverse().map_or_else(Vec3::zeros, |i| i * moment);
            for (v, a) in each() {
                push[v] -= (sum / area + turn.cross(&(x[v] - middle))) * a;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Element;

    /// On a closed surface the forces cancel, their work along a growth is p dV, and their size on a face is p A.
    #[test]
    fn forces_of_a_closed_box_do_the_work_of_its_volume() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
        let positions: Vec<Vec3> = corners.iter().map(|c| Vec3::from_row_slice(c)).collect();
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let triangles = faces.map(|vertices| Element { vertices, rest: [[0.0; 2]; 3], material: 0 }).to_vec();
        let scene = Scene { positions: positions.clone(), triangles: triangles.into(), ..Scene::default() };
        let mut pressure = Pressure::new(&scene, 500.0).unwrap();
        pressure.refresh(&positions);
        let mut f = vec![Vec3::zeros(); 4];
        pressure.evaluate(&positions, &mut f);
        assert!(f.iter().sum::<Vec3>().norm() < 1e-9);
        // Volume 1; growing it by a share s in all directions gains 3 s of it at first.
        let work: f64 = f.iter().zip(&positions).map(|(f, x)| f.dot(x)).sum();
        assert!((work - 500.0 * 3.0).abs() < 1e-9, "{work}");
        assert!((f[0] - Vec3::new(-1.0, -0.5, -1.0 / 3.0) * (500.0 * 3.0 / 3.0)).norm() < 1e-9, "{}", f[0]);
        assert!(Pressure::new(&scene, 0.0).is_none());
    }

    /// A dented sheet has neither a sum nor a moment of forces where nothing holds it. Where a vertex is held, it has no moment
    /// about it. Where two are held, it has both.
    #[test]
    fn forces_on_cloth_that_nothing_holds_neither_carry_nor_turn_it() {
        let positions: Vec<Vec3> =
            (0..6).map(|k| f64::from(k)).map(|k| Vec3::new(k % 3.0, (k / 3.0).floor(), 0.1 * k * k)).collect();
        let faces = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]];
        let rest = |v: u32| [f64::from(v % 3), f64::from(v / 3)];
        let triangles = faces.map(|f: [u32; 3]| Element { vertices: f, rest: f.map(rest), material: 0 }).to_vec();
        let free = Scene { positions: positions.clone(), triangles: triangles.into(), ..Scene::default() };
        let pin = |vertex: u32| crate::Pin { vertex, at: positions[vertex as usize] };
        let held = Scene { pins: vec![pin(0)], ..free.clone() };
        let fixed = Scene { pins: vec![pin(0), pin(5)], ..free.clone() };
        let sums = |scene: &Scene| {
            let mut pressure = Pressure::new(scene, 500.0).unwrap();
            pressure.refresh(&positions);
            let moment: Vec3 = positions.iter().zip(&pressure.push).map(|(x, f)| x.cross(f)).sum();
            (pressure.push.iter().sum::<Vec3>().norm(), moment.norm())
        };
        let [(sum, moment), (pull, about_vertex), (_, turn)] = [&free, &held, &fixed].map(sums);
        assert!(sum < 1e-9 && moment < 1e-9, "{sum} {moment}");
        // Vertex 0 lies at the origin.
        assert!(pull > 100.0 && about_vertex < 1e-9, "{pull} {about_vertex}");
        assert!(turn > 100.0, "{turn}");
    }
}
