//! The command line of the table.

use crate::case::Case;
use std::path::PathBuf;

pub struct Options {
    pub all: bool,
    pub list: bool,
    pub words: Vec<String>,
    /// Keys of the stage `drape`, as TOML.
    pub drape: Vec<String>,
    /// CPU seconds one case may take.
    pub cap: f64,
    pub json: Option<PathBuf>,
    pub keep: Option<PathBuf>,
}

impl Options {
    /// Is this case asked for? Without `--all` only quick ones are.
    pub fn takes(&self, case: &Case) -> bool {
        let named = self.words.is_empty() || self.words.iter().any(|w| case.name.contains(w.as_str()));
        named && (self.all || case.quick)
    }
}

pub fn read(mut arguments: impl Iterator<Item = String>) -> Result<Options, String> {
    let mut o =
        Options { all: false, list: false, words: Vec::new(), drape: Vec::new(), cap: 60.0, json: None, keep: None };
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} wants a value"));
        match argument.as_str() {
            "--all" | "--ignored" | "--include-ignored" => o.all = true,
            "--list" => o.list = true,
            "--accuracy" | "--model" | "--integrator" => o.drape.push(format!("{} = \"{}\"", &argument[2..], value()?)),
            "--cap" => o.cap = value()?.parse().map_err(|e| format!("--cap: {e}"))?,
            "--json" => o.json = Some(value()?.into()),
            "--keep" => o.keep = Some(value()?.into()),
            // What `cargo test` passes on to every kind of test; it says nothing to this one.
            "--test-threads" | "--skip" | "--color" | "--format" => drop(value()?),
            flag if flag.starts_with('-') => {}
            word => o.words.push(word.to_owned()),
        }
    }
    Ok(o)
}
