//! Time to rest of whole scenes, of the kinds that solvers are compared on: `cargo bench -p toile-cloth --bench
//! scenes`. One line per scene and start; starts differ by a jitter of 0.1 mm. Compare ratios within one run: machines
//! are noisy.
#![allow(clippy::print_stdout, clippy::expect_used)]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{flat, jitter, sheet, sphere};
use std::time::Instant;
use toile_cloth::{Element, Material, Pin, Scene, Settings, Silent, Vec3, certify, drape};

/// Cotton as the comparison uses it: 500 N/m with a Poisson ratio of 0.3, 10 µN·m, 0.15 kg/m²; it locks at 1.2 % along
/// warp, weft and bias.
fn cotton() -> Material {
    Material { thickness: 5e-4, friction: 0.3, strain_limit: [0.012; 3], ..Material::isotropic(0.15, 500.0, 0.3, 1e-5) }
}

/// A square metre, flat, held at two corners.
fn hanging(n: u32) -> Scene {
    let mut scene = sheet(1.0, 1.0, n, n, cotton(), |x, y| Vec3::new(x, 0.0, y));
    scene.pins = [0, n].iter().map(|v| Pin { vertex: *v, at: scene.positions[*v as usize] }).collect();
    scene
}

/// A skirt as an importer gives it, every triangle with axes of its own: a cone from 72 to 222 cm of girth, held at the
/// waist, over a ball.
fn skirt(rows: u32) -> Scene {
    let around = rows * 8 / 5;
    let mut scene = Scene { materials: vec![cotton()], ..Scene::default() };
    for j in 0..=rows {
        let part = f64::from(j) / f64::from(rows);
        for i in 0..around {
            let turn = std::f64::consts::TAU * (f64::from(i) + 0.5 * f64::from(j % 2)) / f64::from(around);
            let r = 0.115 + 0.24 * part;
            scene.positions.push(Vec3::new(r * libm::cos(turn), -0.6 * part, r * libm::sin(turn)));
        }
    }
    let at = |i: u32, j: u32| j * around + i % around;
    for j in 0..rows {
        let o = j % 2;
        for i in 0..around {
            for t in [[at(i, j), at(i + o, j + 1), at(i + 1, j)], [at(i + 1 - o, j), at(i, j + 1), at(i + 1, j + 1)]] {
                scene.triangles.push(Element {
                    vertices: t,
                    rest: flat(t.map(|v| scene.positions[v as usize])),
                    material: 0,
                });
            }
        }
    }
    scene.pins = (0..around).map(|v| Pin { vertex: v, at: scene.positions[v as usize] }).collect();
    scene.body = Some(sphere(Vec3::new(0.0, -0.22, 0.0), 0.17, 48).into());
    scene
}

fn main() {
    for (name, scene) in
        [("hanging square", hanging(40)), ("hanging square", hanging(80)), ("skirt", skirt(28)), ("skirt", skirt(56))]
    {
        for seed in 1..=3 {
            let mut scene = scene.clone();
            scene.gravity = Vec3::new(0.0, -9.81, 0.0);
            jitter(&mut scene, seed);
            let start = Instant::now();
            let out = drape(&scene, &Settings::default(), &mut Silent).expect("the scene is sound");
            let seconds = start.elapsed().as_secs_f64();
            let f = certify(&scene, &Settings::default(), &out.positions).expect("the scene is sound");
            println!(
                "{name}, {} triangles, start {seed}: {} after {seconds:.2} s and {} steps, {:.4} mJ elastic, {} crossings",
                scene.triangles.len(),
                out.stop_reason.words(),
                out.steps,
                out.energy * 1e3,
                f.self_crossings + f.body_crossings
            );
        }
    }
}
