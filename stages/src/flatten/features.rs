//! The chains of mesh vertices that a pattern maker reads: edges, sewn pairs, darts, corners, grain.
//!
//! All by stored ids; nothing is searched by position except the vertices next to the ends of the grain line, which
//! the document keeps as points.

use super::figures::length2;
use std::collections::BTreeSet;
use toile_garment::mesh::PieceMesh;
use toile_garment::outline::{OutlineEdge, PieceLine};
use toile_garment::{Garment, Piece, Vec2};

/// A mesh cuts the curve of a drawn line short by a smaller share than this.
const MESHED_SHORT: f64 = 0.02;

/// A named chain of vertices of one piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Name.
    pub name: String,
    /// Vertices in order.
    pub vertices: Vec<u32>,
    /// Length as it is drawn for each length on the mesh, whose edges cut curves short.
    pub scale: f64,
}

/// Two chains of one piece that are sewn to each other, station by station.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainPair {
    /// Name.
    pub name: String,
    /// Side a.
    pub a: Vec<u32>,
    /// Side b.
    pub b: Vec<u32>,
    /// Length of each side as it is drawn for each length on the mesh.
    pub scale: [f64; 2],
}

/// A corner of the outline with its neighbours.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// Name.
    pub name: String,
    /// Vertex before, corner, vertex after.
    pub at: [u32; 3],
}

/// Everything named on the mesh of one piece.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Features {
    /// Runs of the outline between corners, dart legs of marked darts left out.
    pub edges: Vec<Chain>,
    /// Sewn pairs inside the piece.
    pub pairs: Vec<ChainPair>,
    /// Legs from mouth to apex; a fish-eye stands here twice, once per apex.
    pub darts: Vec<ChainPair>,
    /// Corners.
    pub corners: Vec<Corner>,
    /// Vertices nearest to the ends of the grain line.
    pub grain: Option<[u32; 2]>,
}

/// Collects the features of a piece.
#[must_use]
pub fn of(garment: &Garment, piece: &Piece, mesh: &PieceMesh) -> Features {
    let legs = leg_sides(piece);
    let edges = edges(piece, mesh, &legs);
    let (darts, mut pairs) = darts(piece, mesh);
    pairs.extend(inner_seams(garment, piece));
    Features { corners: corners(piece, mesh), edges, pairs, darts, grain: grain(piece, mesh) }
}

/// Mesh edges that belong to dart legs, smaller id first.
fn leg_sides(piece: &Piece) -> BTreeSet<[u32; 2]> {
    let meshes = piece.darts.iter().filter_map(|d| d.mesh.as_ref());
    meshes.flat_map(|m| m.legs.iter()).flat_map(|leg| leg.windows(2)).map(|w| side(w[0], w[1])).collect()
}

