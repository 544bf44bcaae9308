//! Codes of making a working folder.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// No body was asked for, and one of the pattern's own size was chosen by its girths. --body takes another one.
    BODY_CHOSEN = "body-chosen";

    /// The pattern is narrower around the chest or hips than its body and than cloth stretches, or hangs on it like a tent.
    /// The finding names sizes of the usual ease. Another body is chosen with --body.
    BODY_DOES_NOT_FIT = "body-does-not-fit";

    /// The mesh of a body does not stand as a body has to: metres, +y up, front to +z, the feet at 0. `toile body measure
    /// FILE.obj --out UPRIGHT.obj` stands it so. Where no way to stand it shows two legs under a trunk, nothing can be
    /// found on it.
    BODY_NOT_STANDING = "body-not-standing";

    /// A part of a body was not found on its mesh. Write it into the side file; what stands there is kept.
    BODY_PART_NOT_FOUND = "body-part-not-found";

    /// A part of a body is not seen on its mesh, so it was put where it usually is. A line in the side file says otherwise.
    BODY_PART_USUAL = "body-part-usual";

    /// The side file of a body says another measure than its mesh shows, or a landmark of it stands at another height
    /// than its measure. The mesh is what a garment lies on. Take the line out of the side file and measure again, or
    /// correct the mesh.
    BODY_SIDE_FILE_DIFFERS = "body-side-file-differs";

    /// No fabric was asked for, and a text of a piece tells that the garment is a knit: that it is cut of a rib, or is a
    /// legging. Or it is narrower than its body and than woven cloth stretches. So a knit was chosen. --fabric takes
    /// another one.
    FABRIC_CHOSEN = "fabric-chosen";

    /// `toile new` knows no fabric of this name, and there is no such file. The hint lists the fabrics that come with
    /// the program. Exit code 2.
    FABRIC_NOT_KNOWN = "fabric-not-known";

    /// The folder was made from another pattern, or in another size, and what lies in it is kept. Choose another folder with
    /// `--out`. Exit code 2.
    FOLDER_OF_ANOTHER = "folder-of-another";

    /// The largest piece is longer than any garment's, so the unit of the pattern is wrong. Say it with `--units`. Exit
    /// code 3.
    PATTERN_HUGE = "pattern-huge";

    /// The largest piece is smaller than any garment's, so the unit of the pattern is wrong. Say it with `--units`. Exit
    /// code 3.
    PATTERN_TINY = "pattern-tiny";

    /// The file holds several sizes, and one of them was taken. --size takes another one.
    SIZE_TAKEN = "size-taken";
}
