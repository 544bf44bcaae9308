//! The table of all codes of findings, joined from the lists of all packages: `toile explain CODE` and the page of
//! findings read it. Codes that several rooms of the command give are listed here.

use toile_garment::Code;

codes! {
    pub(crate) list SHARED;

    /// A file that the pipeline names is not there. Paths are relative to the pipeline file, not to the folder the
    /// command is run in. Exit code 3.
    FILE_MISSING = "file-missing";

    /// A stage needs something that no stage before it gives, e.g. `drape` before `stitch`. Stages run in the order
    /// they are written.
    NEEDS_NOT_GIVEN = "needs-not-given";

    /// A path leads where a pipeline may not go: out of its project, to a device, or over a file that is there already.
    /// Paths are relative to the pipeline file and stay in its project (the nearest folder upwards with .git,
    /// toile.root or Cargo.toml). `--allow-read DIR` and `--allow-write DIR` widen that, `--force` replaces files.
    /// Exit code 2.
    PATH_REFUSED = "path-refused";

    /// An override must read `--set name=value` for an input or `--set stage-id.key=value` for a parameter.
    SET_FORM = "set-form";

    /// A parameter takes one of a few words, and this is none of them.
    UNKNOWN_VALUE = "unknown-value";

    /// An output could not be written: disk full, no rights, or the folder is gone. Nothing half-written is left.
    /// Exit code 5.
    WRITE_FAILED = "write-failed";

    /// A parameter's value cannot be read. Quantities are texts with a number and a unit, e.g. "8 mm"; a bare number is
    /// refused because it hides its unit.
    WRONG_VALUE = "wrong-value";
}

/// The lists of the command's rooms.
const OWN: &[&[Code]] = &[
    SHARED,
    crate::acceptance::codes::CODES,
    crate::bundle::codes::CODES,
    crate::cli::codes::CODES,
    crate::compare::codes::CODES,
    crate::diff::codes::CODES,
    crate::engine::codes::CODES,
    crate::external::codes::CODES,
    crate::fit::codes::CODES,
    crate::line::codes::CODES,
    crate::load::codes::CODES,
    crate::new::codes::CODES,
    crate::pipeline::codes::CODES,
    crate::study::codes::CODES,
    crate::validate::codes::CODES,
];

/// All codes, in alphabetical order.
#[must_use]
pub fn all() -> Vec<Code> {
    let packages = [toile_formats::codes::CODES, toile_stages::codes::CODES, OWN];
    let mut all: Vec<Code> = packages.into_iter().flatten().copied().flatten().copied().collect();
    all.sort_by_key(|c| c.name());
    all
}

/// A code by its name.
#[must_use]
pub fn find(name: &str) -> Option<Code> {
    all().into_iter().find(|c| c.name() == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_formats::report::findings_in_chinese;

    #[test]
    fn every_code_has_chinese_words_and_all_of_them_belong_to_codes() {
        for (code, ..) in findings_in_chinese() {
            assert!(find(code).is_some(), "no finding has the code `{code}`");
        }
        let has = |name: &str| findings_in_chinese().any(|(code, ..)| *code == name);
        let lacking: Vec<&str> = all().iter().map(|c| c.name()).filter(|name| !has(name)).collect();
        assert!(lacking.is_empty(), "these have none; `formats/src/report/chinese` lacks them: {}", lacking.join(", "));
    }
}
