//! Codes of the findings of comparisons.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The program's own method gives the garment no drape, so there is nothing by which other methods could be measured.
    COMPARE_NO_DRAPE = "compare-no-drape";
}
