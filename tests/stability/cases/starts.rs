//! Starts that a person would simply move: wide skirts beside hanging arms, a collar in the neck, a dress placed too low.

use super::grain::good;
use crate::case::{Case, case};
use crate::drawing::{Drawing, Sheet};
use crate::lab::Lab;
use crate::support::cloth::Cloth;
use std::fmt::Write as _;

pub fn cases() -> Vec<Case> {
    vec![
        case("D21-circle-skirt-beside-arms", circle).quick(),
        case("D22-collar-in-the-neck", collar).quick(),
        case("D23-dress-placed-too-low", dress),
        case("D24-shirt-without-places", shirt).quick(),
        case("D25-sleeves-on-the-wrong-arms", swapped_sleeves).quick().once(),
    ]
}

/// A body with hanging arms: the sample of size 36, waist girth 660 mm at 1050 mm.
fn body() -> Option<(String, String)> {
    let read = |name: &str| std::fs::read_to_string(format!("{}/samples/bodies/{name}", env!("CARGO_MANIFEST_DIR")));
    Some((read("size-36.obj").ok()?, read("size-36.toml").ok()?))
}

fn shirting() -> Cloth {
    Cloth { thickness: 3e-4, ..Cloth::linear(0.12, 2000.0, 300.0, 6e-6) }
}

fn sheet(name: &'static str, corners: &[[f64; 2]], translation: [f64; 3], back: bool) -> Sheet {
    Sheet { name, corners: corners.to_vec(), grain: 90.0, material: "cotton", translation, back }
}

type Ends = [[f64; 2]; 2];

/// A seam between two lines of the drawing, mm.
fn seam(sewing: &mut String, name: &str, a: (&str, Ends), b: (&str, Ends)) {
    let side = |(piece, ends): (&str, Ends)| {
        let [from, to] = ends.map(|[x, y]| format!("[\"{x} mm\", \"{y} mm\"]"));
        format!("[{{ piece = \"{piece}\", from = {from}, to = {to} }}]")
    };
    let _ = writeln!(sewing, "[[seam]]\nname = \"{name}\"\na = {}\nb = {}", side(a), side(b));
}

/// Drapes; the run passes, and tells that it helped itself.
fn passes(lab: &mut Lab, drawing: &Drawing, findings: &[&str]) -> Result<(), String> {
    let accuracy = lab.accuracy().map(str::to_owned);
    let run = lab.program(&[], |folder| drawing.write(folder, accuracy.as_deref()))?;
    good(lab, &run);
    for code in findings {
        lab.expect(run.findings().any(|f| f["code"] == *code), format!("no finding `{code}`"));
    }
    Ok(())
}

/// Two half rings, placed flat in front and behind: a circle skirt of 550 mm. Its side seams close through the forearms.
fn circle(lab: &mut Lab) -> Result<(), String> {
    let (inner, outer) = (660.0 / std::f64::consts::TAU, 660.0 / std::f64::consts::TAU + 550.0);
    let arc = |radius: f64, k: i32| {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(k) / 36.0);
        [radius * cos, -radius * sin]
    };
    let corners: Vec<[f64; 2]> = (0..=36).map(|k| arc(inner, k)).chain((0..=36).rev().map(|k| arc(outer, k))).collect();
    let x = 1e3 * lab.nudge(3e-4, 0);
    let sheets =
        vec![sheet("FRONT", &corners, [x, 1050.0, 180.0], false), sheet("BACK", &corners, [x, 1050.0, -180.0], true)];
    let mut sewing = String::new();
    for (name, side) in [("left", 1.0), ("right", -1.0)] {
        let ends = |side: f64| [[side * inner, 0.0], [side * outer, 0.0]];
        seam(&mut sewing, name, ("FRONT", ends(side)), ("BACK", ends(-side)));
    }
    for piece in ["FRONT", "BACK"] {
        let _ = writeln!(
            sewing,
            "[[edge]]\npiece = \"{piece}\"\nname = \"waist\"\nfrom = [\"{inner} mm\", \"0 mm\"]\nto = [\"-{inner} mm\", \"0 mm\"]\n\
             [[attach]]\npiece = \"{piece}\"\nedge = \"waist\"\nto = \"waist\"\nstrength = \"hold\""
        );
    }
    let drawing =
        Drawing { sheets, sewing, fabrics: vec![("cotton", shirting())], body: body(), edge: 35.0, drape: Vec::new() };
    passes(lab, &drawing, &["sewn-past-limb", "start-on-cone"])
}

