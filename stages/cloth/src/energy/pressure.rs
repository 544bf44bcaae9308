//! Pressure across the cloth, along the normal of every triangle (docs/pressure.md).
//!
//! On cloth with a rim no potential has these forces, so they are constant between two refreshes.

use crate::{Scene, Vec3};

/// The pressure on a cloth.
pub(crate) struct Pressure {
    /// Pressure, Pa.
    pressure: f64,
    faces: Vec<[u32; 3]>,
    /// Force on every vertex at the last refresh, N.
    push: Vec<Vec3>,
    refreshes: u64,
}

impl Pressure {
    /// `None` without pressure.
    pub fn new(scene: &Scene, pressure: f64) -> Option<Self> {
        (pressure != 0.0).then(|| {
            let faces = scene.triangles.iter().map(|t| t.vertices).collect();
            Self { pressure, faces, push: vec![Vec3::zeros(); scene.positions.len()], refreshes: 0 }
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
}
