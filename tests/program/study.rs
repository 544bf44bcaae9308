//! `study` end to end on meshes far too coarse to wear, and what `accuracy` makes of it.

use crate::support;
use serde_json::Value;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use support::bench::{Said, command};
use toile::study::Study;

fn pipeline() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines/long-skirt/v1.toml")
}

fn study(out: &Path, more: &[&str]) -> Said {
    let mut arguments: Vec<OsString> = vec!["study".into(), pipeline().into(), "--out".into(), out.into()];
    let few = "--edges=60mm,52mm,45mm --accuracies=normal --models=coupled --integrators=static --self-contact=auto \
               --starts=1";
    arguments.extend(few.split(' ').map(OsString::from));
    arguments.extend(more.iter().map(OsString::from));
    command(arguments)
}

fn names(study: &Value) -> Vec<&str> {
    study["rows"].as_array().expect("rows").iter().filter_map(|r| r["name"].as_str()).collect()
}

#[test]
fn a_study_compares_goes_on_and_is_chosen_from() {
    let dir = tempfile::tempdir().expect("folder");
    let out = dir.path().join("study");
    let said = study(&out, &["--json"]);
    assert_eq!(said.code, 0, "{said:?}");
    let found: Value = serde_json::from_str(&said.out).expect("JSON");
    assert_eq!(names(&found), ["60mm-normal", "52mm-normal", "45mm-normal"]);
    assert_eq!(found["finest"], 2);
    for row in found["rows"].as_array().expect("rows") {
        assert!(row["cpu_seconds"].as_f64().is_some_and(|s| s > 0.0) && row["triangles"].as_u64() > Some(20), "{row}");
        assert_eq!(row["lengths"]["hems_mm"].as_array().map(Vec::len), Some(2), "waist and hem");
        let error = row["error"]["length_mm"].as_f64().expect("error");
        assert_eq!(error == 0.0, row["name"] == "45mm-normal", "only the finest agrees with itself: {error}");
    }
    assert!(found["rows"][1]["estimate_to_finest_mm"].as_f64().is_some_and(|e| e > 0.0));
    for row in found["rows"].as_array().expect("rows") {
        assert_eq!(row["scatter"]["repeats"], 1, "{row}");
        let same_folds = row["carried"]["distance_p95_mm"].as_f64();
        assert_eq!(same_folds.is_some_and(|d| d > 0.0), row["name"] != "45mm-normal", "{row}");
    }
    let text = |name: &str| std::fs::read_to_string(out.join(name)).expect(name);
    assert!(text("study.svg").starts_with("<svg") && text("study.html").contains("<svg"));
    assert!(!text("study.html").contains("<script") && text("study.md").contains("| 52mm-normal |"));
    let document = out.join("runs/52mm-normal/garment.glb");
    let before = std::fs::read(&document).expect("garment");
    assert!(!String::from_utf8_lossy(&before).contains("cpu_seconds\":1"), "no times in a garment");

    goes_on(&out, &said, &document);
    is_chosen_from(dir.path(), &found);
}

/// Finished runs are not done again; unfinished ones, and those with other settings, are.
fn goes_on(out: &Path, first: &Said, document: &Path) {
    let again = study(out, &["--json"]);
    assert_eq!((again.code, &again.out), (0, &first.out), "the same figures, times included");
    assert_eq!(again.err.matches("done before").count(), 3, "{}", again.err);
    let before = std::fs::read(document).expect("garment");
    let result = document.with_file_name("result.json");
    let text = std::fs::read_to_string(&result).expect("result");
    let key = text.find("\"key\": \"").expect("key") + 8;
    std::fs::write(&result, format!("{}0{}", &text[..key], &text[key + 1..])).expect("result");
    std::fs::write(document, b"damaged").expect("garment");
    let mended = study(out, &["--json"]);
    assert_eq!(mended.err.matches("done before").count(), 2, "{}", mended.err);
    assert_eq!(std::fs::read(document).expect("garment"), before, "the same bytes as the first time");
    let other = out.join("study.json");
    std::fs::write(&other, "{}").expect("file");
    assert_eq!(study(out, &[]).code, 2, "somebody's file is not replaced");
}

