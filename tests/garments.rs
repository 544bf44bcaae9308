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
use std::path::{Path, PathBuf};
use support::bench::Bench;
use support::facts;

#[test]
#[ignore = "needs a folder of garments in TOILE_GARMENTS"]
fn every_garment_is_sewn_and_rests_with_a_passed_certificate() {
    let folder = PathBuf::from(std::env::var_os("TOILE_GARMENTS").expect("TOILE_GARMENTS names a folder"));
    let only = std::env::var("TOILE_ONLY").unwrap_or_default();
    let names: Vec<String> = facts::names(&folder).into_iter().filter(|n| n.contains(&only)).collect();
    assert!(!names.is_empty(), "no *.facts.json in {}", folder.display());
    let failed: Vec<&String> = names.iter().filter(|n| !passes(&folder, n)).collect();
    assert!(failed.is_empty(), "{failed:?}");
}

/// Sews and drapes one garment; prints its figures.
fn passes(folder: &Path, name: &str) -> bool {
    let bench = Bench::new();
    facts::write_files(&bench, folder, name, &facts::read(folder, name));
    let edge = std::env::var("TOILE_EDGE").unwrap_or_else(|_| "12 mm".to_owned());
    bench.stages(&chain(&edge));
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

fn chain(edge: &str) -> String {
    format!(
        "[[stage]]\nuse = \"import-dxf\"\nwith.file = \"../../pattern.dxf\"\nwith.sewing = \"../../sewing.toml\"\n\
         [[stage]]\nuse = \"triangulate\"\nwith.edge_length = \"{edge}\"\n\
         [[stage]]\nuse = \"assemble\"\n\
         [[stage]]\nuse = \"stitch\"\nwith.body = \"../../body.obj\"\nwith.fabric = \"../../fabric.toml\"\n\
         [[stage]]\nuse = \"drape\"\n\
         [[stage]]\nuse = \"export-gltf\"\nwith.file = \"{{out}}/garment.glb\"\n"
    )
}
