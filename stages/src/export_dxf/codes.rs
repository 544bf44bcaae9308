//! Codes of writing flattened pieces as DXF.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The flattened positions do not belong to the piece's mesh or outline. Exit code 3.
    FLAT_DOES_NOT_FIT = "flat-does-not-fit";

    /// There are no flattened pieces to write. Put `flatten` before `export-dxf`, or set its `source` to "pattern".
    FLAT_MISSING = "flat-missing";

    /// A piece is written with its copies as pieces of their own, so its quantity is shared among them. Texts such as
    /// "cut 1 pair" stay as they were in the file; correct them where the cutting room reads them.
    QUANTITY_SHARED = "quantity-shared";
}
