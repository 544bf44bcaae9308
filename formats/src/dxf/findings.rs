//! Collects findings while a file is read: many, but no flood.

use super::codes;
use super::limits;
use std::collections::BTreeMap;
use toile_garment::{Code, Diagnostic, Severity, SourceRef};

/// Findings of one file, with the place filled in.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    file: String,
    list: Vec<Diagnostic>,
    seen: BTreeMap<String, usize>,
}

impl Findings {
    pub(crate) fn new(file: &str) -> Self {
        Self { file: file.to_owned(), ..Self::default() }
    }

    /// No findings yet, of the same file.
    pub(crate) fn blank(&self) -> Self {
        Self::new(&self.file)
    }

    /// Takes the findings of a part of the work, as if they had been made here.
    pub(crate) fn append(&mut self, part: Self) {
        let mut counted = part.seen;
        for finding in part.list {
            counted.entry(finding.code.clone()).and_modify(|n| *n -= 1);
            self.push(finding);
        }
        for (code, more) in counted {
            let seen = self.seen.entry(code).or_insert(0);
            *seen = seen.saturating_add(more);
        }
    }

    /// Place in this file.
    pub(crate) fn place(&self, line: u64) -> SourceRef {
        SourceRef::file(self.file.clone()).at_line(line)
    }

    /// Place in a block of this file.
    pub(crate) fn place_in(&self, block: &str, layer: Option<&str>, line: u64) -> SourceRef {
        SourceRef { block: Some(block.to_owned()), layer: layer.map(str::to_owned), ..self.place(line) }
    }

    /// Adds a finding; beyond a limit per code they are only counted.
    pub(crate) fn push(&mut self, finding: Diagnostic) {
        let seen = self.seen.entry(finding.code.clone()).or_insert(0);
        *seen = seen.saturating_add(1);
        if *seen <= limits::FINDINGS_PER_CODE {
            self.list.push(finding);
        }
    }

    /// Takes out the errors that `belongs` names.
    pub(crate) fn take_errors(&mut self, belongs: impl Fn(&Diagnostic) -> bool) -> Vec<Diagnostic> {
        let is_taken = |f: &Diagnostic| f.severity == Severity::Error && belongs(f);
        let (taken, rest): (Vec<_>, Vec<_>) = std::mem::take(&mut self.list).into_iter().partition(is_taken);
        self.list = rest;
        for finding in &taken {
            self.seen.entry(finding.code.clone()).and_modify(|n| *n = n.saturating_sub(1));
        }
        self.seen.retain(|_, n| *n > 0);
        taken
    }

    /// Was a finding of this code made?
    pub(crate) fn said(&self, code: Code) -> bool {
        self.seen.contains_key(code.name())
    }

    pub(crate) fn has_errors(&self) -> bool {
        self.list.iter().any(|f| f.severity == Severity::Error)
    }

    pub(crate) fn errors_full(&self) -> bool {
        self.list.iter().filter(|f| f.severity == Severity::Error).count() >= limits::FINDINGS_PER_CODE
    }

    /// All findings, and one line for each code of which some were only counted.
    pub(crate) fn finish(self) -> Vec<Diagnostic> {
        let mut list = self.list;
        for (code, seen) in self.seen {
            if seen > limits::FINDINGS_PER_CODE {
                let more = seen - limits::FINDINGS_PER_CODE;
                list.push(Diagnostic::info(
                    codes::MORE_FINDINGS,
                    format!("{more} more findings `{code}` are not listed"),
                ));
            }
        }
        list
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use codes::{BLANK_LINE as A, STRAY_PAIR as B, STRAY_VERTEX as C};

    fn say(to: &mut Findings, code: Code, n: usize) {
        (0..n).for_each(|i| to.push(Diagnostic::warning(code, format!("number {i}"))));
    }

    #[test]
    fn findings_of_parts_are_those_of_the_whole() {
        let most = limits::FINDINGS_PER_CODE;
        let shares = [(A, 3), (B, most + 5), (A, most), (B, 1), (C, 2)];
        let (mut whole, mut parts) = (Findings::new("f"), Findings::new("f"));
        for (code, n) in shares {
            say(&mut whole, code, n);
            let mut part = parts.blank();
            say(&mut part, code, n);
            parts.append(part);
        }
        let (whole, parts) = (whole.finish(), parts.finish());
        assert_eq!(format!("{whole:?}"), format!("{parts:?}"));
        assert_eq!(parts.iter().filter(|f| f.code == "more-findings").count(), 2);
    }
}
