//! A fabric judged before it is used: figures that people know cloth by, and values that no cloth is known to have.
//!
//! The ranges enclose what KES-F, FAST and cantilevers have shown of clothing fabrics, from chiffon to melton. A value
//! outside is no mistake of form, but most often one of a unit.

use crate::fabric_test::direction::bending_length;
use toile_garment::fabric::Fabric;
use toile_garment::{Code, Diagnostic, SourceRef};

codes! {
    pub(crate) list CODES;

    /// A value of a fabric lies outside all that clothing fabrics are known to have. Check the number and its unit.
    FABRIC_DOUBTFUL = "fabric-doubtful";
}

/// Bending lengths, m, and the drape coefficients that the library's fabrics have at them: Cusick's test simulated on
/// meshes of 8 mm, with the friction of the yarns that such fabrics have.
const DRAPE: [[f64; 2]; 10] = [
    [8e-3, 0.19],
    [10e-3, 0.26],
    [12e-3, 0.37],
    [14e-3, 0.48],
    [16e-3, 0.56],
    [18e-3, 0.65],
    [20e-3, 0.76],
    [22e-3, 0.86],
    [26e-3, 0.92],
    [30e-3, 0.985],
];
/// Scatter of the library's fabrics about that line.
const DRAPE_SCATTER: f64 = 0.08;

/// Figures that people know cloth by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Bending length along warp and weft, m (Peirce).
    pub bending_length: [f64; 2],
    /// Between these the drape coefficient (Cusick, 30 cm) is expected, 0 to 1.
    pub drape: [f64; 2],
    /// Edge of a mesh that can show the folds of the cloth, m: no longer than its bending length.
    pub edge: f64,
}

/// Figures of a fabric, from its bending and its mass.
#[must_use]
pub fn figures(fabric: &Fabric) -> Figures {
    let both = [fabric.bend_warp, fabric.bend_weft].map(|b| bending_length(b, fabric.areal_mass));
    let mean = bending_length(0.5 * (fabric.bend_warp + fabric.bend_weft), fabric.areal_mass);
    let drape = drape(mean);
    let range = [drape - DRAPE_SCATTER, drape + DRAPE_SCATTER].map(|d| d.clamp(0.0, 1.0));
    Figures { bending_length: both, drape: range, edge: both[0].min(both[1]) }
}

/// The drape coefficient at a bending length, on the line above; beyond its ends that of the end.
fn drape(length: f64) -> f64 {
    let after = DRAPE.iter().position(|[c, _]| *c >= length).unwrap_or(DRAPE.len());
    match (after.checked_sub(1).and_then(|k| DRAPE.get(k)), DRAPE.get(after)) {
        (Some([a, low]), Some([b, high])) => low + (high - low) * (length - a) / (b - a),
        (None, Some([_, end])) | (Some([_, end]), None) => *end,
        (None, None) => f64::NAN,
    }
}

/// A value with the range that clothing fabrics are known to have.
struct Known {
    what: &'static str,
    value: f64,
    low: f64,
    high: f64,
    unit: &'static str,
}

/// A warning for every value outside the known ranges.
#[must_use]
pub fn doubts(fabric: &Fabric, file: &str) -> Vec<Diagnostic> {
    let outside = |k: &Known| !(k.low..=k.high).contains(&k.value);
    known(fabric).into_iter().filter(outside).map(|k| warning(&k, file)).collect()
}

fn warning(k: &Known, file: &str) -> Diagnostic {
    let code: Code = FABRIC_DOUBTFUL;
    let message = format!(
        "the {} is {}{u}; clothing fabrics have {} to {}{u}",
        k.what,
        short(k.value),
        short(k.low),
        short(k.high),
        u = k.unit
    );
    Diagnostic::warning(code, message).at(SourceRef::file(file)).hint("check the number and its unit")
}

/// Three significant digits.
fn short(x: f64) -> String {
    format!("{x:.2e}").parse::<f64>().unwrap_or(x).to_string()
}

