//! Watching a pipeline: a run after a change, through the cache, and a page that follows.

use crate::support;
use std::time::{Duration, Instant};
use support::project::Project;

/// Waits until the page tells of a run.
fn wait_for(project: &Project, number: usize) {
    let began = Instant::now();
    let wanted = format!("window.toileRun({number}, ");
    let told = || std::fs::read_to_string(project.path("out/watch.js")).unwrap_or_default();
    while !told().starts_with(&wanted) {
        assert!(began.elapsed() < Duration::from_secs(120), "run {number}: {}", told());
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn a_change_is_run_again_and_only_what_changed_is_computed() {
    let project = Project::new();
    let mut child = project.command("watch draped.toml --out out --quiet --runs 3").spawn().expect("watch");
    wait_for(&project, 1);
    let glb = || std::fs::read(project.path("out/skirt.glb")).expect("garment");
    let first = glb();
    let image = std::fs::read(project.path("plain-weave.png")).expect("image");
    std::fs::write(project.path("twill-stripe.png"), image).expect("another texture");
    wait_for(&project, 2);
    assert_ne!(glb(), first, "the new texture is in the garment");
    let record = project.json("out/run.json");
    let stages = record["stages"].as_array().expect("stages");
    let cached = |id: &str| stages.iter().any(|s| s["id"] == id && s["cached"] == true);
    assert!(cached("stitch") && cached("drape") && !cached("export-report"), "{record}");
    assert!(project.path("out/watch.html").is_file() && project.path("out/report.html").is_file());

    // A mistake ends no watch: the next change is seen.
    project.change("draped.toml", "use = \"drape\"", "use = \"drap\"");
    let ended = child.wait().expect("end");
    assert_eq!(ended.code(), Some(2), "as the last run");
}

#[test]
fn a_watch_ends_as_its_last_run_and_never_waits_for_a_name_that_is_wrong() {
    let project = Project::new();
    assert_eq!(project.toile("watch printed.toml --out out --quiet --runs 1").0, 0);
    let (code, _, err) = project.toile("watch printd.toml --out out --quiet");
    assert!(code == 2 && err.contains("error[file-missing]"), "{err}");
    project.change("printed.toml", "{size}", "none");
    assert_eq!(project.toile("watch printed.toml --out out --quiet --runs 1").0, 2, "no such size");
}
