//! `compare` end to end on a mesh far too coarse to wear.

use crate::support;
use serde_json::Value;
use std::ffi::OsString;
use std::path::Path;
use support::bench::{Said, command};

fn compare(out: &Path, more: &[&str]) -> Said {
    let pipeline = Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines/long-skirt/v1.toml");
    let mut arguments: Vec<OsString> = vec!["compare".into(), pipeline.into(), "--out".into(), out.into()];
    arguments.extend(["--set", "triangulate.triangles=600"].map(OsString::from));
    arguments.extend(more.iter().map(OsString::from));
    command(arguments)
}

#[test]
fn methods_are_measured_by_one_law() {
    let dir = tempfile::tempdir().expect("folder");
    let said = compare(dir.path(), &["--json", "--methods", "sewn-only,implicit,toile,paper"]);
    assert_eq!(said.code, 0, "{said:?}");
    let found: Value = serde_json::from_str(&said.out).expect("JSON");
    let rows = found["rows"].as_array().expect("rows");
    let names: Vec<&str> = rows.iter().filter_map(|r| r["name"].as_str()).collect();
    assert_eq!(names, ["toile", "paper", "implicit", "sewn-only"], "in the order of the table");
    for row in rows {
        let is_draped = row["name"] != "sewn-only";
        assert_eq!(row["failure"], Value::Null, "{row}");
        assert_eq!(row["drape_cpu_seconds"].as_f64() > Some(0.0), is_draped, "{row}");
        assert_eq!(row["same_folds"]["mean_mm"].is_number(), is_draped, "{row}");
        assert!(row["sewing_cpu_seconds"].as_f64() > Some(0.0) && row["own_folds"]["mean_mm"].is_number(), "{row}");
        assert_eq!(row["figures"]["body_crossings"], 0, "{row}");
    }
    let energy = |i: usize| rows[i]["figures"]["energy_above_mj"].as_f64().expect("energy");
    let [toile, paper, implicit, sewn] = [0, 1, 2, 3].map(energy);
    assert!(toile.abs() < 0.5 && implicit.abs() < 0.5, "both come to the least energy: {toile}, {implicit}");
    assert!(paper > 5.0 && sewn > paper, "springs resist, and sewn cloth has not come down yet: {paper}, {sewn}");
    let same = |i: usize| rows[i]["same_folds"]["mean_mm"].as_f64().expect("distance");
    assert!(same(0) < 1.0 && same(2) < 1.0 && same(1) > 2.0, "{} {} {}", same(0), same(1), same(2));
    let text = |name: &str| std::fs::read_to_string(dir.path().join(name)).expect(name);
    assert_eq!(text("compare.html").matches("<img").count(), 8);
    assert!(text("compare.md").contains("| paper |") && !text("compare.html").contains("<script"));
    let said = compare(dir.path(), &[]);
    assert!(said.code == 2 && said.err.contains("--force"), "{said:?}");
    std::fs::write(dir.path().join("compare.json"), "{}").expect("file");
    assert_eq!(compare(dir.path(), &[]).code, 2, "somebody's file is not replaced");
}

#[test]
fn an_unknown_method_is_refused_with_those_there_are() {
    let dir = tempfile::tempdir().expect("folder");
    let said = compare(dir.path(), &["--methods", "breen"]);
    assert!(said.code == 2 && said.err.contains("unknown-value") && said.err.contains("provot"), "{said:?}");
    let said = compare(dir.path(), &["--set", "drape.integrator=central-difference", "--methods", "toile"]);
    assert!(said.code == 2 && said.err.contains("this command varies it"), "{said:?}");
    std::fs::write(dir.path().join("run.json"), "{}").expect("file");
    let said = compare(dir.path(), &["--methods", "toile"]);
    assert!(said.code == 2 && said.err.contains("the folder of another command"), "{said:?}");
}
