//! Measurements on a sewn surface.

use crate::support::mesh::{Mesh, area};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use toile_garment::Vec3;

/// Sewn vertices as one: the lowest index of every group.
pub fn welded(count: usize, stitches: &[[usize; 2]]) -> Vec<usize> {
    let mut group: Vec<usize> = (0..count).collect();
    // Chains of stitches are short; a few rounds settle them.
    for _ in 0..8 {
        for [a, b] in stitches {
            let low = group[*a].min(group[*b]);
            (group[*a], group[*b]) = (low, low);
        }
        group = group.iter().map(|g| group[*g]).collect();
    }
    group
}

/// Angle deficit (rad) of every inner vertex of the sewn surface, by its lowest index.
pub fn deficits(mesh: &Mesh, at: &[Vec3], group: &[usize]) -> BTreeMap<usize, f64> {
    let mut sum: BTreeMap<usize, f64> = BTreeMap::new();
    let mut edges: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for t in &mesh.triangles {
        for k in 0..3 {
            let [a, b, c] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
            let (p, q) = (at[b] - at[a], at[c] - at[a]);
            *sum.entry(group[a]).or_default() += libm::atan2(p.cross(&q).norm(), p.dot(&q));
            let (u, v) = (group[a], group[b]);
            *edges.entry((u.min(v), u.max(v))).or_default() += 1;
        }
    }
    for (u, v) in edges.iter().filter(|e| *e.1 == 1).map(|e| *e.0) {
        sum.remove(&u);
        sum.remove(&v);
    }
    sum.into_iter().map(|(v, angle)| (v, TAU - angle)).collect()
}

/// Largest stretch or squeeze of any direction over the triangles that `counts`.
pub fn largest_strain(mesh: &Mesh, at: &[Vec3], counts: impl Fn(&[usize; 3]) -> bool) -> f64 {
    mesh.triangles.iter().filter(|t| counts(t)).map(|t| strain(mesh, at, t)).fold(0.0, f64::max)
}

fn strain(mesh: &Mesh, at: &[Vec3], t: &[usize; 3]) -> f64 {
    let [a, b, c] = t.map(|i| mesh.rest[i]);
    let (p, q) = (at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
    let (e, f) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let det = 2.0 * area(&mesh.rest, t);
    let (u, v) = ((p * f[1] - q * e[1]) / det, (q * e[0] - p * f[0]) / det);
    let (uu, vv, uv) = (u.norm_squared(), v.norm_squared(), u.dot(&v));
    let (mean, spread) = (0.5 * (uu + vv), libm::hypot(0.5 * (uu - vv), uv));
    ((mean + spread).sqrt() - 1.0).max(1.0 - (mean - spread).max(0.0).sqrt())
}

/// A cone through points: its axis, half angle and the radius and height of any point over the fitted axis.
pub struct Fit {
    pub half_angle: f64,
    pub axis: Vec3,
    pub tip: Vec3,
}

/// Least squares: from a first axis, Gauss–Newton on the distance `(p − tip)·axis · sin α − radius · cos α`.
pub fn cone(points: &[Vec3], tip: Vec3, axis: Vec3) -> Fit {
    let mut fit = Fit { half_angle: first_angle(points, tip, axis), axis: axis.normalize(), tip };
    for _ in 0..50 {
        let (side, other) = frame(&fit.axis);
        let turned = |d: [f64; 6]| Fit {
            half_angle: fit.half_angle + d[0],
            axis: (fit.axis + side * d[1] + other * d[2]).normalize(),
            tip: fit.tip + side * d[3] + other * d[4] + fit.axis * d[5],
        };
        let residual = |f: &Fit| -> Vec<f64> { points.iter().map(|p| f.distance(*p)).collect() };
        let base = residual(&fit);
        let step = 1e-7;
        let columns: Vec<Vec<f64>> = (0..6)
            .map(|k| {
                let mut d = [0.0; 6];
                d[k] = step;
                residual(&turned(d)).iter().zip(&base).map(|(a, b)| (a - b) / step).collect()
            })
            .collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let mut matrix = [[0.0; 7]; 6];
        for i in 0..6 {
            for j in 0..6 {
                matrix[i][j] = dot(&columns[i], &columns[j]);
            }
            matrix[i][i] *= 1.0 + 1e-9;
            matrix[i][6] = -dot(&columns[i], &base);
        }
        let d = solve(matrix);
        fit = turned(d);
        if d.iter().all(|x| x.abs() < 1e-12) {
            break;
        }
    }
    fit
}

impl Fit {
    fn distance(&self, p: Vec3) -> f64 {
        let d = p - self.tip;
        let along = d.dot(&self.axis);
        let radius = (d - self.axis * along).norm();
        radius * libm::cos(self.half_angle) - along * libm::sin(self.half_angle)
    }

    /// Distance from the axis, and along it from the tip.
    pub fn place(&self, p: Vec3) -> [f64; 2] {
        let d = p - self.tip;
        let along = d.dot(&self.axis);
        [(d - self.axis * along).norm(), along]
    }
}

fn first_angle(points: &[Vec3], tip: Vec3, axis: Vec3) -> f64 {
    let axis = axis.normalize();
    let of = |p: &Vec3| {
        let d = p - tip;
        libm::atan2((d - axis * d.dot(&axis)).norm(), d.dot(&axis))
    };
    points.iter().map(of).sum::<f64>() / points.len() as f64
}

fn frame(axis: &Vec3) -> (Vec3, Vec3) {
    let other = if axis.x.abs() < 0.7 { Vec3::x() } else { Vec3::y() };
    let side = axis.cross(&other).normalize();
    (side, axis.cross(&side))
}

/// Gauss's elimination with the largest pivot.
fn solve(mut m: [[f64; 7]; 6]) -> [f64; 6] {
    for k in 0..6 {
        let best = (k..6).max_by(|a, b| m[*a][k].abs().total_cmp(&m[*b][k].abs())).expect("a row");
        m.swap(k, best);
        for i in k + 1..6 {
            let share = m[i][k] / m[k][k];
            let row = m[k];
            m[i].iter_mut().zip(row).for_each(|(x, y)| *x -= share * y);
        }
    }
    let mut x = [0.0; 6];
    for i in (0..6).rev() {
        let known: f64 = (i + 1..6).map(|j| m[i][j] * x[j]).sum();
        x[i] = (m[i][6] - known) / m[i][i];
    }
    x
}
