//! Codes of reading sewing files.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// `proposed` is a confidence from 0 to 1. Remove it from a seam that is right. Exit code 2.
    SEWING_BAD_CONFIDENCE = "sewing-bad-confidence";

    /// The length or stretch of an [[elastic]] is not over 0. Exit code 2.
    SEWING_BAND = "sewing-band";

    /// `gather` is longer over shorter and lies between 1 and 100. Exit code 2.
    SEWING_BAD_GATHER = "sewing-bad-gather";

    /// A text is no number with a unit, e.g. "12 mm". Exit code 2.
    SEWING_BAD_QUANTITY = "sewing-bad-quantity";

    /// A run is given by from and to, by an edge, or by several of those. Exit code 2.
    SEWING_BAD_RUN = "sewing-bad-run";

    /// A length is a bare number, which hides its unit. Write it as a text, e.g. "12 mm". Exit code 2.
    SEWING_BARE_NUMBER = "sewing-bare-number";

    /// The name of an [[edge]] is a whole number, as the numbers of edges are. Give it a letter. Exit code 2.
    SEWING_EDGE_NAME = "sewing-edge-name";

    /// A fish-eye dart has two apexes, a wedge dart one. Exit code 2.
    SEWING_DART_APEXES = "sewing-dart-apexes";

    /// An [[interlining]] has no mass, or a bending rigidity below 0. Exit code 2.
    SEWING_INTERLINING = "sewing-interlining";

    /// A seam declares both ease and gather. Keep one. Exit code 2.
    SEWING_EASE_AND_GATHER = "sewing-ease-and-gather";

    /// A side or list is empty; write at least one entry. Exit code 2.
    SEWING_EMPTY_LIST = "sewing-empty-list";

    /// A name is empty; write a name or leave the key out. Exit code 2.
    SEWING_EMPTY_TEXT = "sewing-empty-text";

    /// The sewing file is not TOML at this place; the message says what is wrong. Exit code 2.
    SEWING_FILE_SYNTAX = "sewing-file-syntax";

    /// A key that must be there is not. Exit code 2.
    SEWING_KEY_MISSING = "sewing-key-missing";

    /// The three rows of a rotation are no rotation: they must be at right angles, of length one and not mirrored.
    /// Exit code 2.
    SEWING_NO_ROTATION = "sewing-no-rotation";

    /// A [[place]] needs either rotation and translation, or `around` with side and height. Exit code 2.
    SEWING_PLACE = "sewing-place";

    /// `strength` reads "hold" or "elastic 0.9". Exit code 2.
    SEWING_STRENGTH = "sewing-strength";

    /// A key of the sewing file that nobody reads; a misspelt one would otherwise be ignored in silence. Exit code 2.
    SEWING_UNKNOWN_KEY = "sewing-unknown-key";

    /// A value takes one of a few words, and this is none of them. Exit code 2.
    SEWING_UNKNOWN_WORD = "sewing-unknown-word";

    /// A value is of another type than its key takes. Exit code 2.
    SEWING_WRONG_TYPE = "sewing-wrong-type";

    /// The angle of a [[fold]] is 0 or over 180°. Exit code 2.
    SEWING_FOLD_ANGLE = "sewing-fold-angle";

    /// `press` and `sewn` are for a pleat whose lines end at two `apexes`, and `sewn` is 0 or more. Exit code 2.
    SEWING_PRESS = "sewing-press";
}
