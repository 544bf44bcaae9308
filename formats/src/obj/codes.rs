//! Codes of reading OBJ files.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The OBJ has no vertices or no faces. Exit code 3.
    OBJ_EMPTY = "obj-empty";

    /// A face names a vertex that is not there. Exit code 3.
    OBJ_INDEX = "obj-index";

    /// A line of the OBJ cannot be read. Exit code 3.
    OBJ_LINE = "obj-line";

    /// More mistakes of the OBJ were found than are listed. Exit code 3.
    OBJ_MORE = "obj-more";

    /// A coordinate of the OBJ is no number, not finite or too large. Exit code 3.
    OBJ_NUMBER = "obj-number";

    /// A face of the OBJ cannot be cut into triangles, because it crosses itself or has no area. Exit code 3.
    OBJ_POLYGON = "obj-polygon";

    /// Two independent readings of the OBJ give different meshes, so neither is trusted. Exit code 3.
    OBJ_READERS_DIFFER = "obj-readers-differ";

    /// The OBJ is larger than the limit. Exit code 3.
    OBJ_TOO_MANY = "obj-too-many";
}
