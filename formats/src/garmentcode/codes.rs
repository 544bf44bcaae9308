//! Codes of reading GarmentCode patterns.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// Two stitched edges of a GarmentCode specification differ much in length; they are sewn as a gather.
    GARMENTCODE_GATHERS = "garmentcode-gathers";

    /// The file is not JSON. Give a GarmentCode `…_specification.json`. Exit code 3.
    GARMENTCODE_NOT_JSON = "garmentcode-not-json";

    /// A panel, edge or stitch of a GarmentCode specification is wrong; the message says which and why. Exit code 3.
    GARMENTCODE_WRONG = "garmentcode-wrong";
}
