//! Codes of applying a sewing file to a pattern.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The drawing left a wedge undecided, and the seams close it: they bring its mouth or its legs together. It was
    /// made a dart.
    DART_BY_SEAMS = "dart-by-seams";

    /// The mouth of a dart does not lie on the outline of its piece, so the dart cannot be sewn. Exit code 3.
    DART_MOUTH_OFF_OUTLINE = "dart-mouth-off-outline";

    /// [[dart]] with kind = "none" points at no dart. Nothing was changed; check the mouth points.
    DART_TO_DENY_NOT_FOUND = "dart-to-deny-not-found";

    /// A wedge dart was declared without its apex. Exit code 2.
    DART_WITHOUT_APEX = "dart-without-apex";

    /// Two darts share a part of the outline. Deny one with kind = "none". Exit code 3.
    DARTS_OVERLAP = "darts-overlap";

    /// An apex of a declared dart or pleat lies outside the cloth of its piece. Give the point in the coordinates of
    /// the piece. Exit code 2.
    DART_OFF_CLOTH = "dart-off-cloth";

    /// Edges of one name do not follow one another, so they are no run. Name them apart, or give two points.
    /// Exit code 2.
    EDGE_NAME_SCATTERED = "edge-name-scattered";

    /// A part of an edge is to begin or end where the edge has no such place: beyond its length, or at a notch that it
    /// does not have. The message tells length and notches. Exit code 2.
    EDGE_PLACE_UNKNOWN = "edge-place-unknown";

    /// The name fits two pieces but for upper and lower case. Write it as the pattern does. Exit code 2.
    PIECE_AMBIGUOUS = "piece-ambiguous";

    /// A copy has the name of another piece. Exit code 2.
    PIECE_NAME_TAKEN = "piece-name-taken";

    /// A pleat is to be sewn down beyond the ends of its lines. Exit code 2.
    PLEAT_SEWN_BEYOND = "pleat-sewn-beyond";

    /// A point of a run lies farther than 1 mm from every corner and vertex of the outline. Take the coordinates from
    /// `toile inspect`. Exit code 2.
    POINT_OFF_OUTLINE = "point-off-outline";

    /// Both ways around the piece are about equally long. Say which with way = "left" or "right". Exit code 2.
    RUN_WAY_AMBIGUOUS = "run-way-ambiguous";

    /// A run starts and ends at the same point. Exit code 2.
    RUN_WITHOUT_LENGTH = "run-without-length";

    /// It is not clear which ends of the two sides meet. Give both sides by two points, or say reverse. Exit code 2.
    SEAM_DIRECTION_AMBIGUOUS = "seam-direction-ambiguous";

    /// The sides of a seam differ in length by no more than ease; the longer one is held in evenly.
    SEAM_EASED = "seam-eased";

    /// A side of a seam ends inside the intake of a dart. End it at a mouth point. Exit code 2.
    SEAM_ENDS_IN_DART = "seam-ends-in-dart";

    /// Sewn as written, the pieces would lie on top of each other. Usually from and to of one side are swapped.
    SEAM_FOLDS_OVER = "seam-folds-over";

    /// A seam sews the two legs of a dart, which is sewn already, so the seam was left out.
    SEAM_IS_DART = "seam-is-dart";

    /// The sides of a seam differ by more than may be eased, and neither ease nor gather was declared. Correct the
    /// pattern, or declare `ease` or `gather`. Exit code 2.
    SEAM_LENGTHS_DIFFER = "seam-lengths-differ";

    /// Two seams have one name, so a report and a comparison of runs cannot tell them apart. Give each its own.
    SEAM_NAME_REPEATS = "seam-name-repeats";

    /// The notches of the two sides do not match. The seam is sewn by length; check that the right edges are sewn.
    SEAM_NOTCHES_DIFFER = "seam-notches-differ";

    /// The sides of a seam lie one way and are sewn the other, so the cloth between them is twisted by half a turn.
    /// Swap from and to of one side, or the order of its vertices in a file of stitches, or take `reverse = false` out.
    SEAM_REVERSED = "seam-reversed";

    /// A side of a seam has no length once the darts in it are sewn. Exit code 2.
    SEAM_WITHOUT_LENGTH = "seam-without-length";

    /// Two tables of the sewing file speak of one piece, edge, dart or line, and only one of them could hold. The
    /// message tells the line of the other. Remove one. Exit code 2.
    TABLES_CONTRADICT = "tables-contradict";

    /// A seam uses the edges of a wedge that was taken for a dart, so it is none.
    WEDGE_IS_NO_DART = "wedge-is-no-dart";

    /// Two seams sew the same stretch of a piece to places of the same other piece. Remove the one that is wrong.
    SEWN_TWICE = "sewn-twice";
}
