//! The book: its reference is what the program says, the commands of its first chapter run, and no link is dead.
//! `TOILE_BLESS=1` writes the generated pages and schemas anew.

#![allow(clippy::expect_used, clippy::unwrap_used)]

mod commands;
mod energies;
mod links;
mod reference;
mod schemas;

use std::path::{Path, PathBuf};

/// The repository's own folder.
pub fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Compares a generated file with the committed one, or writes it.
pub fn current(path: &Path, text: &str) {
    if std::env::var_os("TOILE_BLESS").is_some() {
        std::fs::create_dir_all(path.parent().expect("folder")).expect("folder");
        std::fs::write(path, text).expect("generated file");
    }
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    let remedy = "run `TOILE_BLESS=1 cargo test --release --test book`";
    assert!(committed == text, "{} is stale: {remedy}", path.display());
}
