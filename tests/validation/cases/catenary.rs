//! Strips between two level ends.

use crate::case::{Case, case, share};
use crate::closed::{G, catenary};
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::mesh::{Family, sheet};
use crate::support::trial::Trial;
use toile_garment::Vec3;

const ROWS: usize = 60;
const WIDTH: f64 = 0.04;
const W: f64 = 1.962;

pub fn cases() -> Vec<Case> {
    vec![
        case("catenary-0", |lab: &mut Lab| {
            // The public case asks for K ≥ 1e4 w L.
            let expected = catenary::rigid(1.0, 1.2, W);
            hang(lab, 1.2, 1e4 * W * 1.2, &expected, false)
        }),
        case("elastic-catenary-0", |lab: &mut Lab| hang(lab, 1.1, 40.0, &catenary::elastic(1.0, 1.1, W, 40.0), true)),
    ]
}

fn hang(lab: &mut Lab, length: f64, k: f64, expected: &catenary::Cable, elastic: bool) -> Result<(), String> {
    let mesh = sheet::sheet([WIDTH, length], 2, ROWS, Family::Regular, |_| true);
    // Starts as a sharp V of the rest length, which is neither flat nor the answer.
    let (half, depth) = (0.5, (0.25 * length * length - 0.25f64).sqrt());
    let mesh = mesh.place(|[u, v]| {
        let t = 2.0 * v / length;
        let s = if t <= 1.0 { t } else { 2.0 - t };
        Vec3::new(t * half, u, -s * depth)
    });
    let ends = [mesh.pick(|r| r[1] < 1e-9), mesh.pick(|r| r[1] > length - 1e-9)];
    let trial = Trial::new(mesh, Cloth::linear(W / G, k, 0.2 * k, 0.0)).hold(ends.concat());
    let d = lab.drape(&trial)?;
    let lowest = d.at.iter().map(|p| p.z).fold(0.0, f64::min);
    let force = d.reaction(ends[0].iter().copied()) / WIDTH;
    lab.figure("sag m", -lowest, expected.sag, share(2e-3, 2e-2));
    lab.figure("H N/m", force.x.abs(), expected.horizontal, share(5e-3, 5e-2));
    if elastic {
        let middle: Vec<Vec3> = (0..=ROWS)
            .map(|i| d.mean(trial.cloth.pick(|r| (r[1] - length * i as f64 / ROWS as f64).abs() < 1e-9)))
            .collect();
        let stretched: f64 = middle.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
        lab.figure("elongation m", stretched - length, expected.stretched - length, share(5e-3, 5e-2));
    } else {
        lab.figure("end tension N/m", libm::hypot(force.x, force.z), expected.tension, share(5e-3, 5e-2));
    }
    Ok(())
}
