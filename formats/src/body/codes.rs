//! Codes of reading bodies and their side files.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The body has no triangle with area. Exit code 3.
    BODY_EMPTY = "body-empty";

    /// Neighbouring faces of the body look to different sides, so inside and outside are not known. Recalculate the
    /// normals and export again. Exit code 3.
    BODY_FACES_MIXED = "body-faces-mixed";

    /// All faces of the body looked inwards; they were turned.
    BODY_INSIDE_OUT = "body-inside-out";

    /// Edges of the body belong to more than two triangles. Contact works, but inside and outside are doubtful there.
    BODY_NOT_MANIFOLD = "body-not-manifold";

    /// The body has open edges. Cloth can slip in there; close the holes where the garment lies.
    BODY_OPEN = "body-open";

    /// The side file of a body is not TOML. Exit code 3.
    BODY_SYNTAX = "body-syntax";

    /// Triangles of the body stand in the file twice; one of each was kept.
    BODY_TRIANGLES_DOUBLE = "body-triangles-double";

    /// Triangles of the body have no area and were left out.
    BODY_TRIANGLES_FLAT = "body-triangles-flat";

    /// A value in the side file of a body cannot be read. Lengths are texts with a unit, e.g. "914 mm". Exit code 3.
    BODY_VALUE = "body-value";

    /// Vertices of the body at the same place became one.
    BODY_VERTICES_MERGED = "body-vertices-merged";

    /// Vertices of the body belong to no face and were left out.
    BODY_VERTICES_UNUSED = "body-vertices-unused";
}
