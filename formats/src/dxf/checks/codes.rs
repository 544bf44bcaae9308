//! Codes of checking a whole pattern: its cutouts, its marks and its nest of sizes.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The line of a cutout crosses itself, so what falls out of it is not defined. It was kept as drawn; correct it on
    /// layer 11.
    CUTOUT_CROSSES_ITSELF = "cutout-crosses-itself";

    /// The line of a cutout on layer 11 does not close. It was kept as drawn; close it in the pattern program.
    CUTOUT_OPEN = "cutout-open";

    /// A cutout lies outside its piece, crosses its outline or repeats it, so it cannot be cut. It was kept as drawn;
    /// correct it on layer 11.
    CUTOUT_OUTSIDE = "cutout-outside";

    /// Two cutouts of a piece overlap, so they would fall out as one. Both were kept as drawn; draw their common
    /// outline instead.
    CUTOUTS_OVERLAP = "cutouts-overlap";

    /// Drill holes or internal lines lie far outside the piece whose block holds them. They were kept as drawn; perhaps
    /// they belong to another piece.
    MARK_OUTSIDE = "mark-outside";

    /// A notch is deeper or wider than any notch is cut, so its numbers or the unit of the file are wrong. It was kept
    /// as drawn.
    NOTCH_TOO_LARGE = "notch-too-large";

    /// A piece is not drawn in all sizes of the file and has no grade rules to make them. A garment in a missing size
    /// is made without it; export the piece in every size.
    PIECE_LACKS_SIZE = "piece-lacks-size";

    /// No text of the file says `Piece Name`. The pieces have the names of their blocks.
    PIECE_NAME_MISSING = "piece-name-missing";

    /// The names of two pieces differ in the case of their letters alone. Sewing files must spell them exactly, and other
    /// systems may take them for one piece.
    PIECE_NAMES_ALIKE = "piece-names-alike";

    /// Two blocks have the same piece name and size. Both were read, the later one under a numbered name; if one is a
    /// leftover, take it out of the file.
    PIECE_REPEATS = "piece-repeats";

    /// The sample size that the file names is not drawn, or the file holds several sizes and names none as the sample
    /// size. Ask for a size by name.
    SAMPLE_SIZE_MISSING = "sample-size-missing";

    /// The sizes of a piece have different numbers of notches. Each is read on its own, but numbers of notches may not
    /// carry over from size to size. Export the nest again if they should not differ.
    SIZES_DIFFER_IN_NOTCHES = "sizes-differ-in-notches";

    /// The sample size of a piece cannot be used, and it alone has the points that say corners and notches. The other
    /// sizes were read by their angles, and notches may be missing there.
    SIZES_WITHOUT_SAMPLE = "sizes-without-sample";
}
