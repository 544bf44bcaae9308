//! The book, built by one pinned version of mdBook that is installed below `target/`.

use crate::run::{Done, cargo, root, said};

const VERSION: &str = "0.4.52";

/// Builds the book into `target/book`; a warning fails.
pub fn build(more: &[String]) -> Done {
    let tools = root().join("target/tools");
    let program = tools.join("bin").join(format!("mdbook{}", std::env::consts::EXE_SUFFIX));
    let program = program.to_string_lossy().into_owned();
    if !said(&program, &["--version"]).is_ok_and(|version| version.contains(VERSION)) {
        let (tools, build) = (tools.to_string_lossy(), tools.join("build"));
        let build = build.to_string_lossy();
        // Without optimisation, because compiling is all that takes time.
        let words = ["install", "mdbook", "--version", VERSION, "--locked", "--debug", "--no-default-features"];
        cargo(&[&words[..], &["--root", &tools, "--target-dir", &build]].concat(), more)?;
    }
    let text = said(&program, &["build", "docs/book"])?;
    print!("{text}");
    let bad = |line: &&str| line.contains("[WARN]") || line.contains("[ERROR]");
    match text.lines().find(bad) {
        Some(line) => Err(format!("the book has a warning: {line}")),
        None => Ok(()),
    }
}
