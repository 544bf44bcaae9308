//! Small scenes.
#![allow(dead_code, clippy::unwrap_used)]

use toile_cloth::{Bending, BodyMesh, Curve, Element, Material, Scene, Vec3};

/// A linear orthotropic fabric without bending, friction or limit.
pub fn linear(areal_mass: f64, warp: f64, weft: f64, shear: f64) -> Material {
    Material {
        areal_mass,
        thickness: 3e-4,
        friction: 0.0,
        warp: Curve::Linear { stiffness: warp },
        weft: Curve::Linear { stiffness: weft },
        shear,
        shear_curve: None,
        poisson: 0.0,
        bending: Bending::default(),
        springs: None,
        strain_limit: [f64::INFINITY; 3],
    }
}

/// A light cotton.
pub fn cotton() -> Material {
    Material {
        friction: 0.3,
        bending: Bending { warp: 8e-6, weft: 5e-6, ..Bending::default() },
        ..linear(0.115, 1000.0, 800.0, 45.0)
    }
}

/// A `nx` × `ny` grid of squares cut into triangles, x along the weft, y along the warp; `place` puts a rest point in
/// the world.
pub fn sheet(w: f64, h: f64, nx: u32, ny: u32, material: Material, place: impl Fn(f64, f64) -> Vec3) -> Scene {
    let at = |i: u32, j: u32| [w * f64::from(i) / f64::from(nx), h * f64::from(j) / f64::from(ny)];
    let id = |i: u32, j: u32| j * (nx + 1) + i;
    let mut scene = Scene { materials: vec![material], ..Scene::default() };
    for j in 0..=ny {
        for i in 0..=nx {
            let [x, y] = at(i, j);
            scene.positions.push(place(x, y));
        }
    }
    for j in 0..ny {
        for i in 0..nx {
            let q = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let cut = if (i + j) % 2 == 0 { [[0, 1, 2], [0, 2, 3]] } else { [[0, 1, 3], [1, 2, 3]] };
            for c in cut {
                let k = c.map(|k: usize| q[k]);
                scene.triangles.push(Element {
                    vertices: k.map(|(i, j)| id(i, j)),
                    rest: k.map(|(i, j)| at(i, j)),
                    material: 0,
                });
            }
        }
    }
    scene
}

/// Adds another scene's cloth; returns the shift of its vertex numbers.
pub fn add(scene: &mut Scene, other: &Scene) -> u32 {
    let shift = u32::try_from(scene.positions.len()).unwrap();
    let materials = u32::try_from(scene.materials.len()).unwrap();
    scene.positions.extend_from_slice(&other.positions);
    scene.materials.extend_from_slice(&other.materials);
    scene.triangles.extend(other.triangles.iter().map(|t| Element {
        vertices: t.vertices.map(|v| v + shift),
        material: t.material + materials,
        ..*t
    }));
    scene.stitches.extend(other.stitches.iter().map(|s| s.map(|v| v + shift)));
    shift
}

/// A closed sphere of `n` × 2n quads.
pub fn sphere(centre: Vec3, radius: f64, n: u32) -> BodyMesh {
    let mut body = BodyMesh::default();
    let m = 2 * n;
    body.positions.push(centre + Vec3::new(0.0, radius, 0.0));
    for i in 1..n {
        let (st, ct) = libm::sincos(std::f64::consts::PI * f64::from(i) / f64::from(n));
        for j in 0..m {
            let (sp, cp) = libm::sincos(2.0 * std::f64::consts::PI * f64::from(j) / f64::from(m));
            body.positions.push(centre + Vec3::new(st * cp, ct, -st * sp) * radius);
        }
    }
    body.positions.push(centre - Vec3::new(0.0, radius, 0.0));
    let last = u32::try_from(body.positions.len()).unwrap() - 1;
    let id = |i: u32, j: u32| 1 + (i - 1) * m + j % m;
    for j in 0..m {
        body.triangles.push([0, id(1, j), id(1, j + 1)]);
        for i in 1..n - 1 {
            body.triangles.push([id(i, j), id(i + 1, j), id(i + 1, j + 1)]);
            body.triangles.push([id(i, j), id(i + 1, j + 1), id(i, j + 1)]);
        }
        body.triangles.push([id(n - 1, j), last, id(n - 1, j + 1)]);
    }
    body
}

