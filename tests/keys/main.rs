//! Every key of every file format acts: where its value changes, the result changes, or a finding says why not.
//!
//! The keys come from the generated schemas, so a new key fails here until it has a row. What is compared are results:
//! pieces, meshes, seams, positions, certificate, files. What a file says is also kept in the document as it was read;
//! that copy does not count.

#[path = "../support/mod.rs"]
mod support;

mod flips;
mod observed;
mod project;
mod schema;

use flips::{FILES, Flip, NOTES, STAGES};
use observed::{Observed, Project};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Keys of a table that no row flips, and rows whose key is not in the schema.
fn uncovered(known: &BTreeSet<String>, flipped: &BTreeSet<String>) -> Vec<String> {
    let is_note =
        |key: &&String| !NOTES.iter().any(|(note, _)| *note == key.as_str() || key.ends_with(&format!(".{note}")));
    let missing = known.difference(flipped).filter(is_note).map(|k| format!("no row flips `{k}`"));
    missing.chain(flipped.difference(known).map(|k| format!("`{k}` is no key"))).collect()
}

/// The project of a row and its circumstances.
fn circumstances(row: &Flip) -> (&'static str, Vec<&'static str>) {
    (row.project, row.given.to_vec())
}

/// Runs the project of a row with its circumstances, then with the flip as well; the first is run once for all rows
/// with the same circumstances.
fn silent(rows: &'static [Flip], file: &str) -> Vec<String> {
    let run = |project, words: Vec<&'static str>| Project::new(project).changed(file, words.into_iter()).observe();
    let different: BTreeSet<_> = rows.iter().map(circumstances).collect();
    let before: BTreeMap<_, Observed> =
        different.into_par_iter().map(|(project, given)| ((project, given.clone()), run(project, given))).collect();
    let is_silent = |row: &&Flip| {
        let flip = format!("{}={}", row.key, row.value);
        let given = row.given.iter().copied().chain([flip.as_str()]);
        before[&circumstances(row)] == Project::new(row.project).changed(file, given).observe()
    };
    let silent = rows.par_iter().filter(is_silent);
    silent.map(|row| format!("{file}: `{}={}` with {:?} changes nothing", row.key, row.value, row.given)).collect()
}

#[test]
fn every_parameter_of_every_stage_acts() {
    let mut told = Vec::new();
    let mut flipped = BTreeSet::new();
    for row in STAGES {
        flipped.insert(schema::plain(row.key));
    }
    told.extend(uncovered(&schema::of_stages(), &flipped));
    told.extend(silent(STAGES, "pipeline"));
    assert!(told.is_empty(), "{}", told.join("\n"));
}

#[test]
fn every_key_of_the_sewing_fabric_and_body_file_acts() {
    let mut told = Vec::new();
    for (file, rows) in FILES {
        let flipped = rows.iter().map(|row| schema::plain(row.key)).collect();
        told.extend(uncovered(&schema::of_file(file), &flipped));
        told.extend(silent(rows, file));
    }
    assert!(told.is_empty(), "{}", told.join("\n"));
}

/// The circumstances that rows start from are sound.
#[test]
fn the_projects_run_to_their_end() {
    for name in [
        "pattern",
        "altered",
        "moved",
        "shown",
        "specification",
        "garment",
        "sheet",
        "kes",
        "fast",
        "curve",
        "isotropic",
        "springs",
    ] {
        let seen = Project::new(name).observe();
        assert!(seen.exit() == 0, "{name}: {seen:?}");
    }
}
