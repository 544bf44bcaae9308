//! Codes of golden cases.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// `toile test` found no case, or none of the name that --only gives. Cases stand in files with the name
    /// toile-test.toml, in the folder that is given or below it.
    TEST_EMPTY = "test-empty";

    /// Two cases of one file have the same name. The name is also that of the folder of its results.
    TEST_CASE_TWICE = "test-case-twice";

    /// Golden figures are written with a reason alone: toile test --bless --reason "another wool". The reason is kept
    /// in the history of the file.
    TEST_NO_REASON = "test-no-reason";

    /// Golden figures were not written, because a case does not end as its file says, or breaks a bound. Bounds, exit
    /// codes and findings are asked for by a person and are never blessed.
    TEST_NOT_BLESSED = "test-not-blessed";
}
