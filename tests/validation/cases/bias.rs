//! Bias extension: shear angle in the middle of a strip cut at 45° and pulled by its ends.
//!
//! The closed form is that of yarns that do not stretch, and converges slowly. A strip of linear cloth, solved by
//! finite elements on fine meshes, falls short of it. It does so by 18 % at K/G = 100, 13 % at 200, 3.4 % at 2,000 and
//! 0.7 % at 20,000. And where yarns do not stretch, triangles with edges off the yarns lock: here the edges run along
//! them.

use crate::case::{Case, case, share};
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use crate::support::mesh::{Mesh, area, sheet};
use crate::support::trial::Trial;
use std::f64::consts::{FRAC_PI_4, SQRT_2};
use toile_garment::Vec3;

const LENGTH: f64 = 0.2;
const WIDTH: f64 = 0.1;

pub fn cases() -> Vec<Case> {
    vec![case("bias-extension-0", extend).quick()]
}

fn extend(lab: &mut Lab) -> Result<(), String> {
    for mm in [5.0, 15.0] {
        let pull = mm * 1e-3;
        let free = LENGTH - WIDTH;
        let expected = (90.0 - 2.0 * libm::acos((free + pull) / (SQRT_2 * free)).to_degrees()).abs();
        let angle = middle_shear(lab, pull)?;
        lab.figure(format!("gamma {mm} mm deg"), angle, expected, share(0.02, 0.1));
    }
    Ok(())
}

fn middle_shear(lab: &mut Lab, pull: f64) -> Result<f64, String> {
    let flat = sheet::crossed([WIDTH, LENGTH], 16, 32);
    let end = |v: f64| flat.pick(|r| (r[1] - v).abs() < 1e-9);
    let (top, bottom) = (end(0.0), end(LENGTH));
    let stretch = 1.0 + pull / LENGTH;
    let rest = flat.rest.clone();
    let mesh = flat.clone().place(|[u, v]| Vec3::new(u, 0.0, -v * stretch)).turn(FRAC_PI_4);
    let trial = Trial::new(mesh, Cloth::linear(0.1, 2e5, 1.0, 0.0)).weightless().hold([top, bottom].concat());
    let d = lab.drape(&trial)?;
    Ok(shear(&trial.cloth, &rest, &d.at).to_degrees())
}

/// Mean angle by which warp and weft left their right angle, over the triangles near the centre.
fn shear(cloth: &Mesh, strip: &[[f64; 2]], at: &[Vec3]) -> f64 {
    let (mut sum, mut weight) = (0.0, 0.0);
    for t in &cloth.triangles {
        let middle = t.iter().fold([0.0, 0.0], |m, i| [m[0] + strip[*i][0] / 3.0, m[1] + strip[*i][1] / 3.0]);
        if libm::hypot(middle[0] - 0.5 * WIDTH, middle[1] - 0.5 * LENGTH) > 0.2 * WIDTH {
            continue;
        }
        let [weft, warp] = yarns(&cloth.rest, at, t);
        let angle = libm::asin((weft.dot(&warp) / (weft.norm() * warp.norm())).clamp(-1.0, 1.0)).abs();
        let a = area(&cloth.rest, t);
        sum += a * angle;
        weight += a;
    }
    sum / weight
}

/// The images of a weft and a warp yarn of unit length in a triangle.
fn yarns(rest: &[[f64; 2]], at: &[Vec3], t: &[usize; 3]) -> [Vec3; 2] {
    let [a, b, c] = t.map(|i| rest[i]);
    let (p, q) = (at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
    let (e, f) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let det = e[0] * f[1] - e[1] * f[0];
    [(p * f[1] - q * e[1]) / det, (q * e[0] - p * f[0]) / det]
}
