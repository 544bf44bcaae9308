//! Codes of the file of a product line.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// An exclude, a job of a product line, or `--only` names a size, fabric or other choice that the matrix does not
    /// have. Write one of the names in the message, or add the choice to the matrix.
    LINE_CHOICE_UNKNOWN = "line-choice-unknown";

    /// A product line has no job at all: there is no style, or everything is excluded.
    LINE_EMPTY = "line-empty";

    /// Two jobs of a product line would have the same name and folder. Give styles and choices names that differ in
    /// more than signs.
    LINE_JOB_TWICE = "line-job-twice";

    /// An exclude of a product line leaves out no job. Correct it, or take it out.
    LINE_RULE_UNUSED = "line-rule-unused";

    /// A product line has more jobs than this program plans at once. Divide it into several files.
    LINE_TOO_LARGE = "line-too-large";
}
