//! Codes of textures, flattening and written files.

use super::{Code, code};

/// Codes of textures, flattening and written files.
pub(super) const CODES: &[Code] = &[
    code("allowance-failed", "No cut line can be made around a piece: its outline encloses nothing. Exit code 2."),
    code(
        "allowance-grows-together",
        "The allowances of a piece grow together and enclose a hole; the cut line runs around it. Take a smaller allowance there.",
    ),
    code("boundary-too-short", "A piece to write has fewer than three boundary points. Exit code 3."),
    code("font-unreadable", "`font` is not a TrueType or OpenType file. Exit code 3."),
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
    code("fold-not-symmetric", "A piece is not the same on both sides of its fold, so it was written whole."),
    code("form-unknown", "The ending of the file of `export-print` must be .svg, .pdf or .plt. Exit code 2."),
    code("material-name", "Two materials have the same name. Exit code 2."),
    code("material-unused", "No piece uses this material; check its list of pieces."),
    code("notch-shape-lost", "The dialect of the DXF has no notch of this shape; it was written as a plain one."),
    code("paper-unknown", "`paper` of `export-print` names no format; the message lists those there are. Exit code 2."),
    code("piece-name-changed", "A piece's name cannot be a block name in DXF and was written differently."),
    code(
        "piece-not-developable",
        "A piece cannot lie flat without strain beyond the limit; the message says where the dart would have to go that cures it.",
    ),
    code("quantity-without-sides", "AAMA holds one quantity, so mirrored pieces were added to the plain ones."),
    code(
        "reactions-missing",
        "`reactions` needs a drape, and there is none. Put `drape` before `export-obj`. Exit code 2.",
    ),
    code(
        "sheet-too-large",
        "The drawing is larger than the form of file can say. Write fewer pieces, give a width or choose another paper. Exit code 2.",
    ),
    code("size-name-changed", "A size's name cannot be written in DXF as it is and was written differently."),
    code(
        "text-not-ascii",
        "A text holds letters that old DXF readers do not know; the format holds 7-bit ASCII only, so it was simplified.",
    ),
    code(
        "text-not-latin",
        "A PDF written by this program holds Latin letters only; others became `?`. SVG holds all of them, and `font` draws them.",
    ),
    code("text-not-in-font", "The `font` given lacks letters of a label, which stays a text. Give one that has them."),
];
