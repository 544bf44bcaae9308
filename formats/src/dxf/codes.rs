//! Codes of reading DXF files, from the bytes to the choice of a size.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A DXF is pairs of lines, a group code and its value, and here the code is no whole number. The file is damaged
    /// or was edited by hand; export it again. Exit code 3.
    BAD_GROUP_CODE = "bad-group-code";

    /// A value that must be a number is none, or is not finite. Export the file again, or correct the line.
    /// Exit code 3.
    BAD_NUMBER = "bad-number";

    /// The file is a binary DXF whose pieces cannot be read: its data are damaged where the message says. Export it as
    /// text (ASCII) DXF. Exit code 3.
    BINARY_DXF = "binary-dxf";

    /// A part of a binary DXF outside the pieces (header, tables) cannot be read, as some programs write it wrong. It
    /// was passed over to the next section.
    BINARY_DXF_DAMAGED = "binary-dxf-damaged";

    /// The file is a binary DXF. Lines in messages are counted as in its text form, two for each pair.
    BINARY_DXF_READ = "binary-dxf-read";

    /// A blank line stands where a group code belongs. It was skipped; the pairs after it were read as if it were not
    /// there.
    BLANK_LINE = "blank-line";

    /// An INSERT names a block that the file does not hold, so a piece is missing. Export the file again.
    BLOCK_MISSING = "block-missing";

    /// A block has no ENDBLK. The file is cut short or damaged. Exit code 3.
    BLOCK_NOT_CLOSED = "block-not-closed";

    /// A block has no name, so no INSERT can refer to it.
    BLOCK_WITHOUT_NAME = "block-without-name";

    /// A vertex or point has no x or no y. The file is damaged; export it again. Exit code 3.
    COORDINATE_MISSING = "coordinate-missing";

    /// One entity gives the same coordinate twice. The first or the last could be meant, so the file is refused.
    /// Exit code 3.
    COORDINATE_TWICE = "coordinate-twice";

    /// Something follows the EOF mark. It was not read.
    DATA_AFTER_EOF = "data-after-eof";

    /// A number is written with a decimal comma. DXF has points only; export with another locale. Exit code 3.
    DECIMAL_COMMA = "decimal-comma";

    /// The file does not say how its texts are encoded, or says it wrongly, and they are no plain ASCII. The guess
    /// touches names only, never geometry; set `code_page` of `import-dxf` if names look wrong.
    ENCODING_GUESSED = "encoding-guessed";

    /// An ENDBLK closes nothing. The file is damaged. Exit code 3.
    ENDBLK_WITHOUT_BLOCK = "endblk-without-block";

    /// An ENDSEC closes nothing. The file is damaged. Exit code 3.
    ENDSEC_WITHOUT_SECTION = "endsec-without-section";

    /// An entity stands where none may stand. The file is damaged. Exit code 3.
    ENTITY_OUTSIDE_BLOCK = "entity-outside-block";

    /// One entity has more values than any pattern needs. The file is damaged or hostile. Exit code 3.
    ENTITY_TOO_LARGE = "entity-too-large";

    /// The file ends without its EOF mark. All sections were whole, so it was read; make sure that it was copied
    /// completely.
    EOF_MISSING = "eof-missing";

    /// The file has no bytes; copy or export it again. Exit code 3.
    FILE_EMPTY = "file-empty";

    /// The file ends in the middle of a pair, section or entity: it was cut short. Copy or export it again.
    /// Exit code 3.
    FILE_TRUNCATED = "file-truncated";

    /// An INSERT repeats its block in rows and columns; one piece was made of it.
    INSERT_ARRAY = "insert-array";

    /// An INSERT mirrors its block, and the piece was mirrored with it. `inserts = "ignored"` of `import-dxf` takes the
    /// pieces as their blocks draw them.
    INSERT_MIRRORED = "insert-mirrored";

    /// A nested INSERT could not be expanded; what it refers to is missing in the piece.
    INSERT_NOT_EXPANDED = "insert-not-expanded";

    /// A block contains itself. It was not expanded further.
    INSERT_RECURSIVE = "insert-recursive";

    /// INSERTs are nested deeper than the limit. They were not expanded further.
    INSERT_TOO_DEEP = "insert-too-deep";

    /// INSERTs of blocks in blocks would make more entities than the limit, so the file is refused. Export the pieces
    /// as blocks of their own. Exit code 3.
    INSERT_TOO_MANY = "insert-too-many";

    /// An INSERT scales or turns its block. Its scale changes the piece and is applied; its place and turn only lay the
    /// piece out. `inserts` of `import-dxf` can say otherwise.
    INSERT_TRANSFORMED = "insert-transformed";

    /// The library that reads curves (arcs, ellipses, splines, light polylines) gave back less than stands in the file,
    /// so the file is refused. Draw the curve anew, or export it as a polyline. Exit code 3.
    LIBRARY_CENSUS_DIFFERS = "library-census-differs";

    /// The vertices of a line have different heights (z). It was read as seen from above, so lengths along the slope
    /// are lost; lay the pattern flat before the export.
    LINE_NOT_FLAT = "line-not-flat";

    /// A line of the file is longer than any DXF line. The file is no DXF or is damaged. Exit code 3.
    LINE_TOO_LONG = "line-too-long";

    /// More findings of this kind were made than are listed.
    MORE_FINDINGS = "more-findings";

    /// The file does not begin as a DXF does. Exit code 3.
    NOT_DXF = "not-dxf";

    /// A number is too large or too small for a pattern. Exit code 3.
    NUMBER_OUT_OF_RANGE = "number-out-of-range";

    /// A pair stands outside all sections. It was not read.
    OUTSIDE_SECTION = "outside-section";

    /// `with.pieces` of `import-dxf` names a piece that the file does not hold. The message lists its pieces.
    /// Exit code 2.
    PIECE_NOT_FOUND = "piece-not-found";

    /// A piece is not drawn in the size that was asked for, and no grade rules make it. The garment is without it. Draw
    /// the piece in this size, or ask for another size.
    PIECE_NOT_IN_SIZE = "piece-not-in-size";

    /// The file has no blocks with pieces. The outermost closed lines in ENTITIES were taken as the pieces.
    PIECES_FROM_ENTITIES = "pieces-from-entities";

    /// A polyline has more vertices than the limit. Exit code 3.
    POLYLINE_TOO_LONG = "polyline-too-long";

    /// A polyline has no SEQEND. It ends where the next entity begins.
    POLYLINE_WITHOUT_SEQEND = "polyline-without-seqend";

    /// A grade rule moves a point from one size to the next farther than any garment grows. The unit of the rule table,
    /// or of the pattern, is probably wrong.
    RULE_GROWTH_DOUBTFUL = "rule-growth-doubtful";

    /// A graded point names a rule that the table does not hold, so the size cannot be made. Give the rule table that
    /// belongs to the pattern, or a size that is drawn.
    RULE_MISSING = "rule-missing";

    /// The rule table has another name or another sample size than the pattern says. It was used; make sure that it
    /// belongs to the pattern.
    RULE_TABLE_DIFFERS = "rule-table-differs";

    /// Pieces name grade rules that the rule table does not hold, so sizes that are not drawn cannot be made. Give the
    /// whole table that belongs to the pattern.
    RULES_MISSING = "rules-missing";

    /// A section has no ENDSEC. The file is cut short or damaged.
    SECTION_NOT_CLOSED = "section-not-closed";

    /// A section has no name, so what it holds is unknown. Exit code 3.
    SECTION_WITHOUT_NAME = "section-without-name";

    /// No size was asked for; the message names the one taken and why.
    SIZE_CHOSEN = "size-chosen";

    /// The sizes of a piece have different numbers of points or corners. Each is read on its own, but names of edges may not carry
    /// over.
    SIZES_DIFFER_IN_VERTICES = "sizes-differ-in-vertices";

    /// The file holds pieces or sizes that cannot be used, and one of them was asked for. The message says what of the
    /// file can be: other pieces (`with.pieces`) or other sizes (`with.size`).
    SOUND_PARTS = "sound-parts";

    /// The garment holds the name of the style and its size. Other texts of the style, such as author and date, are not
    /// kept. `author` and `date` of `export-dxf` write such texts.
    STYLE_TEXT_NOT_KEPT = "style-text-not-kept";

    /// A spline has knots, weights or points that do not fit each other. Exit code 3.
    SPLINE_DAMAGED = "spline-damaged";

    /// A pair stands before the first entity of its section and means nothing there.
    STRAY_PAIR = "stray-pair";

    /// A SEQEND closes nothing. The file is damaged. Exit code 3.
    STRAY_SEQEND = "stray-seqend";

    /// A VERTEX belongs to no polyline. The file is damaged. Exit code 3.
    STRAY_VERTEX = "stray-vertex";

    /// The file has more entities than the limit. Exit code 3.
    TOO_MANY_ENTITIES = "too-many-entities";

    /// The file has so many mistakes that reading it was given up. Exit code 3.
    TOO_MANY_ERRORS = "too-many-errors";

    /// The file has more pairs than the limit. Exit code 3.
    TOO_MANY_PAIRS = "too-many-pairs";

    /// Two statements of the file name different units. The text `Units` counts before the header; set `units` of
    /// `import-dxf` if that is wrong.
    UNITS_CONTRADICT = "units-contradict";

    /// The unit in the file gives pieces of a size that no garment has, or two statements differ. Set `units` of
    /// `import-dxf` if the message's choice is wrong.
    UNITS_DOUBTFUL = "units-doubtful";

    /// The pattern names no unit, and the grade rule table beside it does. That unit was taken for both.
    UNITS_FROM_RULES = "units-from-rules";

    /// The file does not state its unit. It was taken from the size of the pieces; set `units` of `import-dxf` to be
    /// sure.
    UNITS_GUESSED = "units-guessed";

    /// The file does not state its unit, and the likeliest one gives a garment of a size that none has. Set `units` of
    /// `import-dxf`. Exit code 3.
    UNITS_UNCONFIRMED = "units-unconfirmed";

    /// The file states a unit that is neither metric nor English, and the pieces fit none. Set `units` of `import-dxf`.
    /// Exit code 3.
    UNITS_UNKNOWN = "units-unknown";

    /// A section of the file is unknown. It was not read.
    UNKNOWN_SECTION = "unknown-section";

    /// The file is UTF-16 text, which was read as such.
    UTF_16_TEXT = "utf-16-text";

    /// An entity says how many points it has, and has another number. The points that are there were read.
    VERTEX_COUNT_DIFFERS = "vertex-count-differs";
}
