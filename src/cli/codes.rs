//! Codes of the command line.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The drape coefficient differs by more than five points from the one given with --lab, more than repeats of one
    /// cloth differ in a laboratory. Look at the bending stiffness first.
    DRAPE_DIFFERS_FROM_LAB = "drape-differs-from-lab";

    /// The file's form is not one that this verb reads.
    NO_READER = "no-reader";

    /// No setting of the study gave a drape, so nothing can be compared. `toile run` with the same pipeline says why.
    /// Exit code 4.
    STUDY_EMPTY = "study-empty";

    /// `toile body --set` names a measure that a body does not have. `toile body` without options lists them.
    UNKNOWN_MEASURE = "unknown-measure";
}
