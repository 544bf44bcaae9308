//! Codes of bodies, fabrics, meshes, images and garment files.

use super::{Code, code};

/// Codes of bodies, fabrics, meshes, images and garment files.
pub(super) const CODES: &[Code] = &[
    code(
        "drape-differs-from-lab",
        "The drape coefficient differs by more than five points from the one given with --lab, more than repeats of one cloth differ in a laboratory. Look at the bending stiffness first.",
    ),
    code(
        "garment-file",
        "The file is no garment document of toile, is damaged, or was written by a newer toile. Exit code 3.",
    ),
    code(
        "glb-damaged",
        "The file is no sound GLB: its header, lengths or JSON break the format. Export it again. Exit code 3.",
    ),
];
