//! Codes of drawing pieces on paper.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// `font` is not a TrueType or OpenType file. Exit code 3.
    FONT_UNREADABLE = "font-unreadable";

    /// The drawing is larger than the form of file can say. Write fewer pieces, give a width or choose another paper.
    /// Exit code 2.
    SHEET_TOO_LARGE = "sheet-too-large";

    /// The `font` given lacks letters of a label, which stays a text. Give one that has them.
    TEXT_NOT_IN_FONT = "text-not-in-font";

    /// A PDF written by this program holds Latin letters only; others became `?`. SVG holds all of them, and `font`
    /// draws them.
    TEXT_NOT_LATIN = "text-not-latin";
}
