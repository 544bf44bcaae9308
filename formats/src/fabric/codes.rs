//! Codes of reading fabric files.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A measured curve must begin at zero and rise in both columns. Exit code 3.
    FABRIC_CURVE = "fabric-curve";

    /// The fabric has no name. Give it one, so that reports can tell fabrics apart.
    FABRIC_NAME_MISSING = "fabric-name-missing";

    /// The fabric file is not TOML at this place; the message says what is wrong. Exit code 3.
    FABRIC_SYNTAX = "fabric-syntax";

    /// A value of the fabric is out of its range, of a wrong type, or of a foreign unit; the message says which.
    /// Exit code 3.
    FABRIC_VALUE = "fabric-value";

    /// The fabric file does not say enough: one of [linear], [isotropic], [kes], [fast] or [curve] must give stretch,
    /// shear and bending, with areal mass and thickness. Exit code 3.
    FABRIC_VALUE_MISSING = "fabric-value-missing";

    /// The fabric gives one property in two ways. Keep one. Exit code 3.
    FABRIC_VALUE_TWICE = "fabric-value-twice";

    /// A quantity of the fabric is a bare number, which hides its unit. Write it as a text, e.g. "180 g/m2".
    /// Exit code 3.
    UNIT_MISSING = "unit-missing";
}
