//! The words of findings in Chinese, by their codes. Each has a message and a remedy.
//!
//! Names and figures stand in the sentence of the finding itself, which follows in English. A code that is missing here
//! is told in English alone.

mod body;
mod drape;
mod files;
mod pattern;
mod program;
mod sewing;
mod solver;

/// Code, meaning and remedy; the remedy is empty where nothing has to be done.
pub type Words = (&'static str, &'static str, &'static str);

/// The words of all findings, sorted by what they are about.
pub const FINDINGS: &[&[Words]] =
    &[drape::WORDS, sewing::WORDS, body::WORDS, pattern::WORDS, files::WORDS, solver::WORDS, program::WORDS];

/// The words of all findings, one by one.
pub fn findings() -> impl Iterator<Item = &'static Words> {
    FINDINGS.iter().copied().flatten()
}

/// Meaning and remedy of a code.
#[must_use]
pub fn of_code(code: &str) -> Option<[&'static str; 2]> {
    findings().find(|(known, ..)| *known == code).map(|(_, what, remedy)| [*what, *remedy])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_stands_once_with_its_meaning() {
        let all: Vec<&Words> = findings().collect();
        for (k, (code, what, _)) in all.iter().enumerate() {
            assert!(!what.is_empty() && all[..k].iter().all(|(other, ..)| other != code), "{code}");
        }
    }
}
