//! Every released pipeline loads and its chain is sound; the committed schema is the one the program prints.
//! `TOILE_BLESS=1` writes the schema anew.

use serde_json::Value;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

fn toile(arguments: &[OsString]) -> (u8, String, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let all = std::iter::once(OsString::from("toile")).chain(arguments.iter().cloned());
    let stop = toile::engine::Stop::new();
    let code = toile::cli::run_from(all, toile_stages::builtin(), &stop, &mut out, &mut err);
    (code, String::from_utf8_lossy(&out).into_owned(), String::from_utf8_lossy(&err).into_owned())
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines")
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|e| e.path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            walk(&path, found);
        } else if path.extension().is_some_and(|e| e == "toml") {
            found.push(path);
        }
    }
}

#[test]
fn every_pipeline_is_sound_and_stands_where_it_says() {
    let mut files = Vec::new();
    walk(&root(), &mut files);
    for file in files {
        let (code, _, err) = toile(&["check".into(), file.clone().into()]);
        assert_eq!((code, err.as_str()), (0, ""), "{}", file.display());
        let text = std::fs::read_to_string(&file).expect("pipeline");
        let head: toml::Table = toml::from_str(&text).expect("TOML");
        let (line, version) = (head["pipeline"]["line"].as_str(), head["pipeline"]["version"].as_integer());
        let folder = file.parent().and_then(Path::file_name).and_then(|n| n.to_str());
        assert_eq!(line, folder, "{}: the folder is named after the product line", file.display());
        let stem = file.file_stem().and_then(|n| n.to_str()).unwrap_or("");
        assert_eq!(version.map(|v| format!("v{v}")).as_deref(), Some(stem), "{}", file.display());
    }
}

#[test]
fn the_committed_schema_is_not_stale() {
    let file = root().join("toile.schema.json");
    let (_, printed, _) = toile(&["schema".into()]);
    if std::env::var_os("TOILE_BLESS").is_some() {
        std::fs::write(&file, &printed).expect("schema");
    }
    let committed = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(printed == committed, "stale: run `TOILE_BLESS=1 cargo test --release --test pipelines`");
    let schema: Value = serde_json::from_str(&printed).expect("JSON");
    assert_eq!(schema["title"], "toile pipeline");
}