fn known(f: &Fabric) -> Vec<Known> {
    let row = |what, value, [low, high]: [f64; 2], unit| Known { what, value, low, high, unit };
    let length = |b: f64| 1e3 * bending_length(b, f.areal_mass);
    let mut out = vec![
        row("areal mass", 1e3 * f.areal_mass, [12.0, 900.0], " g/m2"),
        row("thickness", 1e3 * f.thickness, [0.04, 6.0], " mm"),
        row("density, mass over thickness,", f.areal_mass / f.thickness, [50.0, 1300.0], " kg/m3"),
        row("friction", f.friction, [0.08, 1.2], ""),
        row("shear stiffness", f.shear, [3.0, 400.0], " N/m/rad"),
        row("bending length along the warp", length(f.bend_warp), [6.0, 40.0], " mm"),
        row("bending length along the weft", length(f.bend_weft), [6.0, 40.0], " mm"),
        row("ratio of bending, warp over weft,", f.bend_warp / f.bend_weft, [0.2, 6.0], ""),
    ];
    for (what, law) in
        [("tension at 2 % along the warp", &f.stretch_warp), ("tension at 2 % along the weft", &f.stretch_weft)]
    {
        out.push(row(what, law.tension(0.02), [0.2, 3000.0], " N/m"));
    }
    if let Some(friction) = f.bend_hysteresis.filter(|h| *h > 0.0) {
        let curvature = friction / (f.bend_warp + f.bend_weft);
        out.push(row("bending hysteresis over bending, HB/B,", curvature, [2.0, 150.0], " 1/m"));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabric_test::{CusickParams, cusick};
    use crate::testing::lend;
    use std::path::PathBuf;

    fn library() -> Vec<(String, Fabric)> {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../samples/fabrics");
        let mut files: Vec<PathBuf> =
            std::fs::read_dir(folder).expect("folder").map(|f| f.expect("file").path()).collect();
        files.retain(|f| f.extension().is_some_and(|e| e == "toml"));
        files.sort();
        let read = |f: &PathBuf| {
            let name = f.file_stem().expect("name").to_string_lossy().into_owned();
            let text = std::fs::read_to_string(f).expect("text");
            (name.clone(), toile_formats::fabric::read(&text, &name).unwrap_or_else(|e| panic!("{name}: {e:?}")))
        };
        files.iter().map(read).collect()
    }

    #[test]
    fn no_fabric_of_the_library_is_doubtful_and_all_tell_their_look() {
        let all = library();
        assert!(all.len() >= 24, "{} fabrics", all.len());
        for (name, fabric) in &all {
            assert_eq!(doubts(fabric, name), Vec::new(), "{name}");
            assert!(fabric.look.is_some(), "{name} has no look");
            let c = figures(fabric).bending_length;
            assert!(c.iter().all(|c| (6e-3..40e-3).contains(c)), "{name}: {c:?}");
        }
    }

    #[test]
    fn a_wrong_unit_is_noticed() {
        let (_, jersey) = library().remove(0);
        let found = |f: Fabric| doubts(&f, "f.toml").into_iter().map(|d| d.message).collect::<Vec<_>>().join("; ");
        assert!(found(Fabric { shear: 1e3 * jersey.shear, ..jersey.clone() }).contains("shear stiffness"));
        assert!(found(Fabric { areal_mass: 1e-3 * jersey.areal_mass, ..jersey.clone() }).contains("areal mass"));
        assert!(found(Fabric { bend_warp: 1e3 * jersey.bend_warp, ..jersey.clone() }).contains("along the warp"));
        assert!(found(Fabric { thickness: 1e3 * jersey.thickness, ..jersey }).contains("thickness"));
    }

    /// Silk crepe hangs limp, wool suiting in between and denim stands, as laboratories know them, and the quick line
    /// says what the simulated drapemeter says.
    #[test]
    fn the_line_agrees_with_the_drapemeter() {
        let all = library();
        let of = |name: &str| &all.iter().find(|(n, _)| n == name).expect("fabric").1;
        for (name, [low, high]) in
            [("silk-crepe-de-chine", [0.15, 0.40]), ("wool-suiting", [0.40, 0.62]), ("denim-11oz", [0.80, 0.99])]
        {
            let params = CusickParams { edge: 8e-3, ..CusickParams::default() };
            let dc = lend(|cx| cusick::cusick(of(name), &params, cx)).0.expect("at rest").drape_coefficient;
            assert!((low..=high).contains(&dc), "{name}: {dc}");
            let [from, to] = figures(of(name)).drape;
            assert!((from..=to).contains(&dc), "{name}: {dc} outside {from} to {to}");
        }
    }
}