/// A band of two straight pieces around the neck. The front one cuts it.
fn collar(lab: &mut Lab) -> Result<(), String> {
    let corners = [[-105.0, 0.0], [105.0, 0.0], [105.0, 60.0], [-105.0, 60.0]];
    let x = 1e3 * lab.nudge(3e-4, 0);
    let sheets =
        vec![sheet("FRONT", &corners, [x, 1400.0, 30.0], false), sheet("BACK", &corners, [x, 1400.0, -130.0], true)];
    let mut sewing = String::new();
    for (name, side) in [("left", 105.0), ("right", -105.0)] {
        let ends = |x: f64| [[x, 0.0], [x, 60.0]];
        seam(&mut sewing, name, ("FRONT", ends(side)), ("BACK", ends(-side)));
    }
    let drawing =
        Drawing { sheets, sewing, fabrics: vec![("cotton", shirting())], body: body(), edge: 14.0, drape: Vec::new() };
    passes(lab, &drawing, &["start-moved"])
}

/// A strapless dress whose waist seam starts on the hips, 110 mm too low.
fn dress(lab: &mut Lab) -> Result<(), String> {
    let (waist, bust, hem) = (172.0, 218.0, 300.0);
    let top = [[-waist, 0.0], [waist, 0.0], [bust, 180.0], [-bust, 180.0]];
    let skirt = [[-hem, -400.0], [hem, -400.0], [waist, 0.0], [-waist, 0.0]];
    let x = 1e3 * lab.nudge(3e-4, 0);
    let sheets = vec![
        sheet("TOP-F", &top, [x, 945.0, 220.0], false),
        sheet("TOP-B", &top, [x, 945.0, -220.0], true),
        sheet("SKIRT-F", &skirt, [x, 935.0, 200.0], false),
        sheet("SKIRT-B", &skirt, [x, 935.0, -200.0], true),
    ];
    let mut sewing = String::new();
    for (name, side) in [("left", 1.0), ("right", -1.0)] {
        let upper = |s: f64| [[s * waist, 0.0], [s * bust, 180.0]];
        let lower = |s: f64| [[s * waist, 0.0], [s * hem, -400.0]];
        seam(&mut sewing, &format!("top-{name}"), ("TOP-F", upper(side)), ("TOP-B", upper(-side)));
        seam(&mut sewing, &format!("skirt-{name}"), ("SKIRT-F", lower(side)), ("SKIRT-B", lower(-side)));
    }
    for side in ["F", "B"] {
        let line = [[-waist, 0.0], [waist, 0.0]];
        let (top, skirt) = (format!("TOP-{side}"), format!("SKIRT-{side}"));
        seam(&mut sewing, &format!("waist-{side}"), (&top, line), (&skirt, line));
    }
    let drawing =
        Drawing { sheets, sewing, fabrics: vec![("cotton", shirting())], body: body(), edge: 20.0, drape: Vec::new() };
    passes(lab, &drawing, &["start-raised"])
}

