//! Codes of writing DXF files.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A piece to write has fewer than three boundary points. Exit code 3.
    BOUNDARY_TOO_SHORT = "boundary-too-short";

    /// The dialect has no dense copy of curves. Another program makes its curve of the curve points, and that lies off
    /// the line by what the message says.
    CURVE_COPY_LOST = "curve-copy-lost";

    /// Curve points are written as plain vertices, because a curve through them would leave the line that is written.
    /// The line itself keeps every vertex.
    CURVE_POINTS_LOST = "curve-points-lost";

    /// A piece is not the same on both sides of its fold, so it was written whole.
    FOLD_NOT_SYMMETRIC = "fold-not-symmetric";

    /// A mark on the fold of a half piece lies inside the piece when it is written whole, where no notch can be. It is
    /// written as a short internal line across the fold. `half_on_fold = true` writes it as it was.
    MARK_ON_FOLD_AS_LINE = "mark-on-fold-as-line";

    /// The dialect of the DXF has no notch of this shape; it was written as a plain one.
    NOTCH_SHAPE_LOST = "notch-shape-lost";

    /// A piece's name cannot be a block name in DXF and was written differently.
    PIECE_NAME_CHANGED = "piece-name-changed";

    /// AAMA holds one quantity, so mirrored pieces were added to the plain ones.
    QUANTITY_WITHOUT_SIDES = "quantity-without-sides";

    /// A size's name cannot be written in DXF as it is and was written differently.
    SIZE_NAME_CHANGED = "size-name-changed";

    /// The sizes of a piece have different vertices, so no grade rules lead from one to the other. All sizes are
    /// written as drawn.
    SIZES_WITHOUT_RULES = "sizes-without-rules";

    /// A text has letters outside 7-bit ASCII, or outside the code page that was asked for. They are written as escapes
    /// with their number (`U+XXXX`), which not every program resolves. `code_page` of `export-dxf` writes the letters
    /// themselves.
    TEXT_ESCAPED = "text-escaped";
}
