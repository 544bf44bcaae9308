//! `toile fabric test picture-frame`

use super::args::FrameArgs;
use super::{Sheet, Tested, figure};
use serde_json::{Value, json};
use std::fmt::Write as _;
use toile_garment::fabric::Fabric;
use toile_stage_api::StageContext;
use toile_stages::fabric_test::frame::{SIDE, frame};
use toile_stages::fabric_test::{Frame, FrameParams, picture};

pub(super) fn test(args: &FrameArgs, fabric: &Fabric, cx: &mut StageContext<'_>) -> Tested {
    let read = frame(fabric, &FrameParams { edge: args.edge.0, angle: args.angle.0 }, cx)?;
    Ok(Sheet { json: json(&read), text: text(&read), svg: picture::frame(&fabric.name, &read) })
}

fn json(read: &Frame) -> Value {
    let readings = read.readings.iter().map(|r| {
        json!({
            "shear_angle_deg": figure(r.shear_angle.to_degrees()),
            "force_N": figure(r.force),
            "shear_force_N_per_m": figure(r.shear_force),
            "shear_stress_N_per_m": figure(r.shear_stress),
        })
    });
    json!({
        "side_mm": figure(1e3 * SIDE),
        "edge_mm": figure(1e3 * read.params.edge),
        "readings": readings.collect::<Vec<_>>(),
        "shear_secant_N_per_m_rad": figure(read.shear_secant()),
        "file_shear_N_per_m_rad": figure(read.shear),
    })
}

fn text(read: &Frame) -> String {
    let mut text = format!(
        "picture frame, side {:.0} mm, edge {} mm\n  shear angle      force   force per side   shear stress\n",
        1e3 * SIDE,
        1e3 * read.params.edge
    );
    for r in &read.readings {
        let _ = writeln!(
            text,
            "  {:>7.1} deg {:>8.3} N {:>12.3} N/m {:>10.3} N/m",
            r.shear_angle.to_degrees(),
            r.force,
            r.shear_force,
            r.shear_stress
        );
    }
    let _ =
        writeln!(text, "  G over the whole way {:.2} N/m per rad, the file has {:.2}", read.shear_secant(), read.shear);
    text
}
