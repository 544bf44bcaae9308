//! Codes of `toile fit`.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The chain drapes nothing, so there is no garment to be fitted. Exit code 2.
    FIT_NO_DRAPE = "fit-no-drape";

    /// The chain has no stage that meshes pieces, so an altered pattern cannot take the place of its own. Exit code 2.
    FIT_NO_MESH_STAGE = "fit-no-mesh-stage";

    /// The garment covers no height at which its ease is measured, or not the one that was asked for. Exit code 2.
    FIT_NO_MEASURE = "fit-no-measure";

    /// The ease is not within the bounds after the last round. The pattern of that round is written. Ask for an ease
    /// that the garment can have, or for more rounds. Exit code 1.
    FIT_NOT_REACHED = "fit-not-reached";

    /// The pattern for the other body cannot be sewn there. The errors before it say where. A garment follows a body that is
    /// not too different from its own; begin with a size whose body is nearer.
    FIT_NOT_SEWN = "fit-not-sewn";

    /// The ease that is asked for cannot be: less than nothing is left of the cloth. Exit code 2.
    FIT_EASE = "fit-ease";

    /// The body cannot be read as one. Exit code 3.
    FIT_BODY = "fit-body";
}
