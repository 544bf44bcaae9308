//! Draped garments, edited in 3D and laid flat: every edit comes to rest, nothing flips, symmetric edits give symmetric
//! pieces, and what is written is sewn again.
//!
//! ```text
//! TOILE_GARMENTS=FOLDER cargo test --release --test edits -- --ignored --nocapture
//! ```
//!
//! The garments are three samples, and those of a folder as `tests/garments.rs` takes it. `TOILE_EDITS=500` is the
//! number of random edits, `TOILE_ONLY=WORD` takes the garments whose name holds the word, `TOILE_KEEP=FOLDER` keeps
//! the GLB of every fault. The same number gives the same edits on every machine. About a quarter of an hour.

#![allow(clippy::print_stdout, clippy::expect_used, clippy::unwrap_used)]

mod dice;
mod edit;
mod garments;
#[path = "../support/mod.rs"]
mod support;
mod symmetric;

use dice::Dice;
use edit::{Edit, random};
use garments::{CIRCLE_SKIRT, Draped, SAMPLES, outside, sample};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;
use support::bench::Bench;
use support::parallel::side_by_side;
use toile_garment::{Garment, Vec2};

/// All garments that are asked for.
fn garments() -> Vec<Draped> {
    let only = std::env::var("TOILE_ONLY").unwrap_or_default();
    let samples = SAMPLES.iter().filter(|s| s.0.contains(&only)).map(sample);
    let folder = std::env::var_os("TOILE_GARMENTS").map(PathBuf::from);
    samples.chain(folder.iter().flat_map(|f| outside(f, &only))).collect()
}

#[test]
fn a_few_edits_of_the_skirt_come_to_rest_without_a_flip() {
    assert_eq!(faults(&[sample(&SAMPLES[2])], 9), Vec::<String>::new());
}

#[test]
#[ignore = "hundreds of edits"]
fn random_edits_come_to_rest_without_a_flip() {
    let count = std::env::var("TOILE_EDITS").map_or(500, |n| n.parse().expect("a number"));
    assert_eq!(faults(&garments(), count), Vec::<String>::new());
}

/// Tries edits of all garments in turn, and tells what went wrong.
fn faults(garments: &[Draped], count: usize) -> Vec<String> {
    let numbers: Vec<usize> = (0..count).collect();
    let told = side_by_side(&numbers, |k| {
        let garment = &garments[k % garments.len()];
        let edit = random(&mut Dice::new(*k as u64), k / garments.len(), garment);
        let (fault, seconds) = tried(garment, &edit);
        let word = fault.clone().unwrap_or_else(|| "rests".to_owned());
        println!("{k} {}: {}, {seconds:.1} s: {word}", garment.name, edit.words);
        (edit.kind, seconds, fault.map(|f| format!("{k} {}: {}: {f}", garment.name, edit.words)))
    });
    let mut kinds: BTreeMap<&str, (usize, f64)> = BTreeMap::new();
    for (kind, seconds, _) in &told {
        let sum = kinds.entry(kind).or_default();
        *sum = (sum.0 + 1, f64::max(sum.1, *seconds));
    }
    println!("{count} edits of {} garments; kind, edits, the slowest: {kinds:?}", garments.len());
    told.into_iter().filter_map(|(_, _, fault)| fault).collect()
}

/// Lays an edited garment flat and writes the pattern. What is wrong with it, and the seconds of the flattening.
fn tried(garment: &Draped, edit: &Edit) -> (Option<String>, f64) {
    let bench = Bench::new();
    let said = flattened(&bench, garment, edit);
    let seconds = garments::seconds(&bench, "flatten");
    let fault = if said.code != 0 { Some(format!("exit {}: {}", said.code, said.err)) } else { wrong(&bench) };
    if let (Some(_), Some(folder)) = (&fault, std::env::var_os("TOILE_KEEP")) {
        let name = format!("{}-{}.glb", garment.name, edit.words.replace(|c: char| !c.is_alphanumeric(), "-"));
        std::fs::write(PathBuf::from(folder).join(name), edit.on(&garment.glb)).expect("kept");
    }
    (fault, seconds)
}

