//! Steps per second of a draping sheet on a ball: `cargo bench -p toile-cloth`. Prints one line per size and model.
#![allow(clippy::print_stdout, clippy::expect_used)]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{cotton, sheet, sphere};
use std::time::Instant;
use toile_cloth::{ExplicitSteps, Model, Settings, Silent, Vec3, drape};

fn main() {
    for n in [24, 34, 50] {
        for model in [Model::Springs, Model::Coupled] {
            let mut scene = sheet(0.6, 0.6, n, n, cotton(), |x, y| Vec3::new(x - 0.3, 0.152, y - 0.3));
            scene.gravity = Vec3::new(0.0, -9.81, 0.0);
            scene.body = Some(sphere(Vec3::zeros(), 0.15, 32).into());
            let explicit = ExplicitSteps { max_steps: 4_000, ..ExplicitSteps::default() };
            let settings = Settings { model, explicit, ..Settings::default() };
            let start = Instant::now();
            let out = drape(&scene, &settings, &mut Silent).expect("the scene is sound");
            let seconds = start.elapsed().as_secs_f64();
            let per_step = seconds / out.steps as f64;
            let triangles = scene.triangles.len();
            println!(
                "{triangles} triangles, {model:?}: {:.0} steps/s, {:.1} ns per triangle and step, {:.3} s simulated",
                1.0 / per_step,
                per_step * 1e9 / triangles as f64,
                out.seconds
            );
        }
    }
}
