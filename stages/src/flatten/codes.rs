//! Codes of flattening a garment to pieces.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// Two sides of the garment were changed differently, so pieces that mirrored each other no longer do.
    FLATTEN_ASYMMETRIC = "flatten-asymmetric";

    /// A triangle has no area in 3D or in the stored piece, so it cannot be flattened. The message names the place.
    /// Exit code 3.
    FLATTEN_BAD_TRIANGLE = "flatten-bad-triangle";

    /// The 3D shape was edited: the edit is carried into the pieces, and the strain of the drape stays in the cloth.
    FLATTEN_CARRIED = "flatten-carried";

    /// A dart keeps the intake that the shape asks for, or its stored one where it is locked or no edit touched it. The
    /// message has the intake that it would have else, too.
    FLATTEN_DART_KEPT = "flatten-dart-kept";

    /// The shape asks for a dart with less than no intake, whose legs would overlap. It was held open by a little.
    FLATTEN_DART_OVERLAPS = "flatten-dart-overlaps";

    /// Straight edges, right angles or pleats were held, which the flattening would have changed. The message says by how much.
    FLATTEN_HELD = "flatten-held";

    /// Straight edges or right angles changed too much to be held: the shape asks for it.
    FLATTEN_LET_GO = "flatten-let-go";

    /// The edit mirrored the whole shape. Lengths stay the same, so the pieces come back as they were.
    FLATTEN_MIRRORED = "flatten-mirrored";

    /// The edited shape is over four times as large as the drape, or as small: the editor took another unit. Exit code 3.
    FLATTEN_SCALED = "flatten-scaled";

    /// The solve ended before it came to rest. The pieces are the best that it had. The message says how far a vertex still
    /// moved.
    FLATTEN_NOT_AT_REST = "flatten-not-at-rest";

    /// The garment has no drape or no meshes, so there is nothing to flatten. Exit code 3.
    FLATTEN_NOTHING = "flatten-nothing";

    /// An edit changed the length of one side of a seam alone. Each side keeps what the surface says; they no longer
    /// match.
    FLATTEN_ONE_SIDED = "flatten-one-sided";

    /// Seams of the drape are open, so what is flattened is not the sewn garment.
    FLATTEN_OPEN_SEAMS = "flatten-open-seams";

    /// A piece changed by more than the tolerance that was given.
    FLATTEN_OUT_OF_TOLERANCE = "flatten-out-of-tolerance";

    /// The outline of a flat piece crosses itself, so that it cannot be cut.
    FLATTEN_OVERLAP = "flatten-overlap";

    /// A parameter of `flatten` is outside its range. Exit code 2.
    FLATTEN_PARAMETER = "flatten-parameter";

    /// The strain of the cloth is not known, so the pieces get the lengths of the 3D surface as it is.
    FLATTEN_SURFACE = "flatten-surface";

    /// Pieces that mirror each other, or a piece on the middle, differed by little and were made one.
    FLATTEN_SYMMETRIC = "flatten-symmetric";

    /// The 3D shape was not edited since the drape, so the pieces come back as they were; the strain of the drape stays
    /// in the cloth.
    FLATTEN_UNEDITED = "flatten-unedited";

    /// Mesh, drape and the shape before the edit have different numbers of vertices. Exit code 3.
    FLATTEN_VERTICES_DIFFER = "flatten-vertices-differ";

    /// A piece cannot lie flat without strain beyond the limit; the message says where the dart would have to go that
    /// cures it.
    PIECE_NOT_DEVELOPABLE = "piece-not-developable";
}
