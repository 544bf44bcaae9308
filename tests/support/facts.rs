//! Garments from outside the repository: a pattern with facts (pieces with edges and placement, seam runs, body; mm)
//! becomes a project of its own.

use super::bench::Bench;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

/// Seam sides that differ by more than this are gathered.
const GATHERED: f64 = 1.05;
/// Unsewn edges this near to the top belong to the waist, mm.
const WAISTBAND: f64 = 45.0;

/// Names of the garments in a folder.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder").flatten();
    let name = |e: std::fs::DirEntry| Some(e.file_name().to_str()?.strip_suffix(".facts.json")?.to_owned());
    let mut names: Vec<String> = entries.filter_map(name).collect();
    names.sort();
    names
}

/// Reads the facts of a garment.
pub fn read(folder: &Path, name: &str) -> Value {
    let text = std::fs::read_to_string(folder.join(format!("{name}.facts.json"))).expect("facts");
    serde_json::from_str(&text).expect("facts are JSON")
}

/// Writes pattern, sewing file, body and fabric into the root of a bench.
pub fn write_files(to: &Bench, folder: &Path, name: &str, facts: &Value) {
    let body = facts["body"]["obj"].as_str().expect("a body");
    // Trousers go on legs that stand apart.
    let apart = body.replace(".obj", "_apart.obj");
    let body = if name.contains("pants") { &apart } else { body };
    std::fs::copy(folder.join(format!("{name}.dxf")), to.path("pattern.dxf")).expect("the pattern");
    std::fs::copy(folder.join("bodies").join(body), to.path("body.obj")).expect("the body");
    let measures = facts["body"]["measurements"].as_str().expect("measurements");
    let measures = std::fs::read_to_string(folder.join("bodies").join(measures)).expect("measurements");
    std::fs::write(to.path("body.toml"), side_file(&measures)).expect("side file");
    let fabric = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/fabrics/cotton-shirting.toml");
    std::fs::copy(fabric, to.path("fabric.toml")).expect("the fabric");
    std::fs::write(to.path("sewing.toml"), sewing(name, facts)).expect("sewing file");
}

/// The height of the waist is what is left of the body's under head and upper body.
fn side_file(measures: &str) -> String {
    let cm = |key: &str| -> f64 {
        let line = measures.lines().find_map(|l| l.trim().strip_prefix(key)?.strip_prefix(':'));
        line.and_then(|v| v.trim().parse().ok()).expect("a measure in cm")
    };
    let waist = 10.0 * (cm("height") - cm("head_l") - cm("waist_line"));
    format!(
        "name = \"body\"\n[measures]\nwaist_height = \"{waist:.0} mm\"\n[landmarks]\nwaist = [\"0 mm\", \"{waist:.0} mm\", \
         \"0 mm\"]\n[segments.torso]\nfrom = [\"0 mm\", \"{:.0} mm\", \"-10 mm\"]\nto = [\"0 mm\", \"{:.0} mm\", \"-10 mm\"]\n\
         half_width = \"{:.0} mm\"\nhalf_depth = \"{:.0} mm\"\n",
        waist + 310.0,
        waist - 290.0,
        10.0 * cm("waist") / 4.8,
        10.0 * cm("waist") / 7.5
    )
}

fn sewing(name: &str, facts: &Value) -> String {
    let mut text = String::new();
    let mut sewn = BTreeSet::new();
    for side in list(&facts["seams"]).flat_map(|s| [&s["a"], &s["b"]]) {
        sewn.insert((side["piece"].as_str().expect("piece"), side["edge"].as_u64()));
    }
    for run in list(&facts["seam_runs"]) {
        let (a, b) = (number(&run["length_a"]), number(&run["length_b"]));
        let _ = writeln!(text, "[[seam]]");
        for side in ["a", "b"] {
            let turned = side == "b" && run["pairing"] == "opposite";
            let piece = piece(facts, run[side]["piece"].as_str().expect("piece"));
            let edges = list(&run[side]["edges"]).map(|e| &piece["edges"][e.as_u64().expect("edge") as usize]);
            let parts: Vec<String> = edges.map(|e| between(piece, e, turned)).collect();
            let _ = writeln!(text, "{side} = [{}]", parts.join(", "));
        }
        let ratio = a.max(b) / a.min(b);
        if ratio > GATHERED {
            let _ = writeln!(text, "gather = {ratio:.4}");
        }
    }
    list(&facts["pieces"]).for_each(|p| place(p, &mut text));
    if ["skirt", "pants"].iter().any(|w| name.contains(w)) {
        hold_waist(facts, &sewn, &mut text);
    }
    text
}

fn place(piece: &Value, text: &mut String) {
    let at = &piece["placement"];
    let t: Vec<String> = list(&at["translation_mm"]).map(|c| format!("\"{:.3} mm\"", number(c))).collect();
    let _ = writeln!(text, "[[place]]\npiece = {}\nrotation = {}", piece["block"], at["rotation"]);
    let _ = writeln!(text, "translation = [{}]", t.join(", "));
}

/// Holds the free edges at the top to the waist.
fn hold_waist(facts: &Value, sewn: &BTreeSet<(&str, Option<u64>)>, text: &mut String) {
    let height = |p: &Value, e: &Value, end: &str| number(&e[end][1]) + number(&p["placement"]["translation_mm"][1]);
    let edges = || list(&facts["pieces"]).flat_map(|p| list(&p["edges"]).map(move |e| (p, e)));
    let top = edges().map(|(p, e)| height(p, e, "start")).fold(f64::NEG_INFINITY, f64::max);
    for (p, e) in edges() {
        let free = !sewn.contains(&(p["name"].as_str().expect("name"), e["index"].as_u64()));
        if free && height(p, e, "start").min(height(p, e, "end")) > top - WAISTBAND {
            let (from, to) = (point(&e["start"]), point(&e["end"]));
            let name = format!("waist-{}", e["index"]);
            let _ = writeln!(text, "[[edge]]\npiece = {}\nname = \"{name}\"\nfrom = {from}\nto = {to}", p["block"]);
            let _ = writeln!(
                text,
                "[[attach]]\npiece = {}\nedge = \"{name}\"\nto = \"waist\"\nstrength = \"hold\"",
                p["block"]
            );
        }
    }
}

fn between(piece: &Value, edge: &Value, turned: bool) -> String {
    let (a, b) = (point(&edge["start"]), point(&edge["end"]));
    let (from, to) = if turned { (b, a) } else { (a, b) };
    format!("{{ piece = {}, from = {from}, to = {to} }}", piece["block"])
}

fn piece<'a>(facts: &'a Value, name: &str) -> &'a Value {
    list(&facts["pieces"]).find(|p| p["name"] == name).expect("a piece of that name")
}

fn point(p: &Value) -> String {
    format!("[\"{:.4} mm\", \"{:.4} mm\"]", number(&p[0]), number(&p[1]))
}

fn number(v: &Value) -> f64 {
    v.as_f64().expect("a number")
}

fn list(v: &Value) -> impl Iterator<Item = &Value> {
    v.as_array().into_iter().flatten()
}
