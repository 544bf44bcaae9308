//! Garments from outside the repository, sewn and draped on their bodies.
//!
//! ```text
//! TOILE_GARMENTS=FOLDER cargo test --release --test garments -- --ignored --nocapture
//! ```
//!
//! The folder holds, per garment, `NAME.dxf` and `NAME.facts.json` (pieces with edges and placement, seam runs, body;
//! mm), and `bodies/` with OBJ files in metres. Each becomes a project of its own: the facts make the sewing file,
//! skirts and trousers are held at the waist. `TOILE_ONLY=WORD` takes those whose name holds the word, `TOILE_EDGE`
//! another mesh.

#![allow(clippy::print_stdout, clippy::expect_used, clippy::unwrap_used)]

mod support;

use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use support::bench::Bench;

/// Seam sides that differ by more than this are gathered.
const GATHERED: f64 = 1.05;
/// Unsewn edges this near to the top belong to the waist, mm.
const WAISTBAND: f64 = 45.0;

#[test]
#[ignore = "needs a folder of garments in TOILE_GARMENTS"]
fn every_garment_is_sewn_and_rests_with_a_passed_certificate() {
    let folder = PathBuf::from(std::env::var_os("TOILE_GARMENTS").expect("TOILE_GARMENTS names a folder"));
    let only = std::env::var("TOILE_ONLY").unwrap_or_default();
    let mut names: Vec<String> = std::fs::read_dir(&folder)
        .expect("the folder")
        .filter_map(|e| Some(e.ok()?.file_name().to_str()?.strip_suffix(".facts.json")?.to_owned()))
        .filter(|n| n.contains(&only))
        .collect();
    names.sort();
    assert!(!names.is_empty(), "no *.facts.json in {}", folder.display());
    let failed: Vec<&String> = names.iter().filter(|n| !passes(&folder, n)).collect();
    assert!(failed.is_empty(), "{failed:?}");
}

/// Sews and drapes one garment; prints its figures.
fn passes(folder: &Path, name: &str) -> bool {
    let text = std::fs::read_to_string(folder.join(format!("{name}.facts.json"))).expect("facts");
    let facts: Value = serde_json::from_str(&text).expect("facts are JSON");
    let bench = Bench::new();
    write_project(&bench, folder, name, &facts);
    let said = bench.run(&[]);
    let record = bench.output("run.json").unwrap_or_default();
    let record: Value = serde_json::from_str(&record).unwrap_or_default();
    let seconds = |stage: &str| {
        let all = record["stages"].as_array().into_iter().flatten();
        all.filter(|s| s["use"] == stage).filter_map(|s| s["cpu_seconds"].as_f64()).sum::<f64>()
    };
    let c = &record["certificate"];
    println!(
        "{name}: exit {}, residual {}, strain {} of {}, stitch {:.1} s, drape {:.1} s (CPU) {}",
        said.code,
        c["residual_rel"],
        c["strain_max"],
        c["limits"]["strain_max"],
        seconds("stitch"),
        seconds("drape"),
        said.err.lines().next().unwrap_or_default()
    );
    said.code == 0
}

fn write_project(to: &Bench, folder: &Path, name: &str, facts: &Value) {
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
    let edge = std::env::var("TOILE_EDGE").unwrap_or_else(|_| "12 mm".to_owned());
    to.stages(&format!(
        "[[stage]]\nuse = \"import-dxf\"\nwith.file = \"../../pattern.dxf\"\nwith.sewing = \"../../sewing.toml\"\n\
         [[stage]]\nuse = \"triangulate\"\nwith.edge_length = \"{edge}\"\n\
         [[stage]]\nuse = \"assemble\"\n\
         [[stage]]\nuse = \"stitch\"\nwith.body = \"../../body.obj\"\nwith.fabric = \"../../fabric.toml\"\n\
         [[stage]]\nuse = \"drape\"\n\
         [[stage]]\nuse = \"export-gltf\"\nwith.file = \"{{out}}/garment.glb\"\n"
    ));
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
