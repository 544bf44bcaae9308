//! Differences of the draped surfaces, before and after the best alignment.
//!
//! The alignment is the rigid motion that brings cloth of the one to the same cloth of the other with the least sum of
//! squared distances. It is Horn's: the eigenvector of a symmetric 4 × 4 matrix is the turn as a quaternion.

use super::change::{Change, Group};
use crate::study::measure::distance;
use toile_garment::{Garment, Vec3};
use toile_stages::fit::Surface;

/// Distances below this are not told, mm.
const LEAST_MM: f64 = 1e-3;
/// Points that the alignment looks at.
const SAMPLES: usize = 400;
/// Rounds of nearest points and motions, where the meshes differ.
const ROUNDS: usize = 8;

/// A rigid motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Turn, rows.
    pub turn: [[f64; 3]; 3],
    /// Move after the turn, metres.
    pub shift: [f64; 3],
}

impl Motion {
    const NONE: Self = Self { turn: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], shift: [0.0; 3] };

    /// A point after the motion.
    #[must_use]
    pub fn apply(&self, p: &Vec3) -> Vec3 {
        let row = |k: usize| Vec3::from(self.turn[k]).dot(p) + self.shift[k];
        Vec3::new(row(0), row(1), row(2))
    }

    /// Angle of the turn, degrees.
    #[must_use]
    pub fn degrees(&self) -> f64 {
        let trace = self.turn[0][0] + self.turn[1][1] + self.turn[2][2];
        libm::acos((0.5 * (trace - 1.0)).clamp(-1.0, 1.0)).to_degrees()
    }
}

pub fn changes(a: &Garment, b: &Garment) -> Vec<Change> {
    let (Some(a), Some(b)) = (Surface::of(a), Surface::of(b)) else { return Vec::new() };
    if a.triangles.is_empty() || b.triangles.is_empty() {
        return Vec::new();
    }
    let motion = best_motion(&b, &a);
    let moved = Surface { points: b.points.iter().map(|p| motion.apply(p)).collect(), ..b.clone() };
    let names = ["mean", "95 % below", "largest"];
    let told = |when: &str, figures: [f64; 3]| {
        let one = |(name, mm): (&str, f64)| {
            Change::moved(Group::Shape, format!("distance of the surfaces {when}, {name}"), mm, "mm", LEAST_MM)
        };
        names.into_iter().zip(figures).filter_map(one).collect::<Vec<_>>()
    };
    let mut found = told("after alignment", distance(&a, &moved));
    found.extend(told("as they hang", distance(&a, &b)));
    let shift = 1e3 * middle_move(&b, &motion);
    found.extend(Change::moved(Group::Shape, "alignment, shift of the middle", shift, "mm", LEAST_MM));
    found.extend(Change::moved(Group::Shape, "alignment, turn", motion.degrees(), "°", 1e-3));
    found
}

/// How far the middle of the cloth moves.
fn middle_move(surface: &Surface, motion: &Motion) -> f64 {
    let middle = surface.points.iter().sum::<Vec3>() / surface.points.len().max(1) as f64;
    (motion.apply(&middle) - middle).norm()
}

/// The motion of `from` that brings it nearest to `to`. With the same mesh a vertex belongs to its namesake. Else it
/// belongs to the nearest vertex, which is sought again after every motion.
fn best_motion(from: &Surface, to: &Surface) -> Motion {
    let step = (from.points.len() / SAMPLES).max(1);
    let chosen: Vec<Vec3> = from.points.iter().step_by(step).copied().collect();
    if from.triangles == to.triangles && from.points.len() == to.points.len() {
        let partners: Vec<Vec3> = to.points.iter().step_by(step).copied().collect();
        return align(&chosen, &partners);
    }
    let nearest = |p: Vec3| {
        let best = to.points.iter().min_by(|a, b| (*a - p).norm_squared().total_cmp(&(*b - p).norm_squared()));
        best.copied().unwrap_or(p)
    };
    let mut motion = Motion::NONE;
    for _ in 0..ROUNDS {
        let partners: Vec<Vec3> = chosen.iter().map(|p| nearest(motion.apply(p))).collect();
        motion = align(&chosen, &partners);
    }
    motion
}

