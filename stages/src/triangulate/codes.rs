//! Codes of meshing pieces.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The draft mesh of lyon does not hold the piece: a triangle has no area, or a drawn edge is lost. Exit code 3.
    DRAFT_MESH_WRONG = "draft-mesh-wrong";

    /// `edge_length` or `triangles` is impossible: both were given, or the value is out of range. Exit code 2.
    EDGE_LENGTH = "edge-length";

    /// A part of a fold line lies outside the cloth; that part is not folded.
    FOLD_LINE_CLIPPED = "fold-line-clipped";

    /// A fold line runs so close to the outline or to another line that no triangle fits between. It is not folded.
    FOLD_LINE_TOO_CLOSE = "fold-line-too-close";

    /// A fold line is too short for the mesh and is not folded.
    FOLD_LINE_TOO_SHORT = "fold-line-too-short";

    /// A cutout lies outside its piece, or crosses the outline. Exit code 3.
    HOLE_MISPLACED = "hole-misplaced";

    /// Lines of a piece cross or touch when they are cut into edges of the mesh. Use a shorter edge_length, or redraw
    /// the lines apart. Exit code 3.
    LINES_CROSS = "lines-cross";

    /// Some triangles are sharper than the mesh promises, forced by the drawing. The drape is less exact there.
    MESH_ANGLE_LOW = "mesh-angle-low";

    /// The mesh of a piece does not cover the piece. This is a mistake of the program; please report it. Exit code 3.
    MESH_WRONG = "mesh-wrong";

    /// An outline runs clockwise. Importers turn them; a stage of another program did not. Exit code 3.
    OUTLINE_CLOCKWISE = "outline-clockwise";

    /// The outline has more corners than can be checked within the limit. Exit code 3.
    OUTLINE_TOO_COMPLEX = "outline-too-complex";

    /// The largest piece of the pattern is smaller or larger than any of a garment, so its unit is wrong; the message
    /// says which it looks like. Exit code 3.
    PIECE_SIZE = "piece-size";

    /// A stretch of outline is sewn to itself with a shift, so vertices would have to be matched without end. Split the
    /// seam at its ends. Exit code 3.
    SEAM_MARKS_ENDLESS = "seam-marks-endless";
}
