//! Codes of the laboratory's tests.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The bending length of a strip on the cantilever differs by more than 5 % from the fabric file's. A shorter
    /// --edge helps where the mesh is too coarse; what stays is how garments of this fabric will bend.
    BENDING_DIFFERS_FROM_FILE = "bending-differs-from-file";

    /// The fabric has no bending stiffness, or a bending length below 1 mm, so it hangs as the mesh lets it and the
    /// test has no answer. Give its bending in the fabric file. Exit code 3.
    FABRIC_WITHOUT_BENDING = "fabric-without-bending";

    /// The drape coefficient is below 30 %: the standard asks for a smaller specimen, which tells limp cloths apart
    /// better.
    SPECIMEN_TOO_LARGE = "specimen-too-large";

    /// The drape coefficient is above 85 %: the standard asks for a larger specimen, which tells stiff cloths apart
    /// better.
    SPECIMEN_TOO_SMALL = "specimen-too-small";
}
