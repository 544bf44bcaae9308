//! How many triangles use an edge.

/// The number of triangles at each of some edges, in their order.
pub fn triangles_at(triangles: &[[u32; 3]], edges: &[[u32; 2]]) -> Vec<usize> {
    let in_order = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let sides = triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let mut sides: Vec<[u32; 2]> = sides.map(in_order).collect();
    sides.sort_unstable();
    let count = |edge: [u32; 2]| sides.partition_point(|s| *s <= edge) - sides.partition_point(|s| *s < edge);
    edges.iter().map(|edge| count(in_order(*edge))).collect()
}
