//! Bodies: closed meshes.

use super::Mesh;
use std::f64::consts::TAU;
use toile_garment::Vec3;

/// An elliptic cylinder along y, half axes `a` (x) and `b` (z), with flat ends. The corners lie outside of the ellipse
/// by as much as the middles of the faces lie inside.
pub fn cylinder(a: f64, b: f64, from: f64, to: f64, sides: usize) -> Mesh {
    let half = TAU / 2.0 / sides as f64;
    let grow = 2.0 / (1.0 + libm::cos(half));
    let mut at = Vec::new();
    for y in [from, to] {
        for i in 0..sides {
            let t = TAU * i as f64 / sides as f64;
            at.push(Vec3::new(grow * a * libm::cos(t), y, grow * b * libm::sin(t)));
        }
        at.push(Vec3::new(0.0, y, 0.0));
    }
    let second = sides + 1;
    let mut triangles = Vec::new();
    for i in 0..sides {
        let j = (i + 1) % sides;
        triangles.push([i, i + second, j]);
        triangles.push([j, i + second, j + second]);
        triangles.push([sides, i, j]);
        triangles.push([second + sides, second + j, second + i]);
    }
    Mesh { at, rest: Vec::new(), triangles }
}

/// A slab whose upper face goes through the origin, `size` (x, y) and `thick` deep, turned about y so that +x goes
/// down by `slope` (rad).
pub fn slab(size: [f64; 2], thick: f64, slope: f64) -> Mesh {
    let (s, c) = (libm::sin(slope), libm::cos(slope));
    let mut at = Vec::new();
    for z in [0.0, -thick] {
        for (x, y) in [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)] {
            let (x, y) = (x * size[0], y * size[1]);
            at.push(Vec3::new(c * x + s * z, y, -s * x + c * z));
        }
    }
    let triangles = vec![
        [0, 1, 2],
        [0, 2, 3],
        [4, 6, 5],
        [4, 7, 6],
        [0, 4, 5],
        [0, 5, 1],
        [1, 5, 6],
        [1, 6, 2],
        [2, 6, 7],
        [2, 7, 3],
        [3, 7, 4],
        [3, 4, 0],
    ];
    Mesh { at, rest: Vec::new(), triangles }
}
