//! The command line of the table.

use crate::case::Case;
use crate::lab::Vary;
use std::path::PathBuf;

pub struct Options {
    pub all: bool,
    pub matrix: bool,
    /// Quick cases only, in the matrix too.
    pub quick: bool,
    pub list: bool,
    pub words: Vec<String>,
    /// Accuracy of single runs; the pipeline's default when not given.
    pub accuracy: Option<String>,
    /// CPU seconds one case may take, in each variant.
    pub cap: f64,
    pub jitters: u64,
    pub json: Option<PathBuf>,
    pub keep: Option<PathBuf>,
}

/// Accuracies of the matrix.
const ACCURACIES: [&str; 3] = ["draft", "normal", "fine"];

impl Options {
    /// More than the quick cases, once.
    pub fn wide(&self) -> bool {
        self.all || self.matrix
    }

    /// Is this case asked for? Without `--all` and `--matrix` only quick ones are.
    pub fn takes(&self, case: &Case) -> bool {
        let named = self.words.is_empty() || self.words.iter().any(|w| case.id.starts_with(w.as_str()));
        named && (case.quick || self.wide() && !self.quick)
    }

    /// How a case is varied: refusals and comparisons bit for bit run once.
    pub fn variants(&self, case: &Case) -> Vec<Vary> {
        if !self.matrix || case.once {
            return vec![Vary { accuracy: self.accuracy.clone(), jitter: None }];
        }
        let of =
            |a: &'static str| (1..=self.jitters).map(move |j| Vary { accuracy: Some(a.to_owned()), jitter: Some(j) });
        ACCURACIES.into_iter().flat_map(of).collect()
    }
}

pub fn read(mut arguments: impl Iterator<Item = String>) -> Result<Options, String> {
    let mut o = Options {
        all: false,
        matrix: false,
        quick: false,
        list: false,
        words: Vec::new(),
        accuracy: None,
        cap: 90.0,
        jitters: 10,
        json: None,
        keep: None,
    };
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} wants a value"));
        match argument.as_str() {
            "--all" | "--ignored" | "--include-ignored" => o.all = true,
            "--matrix" => o.matrix = true,
            "--quick" => o.quick = true,
            "--list" => o.list = true,
            "--accuracy" => o.accuracy = Some(value()?),
            "--cap" => o.cap = value()?.parse().map_err(|e| format!("--cap: {e}"))?,
            "--jitters" => o.jitters = value()?.parse().map_err(|e| format!("--jitters: {e}"))?,
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
