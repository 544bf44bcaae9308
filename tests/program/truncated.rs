//! Files cut short, at every 1/64 of their length: refused with a word, or read; never a panic.

use crate::support;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use support::bench::{Bench, command};

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    for name in support::bench::list(folder) {
        let path = folder.join(name);
        if path.is_dir() { walk(&path, found) } else { found.push(path) }
    }
}

fn cuts(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    (0..64).map(move |i| &bytes[..bytes.len() * i / 64])
}

#[test]
fn pipelines_cut_short_are_refused_in_words() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    walk(&root.join("pipelines"), &mut files);
    walk(&root.join("tests/bad"), &mut files);
    files.retain(|f| f.extension().is_some_and(|e| e == "toml") && !f.ends_with("case.toml"));
    assert!(!files.is_empty());
    let bench = Bench::new();
    for file in files {
        let bytes = std::fs::read(&file).expect("pipeline");
        for cut in cuts(&bytes) {
            std::fs::write(bench.pipeline_file(), cut).expect("cut");
            let said = bench.check(&[]);
            assert!(matches!(said.code, 0 | 2 | 3), "{}: {said:?}", file.display());
            assert!(said.code == 0 || said.err.contains("error["), "{}: {said:?}", file.display());
        }
    }
}

#[test]
fn samples_cut_short_do_not_bring_inspect_down() {
    let mut files = Vec::new();
    walk(&Path::new(env!("CARGO_MANIFEST_DIR")).join("samples"), &mut files);
    files.retain(|f| {
        f.extension().is_some_and(|e| ["dxf", "rul", "obj", "glb", "json"].iter().any(|known| e == *known))
    });
    let dir = tempfile::tempdir().expect("folder");
    for file in files {
        let bytes = std::fs::read(&file).expect("sample");
        let cut_file = dir.path().join(file.file_name().expect("name"));
        for cut in cuts(&bytes).step_by(4) {
            std::fs::write(&cut_file, cut).expect("cut");
            let arguments: Vec<OsString> = vec!["inspect".into(), cut_file.clone().into(), "--json".into()];
            let said = command(arguments);
            assert!(matches!(said.code, 0 | 3), "{}: {said:?}", file.display());
            assert!(said.code == 0 || said.err.starts_with("error["), "{}: {said:?}", file.display());
        }
    }
}