fn side(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn edges(piece: &Piece, mesh: &PieceMesh, legs: &BTreeSet<[u32; 2]>) -> Vec<Chain> {
    let mut out = Vec::new();
    for edge in &piece.edges {
        let name = edge.name.clone().unwrap_or_else(|| format!("edge {}", edge.index));
        let Some(chain) = outline_run(mesh, edge.from, edge.to) else { continue };
        let runs = without_legs(&chain, legs);
        let many = runs.len() > 1;
        let scale = match runs.as_slice() {
            [whole] => drawn_scale(drawn_length(&piece.outline, edge), mesh, whole),
            _ => 1.0,
        };
        for (k, vertices) in runs.into_iter().enumerate() {
            let name = if many { format!("{name} ({})", k + 1) } else { name.clone() };
            out.push(Chain { name, vertices, scale });
        }
    }
    out
}

/// Length of an edge of the drawn outline, metres.
fn drawn_length(outline: &PieceLine, edge: &OutlineEdge) -> f64 {
    let n = outline.points.len();
    let [from, to] = [edge.from, edge.to].map(|i| i as usize);
    if from >= n || to >= n {
        return 0.0;
    }
    let count = if to > from { to - from } else { to + n - from };
    let point = |k: usize| outline.points[(from + k) % n].at;
    (0..count).map(|k| (point(k + 1) - point(k)).norm()).sum()
}

/// Length as it is drawn for each length of a chain at rest. A chain that runs elsewhere keeps its own length.
fn drawn_scale(drawn: f64, mesh: &PieceMesh, chain: &[u32]) -> f64 {
    let share = drawn / length2(&mesh.rest, chain);
    if (share - 1.0).abs() <= MESHED_SHORT { share } else { 1.0 }
}

/// The mesh vertices of the outline from one outline point to another, counter-clockwise.
fn outline_run(mesh: &PieceMesh, from: u32, to: u32) -> Option<Vec<u32>> {
    let outline = &mesh.outline()?.vertices;
    let place = |point: u32| {
        let vertex = (*mesh.outline_vertex.get(point as usize)?)?;
        outline.iter().position(|v| *v == vertex)
    };
    let (start, end, n) = (place(from)?, place(to)?, outline.len());
    let count = (end + n - start) % n;
    let count = if count == 0 { n } else { count };
    Some((0..=count).map(|k| outline[(start + k) % n]).collect())
}

/// The parts of a chain that are no dart legs; a chain that is nothing but leg stays whole.
fn without_legs(chain: &[u32], legs: &BTreeSet<[u32; 2]>) -> Vec<Vec<u32>> {
    let is_leg = |w: &[u32]| legs.contains(&side(w[0], w[1]));
    if chain.windows(2).all(is_leg) {
        return vec![chain.to_vec()];
    }
    let mut runs: Vec<Vec<u32>> = Vec::new();
    let mut open = false;
    for w in chain.windows(2) {
        if is_leg(w) {
            open = false;
        } else if let (true, Some(run)) = (open, runs.last_mut()) {
            run.push(w[1]);
        } else {
            runs.push(w.to_vec());
            open = true;
        }
    }
    runs
}

/// Darts with a common apex, and the leg pairs of everything that is sewn along legs.
fn darts(piece: &Piece, mesh: &PieceMesh) -> (Vec<ChainPair>, Vec<ChainPair>) {
    let (mut darts, mut pairs) = (Vec::new(), Vec::new());
    for dart in &piece.darts {
        let Some([a, b]) = dart.mesh.as_ref().map(|m| &m.legs) else { continue };
        let n = a.len().min(b.len());
        if n < 2 {
            continue;
        }
        let scale = [(0, a), (1, b)].map(|(leg, chain)| drawn_scale(dart.leg_length(leg), mesh, chain));
        pairs.push(ChainPair { name: dart.name.clone(), a: a.clone(), b: b.clone(), scale });
        if dart.apexes.len() == 2 {
            let wide = widest(piece, a, b).clamp(1, n - 2.min(n - 1));
            let back = |leg: &[u32]| leg[..=wide].iter().rev().copied().collect::<Vec<_>>();
            darts.push(ChainPair { name: format!("{} (1)", dart.name), a: back(a), b: back(b), scale });
            let [a, b] = [a, b].map(|leg| leg[wide..].to_vec());
            darts.push(ChainPair { name: format!("{} (2)", dart.name), a, b, scale });
        } else if a.last() == b.last() {
            darts.push(ChainPair { name: dart.name.clone(), a: a.clone(), b: b.clone(), scale });
        }
    }
    (darts, pairs)
}

/// Where the two legs of a fish-eye are farthest apart.
fn widest(piece: &Piece, a: &[u32], b: &[u32]) -> usize {
    let Some(mesh) = &piece.mesh else { return 0 };
    let gap = |k: &usize| (mesh.rest[a[*k] as usize] - mesh.rest[b[*k] as usize]).norm_squared();
    (0..a.len().min(b.len())).max_by(|i, j| gap(i).total_cmp(&gap(j))).unwrap_or(0)
}

/// Declared seams whose both sides lie on this piece alone.
fn inner_seams<'a>(garment: &'a Garment, piece: &'a Piece) -> impl Iterator<Item = ChainPair> + 'a {
    let declared = garment.seams.iter().filter(|s| s.kind == toile_garment::seam::SeamKind::Seam);
    declared
        .filter(|s| !s.stitches.is_empty())
        .filter(|s| s.stitches.iter().all(|t| t.a.piece == piece.id && t.b.piece == piece.id))
        .map(|s| ChainPair {
            name: s.name.clone(),
            a: s.stitches.iter().map(|t| t.a.vertex).collect(),
            b: s.stitches.iter().map(|t| t.b.vertex).collect(),
            scale: [1.0; 2],
        })
}

fn corners(piece: &Piece, mesh: &PieceMesh) -> Vec<Corner> {
    let Some(outline) = mesh.outline().map(|c| &c.vertices).filter(|v| v.len() >= 3) else { return Vec::new() };
    let n = outline.len();
    let mut out = Vec::new();
    for edge in &piece.edges {
        let vertex = mesh.outline_vertex.get(edge.from as usize).copied().flatten();
        let Some(k) = vertex.and_then(|v| outline.iter().position(|o| *o == v)) else { continue };
        let at = [outline[(k + n - 1) % n], outline[k], outline[(k + 1) % n]];
        out.push(Corner { name: format!("corner {}", edge.index), at });
    }
    out
}

fn grain(piece: &Piece, mesh: &PieceMesh) -> Option<[u32; 2]> {
    let used: BTreeSet<u32> = mesh.triangles.iter().flatten().copied().collect();
    let nearest = |to: Vec2| {
        let far = |v: &u32| (mesh.rest[*v as usize] - to).norm_squared();
        used.iter().copied().min_by(|a, b| far(a).total_cmp(&far(b)))
    };
    let [a, b] = piece.grain?;
    let (a, b) = (nearest(a)?, nearest(b)?);
    (a != b).then_some([a, b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_over_a_marked_dart_is_read_without_its_legs() {
        let legs = BTreeSet::from([[2, 3], [3, 4]]);
        assert_eq!(without_legs(&[0, 1, 2, 3, 4, 5], &legs), vec![vec![0, 1, 2], vec![4, 5]]);
        assert_eq!(without_legs(&[2, 3, 4], &legs), vec![vec![2, 3, 4]]);
        assert_eq!(without_legs(&[3, 4, 5], &legs), vec![vec![4, 5]]);
    }
}
