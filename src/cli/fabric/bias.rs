//! `toile fabric test bias`

use super::args::BiasArgs;
use super::{Sheet, Tested, figure};
use serde_json::{Value, json};
use std::fmt::Write as _;
use toile_garment::fabric::Fabric;
use toile_stage_api::StageContext;
use toile_stages::fabric_test::bias::{FAST, LENGTH, WIDTH, bias};
use toile_stages::fabric_test::{Bias, BiasParams, picture};

pub(super) fn test(args: &BiasArgs, fabric: &Fabric, cx: &mut StageContext<'_>) -> Tested {
    let read = bias(fabric, &BiasParams { edge: args.edge.0, extension: args.extension.0 }, cx)?;
    Ok(Sheet { json: json(&read), text: text(&read), svg: picture::bias(&fabric.name, &read) })
}

fn json(read: &Bias) -> Value {
    let readings = read.readings.iter().map(|r| {
        json!({
            "extension": figure(r.extension),
            "force_N": figure(r.force),
            "shear_angle_deg": figure(r.shear_angle.to_degrees()),
            "shear_angle_rigid_yarns_deg": figure(r.shear_angle_rigid.to_degrees()),
            "waist_mm": figure(1e3 * WIDTH * r.waist),
        })
    });
    json!({
        "length_mm": figure(1e3 * LENGTH),
        "width_mm": figure(1e3 * WIDTH),
        "edge_mm": figure(1e3 * read.params.edge),
        "readings": readings.collect::<Vec<_>>(),
        "eb5": figure(read.eb5),
        "eb5_tension_N_per_m": figure(FAST),
        "shear_fast_N_per_m_rad": figure(read.shear_fast),
        "file_shear_N_per_m_rad": figure(read.shear),
    })
}

fn text(read: &Bias) -> String {
    let mut text = format!(
        "bias extension, {:.0} x {:.0} mm cut at 45 degrees, edge {} mm\n  extension     force   shear angle   of rigid yarns     waist\n",
        1e3 * LENGTH,
        1e3 * WIDTH,
        1e3 * read.params.edge
    );
    for r in &read.readings {
        let _ = writeln!(
            text,
            "  {:>7.2} % {:>7.3} N {:>9.2} deg {:>12.2} deg {:>6.1} mm",
            100.0 * r.extension,
            r.force,
            r.shear_angle.to_degrees(),
            r.shear_angle_rigid.to_degrees(),
            1e3 * WIDTH * r.waist
        );
    }
    let _ = writeln!(
        text,
        "  EB5 {:.2} % (at 5 gf/cm); shear alone, without clamps, would show {:.2} %\n  G = 123/EB5 = {:.1} N/m per rad, the file has {:.1}: clamps raise it, yarns that stretch lower it",
        100.0 * read.eb5,
        100.0 * 0.25 * FAST / read.shear,
        read.shear_fast,
        read.shear
    );
    text
}
