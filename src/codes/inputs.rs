//! Codes of bodies, fabrics, meshes, images and garment files.

use super::{Code, code};

/// Codes of bodies, fabrics, meshes, images and garment files.
pub(super) const CODES: &[Code] = &[
    code(
        "bending-differs-from-file",
        "The bending length of a strip on the cantilever differs by more than 5 % from the fabric file's. A shorter --edge helps where the mesh is too coarse; what stays is how garments of this fabric will bend.",
    ),
    code("body-empty", "The body has no triangle with area. Exit code 3."),
    code(
        "body-faces-mixed",
        "Neighbouring faces of the body look to different sides, so inside and outside are not known. Recalculate the normals and export again. Exit code 3.",
    ),
    code("body-inside-out", "All faces of the body looked inwards; they were turned."),
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
    code(
        "body-not-manifold",
        "Edges of the body belong to more than two triangles. Contact works, but inside and outside are doubtful there.",
    ),
    code("body-open", "The body has open edges. Cloth can slip in there; close the holes where the garment lies."),
    code("body-size", "The body is taller or smaller than a person. Its file is probably not in metres."),
    code("body-syntax", "The side file of a body is not TOML. Exit code 3."),
    code("body-triangles-double", "Triangles of the body stand in the file twice; one of each was kept."),
    code("body-triangles-flat", "Triangles of the body have no area and were left out."),
    code(
        "body-value",
        "A value in the side file of a body cannot be read. Lengths are texts with a unit, e.g. \"914 mm\". Exit code 3.",
    ),
    code("body-vertices-merged", "Vertices of the body at the same place became one."),
    code("body-vertices-unused", "Vertices of the body belong to no face and were left out."),
    code("color", "A colour is not written as # and six hexadecimal digits. Exit code 2."),
    code(
        "drape-differs-from-lab",
        "The drape coefficient differs by more than five points from the one given with --lab, more than repeats of one cloth differ in a laboratory. Look at the bending stiffness first.",
    ),
    code("fabric-curve", "A measured curve must begin at zero and rise in both columns. Exit code 3."),
    code("fabric-name-missing", "The fabric has no name. Give it one, so that reports can tell fabrics apart."),
    code("fabric-syntax", "The fabric file is not TOML at this place; the message says what is wrong. Exit code 3."),
    code(
        "fabric-value",
        "A value of the fabric is out of its range, of a wrong type, or of a foreign unit; the message says which. Exit code 3.",
    ),
    code(
        "fabric-value-missing",
        "The fabric file does not say enough: one of [linear], [isotropic], [kes], [fast] or [curve] must give stretch, shear and bending, with areal mass and thickness. Exit code 3.",
    ),
    code("fabric-value-twice", "The fabric gives one property in two ways. Keep one. Exit code 3."),
    code(
        "fabric-without-bending",
        "The fabric has no bending stiffness, or a bending length below 1 mm, so it hangs as the mesh lets it and the test has no answer. Give its bending in the fabric file. Exit code 3.",
    ),
    code(
        "garment-file",
        "The file is no garment document of toile, is damaged, or was written by a newer toile. Exit code 3.",
    ),
    code(
        "garmentcode-gathers",
        "Two stitched edges of a GarmentCode specification differ much in length; they are sewn as a gather.",
    ),
    code("garmentcode-not-json", "The file is not JSON. Give a GarmentCode `…_specification.json`. Exit code 3."),
    code(
        "garmentcode-wrong",
        "A panel, edge or stitch of a GarmentCode specification is wrong; the message says which and why. Exit code 3.",
    ),
    code(
        "glb-damaged",
        "The file is no sound GLB: its header, lengths or JSON break the format. Export it again. Exit code 3.",
    ),
    code("grain-guessed", "The mesh has no cloth coordinates, so the warp was laid along its height."),
    code("image-broken", "The image is damaged or cut short. Exit code 3."),
    code("image-kind", "The image is neither PNG nor JPEG. Exit code 3."),
    code("image-size", "The image is larger than the limit. Exit code 3."),
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
    code("obj-empty", "The OBJ has no vertices or no faces. Exit code 3."),
    code("obj-index", "A face names a vertex that is not there. Exit code 3."),
    code("obj-line", "A line of the OBJ cannot be read. Exit code 3."),
    code("obj-more", "More mistakes of the OBJ were found than are listed. Exit code 3."),
    code("obj-number", "A coordinate of the OBJ is no number, not finite or too large. Exit code 3."),
    code(
        "obj-polygon",
        "A face of the OBJ cannot be cut into triangles, because it crosses itself or has no area. Exit code 3.",
    ),
    code(
        "obj-readers-differ",
        "Two independent readings of the OBJ give different meshes, so neither is trusted. Exit code 3.",
    ),
    code("obj-too-many", "The OBJ is larger than the limit. Exit code 3."),
    code(
        "shape-edited",
        "Vertices of the GLB were moved since the export. The flattening carries the edit into the pieces.",
    ),
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
        "unit-missing",
        "A quantity of the fabric is a bare number, which hides its unit. Write it as a text, e.g. \"180 g/m2\". Exit code 3.",
    ),
    code(
        "uv-mirrored",
        "Triangles of the mesh lie mirrored in its texture coordinates, so right and wrong side of the cloth are mixed.",
    ),
    code(
        "value-out-of-range",
        "A value of a material is outside the range that makes sense; check the number and its unit. Exit code 2.",
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
