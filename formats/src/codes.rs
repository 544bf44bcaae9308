//! All codes of findings that this package gives, joined from the lists of its rooms, and the codes that several rooms
//! or packages give.

use toile_garment::Code;

codes! {
    pub list SHARED;

    /// The body is taller or smaller than a person. Its file is probably not in metres.
    BODY_SIZE = "body-size";

    /// The `code_page` asked for is none this program knows. The hint gives examples.
    CODE_PAGE_UNKNOWN = "code-page-unknown";

    /// A piece holds a coordinate that is no place on a pattern. Exit code 3.
    COORDINATE_OUT_OF_RANGE = "coordinate-out-of-range";

    /// A wedge may be a dart, and neither its marks nor the sewing file decide it: it is narrow, or shaped as a slit.
    /// It was not made one. Copy the `[[dart]]` lines of the finding into the sewing file, with kind = "none" if it is
    /// none.
    DART_UNDECIDED = "dart-undecided";

    /// A piece has no edge of this name or number. `toile inspect --svg` draws the edges with their numbers.
    /// Exit code 2.
    EDGE_UNKNOWN = "edge-unknown";

    /// A file is larger than the limit (pipelines 1 MiB, inputs 256 MiB), so that a wrong file cannot take all memory.
    /// Exit code 3.
    FILE_TOO_LARGE = "file-too-large";

    /// The file is no garment document of toile, is damaged, or was written by a newer toile. Exit code 3.
    GARMENT_FILE = "garment-file";

    /// A value is outside the range that makes sense; the message names the range.
    OUT_OF_RANGE = "out-of-range";

    /// The outline of a piece crosses itself, so inside and outside are not defined. Correct the pattern at the place
    /// named. Exit code 3.
    OUTLINE_CROSSES_ITSELF = "outline-crosses-itself";

    /// Pieces are not in the garment because `leave_out` in the sewing file names them. The message names them. Take a
    /// name out of the list, and write the seams of the piece, to have it sewn.
    PIECES_LEFT_OUT = "pieces-left-out";

    /// A change in one size was carried to all sizes of the pattern. The message lists them.
    SIZES_CARRIED = "sizes-carried";

    /// Something of a changed piece could not be carried to the other sizes; the message tells what. Exit code 3 where
    /// the pattern has no other sizes.
    SIZES_NOT_CARRIED = "sizes-not-carried";

    /// The size asked for is neither drawn nor graded. The message lists the sizes that are there. Exit code 2.
    SIZE_NOT_FOUND = "size-not-found";

    /// A text holds letters that old DXF readers do not know; the format holds 7-bit ASCII only, so it was simplified.
    TEXT_NOT_ASCII = "text-not-ascii";

    /// A key that nobody reads. It is an error because a misspelt parameter would otherwise be ignored in silence.
    UNKNOWN_KEY = "unknown-key";

    /// A value of a material is outside the range that makes sense; check the number and its unit. Exit code 2.
    VALUE_OUT_OF_RANGE = "value-out-of-range";
}

/// The lists of all rooms.
pub const CODES: &[&[Code]] = &[
    SHARED,
    crate::allowance::CODES,
    crate::body::codes::CODES,
    crate::dxf::codes::CODES,
    crate::dxf::checks::codes::CODES,
    crate::dxf::darts::codes::CODES,
    crate::dxf::pattern::codes::CODES,
    crate::dxf::piece::codes::CODES,
    crate::dxf::write::codes::CODES,
    crate::fabric::codes::CODES,
    crate::garmentcode::codes::CODES,
    crate::gltf::codes::CODES,
    crate::measures::CODES,
    crate::obj::codes::CODES,
    crate::plot::codes::CODES,
    crate::rul::CODES,
    crate::sewing::codes::CODES,
    crate::texture::codes::CODES,
];
