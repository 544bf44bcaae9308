//! KES figures to an exponential law.

use crate::case::{Case, case, share};
use crate::lab::Lab;
use crate::support::cloth::{Cloth, Law};
use toile_garment::fabric::StretchLaw;

pub fn cases() -> Vec<Case> {
    [(0.04, 0.8), (0.08, 0.6)]
        .into_iter()
        .enumerate()
        .map(|(i, (emt, lt))| case(format!("kes-tensile-{i}"), move |lab: &mut Lab| tensile(lab, emt, lt)).quick())
        .collect()
}

fn tensile(lab: &mut Lab, emt: f64, lt: f64) -> Result<(), String> {
    let fm = 490.332_5;
    // LT = 2 (1/x − 1/(eˣ − 1)), K0 = Fm x / (EMT (eˣ − 1)), β = x / EMT.
    let x = crate::closed::root(1e-3, 100.0, |x| 2.0 * (1.0 / x - 1.0 / libm::expm1(x)) - lt);
    let expected = (fm * x / (emt * libm::expm1(x)), x / emt, 0.5 * lt * fm * emt);
    let text =
        Cloth { warp: Law::Exponential { k0: expected.0, beta: expected.1 }, ..Cloth::linear(0.2, 1.0, 1.0, 0.0) }
            .text();
    // The figures as a laboratory gives them, not the ones worked back from the law.
    let text = text
        .lines()
        .map(|l| match l.split_once(' ') {
            Some(("emt_warp", _)) => format!("emt_warp = \"{} %\"", emt * 100.0),
            Some(("lt_warp", _)) => format!("lt_warp = {lt:?}"),
            _ => l.to_owned(),
        })
        .collect::<Vec<_>>()
        .join("\n");
    let fabric = toile_formats::fabric::read(&text, "fabric.toml").map_err(|e| format!("{e:?}"))?;
    let StretchLaw::Exponential { k0, beta } = fabric.stretch_warp else {
        return Err(format!("{:?} is no exponential law", fabric.stretch_warp));
    };
    let n = 20_000;
    let step = emt / f64::from(n);
    let work = (0..n).map(|i| step * fabric.stretch_warp.tension((f64::from(i) + 0.5) * step)).sum();
    lab.figure("K0 N/m", k0, expected.0, share(1e-6, 1e-3));
    lab.figure("beta", beta, expected.1, share(1e-6, 1e-3));
    lab.figure("WT J/m2", work, expected.2, share(1e-6, 1e-3));
    Ok(())
}
