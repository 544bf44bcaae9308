//! Codes of joining the meshes of pieces by their seams.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// An elastic band ends where the mesh has no vertex. Let it run along whole edges. Exit code 3.
    BAND_NOT_IN_MESH = "band-not-in-mesh";

    /// An elastic band is longer than the cloth that it is sewn to, so it never pulls. Make it shorter.
    BAND_SLACK = "band-slack";

    /// A fold runs where the mesh has no edges, so that nothing is folded. Exit code 3.
    FOLD_NOT_IN_MESH = "fold-not-in-mesh";

    /// `max_ease` must be a share between 0 and 1. Exit code 2.
    MAX_EASE = "max-ease";

    /// Seams sew two neighbouring mesh vertices of one piece to one point, and no dart takes the cloth between them away.
    /// Declare the dart with the [[dart]] lines of the finding, or end both seams at one place. Exit code 3.
    SEAMS_CLOSE_CLOTH = "seams-close-cloth";

    /// The two sides of a seam have different numbers of mesh vertices. The mesh was not made for these seams; put
    /// `triangulate` after the sewing file was read. Exit code 3.
    SEAM_COUNTS_DIFFER = "seam-counts-differ";

    /// A seam runs where the mesh has no edges. Exit code 3.
    SEAM_NOT_IN_MESH = "seam-not-in-mesh";
}
