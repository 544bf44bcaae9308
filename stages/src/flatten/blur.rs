//! Smoothing over a length of cloth, however fine the mesh is.
//!
//! A field `f` on the triangles of a piece becomes the solution `u` of `u − w² Δu = f` on its vertices, with no flow
//! over the outline. The width `w` is a length, so a finer mesh averages over more triangles. Two legs of a dart have
//! vertices of their own, and so have two pieces: nothing is averaged across a dart or seam. A constant stays as it is.

use super::energy::Local;
use super::metric::edges2;
use super::system::{System, SystemError};
use nalgebra::Matrix2;
use toile_garment::Vec2;

/// The smoothing of one piece.
pub struct Blur {
    system: System,
    triangles: Vec<[u32; 3]>,
    area: Vec<f64>,
}

impl Blur {
    /// Smoothing of width `width` (metres) on a mesh in the plane.
    ///
    /// # Errors
    /// When memory runs out.
    pub fn new(rest: &[Vec2], triangles: &[[u32; 3]], width: f64) -> Result<Self, SystemError> {
        let mut used = vec![false; rest.len()];
        triangles.iter().flatten().for_each(|v| used[*v as usize] = true);
        let held = used.iter().map(|used| [!used; 2]).collect();
        let mut system = System::new(held, triangles.iter().map(<[u32; 3]>::as_slice))?;
        system.clear();
        let mut area = Vec::with_capacity(triangles.len());
        for t in triangles {
            let e = edges2(rest, *t);
            let a = 0.5 * e.determinant();
            area.push(a);
            let sides = [e.column(1) - e.column(0), -e.column(1), e.column(0).into_owned()];
            let mut term = Local { gradient: [Vec2::zeros(); 3], hessian: [[Matrix2::zeros(); 3]; 3] };
            for i in 0..3 {
                for j in 0..3 {
                    let mass = if i == j { a / 3.0 } else { 0.0 };
                    let flow = sides[i].dot(&sides[j]) / (4.0 * a);
                    term.hessian[i][j] = Matrix2::identity() * (mass + width * width * flow);
                }
            }
            system.add(t, &term);
        }
        system.factorize()?;
        Ok(Self { system, triangles: triangles.to_vec(), area })
    }

    /// Smooths two fields at once.
    pub fn pair(&mut self, field: &[Vec2]) -> Vec<Vec2> {
        self.system.rhs.fill(Vec2::zeros());
        for ((t, a), f) in self.triangles.iter().zip(&self.area).zip(field) {
            t.iter().for_each(|v| self.system.rhs[*v as usize] += f * (a / 3.0));
        }
        self.system.substitute();
        let at = |v: u32| self.system.rhs[v as usize];
        self.triangles.iter().map(|t| (at(t[0]) + at(t[1]) + at(t[2])) / 3.0).collect()
    }

    /// Smooths symmetric tensors.
    pub fn tensors(&mut self, field: &[Matrix2<f64>]) -> Vec<Matrix2<f64>> {
        let diagonal = self.pair(&field.iter().map(|m| Vec2::new(m.m11, m.m22)).collect::<Vec<_>>());
        let shear = self.pair(&field.iter().map(|m| Vec2::new(m.m12, 0.0)).collect::<Vec<_>>());
        let tensor = |(d, s): (&Vec2, &Vec2)| Matrix2::new(d.x, s.x, s.x, d.y);
        diagonal.iter().zip(&shear).map(tensor).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of `n × n` cells, 0.2 m wide.
    fn square(n: usize) -> (Vec<Vec2>, Vec<[u32; 3]>) {
        let at = |i: usize| 0.2 * (i as f64) / n as f64;
        let points = (0..=n).flat_map(|i| (0..=n).map(move |j| Vec2::new(at(i), at(j)))).collect();
        let id = |i: usize, j: usize| (i * (n + 1) + j) as u32;
        let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let two = |(i, j)| [[id(i, j), id(i + 1, j), id(i + 1, j + 1)], [id(i, j), id(i + 1, j + 1), id(i, j + 1)]];
        (points, cells.flat_map(two).collect())
    }

    #[test]
    fn a_constant_stays_and_the_width_does_not_depend_on_the_mesh() {
        let mut steps = Vec::new();
        for n in [16, 48] {
            let (points, triangles) = square(n);
            let mut blur = Blur::new(&points, &triangles, 0.02).expect("blur");
            let even = blur.tensors(&vec![Matrix2::identity() * 1.2; triangles.len()]);
            assert!(even.iter().all(|m| (m - Matrix2::identity() * 1.2).norm() < 1e-12));
            // A step in the middle of the square: what is left of it 20 mm away.
            let middle = |t: &[u32; 3]| t.iter().map(|v| points[*v as usize].x).sum::<f64>() / 3.0;
            let field: Vec<Vec2> =
                triangles.iter().map(|t| Vec2::new(f64::from(u8::from(middle(t) > 0.1)), 0.0)).collect();
            let soft = blur.pair(&field);
            let near: Vec<f64> = triangles
                .iter()
                .zip(&soft)
                .filter(|(t, _)| (middle(t) - 0.12).abs() < 0.01)
                .map(|(_, s)| s.x)
                .collect();
            steps.push(near.iter().sum::<f64>() / near.len() as f64);
        }
        // 1 − ½ e^(−x/w) at one width from the step.
        let exact = 1.0 - 0.5 * libm::exp(-1.0);
        assert!(steps.iter().all(|s| (s - exact).abs() < 0.02), "{steps:?} {exact}");
    }
}
