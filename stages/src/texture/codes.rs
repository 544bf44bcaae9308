//! Codes of giving materials their look.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A colour is not written as # and six hexadecimal digits. Exit code 2.
    COLOR = "color";

    /// Two materials have the same name. Exit code 2.
    MATERIAL_NAME = "material-name";

    /// No piece uses this material; check its list of pieces.
    MATERIAL_UNUSED = "material-unused";

    /// A look was to be drawn from a fabric that does not tell its weave. Add a table `[look]` to the fabric file.
    LOOK_MISSING = "look-missing";

    /// Parts of a U3M material are not used. The message names them. How cloth moves stands in a fabric file.
    U3M_PARTS_UNUSED = "u3m-parts-unused";
}
