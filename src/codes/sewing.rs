//! Codes of the sewing file and of what it says about the pattern.

use super::{Code, code};

/// Codes of the sewing file and of what it says about the pattern.
pub(super) const CODES: &[Code] = &[
    code("coordinate-out-of-range", "A piece holds a coordinate that is no place on a pattern. Exit code 3."),
    code(
        "dart-mouth-off-outline",
        "The mouth of a dart does not lie on the outline of its piece, so the dart cannot be sewn. Exit code 3.",
    ),
    code(
        "dart-to-deny-not-found",
        "[[dart]] with kind = \"none\" points at no dart. Nothing was changed; check the mouth points.",
    ),
    code("dart-without-apex", "A wedge dart was declared without its apex. Exit code 2."),
    code("darts-overlap", "Two darts share a part of the outline. Deny one with kind = \"none\". Exit code 3."),
    code(
        "edge-name-scattered",
        "Edges of one name do not follow one another, so they are no run. Name them apart, or give two points. Exit code 2.",
    ),
    code(
        "edge-unknown",
        "A piece has no edge of this name or number. `toile inspect --svg` draws the edges with their numbers. Exit code 2.",
    ),
    code(
        "piece-ambiguous",
        "The name fits two pieces but for upper and lower case. Write it as the pattern does. Exit code 2.",
    ),
    code("piece-name-taken", "A copy has the name of another piece. Exit code 2."),
    code(
        "piece-unknown",
        "The sewing file names a piece that the pattern does not have. The message lists the pieces. Exit code 2.",
    ),
    code(
        "point-off-outline",
        "A point of a run lies farther than 1 mm from every corner and vertex of the outline. Take the coordinates from `toile inspect`. Exit code 2.",
    ),
    code(
        "run-way-ambiguous",
        "Both ways around the piece are about equally long. Say which with way = \"left\" or \"right\". Exit code 2.",
    ),
    code("run-without-length", "A run starts and ends at the same point. Exit code 2."),
    code(
        "seam-direction-ambiguous",
        "It is not clear which ends of the two sides meet. Give both sides by two points, or say reverse. Exit code 2.",
    ),
    code("seam-eased", "The sides of a seam differ in length by no more than ease; the longer one is held in evenly."),
    code(
        "seam-ends-in-dart",
        "A side of a seam ends inside the intake of a dart. End it at a mouth point. Exit code 2.",
    ),
    code(
        "seam-folds-over",
        "Sewn as written, the pieces would lie on top of each other. Usually from and to of one side are swapped.",
    ),
    code("seam-is-dart", "A seam sews the two legs of a dart, so the dart was taken out and the seam kept."),
    code(
        "seam-lengths-differ",
        "The sides of a seam differ by more than may be eased, and neither ease nor gather was declared. Correct the pattern, or declare `ease` or `gather`. Exit code 2.",
    ),
    code(
        "seam-notches-differ",
        "The notches of the two sides do not match. The seam is sewn by length; check that the right edges are sewn.",
    ),
    code(
        "seam-reversed",
        "The sides of a seam lie one way and are sewn the other, so the cloth between them is twisted by half a turn. Swap from and to of one side, or the order of its vertices in a file of stitches.",
    ),
    code("seam-to-itself", "Both sides of a seam are the same stretch of outline. Exit code 2."),
    code("seam-without-length", "A side of a seam has no length once the darts in it are sewn. Exit code 2."),
    code("sewing-bad-gather", "`gather` is longer over shorter and lies between 1 and 100. Exit code 2."),
    code("sewing-bad-quantity", "A text is no number with a unit, e.g. \"12 mm\". Exit code 2."),
    code("sewing-bad-run", "A run is given by from and to, by an edge, or by several of those. Exit code 2."),
    code(
        "sewing-bare-number",
        "A length is a bare number, which hides its unit. Write it as a text, e.g. \"12 mm\". Exit code 2.",
    ),
    code("sewing-dart-apexes", "A fish-eye dart has two apexes, a wedge dart one. Exit code 2."),
    code("sewing-ease-and-gather", "A seam declares both ease and gather. Keep one. Exit code 2."),
    code("sewing-empty-list", "A side or list is empty; write at least one entry. Exit code 2."),
    code("sewing-empty-text", "A name is empty; write a name or leave the key out. Exit code 2."),
    code("sewing-file", "The sewing file is not UTF-8 text. Exit code 2."),
    code(
        "sewing-file-syntax",
        "The sewing file is not TOML at this place; the message says what is wrong. Exit code 2.",
    ),
    code("sewing-key-missing", "A key that must be there is not. Exit code 2."),
    code(
        "sewing-no-rotation",
        "The three rows of a rotation are no rotation: they must be at right angles, of length one and not mirrored. Exit code 2.",
    ),
    code(
        "sewing-place",
        "A [[place]] needs either rotation and translation, or `around` with side and height. Exit code 2.",
    ),
    code("sewing-strength", "`strength` reads \"hold\" or \"elastic 0.9\". Exit code 2."),
    code(
        "sewing-unknown-key",
        "A key of the sewing file that nobody reads; a misspelt one would otherwise be ignored in silence. Exit code 2.",
    ),
    code("sewing-unknown-word", "A value takes one of a few words, and this is none of them. Exit code 2."),
    code("sewing-wrong-type", "A value is of another type than its key takes. Exit code 2."),
    code("wedge-is-no-dart", "A seam uses the edges of a wedge that was taken for a dart, so it is none."),
];
