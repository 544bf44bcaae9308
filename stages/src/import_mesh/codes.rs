//! Codes of taking a garment from a mesh.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The mesh has no cloth coordinates, so the warp was laid along its height.
    GRAIN_GUESSED = "grain-guessed";

    /// The mesh has no triangle, so there is no cloth to drape. Exit code 3.
    MESH_EMPTY = "mesh-empty";

    /// An edge of the cloth mesh belongs to more than two triangles. Cloth is a surface; cut the mesh there.
    /// Exit code 3.
    MESH_NOT_MANIFOLD = "mesh-not-manifold";

    /// A border vertex of the cloth mesh lies in the middle of a neighbour's edge, so the cloth would open there. Split
    /// the triangle beside it at that vertex. Exit code 3.
    MESH_T_JUNCTION = "mesh-t-junction";

    /// The rest shape was asked from texture coordinates, and the mesh has none. Exit code 3.
    MESH_WITHOUT_UV = "mesh-without-uv";

    /// Triangles of the cloth mesh stand in the file again: they would be a second cloth in the place of the first.
    /// Exit code 3.
    TRIANGLES_DOUBLE = "triangles-double";

    /// Triangles of the cloth mesh have no area and were left out.
    TRIANGLES_FLAT = "triangles-flat";

    /// Triangles of the mesh lie mirrored in its texture coordinates, so right and wrong side of the cloth are mixed.
    UV_MIRRORED = "uv-mirrored";

    /// A line of a list of pins, stitches or loads cannot be read or names a vertex that is not there. Exit code 3.
    VERTEX_LIST = "vertex-list";

    /// Border vertices of the cloth mesh stand twice at one place, at the start and at rest, and nothing sews them:
    /// cloth that touches itself cannot be kept apart. Join them, name the pairs in with.stitches, or draw a slit open.
    /// Exit code 3.
    VERTICES_DOUBLED = "vertices-doubled";

    /// Vertices of the mesh belong to no triangle. They keep their place in the file.
    VERTICES_UNUSED = "vertices-unused";
}
