//! Codes of making a working folder.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// `toile new` knows no fabric of this name, and there is no such file. The hint lists the fabrics that come with
    /// the program. Exit code 2.
    FABRIC_NOT_KNOWN = "fabric-not-known";

    /// The largest piece is smaller than any garment's, so the unit of the pattern is wrong. Say it with `--units`. Exit
    /// code 3.
    PATTERN_TINY = "pattern-tiny";
}
