//! Codes of reading GLB files.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The frames of a motion ride in the GLB as morph targets; they are for viewers and are not read back into the
    /// garment.
    ANIMATION_LEFT_OUT = "animation-left-out";

    /// The file is no sound GLB: its header, lengths or JSON break the format. Export it again. Exit code 3.
    GLB_DAMAGED = "glb-damaged";

    /// Vertices of the GLB were moved since the export, and the flattening carries the edit into the pieces. Or positions of
    /// a garment document were edited after its certificate was given, which is left out then.
    SHAPE_EDITED = "shape-edited";
}