/// A triangle laid into a plane of its own, its first edge along the weft.
pub fn flat([a, b, c]: [Vec3; 3]) -> [[f64; 2]; 3] {
    let (e, d) = ((b - a).normalize(), c - a);
    let x = d.dot(&e);
    [[0.0, 0.0], [(b - a).norm(), 0.0], [x, (d - e * x).norm()]]
}

/// Moves every vertex that is not held by up to 0.1 mm along each axis, another way for every seed.
pub fn jitter(scene: &mut Scene, seed: u32) {
    let held: Vec<u32> = scene.pins.iter().map(|p| p.vertex).collect();
    for (v, p) in (0u32..).zip(&mut scene.positions).filter(|(v, _)| !held.contains(v)) {
        (0..3).for_each(|k| p[k as usize] += 1e-4 * noise(seed.wrapping_mul(1_000_003).wrapping_add(3 * v + k)));
    }
}

/// The same numbers every time, in −1..1.
pub fn noise(seed: u32) -> f64 {
    let mut h = seed.wrapping_mul(0x9E37_79B9) ^ 0x85EB_CA6B;
    for _ in 0..3 {
        h ^= h >> 15;
        h = h.wrapping_mul(0x2C1B_3C6D);
        h ^= h >> 12;
    }
    f64::from(h) / f64::from(u32::MAX) * 2.0 - 1.0
}

/// `nx` × `ny` cells of equilateral triangles in the plane y = 0, rows along x (weft), z along the warp.
pub fn regular(nx: u32, ny: u32, side: f64, material: Material) -> Scene {
    let row = side * 0.75f64.sqrt();
    let at = |i: u32, j: u32| [side * (f64::from(i) + 0.5 * f64::from(j % 2)), row * f64::from(j)];
    let id = |i: u32, j: u32| j * (nx + 1) + i;
    let mut scene = Scene { materials: vec![material], ..Scene::default() };
    for j in 0..=ny {
        for i in 0..=nx {
            let [x, z] = at(i, j);
            scene.positions.push(Vec3::new(x, 0.0, z));
        }
    }
    for j in 0..ny {
        for i in 0..nx {
            let q = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            for c in if j % 2 == 0 { [[0, 1, 3], [1, 2, 3]] } else { [[0, 1, 2], [0, 2, 3]] } {
                let k = c.map(|k: usize| q[k]);
                scene.triangles.push(Element {
                    vertices: k.map(|(i, j)| id(i, j)),
                    rest: k.map(|(i, j)| at(i, j)),
                    material: 0,
                });
            }
        }
    }
    scene
}

/// A closed upright cylinder of `n` sides.
pub fn post(radius: f64, height: f64, n: u32) -> BodyMesh {
    let mut body =
        BodyMesh { positions: vec![Vec3::y() * (0.5 * height), Vec3::y() * (-0.5 * height)], triangles: vec![] };
    for j in 0..n {
        let (s, c) = libm::sincos(2.0 * std::f64::consts::PI * f64::from(j) / f64::from(n));
        for y in [0.5, -0.5] {
            body.positions.push(Vec3::new(radius * c, y * height, -radius * s));
        }
    }
    for j in 0..n {
        let (a, b) = (2 + 2 * j, 2 + 2 * ((j + 1) % n));
        body.triangles.extend([[0, a, b], [1, b + 1, a + 1], [a, a + 1, b + 1], [a, b + 1, b]]);
    }
    body
}
