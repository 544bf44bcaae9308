//! A strip rolled onto cylinders and back: the loop is as wide as 2HB, and the forces are minus the gradient.

use crate::energy::hysteresis::held::*;
use crate::{Bending, Element, Scene};

const FRICTION: f64 = 2e-4;
const CELL: f64 = 0.005;

/// A strip of 12 by 4 cells along the warp.
fn strip() -> (Scene, Hysteresis) {
    let (n, m) = (12u32, 4u32);
    let rest = |i: u32, j: u32| [CELL * f64::from(i), CELL * f64::from(j)];
    let mut scene = Scene {
        materials: vec![Material {
            bending: Bending { friction: FRICTION, ..Bending::isotropic(1e-5) },
            ..Material::isotropic(0.15, 500.0, 0.0, 1e-5)
        }],
        ..Scene::default()
    };
    for j in 0..=n {
        for i in 0..=m {
            let [x, y] = rest(i, j);
            scene.positions.push(Vec3::new(x, y, 0.0));
        }
    }
    for (i, j) in (0..n).flat_map(|j| (0..m).map(move |i| (i, j))) {
        let q = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        for c in [[0, 1, 2], [0, 2, 3]] {
            let vertices = c.map(|k: usize| q[k].1 * (m + 1) + q[k].0);
            scene.triangles.push(Element { vertices, rest: c.map(|k| rest(q[k].0, q[k].1)), material: 0 });
        }
    }
    let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
    let held = Hysteresis::new(&scene, &topology).expect("there is friction");
    (scene, held)
}

/// Rolled up along the warp with this curvature, 1/m.
fn rolled(scene: &Scene, curvature: f64) -> Vec<Vec3> {
    let roll = |p: &Vec3| {
        let turn = curvature * p.y;
        let (out, up) =
            if turn == 0.0 { (p.y, 0.0) } else { (libm::sin(turn) / curvature, (1.0 - libm::cos(turn)) / curvature) };
        Vec3::new(p.x, out, up)
    };
    scene.positions.iter().map(roll).collect()
}

/// Moment per width at a curvature: the derivative of the energy over the area that bends.
///
/// Triangles with a free side across do not bend; they are at the ends.
fn moment(scene: &Scene, held: &Hysteresis, curvature: f64) -> f64 {
    let mut f = vec![Vec3::zeros(); scene.positions.len()];
    let h = 1e-4;
    let energy = |k: f64, f: &mut [Vec3]| held.evaluate(&rolled(scene, k), f);
    let slope = (energy(curvature + h, &mut f) - energy(curvature - h, &mut f)) / (2.0 * h);
    slope / (scene.triangles.iter().map(Element::area).sum::<f64>() * 11.0 / 12.0)
}

#[test]
fn a_loop_of_bending_is_as_wide_as_2hb() {
    let (scene, mut held) = strip();
    let to = |held: &mut Hysteresis, from: f64, to: f64| {
        for k in 1..=40 {
            held.refresh(&rolled(&scene, from + (to - from) * f64::from(k) / 40.0));
        }
        moment(&scene, held, to)
    };
    let up = to(&mut held, 0.0, 20.0);
    to(&mut held, 20.0, 40.0);
    let down = to(&mut held, 40.0, 20.0);
    assert!(((up - down) / (2.0 * FRICTION) - 1.0).abs() < 0.02, "{up} and {down}");
    assert!((up / FRICTION - 1.0).abs() < 0.02, "{up}");
}

#[test]
fn friction_holds_what_bends_little() {
    let (scene, mut held) = strip();
    held.refresh(&scene.positions);
    let little = 0.5 * FRICTION_BUILD_UP.get() / scene.materials[0].bending_length();
    assert!((moment(&scene, &held, little) / (0.5 * FRICTION) - 1.0).abs() < 0.02);
    held.refresh(&rolled(&scene, little));
    assert_eq!((held.slip, held.largest), (0, 0.0));
}

#[test]
fn forces_are_minus_the_gradient() {
    let (scene, mut held) = strip();
    held.refresh(&rolled(&scene, 3.0));
    for curvature in [3.2, 4.5, -8.0] {
        let mut x = rolled(&scene, curvature);
        let n = x.len();
        let mut f = vec![Vec3::zeros(); n];
        held.evaluate(&x, &mut f);
        let size = f.iter().map(|f| f.amax()).fold(0.0, f64::max);
        let mut unused = vec![Vec3::zeros(); n];
        for (i, c) in (0..n).flat_map(|i| (0..3).map(move |c| (i, c))) {
            let keep = x[i][c];
            let mut at = |d: f64, x: &mut Vec<Vec3>| {
                x[i][c] = keep + d;
                held.evaluate(x, &mut unused)
            };
            let slope = (at(1e-8, &mut x) - at(-1e-8, &mut x)) / 2e-8;
            x[i][c] = keep;
            assert!((f[i][c] + slope).abs() < 1e-4 * size, "vertex {i}: {} and {slope}", f[i][c]);
        }
    }
}
