//! Codes of meshing and assembly.

use super::{Code, code};

/// Codes of meshing and assembly.
pub(super) const CODES: &[Code] = &[
    code(
        "edge-length",
        "`edge_length` or `triangles` is impossible: both were given, or the value is out of range. Exit code 2.",
    ),
    code("hole-misplaced", "A cutout lies outside its piece, or crosses the outline. Exit code 3."),
    code("internal-line-clipped", "A part of an internal line lies outside the cloth; that part is not in the mesh."),
    code("internal-line-too-short", "An internal line is too short for the mesh and was left out."),
    code(
        "lines-cross",
        "Lines of a piece cross or touch when they are cut into edges of the mesh. Use a shorter edge_length, or redraw the lines apart. Exit code 3.",
    ),
    code("max-ease", "`max_ease` must be a share between 0 and 1. Exit code 2."),
    code(
        "mesh-angle-low",
        "Some triangles are sharper than the mesh promises, forced by the drawing. The drape is less exact there.",
    ),
    code(
        "mesh-wrong",
        "The mesh of a piece does not cover the piece. This is a mistake of the program; please report it. Exit code 3.",
    ),
    code(
        "outline-clockwise",
        "An outline runs clockwise. Importers turn them; a stage of another program did not. Exit code 3.",
    ),
    code("outline-too-complex", "The outline has more corners than can be checked within the limit. Exit code 3."),
    code("outline-too-small", "The outline has fewer than three points or no area worth meshing. Exit code 3."),
    code(
        "piece-size",
        "The largest piece of the pattern is smaller or larger than any of a garment, so its unit is wrong; the message says which it looks like. Exit code 3.",
    ),
    code(
        "seam-counts-differ",
        "The two sides of a seam have different numbers of mesh vertices. The mesh was not made for these seams; put `triangulate` after the sewing file was read. Exit code 3.",
    ),
    code(
        "seam-marks-endless",
        "A stretch of outline is sewn to itself with a shift, so vertices would have to be matched without end. Split the seam at its ends. Exit code 3.",
    ),
    code("seam-not-in-mesh", "A seam runs where the mesh has no edges. Exit code 3."),
];