/// A shirt of straight pieces, with sleeves in one piece. Where a piece is placed the sewing file has to say.
fn shirt_drawing() -> Drawing {
    let trunk = |neck: f64| {
        let half = [[250.0, 0.0], [250.0, 360.0], [195.0, 545.0], [75.0, 590.0], [40.0, neck]];
        half.into_iter().chain(half.into_iter().rev().map(|[x, y]| [-x, y])).collect::<Vec<_>>()
    };
    let sleeve = [[-150.0, 0.0], [150.0, 0.0], [180.0, 150.0], [0.0, 220.0], [-180.0, 150.0]];
    let sheets = vec![
        sheet("FRONT", &trunk(510.0), [0.0; 3], false),
        sheet("BACK", &trunk(570.0), [0.0; 3], true),
        sheet("SLEEVE-L", &sleeve, [0.0; 3], false),
        sheet("SLEEVE-R", &sleeve, [0.0; 3], false),
    ];
    let mut sewing = String::new();
    // The left of the back as drawn is the wearer's left.
    for (name, arm, s) in [("left", "SLEEVE-L", 1.0), ("right", "SLEEVE-R", -1.0)] {
        let (side, shoulder) =
            (|s: f64| [[s * 250.0, 0.0], [s * 250.0, 360.0]], |s: f64| [[s * 195.0, 545.0], [s * 75.0, 590.0]]);
        let (armhole, cap) =
            (|s: f64| [[s * 250.0, 360.0], [s * 195.0, 545.0]], |s: f64| [[s * 180.0, 150.0], [0.0, 220.0]]);
        let under = |s: f64| [[s * 150.0, 0.0], [s * 180.0, 150.0]];
        seam(&mut sewing, &format!("side-{name}"), ("FRONT", side(s)), ("BACK", side(-s)));
        seam(&mut sewing, &format!("shoulder-{name}"), ("FRONT", shoulder(s)), ("BACK", shoulder(-s)));
        seam(&mut sewing, &format!("armhole-front-{name}"), ("FRONT", armhole(s)), (arm, cap(-s)));
        seam(&mut sewing, &format!("armhole-back-{name}"), ("BACK", armhole(-s)), (arm, cap(s)));
        seam(&mut sewing, &format!("under-{name}"), (arm, under(s)), (arm, under(-s)));
    }
    Drawing { sheets, sewing, fabrics: vec![("cotton", shirting())], body: body(), edge: 30.0, drape: Vec::new() }
}

/// Writes the drawing with other places than those of its sheets.
fn write_with_places(
    drawing: &Drawing,
    places: &str,
    folder: &std::path::Path,
    accuracy: Option<&str>,
) -> std::io::Result<()> {
    drawing.write(folder, accuracy)?;
    std::fs::write(folder.join("sewing.toml"), format!("{}{places}", drawing.sewing))
}

/// Its sewing file has seams alone: the pieces arrange themselves.
fn shirt(lab: &mut Lab) -> Result<(), String> {
    let drawing = shirt_drawing();
    let accuracy = lab.accuracy().map(str::to_owned);
    let run = lab.program(&[], |folder| write_with_places(&drawing, "", folder, accuracy.as_deref()))?;
    good(lab, &run);
    lab.expect(run.findings().any(|f| f["code"] == "arranged"), "no finding `arranged`");
    Ok(())
}

/// Its left sleeve is put on the right arm, and the right one on the left: refused before the first step.
fn swapped_sleeves(lab: &mut Lab) -> Result<(), String> {
    let drawing = shirt_drawing();
    let place = |piece: &str, side: &str| {
        format!("[[place]]\npiece = \"{piece}\"\naround = \"arm-{side}\"\nside = \"{side}\"\nheight = \"0 mm\"\n")
    };
    let places = place("SLEEVE-L", "right") + &place("SLEEVE-R", "left");
    let run = lab.program(&[], |folder| write_with_places(&drawing, &places, folder, None))?;
    lab.refusal(&run, "arm-swapped");
    for piece in ["SLEEVE-L", "SLEEVE-R"] {
        let named = run.findings().any(|f| f["code"] == "arm-swapped" && f["message"].to_string().contains(piece));
        lab.expect(named, format!("`{piece}` is not named"));
    }
    Ok(())
}