/// The rigid motion of points with the least sum of squared distances to their partners.
#[must_use]
pub fn align(points: &[Vec3], partners: &[Vec3]) -> Motion {
    let count = points.len().min(partners.len()).max(1) as f64;
    let middle = |all: &[Vec3]| all.iter().sum::<Vec3>() / count;
    let (p, q) = (middle(points), middle(partners));
    let mut s = [[0.0; 3]; 3];
    for (a, b) in points.iter().zip(partners) {
        let (a, b) = (a - p, b - q);
        for (i, row) in s.iter_mut().enumerate() {
            for (j, cell) in row.iter_mut().enumerate() {
                *cell += a[i] * b[j];
            }
        }
    }
    let [w, x, y, z] = top_eigenvector(horn(&s));
    let turn = [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ];
    let turned = Motion { turn, shift: [0.0; 3] }.apply(&p);
    Motion { turn, shift: [q.x - turned.x, q.y - turned.y, q.z - turned.z] }
}

/// Horn's matrix of the sums of products.
fn horn(s: &[[f64; 3]; 3]) -> [[f64; 4]; 4] {
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = *s;
    [
        [xx + yy + zz, yz - zy, zx - xz, xy - yx],
        [yz - zy, xx - yy - zz, xy + yx, zx + xz],
        [zx - xz, xy + yx, yy - xx - zz, yz + zy],
        [xy - yx, zx + xz, yz + zy, zz - xx - yy],
    ]
}

/// The eigenvector of the largest eigenvalue of a symmetric matrix, by Jacobi's rotations.
fn top_eigenvector(mut m: [[f64; 4]; 4]) -> [f64; 4] {
    let mut v = [[0.0; 4]; 4];
    (0..4).for_each(|k| v[k][k] = 1.0);
    for _ in 0..32 {
        for p in 0..3 {
            for q in p + 1..4 {
                if m[p][q] != 0.0 {
                    rotate(&mut m, &mut v, p, q);
                }
            }
        }
    }
    let top = (0..4).max_by(|a, b| m[*a][*a].total_cmp(&m[*b][*b])).unwrap_or(0);
    [v[0][top], v[1][top], v[2][top], v[3][top]]
}

fn rotate(m: &mut [[f64; 4]; 4], v: &mut [[f64; 4]; 4], p: usize, q: usize) {
    let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    let turn = |a: f64, b: f64| (c * a - s * b, s * a + c * b);
    for row in m.iter_mut() {
        (row[p], row[q]) = turn(row[p], row[q]);
    }
    let (above, below) = (m[p], m[q]);
    for (k, (a, b)) in above.into_iter().zip(below).enumerate() {
        (m[p][k], m[q][k]) = turn(a, b);
    }
    for row in v {
        (row[p], row[q]) = turn(row[p], row[q]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_and_a_shift_are_found() {
        let points: Vec<Vec3> =
            (0..30_i32).map(|k| Vec3::new(f64::from(k % 5), f64::from(k % 7), f64::from(k % 3))).collect();
        let (s, c) = libm::sincos(0.3);
        let turn = |p: &Vec3| Vec3::new(c * p.x + s * p.z + 0.1, p.y - 0.2, -s * p.x + c * p.z + 0.3);
        let partners: Vec<Vec3> = points.iter().map(turn).collect();
        let motion = align(&points, &partners);
        let worst = points.iter().zip(&partners).map(|(p, q)| (motion.apply(p) - q).norm()).fold(0.0, f64::max);
        assert!(worst < 1e-12, "{worst}");
        assert!((motion.degrees() - 0.3_f64.to_degrees()).abs() < 1e-9);
    }
}
