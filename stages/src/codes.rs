//! All codes of findings that this package gives, joined from the lists of its rooms, and the codes that several rooms
//! or packages give.

use toile_garment::Code;

codes! {
    pub list SHARED;

    /// The program proposed this seam, and nobody has confirmed it yet. Look at it, and remove `proposed` from the seam
    /// in the sewing file when it is right.
    SEAM_PROPOSED = "seam-proposed";

    /// A text file is not UTF-8. Save it as UTF-8. Exit code 3.
    TEXT_NOT_UTF8 = "text-not-utf8";
}

codes! {
    pub(crate) list OWN;

    /// A frame of the moving body has other vertices than the body the garment was draped on. Export every frame from
    /// the same mesh. Exit code 3.
    BODY_FRAME_VERTICES = "body-frame-vertices";

    /// A placement, an attachment or a map of the distance to the body refers to the body, and none was given. Give
    /// `with.body` to `stitch`. Exit code 2.
    BODY_MISSING = "body-missing";

    /// The outline has fewer than three points or no area worth meshing. Exit code 3.
    OUTLINE_TOO_SMALL = "outline-too-small";

    /// The sewing file names a piece that the pattern does not have. The message lists the pieces. Exit code 2.
    PIECE_UNKNOWN = "piece-unknown";

    /// Both sides of a seam are the same stretch of outline. Exit code 2.
    SEAM_TO_ITSELF = "seam-to-itself";

    /// A setting of the solver or of a test is outside the range in which it works. Exit code 2.
    SETTING_OUT_OF_RANGE = "setting-out-of-range";
}

/// The lists of all rooms.
pub const CODES: &[&[Code]] = &[
    SHARED,
    OWN,
    crate::alter::CODES,
    crate::animate::codes::CODES,
    crate::assemble::codes::CODES,
    crate::body::codes::CODES,
    crate::drape::CODES,
    crate::export_dxf::codes::CODES,
    crate::export_obj::CODES,
    crate::export_print::CODES,
    crate::export_report::CODES,
    crate::fabric_check::CODES,
    crate::fabric_test::codes::CODES,
    crate::flatten::codes::CODES,
    crate::import_dxf::CODES,
    crate::import_garment::CODES,
    crate::import_mesh::codes::CODES,
    crate::sewing::codes::CODES,
    crate::solve::codes::CODES,
    crate::stitch::codes::CODES,
    crate::texture::codes::CODES,
    crate::transfer::CODES,
    crate::triangulate::codes::CODES,
];
