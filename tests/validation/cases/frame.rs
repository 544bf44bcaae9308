//! Picture frame: a square whose rigid sides become a rhombus.

use crate::case::{Case, case, share};
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::mesh::{FAMILIES, Family, jitter, sheet};
use crate::support::trial::Trial;
use std::f64::consts::FRAC_PI_4;
use toile_garment::Vec3;

const SIDE: f64 = 0.1;
const SHEAR: f64 = 50.0;

pub fn cases() -> Vec<Case> {
    let mut list: Vec<Case> = FAMILIES
        .into_iter()
        .map(|f| {
            let c = case(format!("picture-frame-0.{}", f.name()), move |lab: &mut Lab| frame(lab, f));
            if f == Family::Irregular { c.quick() } else { c }
        })
        .collect();
    list.push(case("picture-frame-curve", measured).quick());
    list
}

/// A measured curve: as stiff again up to 10 degrees.
fn measured(lab: &mut Lab) -> Result<(), String> {
    let knee = [f64::to_radians(10.0), SHEAR * f64::to_radians(10.0)];
    for degrees in [5.0, 15.0, 30.0] {
        let gamma = f64::to_radians(degrees);
        let tension = SHEAR * (gamma + gamma.min(knee[0]));
        let expected = SIDE * tension / libm::sin(FRAC_PI_4 - 0.5 * gamma);
        let force = pull(lab, Family::Irregular, gamma, Some(knee))?;
        lab.figure(format!("F {degrees} deg N"), force, expected, share(0.01, 0.1));
    }
    Ok(())
}

fn frame(lab: &mut Lab, family: Family) -> Result<(), String> {
    for degrees in [5.0, 15.0, 30.0] {
        let gamma = f64::to_radians(degrees);
        let expected = SIDE * SHEAR * gamma / libm::sin(FRAC_PI_4 - 0.5 * gamma);
        let force = pull(lab, family, gamma, None)?;
        lab.figure(format!("F {degrees} deg N"), force, expected, share(0.01, 0.1));
    }
    Ok(())
}

/// Force along the long diagonal, from the reactions by virtual work.
fn pull(lab: &mut Lab, family: Family, gamma: f64, shear_knee: Option<[f64; 2]>) -> Result<f64, String> {
    let flat = sheet::sheet([SIDE, SIDE], 10, 10, family, |_| false);
    // The yarns keep their lengths and stand at 90° − γ to each other, symmetric about the diagonal.
    let corner = |[u, v]: [f64; 2], g: f64| {
        let half = FRAC_PI_4 - 0.5 * g;
        let (s, c) = (libm::sin(half), libm::cos(half));
        Vec3::new((u - v) * s, 0.0, -(u + v) * c)
    };
    let on = |x: f64| x.abs() < 1e-9 || (x - SIDE).abs() < 1e-9;
    let rim = flat.pick(|r| on(r[0]) || on(r[1]));
    let rest = flat.rest.clone();
    let mut mesh = flat.place(|r| corner(r, gamma));
    // The middle starts elsewhere than where it must come to rest.
    for (i, p) in mesh.at.iter_mut().enumerate() {
        if !rim.contains(&i) {
            *p += Vec3::new(jitter::noise(3 * i as u64), 0.0, jitter::noise(3 * i as u64 + 1)) * 5e-4;
        }
    }
    let fabric = Cloth { shear_knee, ..Cloth::linear(0.1, 100.0 * SHEAR, SHEAR, 0.0) };
    let d = lab.drape(&Trial::new(mesh, fabric).weightless().hold(rim.iter().copied()))?;
    // F dD = Σ R · dx for a change dγ of the frame, D = 2 a cos(π/4 − γ/2) its diagonal.
    let step = 1e-6;
    let moved = |v: usize| (corner(rest[v], gamma + step) - corner(rest[v], gamma - step)) / (2.0 * step);
    let work: f64 = rim.iter().map(|v| d.reactions[v].dot(&moved(*v))).sum();
    Ok(work / (SIDE * libm::sin(FRAC_PI_4 - 0.5 * gamma)))
}
