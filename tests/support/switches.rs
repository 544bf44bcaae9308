//! The command line of a test that prints a table.

use std::path::PathBuf;

/// The switches that every such test understands.
pub struct Switches {
    pub all: bool,
    pub list: bool,
    /// Names of cases, or parts of them.
    pub words: Vec<String>,
    /// CPU seconds one case may take.
    pub cap: f64,
    pub json: Option<PathBuf>,
    /// Where the files of every run are left.
    pub keep: Option<PathBuf>,
}

/// Asks for the value of the switch at hand.
pub type Value<'a> = &'a mut dyn FnMut() -> Result<String, String>;

/// Reads the arguments; `own` takes the switches of this one test and says whether a switch was one of them.
pub fn read(
    mut arguments: impl Iterator<Item = String>,
    cap: f64,
    mut own: impl FnMut(&str, Value<'_>) -> Result<bool, String>,
) -> Result<Switches, String> {
    let mut s = Switches { all: false, list: false, words: Vec::new(), cap, json: None, keep: None };
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} wants a value"));
        match argument.as_str() {
            "--all" | "--ignored" | "--include-ignored" => s.all = true,
            "--list" => s.list = true,
            "--cap" => s.cap = number("--cap", &value()?)?,
            "--json" => s.json = Some(value()?.into()),
            "--keep" => s.keep = Some(value()?.into()),
            // What `cargo test` passes on to every kind of test; it says nothing to this one.
            "--test-threads" | "--skip" | "--color" | "--format" => drop(value()?),
            other if own(other, &mut value)? => {}
            flag if flag.starts_with('-') => {}
            word => s.words.push(word.to_owned()),
        }
    }
    Ok(s)
}

/// The number given with a switch.
pub fn number<T: std::str::FromStr<Err: std::fmt::Display>>(switch: &str, text: &str) -> Result<T, String> {
    text.parse().map_err(|e| format!("{switch}: {e}"))
}
