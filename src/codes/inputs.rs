//! Codes of bodies, fabrics, meshes, images and garment files.

use super::{Code, code};

/// Codes of bodies, fabrics, meshes, images and garment files.
pub(super) const CODES: &[Code] = &[
    code(
        "bending-differs-from-file",
        "The bending length of a strip on the cantilever differs by more than 5 % from the fabric file's. A shorter --edge helps where the mesh is too coarse; what stays is how garments of this fabric will bend.",
    ),
    code(
        "body-measure-not-met",
        "No figure of this kind has these measures together; the message names the nearest. Exit code 2.",
    ),
    code("body-measure-out-of-range", "A measure is none that a body has; the message gives the range. Exit code 2."),
    code(
        "body-measures-contradict",
        "Two measures do not go with each other, e.g. a hip above the waist. Exit code 2.",
    ),
    code(
        "body-not-clean",
        "The measures give a surface that folds or grows together. Bring them closer to a usual size. Exit code 2.",
    ),
    code("color", "A colour is not written as # and six hexadecimal digits. Exit code 2."),
    code(
        "drape-differs-from-lab",
        "The drape coefficient differs by more than five points from the one given with --lab, more than repeats of one cloth differ in a laboratory. Look at the bending stiffness first.",
    ),
    code(
        "fabric-without-bending",
        "The fabric has no bending stiffness, or a bending length below 1 mm, so it hangs as the mesh lets it and the test has no answer. Give its bending in the fabric file. Exit code 3.",
    ),
    code(
        "garment-file",
        "The file is no garment document of toile, is damaged, or was written by a newer toile. Exit code 3.",
    ),
    code(
        "glb-damaged",
        "The file is no sound GLB: its header, lengths or JSON break the format. Export it again. Exit code 3.",
    ),
    code("grain-guessed", "The mesh has no cloth coordinates, so the warp was laid along its height."),
    code("mesh-empty", "The mesh has no triangle, so there is no cloth to drape. Exit code 3."),
    code(
        "mesh-not-manifold",
        "An edge of the cloth mesh belongs to more than two triangles. Cloth is a surface; cut the mesh there. Exit code 3.",
    ),
    code(
        "mesh-t-junction",
        "A border vertex of the cloth mesh lies in the middle of a neighbour's edge, so the cloth would open there. Split the triangle beside it at that vertex. Exit code 3.",
    ),
    code("mesh-without-uv", "The rest shape was asked from texture coordinates, and the mesh has none. Exit code 3."),
    code(
        "specimen-too-large",
        "The drape coefficient is below 30 %: the standard asks for a smaller specimen, which tells limp cloths apart better.",
    ),
    code(
        "specimen-too-small",
        "The drape coefficient is above 85 %: the standard asks for a larger specimen, which tells stiff cloths apart better.",
    ),
    code("text-encoding", "A text file is not UTF-8. Save it as UTF-8. Exit code 3."),
    code("text-not-utf8", "A text file is not UTF-8. Save it as UTF-8. Exit code 3."),
    code("triangles-flat", "Triangles of the cloth mesh have no area and were left out."),
    code(
        "uv-mirrored",
        "Triangles of the mesh lie mirrored in its texture coordinates, so right and wrong side of the cloth are mixed.",
    ),
    code(
        "vertex-list",
        "A line of a list of pins, stitches or loads cannot be read or names a vertex that is not there. Exit code 3.",
    ),
    code(
        "vertices-doubled",
        "Border vertices of the cloth mesh stand twice at one place, at the start and at rest, and nothing sews them: cloth that touches itself cannot be kept apart. Join them, name the pairs in with.stitches, or draw a slit open. Exit code 3.",
    ),
    code("vertices-unused", "Vertices of the mesh belong to no triangle. They keep their place in the file."),
];
