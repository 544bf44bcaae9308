//! `toile fabric test cantilever`

use super::args::CantileverArgs;
use super::{Sheet, Tested, figure};
use serde_json::{Value, json};
use std::fmt::Write as _;
use toile_garment::fabric::Fabric;
use toile_stage_api::StageContext;
use toile_stages::fabric_test::cantilever::{SLOPE, cantilever, compare};
use toile_stages::fabric_test::direction::bending_length;
use toile_stages::fabric_test::{Cantilever, CantileverParams, Direction, picture};

pub(super) fn test(args: &CantileverArgs, fabric: &Fabric, cx: &mut StageContext<'_>) -> Tested {
    let asked: Vec<Direction> = args.direction.map_or(Direction::ALL.to_vec(), |d| vec![d.into()]);
    let params = |direction| CantileverParams { direction, edge: args.edge.map(|e| e.0) };
    let read = asked.into_iter().map(|d| cantilever(fabric, &params(d), cx)).collect::<Result<Vec<_>, _>>()?;
    read.iter().for_each(|c| compare(c, cx));
    Ok(Sheet { json: json(fabric, &read), text: text(fabric, &read), svg: picture::cantilever(&fabric.name, &read) })
}

fn json(fabric: &Fabric, read: &[Cantilever]) -> Value {
    json!({
        "standard": "BS 3356, ASTM D1388",
        "slope_deg": SLOPE,
        "areal_mass_g_per_m2": figure(1e3 * fabric.areal_mass),
        "strips": read.iter().map(|c| strip(fabric, c)).collect::<Vec<_>>(),
    })
}

fn strip(fabric: &Fabric, c: &Cantilever) -> Value {
    let (said, given) = c.expected;
    json!({
        "direction": c.direction.word(),
        "edge_mm": figure(1e3 * c.edge),
        "overhang_mm": figure(1e3 * c.overhang),
        "bending_length_mm": figure(1e3 * c.bending_length),
        "flexural_rigidity_uN_m": figure(1e6 * c.rigidity),
        "file_bending_length_mm": figure(1e3 * bending_length(said, fabric.areal_mass)),
        "file_rigidity_uN_m": figure(1e6 * said),
        "file_rigidity_estimated": !given,
        "profile_mm": c.profile.iter().map(|p| p.map(|x| figure(1e3 * x))).collect::<Vec<_>>(),
    })
}

fn text(fabric: &Fabric, read: &[Cantilever]) -> String {
    let mut text = format!(
        "cantilever at {SLOPE} degrees (BS 3356, ASTM D1388), {:.0} g/m2\n  {:<5} {:>9} {:>11} {:>12} {:>22}\n",
        1e3 * fabric.areal_mass,
        "",
        "overhang",
        "c",
        "B",
        "by the file: c, B"
    );
    for c in read {
        let (said, given) = c.expected;
        let _ = writeln!(
            text,
            "  {:<5} {:>6.1} mm {:>8.2} mm {:>7.2} uN.m {:>8.2} mm {:>6.2} uN.m{}",
            c.direction.word(),
            1e3 * c.overhang,
            1e3 * c.bending_length,
            1e6 * c.rigidity,
            1e3 * bending_length(said, fabric.areal_mass),
            1e6 * said,
            if given { "" } else { " (estimated from warp and weft)" }
        );
    }
    text
}
