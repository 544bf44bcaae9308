//! Codes of comparing two results.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// `toile diff` was given something that is no result: a folder without run.json and GLB, or a file that is neither a
    /// record nor a garment. Exit code 3.
    DIFF_NO_RESULT = "diff-no-result";
}
