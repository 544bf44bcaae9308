//! Codes of a study.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A --set holds a parameter that the study varies: all its rows would be the same. Leave it out. Exit code 2.
    STUDY_HELD = "study-held";

    /// A study compares drapes, and the chain has none. Exit code 2.
    STUDY_NO_DRAPE = "study-no-drape";
}
