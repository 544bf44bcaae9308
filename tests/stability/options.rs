//! The command line of the table.

use crate::case::Case;
use crate::lab::Vary;
use crate::support::switches::{self, Switches};

pub struct Options {
    pub common: Switches,
    pub matrix: bool,
    /// Quick cases only, in the matrix too.
    pub quick: bool,
    /// Accuracy of single runs; the pipeline's default when not given.
    pub accuracy: Option<String>,
    pub jitters: u64,
}

/// Accuracies of the matrix.
const ACCURACIES: [&str; 3] = ["draft", "normal", "fine"];

impl Options {
    /// More than the quick cases, once.
    pub fn wide(&self) -> bool {
        self.common.all || self.matrix
    }

    /// Is this case asked for? Without `--all` and `--matrix` only quick ones are.
    pub fn takes(&self, case: &Case) -> bool {
        let words = &self.common.words;
        let named = words.is_empty() || words.iter().any(|w| case.id.starts_with(w.as_str()));
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

pub fn read(arguments: impl Iterator<Item = String>) -> Result<Options, String> {
    let (mut matrix, mut quick, mut accuracy, mut jitters) = (false, false, None, 10);
    let common = switches::read(arguments, 90.0, |switch, value| {
        match switch {
            "--matrix" => matrix = true,
            "--quick" => quick = true,
            "--accuracy" => accuracy = Some(value()?),
            "--jitters" => jitters = switches::number(switch, &value()?)?,
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    Ok(Options { common, matrix, quick, accuracy, jitters })
}
