//! Codes of textures, flattening and written files.

use super::{Code, code};

/// Codes of textures, flattening and written files.
pub(super) const CODES: &[Code] = &[
    code("flat-does-not-fit", "The flattened positions do not belong to the piece's mesh or outline. Exit code 3."),
    code(
        "flat-missing",
        "There are no flattened pieces to write. Put `flatten` before `export-dxf`, or set its `source` to \"pattern\".",
    ),
    code(
        "flatten-bad-triangle",
        "A triangle has no area in 3D or in the stored piece, so it cannot be flattened. The message names the place. Exit code 3.",
    ),
    code(
        "flatten-carried",
        "The 3D shape was edited: the edit is carried into the pieces, and the strain of the drape stays in the cloth.",
    ),
    code("flatten-nothing", "The garment has no drape or no meshes, so there is nothing to flatten. Exit code 3."),
    code("flatten-open-seams", "Seams of the drape are open, so what is flattened is not the sewn garment."),
    code(
        "flatten-one-sided",
        "An edit changed the length of one side of a seam alone. Each side keeps what the surface says; they no longer match.",
    ),
    code("flatten-parameter", "A parameter of `flatten` is outside its range. Exit code 2."),
    code(
        "flatten-surface",
        "The strain of the cloth is not known, so the pieces get the lengths of the 3D surface as it is.",
    ),
    code(
        "flatten-unedited",
        "The 3D shape was not edited since the drape, so the pieces come back as they were; the strain of the drape stays in the cloth.",
    ),
    code(
        "flatten-vertices-differ",
        "Mesh, drape and the shape before the edit have different numbers of vertices. Exit code 3.",
    ),
    code("form-unknown", "The ending of the file of `export-print` must be .svg, .pdf or .plt. Exit code 2."),
    code("material-name", "Two materials have the same name. Exit code 2."),
    code("material-unused", "No piece uses this material; check its list of pieces."),
    code("paper-unknown", "`paper` of `export-print` names no format; the message lists those there are. Exit code 2."),
    code(
        "piece-not-developable",
        "A piece cannot lie flat without strain beyond the limit; the message says where the dart would have to go that cures it.",
    ),
    code(
        "reactions-missing",
        "`reactions` needs a drape, and there is none. Put `drape` before `export-obj`. Exit code 2.",
    ),
];
