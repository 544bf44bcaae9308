//! The command line of the table.

use crate::case::Case;
use crate::support::switches::{self, Switches};

pub struct Options {
    pub common: Switches,
    /// Keys of the stage `drape`, as TOML.
    pub drape: Vec<String>,
}

impl Options {
    /// Is this case asked for? Without `--all` only quick ones are.
    pub fn takes(&self, case: &Case) -> bool {
        let Switches { words, all, .. } = &self.common;
        let named = words.is_empty() || words.iter().any(|w| case.name.contains(w.as_str()));
        named && (*all || case.quick)
    }
}

pub fn read(arguments: impl Iterator<Item = String>) -> Result<Options, String> {
    let mut drape = Vec::new();
    let common = switches::read(arguments, 60.0, |switch, value| {
        let known = ["--accuracy", "--model", "--integrator"].contains(&switch);
        if known {
            drape.push(format!("{} = \"{}\"", &switch[2..], value()?));
        }
        Ok(known)
    })?;
    Ok(Options { common, drape })
}