/// Runs the chain from the edited GLB to the pattern.
fn flattened(bench: &Bench, garment: &Draped, edit: &Edit) -> support::bench::Said {
    std::fs::write(bench.path("edited.glb"), edit.on(&garment.glb)).expect("GLB");
    let mut chain = "[[stage]]\nuse = \"import-garment\"\nwith.file = \"../../edited.glb\"\n".to_owned();
    if let Some(size) = edit.size {
        garment.copy_bodies(bench, size);
        chain += "[[stage]]\nuse = \"transfer\"\nwith.from = \"../../body.obj\"\nwith.body = \"../../other.obj\"\n";
    }
    bench.stages(&format!(
        "{chain}[[stage]]\nuse = \"flatten\"\nwith.metric = \"{}\"\nwith.smooth = \"{} mm\"\n\
         [[stage]]\nuse = \"export-gltf\"\nwith.file = \"{{out}}/flat.glb\"\n\
         [[stage]]\nuse = \"export-dxf\"\nwith.file = \"{{out}}/new.dxf\"\nwith.sewing = \"{{out}}/new.sewing.toml\"\n",
        edit.metric, edit.smooth
    ));
    bench.run(&[])
}

/// The faults of a garment that was laid flat: no rest, flipped triangles, places that are no numbers.
fn wrong(bench: &Bench) -> Option<String> {
    let findings = bench.record()["findings"].as_array().cloned().unwrap_or_default();
    let restless = |f: &&Value| f["code"] == "flatten-not-at-rest";
    if let Some(finding) = findings.iter().find(restless) {
        return Some(finding["message"].to_string());
    }
    let bytes = std::fs::read(bench.out().join("flat.glb")).expect("GLB");
    let garment = toile_formats::gltf::read_stored_garment(&bytes).expect("garment");
    let flipped = flips(&garment);
    (flipped > 0).then(|| format!("{flipped} triangles are flipped"))
}

fn flips(garment: &Garment) -> usize {
    let flat = garment.flat.as_ref().expect("flat pieces");
    assert_eq!(flat.pieces.len(), garment.pieces.len());
    let of_piece = |(piece, flat): (&toile_garment::Piece, &toile_garment::flat::FlatPiece)| {
        let mesh = piece.mesh.as_ref().expect("mesh");
        let at = |v: u32| flat.positions[v as usize];
        let area = |[a, b, c]: [Vec2; 3]| (b - a).perp(&(c - a));
        let is_upright = |t: &&[u32; 3]| area(t.map(at)) > 0.0;
        mesh.triangles.len() - mesh.triangles.iter().filter(is_upright).count()
    };
    garment.pieces.iter().zip(&flat.pieces).map(of_piece).sum()
}

#[test]
#[ignore = "sews every garment twice"]
fn edited_garments_are_sewn_again() {
    let mut failed = Vec::new();
    for garment in garments() {
        for edit in symmetric::edits(&garment) {
            let bench = Bench::new();
            let said = flattened(&bench, &garment, &edit);
            let again = if said.code == 0 { garment.sewn_again(&bench) } else { Err(said.err) };
            let word = again.clone().unwrap_or_else(|e| format!("fails: {e}"));
            println!("{}: {}: {word}", garment.name, edit.words);
            failed.extend(again.err().map(|e| format!("{}: {}: {e}", garment.name, edit.words)));
        }
    }
    assert_eq!(failed, Vec::<String>::new());
}

#[test]
fn a_symmetric_edit_of_the_circle_skirt_gives_symmetric_pieces() {
    symmetric::judge(&[sample(&CIRCLE_SKIRT)]);
}

#[test]
#[ignore = "needs the garments of a folder"]
fn symmetric_edits_give_symmetric_pieces() {
    symmetric::judge(&garments());
}
