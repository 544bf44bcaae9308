//! The garments of the samples: each has its files, and passes on five bodies in three fabrics without a changed setting.
//!
//! ```text
//! cargo test --release --test own_garments -- --ignored --nocapture
//! ```
//!
//! Patterns are drawn in five sizes, bodies of the missing sizes are made, and the pipelines are run as they stand.
//! `TOILE_ONLY=WORD` takes the garments whose name holds the word. About half an hour.

#![allow(clippy::print_stdout, clippy::expect_used)]

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Sizes of patterns and bodies.
const SIZES: [&str; 5] = ["34", "36", "38", "40", "42"];
/// Three cloths that are woven, and three that are knitted.
const WOVEN: [&str; 3] = ["cotton-shirting", "wool-suiting", "silk-habotai"];
const KNITTED: [&str; 3] = ["cotton-jersey", "cotton-interlock", "cotton-fleece"];
/// Garments whose bands are stretched on, which only knitted cloth bears.
const STRETCHED: [&str; 2] = ["t-shirt", "hoodie"];
/// Garments whose pipeline changes the pattern of another one, so that they have none of their own.
const CHANGED: [&str; 1] = ["princess-bodice"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The garments: a folder of pipelines each. Other folders hold no first version.
fn styles() -> Vec<String> {
    let entries = std::fs::read_dir(root().join("pipelines")).expect("pipelines").flatten();
    let folders = entries.filter(|e| e.path().join("v1.toml").is_file());
    let mut names: Vec<String> = folders.filter_map(|e| e.file_name().into_string().ok()).collect();
    names.sort();
    names
}

#[test]
fn every_garment_has_its_files() {
    let styles = styles();
    assert!(styles.len() >= 10, "{styles:?}");
    for style in styles.iter().filter(|s| !CHANGED.contains(&s.as_str())) {
        for end in ["aama.dxf", "astm.dxf", "sewing.toml"] {
            let file = root().join("samples/patterns").join(format!("{style}.{end}"));
            assert!(file.is_file(), "{} is missing", file.display());
        }
    }
}

/// Its back clears the hip, and the back of a coarser mesh cuts it. So it is sewn without coarser cloth.
#[test]
fn a_finer_mesh_of_the_t_shirt_starts() {
    let folder = tempfile::tempdir().expect("folder");
    let pipeline = root().join("pipelines/t-shirt/v1.toml");
    let mut command = toile();
    command.arg("run").arg(pipeline).args(["--quiet", "--set", "triangulate.edge_length=10 mm", "--out"]);
    run(command.arg(folder.path().join("out")));
}

#[test]
#[ignore = "runs 150 garments"]
fn every_garment_passes_on_five_bodies_in_three_fabrics() {
    let only = std::env::var("TOILE_ONLY").unwrap_or_default();
    let folder = tempfile::tempdir().expect("folder");
    set_up(folder.path());
    let mut failed = Vec::new();
    for style in styles().iter().filter(|s| s.contains(&only)) {
        let fabrics = if STRETCHED.contains(&style.as_str()) { KNITTED } else { WOVEN };
        for (size, fabric) in SIZES.iter().flat_map(|s| fabrics.map(|f| (*s, f))) {
            if !passes(folder.path(), style, size, fabric) {
                failed.push(format!("{style} {size} {fabric}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// A project with patterns and bodies of all sizes, and the pipelines as they stand.
fn set_up(to: &Path) {
    for below in ["samples/fabrics", "samples/textures", "samples/bodies", "samples/patterns"] {
        copy(&root().join(below), &to.join(below));
    }
    for style in styles() {
        let below = Path::new("pipelines").join(style);
        copy(&root().join(&below), &to.join(&below));
    }
    let mut draw = Command::new(env!("CARGO"));
    draw.current_dir(root()).args(["run", "--release", "--quiet", "--example", "draw_patterns", "--"]);
    run(draw.arg(to.join("samples/patterns")).arg(SIZES.join(",")));
    for size in SIZES {
        let file = to.join(format!("samples/bodies/size-{size}.obj"));
        if !file.is_file() {
            run(toile().args(["body", "--size", size, "--out"]).arg(file));
        }
    }
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("folder");
    for entry in std::fs::read_dir(from).expect("folder").flatten().filter(|e| e.path().is_file()) {
        std::fs::copy(entry.path(), to.join(entry.file_name())).expect("copy");
    }
}

fn toile() -> Command {
    Command::new(env!("CARGO_BIN_EXE_toile"))
}

fn run(command: &mut Command) {
    let said = command.output().expect("started");
    assert!(said.status.success(), "{command:?}: {}", String::from_utf8_lossy(&said.stderr));
}

/// Runs one garment and prints its figures.
fn passes(folder: &Path, style: &str, size: &str, fabric: &str) -> bool {
    let out = folder.join("out").join(format!("{style}-{size}-{fabric}"));
    let mut command = toile();
    command.arg("run").arg("--allow-read").arg(folder).arg(folder.join("pipelines").join(style).join("v1.toml"));
    command
        .args(["--quiet", "--set", &format!("size={size}"), "--set", &format!("fabric={fabric}"), "--out"])
        .arg(&out);
    let said = command.output().expect("started");
    let record = std::fs::read(out.join("run.json")).unwrap_or_default();
    let record: Value = serde_json::from_slice(&record).unwrap_or_default();
    let stages = record["stages"].as_array().into_iter().flatten();
    let seconds: f64 = stages.filter_map(|s| s["cpu_seconds"].as_f64()).sum();
    let certificate = &record["certificate"];
    let strain = certificate["strain_over_limit"].as_f64().unwrap_or(f64::NAN);
    let error = String::from_utf8_lossy(&said.stderr);
    let code = said.status.code().unwrap_or(-1);
    println!(
        "{style} {size} {fabric}: exit {code}, {seconds:.1} CPU s, strain {strain:.2} of the limit {}",
        first(&error)
    );
    code == 0
}

fn first(text: &str) -> &str {
    text.lines().next().unwrap_or_default()
}
