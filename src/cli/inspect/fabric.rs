//! `inspect` of a fabric file: its curves, its drape by an estimate, and values that no cloth of its kind has.

use super::{Inspected, Source};
use serde_json::{Value, json};
use toile_formats::fabric;
use toile_garment::Diagnostic;
use toile_garment::fabric::Fabric;
use toile_stages::fabric_check::{self, Figures};
use toile_stages::text::text;

/// Strains at which the tension curves are told.
const STRAINS: [f64; 5] = [0.005, 0.01, 0.02, 0.05, 0.1];

/// Facts about a fabric file.
pub fn inspect(source: &Source<'_>) -> Result<Inspected, Vec<Diagnostic>> {
    let text = text(source.name, source.bytes).map_err(|finding| vec![finding])?;
    if !is_fabric(&text) {
        return Err(vec![super::no_reader(source.name)]);
    }
    let fabric = fabric::read(&text, source.name)?;
    let figures = fabric_check::figures(&fabric);
    let findings = fabric_check::doubts(&fabric, source.name);
    let svg = source.draw.then(|| toile_stages::fabric_test::picture::tension(&fabric));
    Ok(Inspected { json: json(&fabric, &figures), text: words(&fabric, &figures), svg, findings, is_usable: true })
}

/// Has a text the keys of a fabric? Text that is no TOML is left to the reader, which says what is wrong.
fn is_fabric(text: &str) -> bool {
    let table = text.parse::<toml::Table>();
    table.map_or(true, |t| ["areal_mass", "method", "kes", "fast"].iter().any(|key| t.contains_key(*key)))
}

fn curves(fabric: &Fabric) -> [(&'static str, Vec<[f64; 2]>); 2] {
    [("warp", &fabric.stretch_warp), ("weft", &fabric.stretch_weft)]
        .map(|(name, law)| (name, STRAINS.iter().map(|e| [*e, law.tension(*e)]).collect()))
}

fn json(fabric: &Fabric, figures: &Figures) -> Value {
    let curves: serde_json::Map<String, Value> =
        curves(fabric).into_iter().map(|(name, points)| (name.to_owned(), json!(points))).collect();
    json!({
        "format": "fabric", "name": fabric.name, "areal_mass_g_m2": 1e3 * fabric.areal_mass,
        "thickness_mm": 1e3 * fabric.thickness, "friction": fabric.friction, "shear_N_m_rad": fabric.shear,
        "shear_curve_rad_N_m": fabric.shear_curve,
        "bending_curve_per_m_N": [&fabric.bend_curve_warp, &fabric.bend_curve_weft],
        "bending_uNm": [1e6 * fabric.bend_warp, 1e6 * fabric.bend_weft],
        "rest_curvature_warp_per_m": fabric.rest_curvature_warp,
        "rest_curvature_weft_per_m": fabric.rest_curvature_weft,
        "bending_hysteresis_mN": fabric.bend_hysteresis.map(|h| 1e3 * h),
        "bending_length_mm": figures.bending_length.map(|c| 1e3 * c),
        "drape_coefficient_estimate": figures.drape, "edge_mm": 1e3 * figures.edge,
        "tension_N_m": curves, "sources": fabric.sources, "look": fabric.look,
    })
}

fn words(fabric: &Fabric, figures: &Figures) -> String {
    let mut out = format!(
        "fabric `{}`: {:.0} g/m2, {:.2} mm thick, friction {}\n",
        fabric.name,
        1e3 * fabric.areal_mass,
        1e3 * fabric.thickness,
        fabric.friction
    );
    let [warp, weft] = figures.bending_length.map(|c| 1e3 * c);
    out += &format!(
        "bending {:.2} / {:.2} uN.m (warp / weft), bending length {warp:.1} / {weft:.1} mm, shear {:.1} N/m/rad\n",
        1e6 * fabric.bend_warp,
        1e6 * fabric.bend_weft,
        fabric.shear
    );
    if fabric.shear_curve.is_some() || fabric.bend_curve_warp.is_some() || fabric.bend_curve_weft.is_some() {
        out += "where a curve was measured, these are its smallest slopes\n";
    }
    let [low, high] = figures.drape.map(|d| 100.0 * d);
    out += &format!(
        "drape coefficient about {low:.0} to {high:.0} % (Cusick, 30 cm); `toile fabric test cusick` simulates it\n"
    );
    out += &format!("folds need a mesh with edges of {:.0} mm or less\n", 1e3 * figures.edge);
    out += "tension, N/m:  strain";
    STRAINS.iter().for_each(|e| out += &format!("{:>9.1} %", 100.0 * e));
    for (name, points) in curves(fabric) {
        out += &format!("\n               {name:<6}");
        points.iter().for_each(|[_, t]| out += &format!("{t:>11.1}"));
    }
    out += "\n";
    for (key, source) in &fabric.sources {
        out += &format!("  {key}: {} ({}; {})\n", source.written, source.method, source.source);
    }
    out
}
