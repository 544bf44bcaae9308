//! Codes of writing DXF files.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A piece to write has fewer than three boundary points. Exit code 3.
    BOUNDARY_TOO_SHORT = "boundary-too-short";

    /// A piece is not the same on both sides of its fold, so it was written whole.
    FOLD_NOT_SYMMETRIC = "fold-not-symmetric";

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
}
