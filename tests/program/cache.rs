//! The stage cache: the same bytes with and without it, nothing done twice, and nothing damaged used.

use crate::support;
use serde_json::Value;
use std::path::{Path, PathBuf};
use support::project::Project;

/// Runs the draped skirt; gives the ids of the stages that came from the cache.
fn run(project: &Project, out: &str, more: &str) -> Vec<String> {
    let (code, _, err) = project.toile(format!("run draped.toml --out {out} --quiet {more}").trim());
    assert!(code == 0 || code == 1, "{code}: {err}");
    cached(&project.json(&format!("{out}/run.json")))
}

fn cached(record: &Value) -> Vec<String> {
    let stages = record["stages"].as_array().expect("stages").iter().filter(|s| s["cached"] == true);
    stages.map(|s| s["id"].as_str().expect("id").to_owned()).collect()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.path().is_dir() { files(&entry.path(), found) } else { found.push(entry.path()) }
    }
}

#[test]
fn a_cached_drape_gives_the_same_bytes_and_is_not_computed_again() {
    let project = Project::new();
    assert!(run(&project, "plain", "").is_empty());
    let plain = project.digests("plain");
    assert!(run(&project, "first", "--cache cache").is_empty());
    assert_eq!(project.digests("first"), plain, "storing changes nothing");
    let second = run(&project, "second", "--cache cache");
    assert!(["stitch", "drape", "export-report"].iter().all(|s| second.iter().any(|id| id == s)), "{second:?}");
    assert_eq!(project.digests("second"), plain, "taking changes nothing");
    let inputs = |out: &str| project.json(&format!("{out}/run.json"))["inputs"].clone();
    let findings = |out: &str| project.json(&format!("{out}/run.json"))["findings"].clone();
    assert_eq!((inputs("second"), findings("second")), (inputs("plain"), findings("plain")));

    // Another texture: the drape is there, and what shows the texture is made anew.
    let textured = run(&project, "textured", "--set image=plain-weave --cache cache");
    assert!(textured.iter().any(|id| id == "drape") && !textured.iter().any(|id| id.starts_with("export")));
    run(&project, "textured-plain", "--set image=plain-weave");
    assert_eq!(project.digests("textured"), project.digests("textured-plain"));

    // Another fabric: nothing of the drape holds any more.
    let other = run(&project, "linen", "--set fabric=linen-plain --cache cache");
    assert!(!other.iter().any(|id| id == "drape" || id == "stitch"), "{other:?}");

    // A file changed under the same name: its content counts.
    project.change("wool-suiting.toml", "friction", "# A comment.\nfriction");
    let comment = run(&project, "comment", "--cache cache");
    assert!(comment.iter().any(|id| id == "drape"), "the same cloth is the same drape: {comment:?}");
    damage(&project);
}

/// Every file of the cache in turn is made wrong: it is found, not used, and the bytes are right.
fn damage(project: &Project) {
    run(project, "before", "");
    let right = project.digests("before");
    run(project, "warm", "--cache small");
    let mut all = Vec::new();
    files(&project.path("small"), &mut all);
    assert!(all.len() >= 6, "{all:?}");
    for path in &all {
        let mut bytes = std::fs::read(path).expect("file");
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        std::fs::write(path, bytes).expect("damage");
    }
    assert!(run(project, "damaged", "--cache small").is_empty(), "nothing damaged is used");
    assert_eq!(project.digests("damaged"), right);
    let record = project.json("damaged/run.json");
    let codes: Vec<&str> =
        record["findings"].as_array().expect("findings").iter().filter_map(|f| f["code"].as_str()).collect();
    assert!(codes.contains(&"cache-damaged"), "{codes:?}");
    assert!(!run(project, "healed", "--cache small").is_empty(), "it is whole again");
    assert_eq!(project.digests("healed"), right);
}

#[test]
fn two_programs_share_a_folder_and_keep_it_small() {
    let project = Project::new();
    let start = |out: &str| {
        project
            .command(&format!("run draped.toml --out {out} --quiet --cache cache --cache-size 1"))
            .spawn()
            .expect("run")
    };
    let (mut one, mut two) = (start("one"), start("two"));
    one.wait().expect("end");
    two.wait().expect("end");
    assert_eq!(project.digests("one"), project.digests("two"));
    let mut all = Vec::new();
    files(&project.path("cache"), &mut all);
    let size: u64 = all.iter().map(|p| p.metadata().expect("file").len()).sum();
    assert!(size <= 1_000_000, "{size} bytes");
    run(&project, "three", "--cache cache --cache-size 1");
    assert_eq!(project.digests("one"), project.digests("three"), "what is left is right");
}
