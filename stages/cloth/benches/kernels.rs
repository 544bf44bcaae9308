//! The hot kernels of a descent, each by itself: `cargo bench -p toile-cloth --bench kernels`. Times are the best of 15
//! runs; machines are noisy. Instructions, which are not (one kernel at one size, 2,000, 10,000 or 40,000 triangles):
//!
//!     cargo bench -p toile-cloth --bench kernels --no-run      # prints the name of the program
//!     valgrind --tool=callgrind --collect-atstart=no --toggle-collect='*measured*' PROGRAM forces 10000
#![allow(clippy::print_stdout, clippy::expect_used)]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{cotton, sheet, sphere};
use std::hint::black_box;
use std::time::Instant;
use toile_cloth::kernels::Kernels;
use toile_cloth::{Scene, Settings, Vec3};

const NAMES: [&str; 5] = ["forces", "assemble", "factor", "solve", "lists"];
const SIZES: [u32; 3] = [2_000, 10_000, 40_000];
const RUNS: usize = 15;

/// A tube over a ball.
fn tube(triangles: u32) -> Scene {
    let n = libm::round(libm::sqrt(f64::from(triangles) / 2.0)) as u32;
    let round = |x: f64, y: f64| {
        let (s, c) = libm::sincos(x * 10.0);
        Vec3::new(s * (0.11 + 0.02 * y), y - 0.3, c * (0.11 + 0.02 * y))
    };
    let mut scene = sheet(0.62, 0.6, n, n, cotton(), round);
    scene.gravity = Vec3::new(0.0, -9.81, 0.0);
    scene.body = Some(sphere(Vec3::zeros(), 0.108, 48).into());
    scene
}

#[inline(never)]
fn measured(kernel: &str, k: &mut Kernels<'_>) {
    match kernel {
        "forces" => k.forces(),
        "assemble" => k.assemble(),
        "factor" => assert!(black_box(k.factor()), "the system can be factorised"),
        "solve" => k.solve(),
        _ => k.lists(),
    }
}

fn main() {
    let settings = Settings::default();
    let args: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let asked: Option<u32> = args.get(1).and_then(|n| n.parse().ok());
    for size in SIZES.into_iter().filter(|s| asked.is_none_or(|n| n == *s)) {
        let scene = tube(size);
        let mut k = Kernels::new(&scene, &settings).expect("the scene is sound");
        assert!(k.factor(), "the system can be factorised");
        k.lists();
        for name in NAMES.into_iter().filter(|n| args.first().is_none_or(|a| a == n)) {
            let runs = if asked.is_some() { 1 } else { RUNS };
            let time = |_: usize| {
                let start = Instant::now();
                measured(name, &mut k);
                start.elapsed().as_secs_f64()
            };
            let best = (0..runs).map(time).fold(f64::INFINITY, f64::min);
            println!("{name} of {} triangles: {:.3} ms", scene.triangles.len(), best * 1e3);
        }
    }
}
