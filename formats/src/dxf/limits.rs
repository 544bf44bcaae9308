//! Limits on size and count, each named in its message.

/// Largest file, bytes.
pub const FILE_BYTES: usize = 256 << 20;
/// Most code/value pairs in a file.
pub const PAIRS: u64 = 20_000_000;
/// Longest line, bytes.
pub const LINE_BYTES: usize = 65_536;
/// Most pairs of one entity (a lightweight polyline holds its vertices itself).
pub const PAIRS_PER_ENTITY: usize = 2_000_000;
/// Most entities, vertices not counted.
pub const ENTITIES: usize = 1_000_000;
/// Most entities that INSERTs inside blocks place.
pub const EXPANDED: usize = 200_000;
/// Most pieces (blocks with an outline).
pub const PIECES: usize = 2_000;
/// Most vertices of one outline, after flattening of curves.
pub const OUTLINE_POINTS: usize = 200_000;
/// Most notches, and most notch strokes, of one piece.
pub const NOTCHES: usize = 5_000;
/// Most pairs of a notch and a vertex of its outline.
pub const NOTCH_TESTS: u64 = 200_000_000;
/// Most internal lines of a piece that are looked at as darts, times the vertices of its outline.
pub const DART_TESTS: usize = 200_000_000;
/// Deepest nesting of INSERTs.
pub const INSERT_DEPTH: usize = 8;
/// Largest absolute number accepted for a coordinate, in file units.
pub const COORDINATE: f64 = 1e8;
/// Largest extent of a piece, mm.
pub const PIECE_EXTENT_MM: f64 = 1e6;
/// Largest degree of a spline.
pub const SPLINE_DEGREE: usize = 11;
/// Most findings kept of one code; the rest are counted.
pub const FINDINGS_PER_CODE: usize = 40;
/// Most pairs tested for crossings of one outline.
pub const CROSSING_TESTS: u64 = 200_000_000;
