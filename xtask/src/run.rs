//! Running other programs in the root of the repository.

use std::path::Path;
use std::process::Command;

/// Nothing, or why it failed.
pub type Done = Result<(), String>;

/// `cargo` with these words, then more.
pub fn cargo(words: &[&str], more: &[String]) -> Done {
    program("cargo", words, more, &[])
}

/// A program with these words, then more, and settings of its environment.
pub fn program(name: &str, words: &[&str], more: &[String], settings: &[(&str, &str)]) -> Done {
    let mut command = Command::new(name);
    command.args(words).args(more).envs(settings.iter().copied()).current_dir(root());
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{name} {}: {status}", words.join(" "))),
        Err(error) => Err(format!("{name}: {error}")),
    }
}

/// The output of a program, both streams together.
pub fn said(name: &str, words: &[&str]) -> Result<String, String> {
    let output = Command::new(name).args(words).current_dir(root()).output().map_err(|e| format!("{name}: {e}"))?;
    let both = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    if output.status.success() {
        Ok(both.concat())
    } else {
        Err(format!("{name} {}: {}", words.join(" "), both.concat()))
    }
}

/// The root of the repository.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}
