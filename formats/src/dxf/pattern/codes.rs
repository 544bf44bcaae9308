//! Codes of telling the pieces of a drawing from its blocks and sheets.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// Two blocks have the same name. Both pieces are kept and told apart by a number.
    BLOCK_NAME_REPEATS = "block-name-repeats";

    /// Blocks with an outline are placed by no INSERT, though other blocks are. They were read as pieces all the same.
    /// Leave out what is not meant with `pieces` of `import-dxf`.
    BLOCK_NOT_INSERTED = "block-not-inserted";

    /// A block holds nothing on the boundary layers (1, or 14), so it is no piece and was left out. Check the layers,
    /// or map them with `layers` of `import-dxf`.
    BLOCK_WITHOUT_OUTLINE = "block-without-outline";

    /// Entities of the file are nothing this program can place: unknown kinds or layers. The message counts them by
    /// kind and layer; no outline was among them unless other findings say so.
    ENTITIES_LEFT_OUT = "entities-left-out";

    /// A block is inserted several times with other scales or mirrored. One piece was made of it, as the first INSERT
    /// has it, and the others were only counted. Give each shape a block of its own.
    INSERT_REPEATED = "insert-repeated";

    /// Short lines on layers 2 or 3, or circles on layer 2, were read as notches and drill holes, and closed lines on
    /// layer 8 as sew lines, as some programs draw them. The standards have points on layers 2 and 3, and sew lines on
    /// 14.
    LAYER_FOREIGN = "layer-foreign";

    /// `layers` of `import-dxf` names a layer that the file does not have, so this line of the table does nothing. The
    /// hint lists the layers of the file.
    LAYER_NOT_IN_FILE = "layer-not-in-file";

    /// Lines on piece layers stand outside all blocks. They belong to no piece and were left out.
    LINES_OUTSIDE_BLOCKS = "lines-outside-blocks";

    /// No text names pieces and sizes, so they were taken from the names of the blocks, as `FRONT_38`.
    NAME_FROM_BLOCK = "name-from-block";

    /// The file holds no closed boundary on the layers of the standards, so there is no piece. Check the layers, or map
    /// them with `layers` of `import-dxf`. Exit code 3.
    NO_PIECES = "no-pieces";

    /// Some pieces or sizes of the file are drawn too wrongly to be used. They refuse the file only if they are asked
    /// for; `toile inspect` shows them with their faults.
    PIECES_REFUSED = "pieces-refused";

    /// A flat drawing has an upright rectangle round pieces that fill it, or round texts of the sheet. It was taken for
    /// a plot frame or a title block and left out. If it is a piece, export every piece as a block of its own.
    PLOT_FRAME_LEFT_OUT = "plot-frame-left-out";

    /// A flat drawing has an upright rectangle round other closed lines or texts, and nothing says whether it is a plot
    /// frame, a title block or a piece. It was read as a piece, and what lies in it as lines of this piece. Delete the
    /// rectangle if it is none, or export every piece as a block of its own.
    PLOT_FRAME_UNDECIDED = "plot-frame-undecided";

    /// Texts of pieces or of the style have keys that are not those of the standards, as `PIECE:`, `QTY:` or `Unit:`,
    /// or no colon behind their key, as `SIZE 36`. They were read as the keys they stand for.
    TEXT_KEY_FOREIGN = "text-key-foreign";

    /// Texts of pieces have keys without a meaning for this program. The texts are kept and written again.
    TEXT_KEY_UNKNOWN = "text-key-unknown";

    /// The file has more pieces than the limit. Exit code 3.
    TOO_MANY_PIECES = "too-many-pieces";
}
