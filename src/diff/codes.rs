//! Codes of comparing two results.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// `toile diff` was given something that is no result. A result is the folder of a run, its run.json, a GLB,
    /// or the folder of a line.
    /// Exit code 3.
    DIFF_NO_RESULT = "diff-no-result";

    /// The file of tolerances of `toile diff` states none, so no difference is judged. Without --tolerance every
    /// difference is over.
    TOLERANCE_EMPTY = "tolerance-empty";
}