/// A study beside a pipeline is what `accuracy` chooses from.
fn is_chosen_from(dir: &Path, found: &Value) {
    let text = std::fs::read_to_string(pipeline()).expect("pipeline");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let study: Study = serde_json::from_value(found.clone()).expect("a study");
    let wanted = (10.0 * study.stated(study.finest).expect("an error")).ceil() / 10.0;
    let file = dir.join("v1.toml");
    let head = format!("version = 1\naccuracy = \"{wanted} mm\"");
    let samples = root.join("samples").to_string_lossy().into_owned();
    std::fs::write(&file, text.replace("version = 1", &head).replace("../../samples", &samples)).expect("pipeline");
    let check = |more: &[&str]| {
        let mut arguments: Vec<OsString> =
            vec!["check".into(), file.clone().into(), "--allow-read".into(), root.into()];
        arguments.extend(more.iter().map(OsString::from));
        command(arguments)
    };
    assert_eq!(check(&[]).code, if wanted < toile::study::PRESETS[3].bound { 2 } else { 0 }, "the presets alone");
    std::fs::write(dir.join("v1.study.json"), found.to_string()).expect("study");
    let said = check(&[]);
    assert_eq!(said.code, 0, "{said:?}");
    assert!(said.err.contains("accuracy-chosen") && said.err.contains("v1.study.json"), "{said:?}");
    assert_eq!(check(&["--accuracy", "0.0001 mm"]).code, 2, "out of reach");
    std::fs::write(dir.join("v1.study.json"), "{}").expect("study");
    let said = check(&["--accuracy", "draft"]);
    assert!(said.code == 0 && said.err.contains("study-unfit"), "{said:?}");
}

#[test]
fn what_the_study_varies_is_not_held() {
    let dir = tempfile::tempdir().expect("folder");
    let said = study(&dir.path().join("study"), &["--set", "drape.model=springs"]);
    assert!(said.code == 2 && said.err.contains("study-held"), "{said:?}");
    assert_eq!(study(&dir.path().join("study"), &["--edges", "12"]).code, 2, "a bare number");
}

/// The page of a run shows the study beside its pipeline, while that is of this very garment.
#[test]
fn the_page_shows_the_study_of_its_garment_alone() {
    let dir = tempfile::tempdir().expect("folder");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (file, out) = (dir.path().join("v1.toml"), dir.path().join("study"));
    let text = std::fs::read_to_string(pipeline()).expect("pipeline");
    let samples = root.join("samples").to_string_lossy().into_owned();
    std::fs::write(&file, text.replace("../../samples", &samples)).expect("pipeline");
    let told = |verb: &str, more: &[&str]| {
        let own: [OsString; 4] = [verb.into(), file.clone().into(), "--allow-read".into(), root.into()];
        command(own.into_iter().chain(more.iter().map(OsString::from)).collect())
    };
    let out_text = out.to_string_lossy().into_owned();
    let few = "--edges=60mm,52mm,45mm --accuracies=normal --models=coupled --integrators=static --self-contact=auto \
               --starts=0 --language=zh";
    let said = told("study", &[&["--out", &out_text], few.split(' ').collect::<Vec<_>>().as_slice()].concat());
    assert_eq!(said.code, 0, "{said:?}");
    let page = std::fs::read_to_string(out.join("study.html")).expect("page");
    assert!(
        page.contains("精度与代价")
            && page.contains("<html lang=\"zh-Hans\">")
            && !page.contains("what accuracy costs")
    );
    std::fs::copy(out.join("study.json"), dir.path().join("v1.study.json")).expect("study");
    let run = |more: &[&str]| {
        let run = dir.path().join("run").to_string_lossy().into_owned();
        let said = told("run", &[&["--out", &run, "--force", "--quiet"], more].concat());
        assert!(said.code < 2, "{said:?}");
        let text = |name: &str| std::fs::read_to_string(dir.path().join("run").join(name)).expect(name);
        (text("report.html"), text("run.json"))
    };
    let (page, record) = run(&["--set", "triangulate.edge_length=52 mm"]);
    assert!(
        page.contains("<figure class=\"chart\">") && page.contains("This garment was draped as 52mm-normal: error")
    );
    assert!(!record.contains("study-not-shown") && record.contains("v1.study.json"));
    // Another mesh is no setting of the study, and another size another garment.
    let (page, _) = run(&["--set", "triangulate.edge_length=58 mm"]);
    assert!(page.contains("The setting of this garment is none of the study."));
    let (page, record) = run(&["--set", "triangulate.edge_length=52 mm", "--set", "size=40"]);
    assert!(record.contains("study-not-shown") && !page.contains("<figure class=\"chart\">"));
}
