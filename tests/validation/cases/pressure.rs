//! A tube under an inner pressure.

use crate::case::{Case, case, share};
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::mesh::{Family, sheet};
use crate::support::trial::Trial;
use std::f64::consts::TAU;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    vec![case("pressure-tube-0", tube).quick()]
}

/// Free ends, no weight: p R = K (R/R₀ − 1).
fn tube(lab: &mut Lab) -> Result<(), String> {
    let (stretch, r0, p) = (300.0, 0.05, 500.0);
    let (girth, cells, height) = (TAU * r0, 96, 0.06);
    // Of n chords, whose girth is that of the rest shape.
    let radius = 0.5 * girth / cells as f64 / libm::sin(0.5 * TAU / cells as f64);
    let flat = sheet::sheet([girth, height], cells, 18, Family::Right, |_| true);
    let mesh = flat.place(|[u, v]| {
        let a = u / r0;
        Vec3::new(radius * libm::cos(a), radius * libm::sin(a), v)
    });
    let stitches = mesh.round(girth);
    let middle = mesh.pick(|r| (r[1] - 0.5 * height).abs() < 1e-9);
    let fabric = Cloth { thickness: 1e-4, limit: 0.6, ..Cloth::linear(0.1, stretch, 40.0, 1e-7) };
    let trial = Trial { stitches, ..Trial::new(mesh, fabric).weightless().set(&format!("pressure = \"{p} Pa\"")) };
    let d = lab.drape(&trial)?;
    let ring = &middle[..cells];
    let centre = ring.iter().map(|v| d.at[*v]).sum::<Vec3>() / cells as f64;
    let r = ring.iter().map(|v| (d.at[*v] - centre).norm()).sum::<f64>() / cells as f64;
    let expected = r0 / (1.0 - p * r0 / stretch);
    lab.figure("radius m", r, expected, share(0.005, 0.03));
    let stretched: f64 = (0..cells).map(|k| (d.at[ring[k]] - d.at[ring[(k + 1) % cells]]).norm()).sum();
    lab.figure("tension N/m", stretch * (stretched / girth - 1.0), p * expected, share(0.01, 0.1));
    Ok(())
}
