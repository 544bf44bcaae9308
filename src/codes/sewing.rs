//! Codes of the sewing file and of what it says about the pattern.

use super::{Code, code};

/// Codes of the sewing file and of what it says about the pattern.
pub(super) const CODES: &[Code] = &[
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
    code("sewing-file", "The sewing file is not UTF-8 text. Exit code 2."),
    code("wedge-is-no-dart", "A seam uses the edges of a wedge that was taken for a dart, so it is none."),
];
