//! I: effects only where they are called for. What the solver's own tests hold stands in `elsewhere.rs`.

use crate::case::{Case, case};
use crate::lab::Lab;
use crate::scenes::{apart, ball, cotton, del, even, lying, top, upright};
use crate::support::cloth::Cloth;
use crate::support::mesh::Mesh;
use crate::support::trial::Trial;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    vec![
        case("I2-body-far-away", far_body).quick().once(),
        case("I3-bend-to-0", little_bending).quick().once(),
        case("I6-garment-10m-away", far_cloth).quick().once(),
        case("I9-effects-refused", unknown).quick().once(),
    ]
}

fn hung() -> Trial {
    let cloth = upright(del(0.2, 0.025));
    let held = top(&cloth);
    Trial::new(cloth, cotton()).hold(held)
}

/// A body that nothing meets changes no bit.
fn far_body(lab: &mut Lab) -> Result<(), String> {
    let d = lab.settles(&hung())?;
    let e = lab.settles(&hung().over(ball(0.1, Vec3::new(3.0, 0.0, 0.0), 2)))?;
    lab.expect(d.at == e.at, format!("another shape, by {:.1e} m", apart(&d.at, &e.at)));
    Ok(())
}

/// The share of bending in the shape vanishes together with bending.
fn little_bending(lab: &mut Lab) -> Result<(), String> {
    let level = even(0.02, 0.06, 0.005).place(|[u, v]| Vec3::new(u, v, 0.0));
    let clamp = level.pick(|[_, v]| v < 0.0051);
    let low = |lab: &mut Lab, bending: f64| {
        let trial = Trial::new(level.clone(), Cloth { bending, ..cotton() }).hold(clamp.clone());
        let d = lab.settles(&trial.set("accuracy = \"reference\""))?;
        Ok::<f64, String>(d.at.iter().map(|p| p.z).fold(f64::INFINITY, f64::min))
    };
    let (a, b, c) = (low(lab, 1e-7)?, low(lab, 1e-9)?, low(lab, 1e-12)?);
    lab.expect((b - c).abs() <= (a - c).abs() + 1e-7, format!("lowest points {a}, {b}, {c} m"));
    lab.below("from 1e-9 to 1e-12 N.m, m", (b - c).abs(), 1e-4);
    Ok(())
}

/// Another sheet ten metres off changes no bit of the first.
fn far_cloth(lab: &mut Lab) -> Result<(), String> {
    let one = hung();
    let mut both = one.clone();
    let other = Mesh { at: one.cloth.at.iter().map(|p| p + Vec3::x() * 10.0).collect(), ..one.cloth.clone() };
    let first = both.cloth.join(&other);
    both = both.hold(top(&one.cloth).into_iter().map(|v| v + first));
    let (d, e) = (lab.settles(&one)?, lab.settles(&both)?);
    let off = apart(&d.at, &e.at[..first]);
    lab.expect(d.at[..] == e.at[..first], format!("another shape, by {off:.1e} m"));
    Ok(())
}

fn unknown(lab: &mut Lab) -> Result<(), String> {
    for key in
        ["effects.wind = \"on\"", "effects.friction = \"maybe\"", "effects.self-contact = 1", "effects = \"auto\""]
    {
        let run = lab.run(&Trial::new(lying(even(0.1, 0.1, 0.05), 0.0), cotton()).hold([0]).set(key), &[])?;
        lab.expect(run.code == 2, format!("{key}: exit code {}", run.code));
    }
    Ok(())
}
