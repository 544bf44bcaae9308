//! A case and its result.

use crate::known;
use crate::lab::{Count, Lab};
use crate::options::Options;

/// Runs the scenes and asks what must hold; the text says why there is nothing to ask.
type Run = Box<dyn Fn(&mut Lab) -> Result<(), String>>;

/// A case of the catalogue.
pub struct Case {
    /// Catalogue number and name: `E1-knife`.
    pub id: String,
    /// Runs in the normal test command: it takes less than two CPU seconds.
    pub quick: bool,
    /// Does not depend on accuracy and start: the matrix runs it once.
    pub once: bool,
    run: Run,
}

pub fn case(id: impl Into<String>, run: impl Fn(&mut Lab) -> Result<(), String> + 'static) -> Case {
    Case { id: id.into(), quick: false, once: false, run: Box::new(run) }
}

impl Case {
    pub fn quick(self) -> Self {
        Self { quick: true, ..self }
    }

    pub fn once(self) -> Self {
        Self { once: true, ..self }
    }
}

/// One line of the table: all variants of a case.
pub struct Row {
    pub id: String,
    pub variants: usize,
    /// The failed expectations, each with its variant.
    pub failures: Vec<String>,
    /// Variants with a failure.
    pub failed: usize,
    pub notes: Vec<String>,
    pub count: Count,
    pub cpu: f64,
    pub known: Option<&'static str>,
}

impl Row {
    /// Does it make the test command fail? Known failures do so only in the wide runs; a known failure that is gone
    /// must leave the list.
    pub fn breaks(&self, wide: bool) -> bool {
        match self.known {
            Some(_) if !wide => self.failed == 0,
            _ => self.failed > 0,
        }
    }
}

/// Runs all variants of a case.
pub fn run(case: &Case, options: &Options) -> Row {
    let mut row = Row {
        id: case.id.clone(),
        variants: 0,
        failures: Vec::new(),
        failed: 0,
        notes: Vec::new(),
        count: Count::default(),
        cpu: 0.0,
        known: known::reason(&case.id),
    };
    for vary in options.variants(case) {
        let words = vary.words();
        let mut lab = Lab::new(&case.id, options, vary);
        if let Err(why) = (case.run)(&mut lab) {
            lab.failures.push(why);
        }
        row.variants += 1;
        row.failed += usize::from(!lab.failures.is_empty());
        row.failures.extend(lab.failures.into_iter().map(|f| format!("{words}{f}")));
        row.notes.extend(lab.notes);
        row.count.add(&lab.count);
        row.cpu += lab.used;
    }
    row
}
