//! Corners and edges of a body that cloth can press on.
//!
//! Features that nothing outside can touch first are left out. For cloth much coarser than the body, most features
//! that lie close together are left out too.

use crate::Vec3;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::tuning::{CONVEX_FEATURES, FEATURE_CELL, FEATURE_DECIMATION, FEATURE_DEPTH};
use crate::scene::topology::{Hinge, Topology};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Features of the body: for each face one bit for each corner (bits 0 to 2) and edge (bits 3 to 5) that it owns and
/// that counts.
#[derive(Clone)]
pub(crate) struct ConvexFeatures {
    /// All features except hollow and flat edges of a closed, oriented mesh, and the corners where only such edges
    /// meet.
    pressing: Arc<Vec<u8>>,
    /// Fewer features, for coarser cloth.
    decimated: Option<Vec<u8>>,
    /// Edges between parts of the body, of which cloth may ignore one. Empty where all cloth meets all of the body.
    borders: Vec<u32>,
}

impl ConvexFeatures {
    /// Features of a body. `flat` marks edges between coplanar faces; it may be empty.
    pub fn new(x: &[Vec3], topology: &Topology, flat: &[bool]) -> Self {
        let pressing = owned_bits(topology, &pressing_edges(x, topology, flat), x.len());
        Self { pressing: Arc::new(pressing), decimated: None, borders: Vec::new() }
    }

    /// Adds the edges and corners between two parts of the body to the faces on both sides. Cloth that ignores one part
    /// meets the open border of the other from within, where a hollow edge is touched first.
    pub fn open_borders(&mut self, topology: &Topology, part_of: impl Fn(u32) -> u32) {
        let pressing = Arc::make_mut(&mut self.pressing);
        let own = |(f, bits): (usize, &u8)| (0..3).filter(|k| bits & (1 << k) != 0).map(|k| (f, k)).collect::<Vec<_>>();
        let corner = |(f, k): (usize, usize)| (topology.faces[f][k], part_of(f as u32));
        let mut known: BTreeSet<(u32, u32)> = pressing.iter().enumerate().flat_map(own).map(corner).collect();
        for h in topology.hinges.iter().filter(|h| part_of(h.faces[0]) != part_of(h.faces[1])) {
            self.borders.push(topology.edge_of(h) as u32);
            for (face, side) in h.faces.into_iter().zip(h.sides) {
                let (face, side) = (face as usize, usize::from(side));
                pressing[face] |= 1 << (side + 3);
                for k in [side, (side + 1) % 3].into_iter().filter(|k| known.insert(corner((face, *k)))) {
                    pressing[face] |= 1 << k;
                }
            }
        }
    }

    /// The bits of face `f`.
    #[inline]
    pub fn of(&self, f: u32) -> u8 {
        self.decimated.as_ref().unwrap_or(&self.pressing)[f as usize]
    }

    /// Restores all features, for a body that moves: a hollow edge may open and a flat edge may bend.
    pub fn restore_all(&mut self, topology: &Topology) {
        *self = Self { pressing: Arc::new(topology.owned.clone()), decimated: None, borders: Vec::new() };
    }

    /// Leaves out features for coarser cloth with this mean edge and gap to the body, m.
    ///
    /// A triangle of such cloth would press on hundreds of corners of a finely meshed body. Where the body is smooth,
    /// one corner in each cell of a grid holds it off nearly as well, and no edge is needed. The cloth may come a
    /// little nearer then, and may touch. The finest cloth starts from there and is held off by all features.
    pub fn decimate(&mut self, x: &[Vec3], topology: &Topology, [edge, gap]: [f64; 2]) {
        if !FEATURE_DECIMATION.is_on() {
            return;
        }
        let depth = FEATURE_DEPTH.get() * gap;
        let cell = FEATURE_CELL.get() * edge;
        let mut stays = vec![true; topology.edges.len()];
        // An edge with more than two faces is left out only if all its hinges are smooth.
        for h in &topology.hinges {
            stays[topology.edge_of(h)] = false;
        }
        for h in topology.hinges.iter().filter(|h| !is_smooth(x, h, cell, depth)) {
            stays[topology.edge_of(h)] = true;
        }
        self.borders.iter().for_each(|e| stays[*e as usize] = true);
        let mut corners = end_vertices(topology, &stays, x.len());
        one_of_each_cell(x, self.corners(topology), cell, &mut corners);
        let counts = self.pressing.iter().enumerate().map(|(f, s)| s & marked_bits(topology, f, &corners, &stays));
        self.decimated = Some(counts.collect());
    }

    /// The corners that press.
    fn corners<'a>(&'a self, topology: &'a Topology) -> impl Iterator<Item = u32> + 'a {
        let of = |(t, bits): (&'a [u32; 3], &'a u8)| (0..3).filter(move |k| bits & (1 << k) != 0).map(move |k| t[k]);
        topology.faces.iter().zip(self.pressing.iter()).flat_map(of)
    }
}

/// Edges that something outside can touch first.
///
/// A straight edge outside meets a hollow edge never first, nor an edge between two faces of a plane, which would
/// push cloth along that plane. Where the mesh is not closed or not oriented, every edge counts.
fn pressing_edges(x: &[Vec3], topology: &Topology, flat: &[bool]) -> Vec<bool> {
    let all = vec![true; topology.edges.len()];
    let is_closed =
        topology.hinges.len() * 2 == topology.faces.len() * 3 && topology.edges.len() == topology.hinges.len();
    if !is_closed || !CONVEX_FEATURES.is_on() {
        return all;
    }
    let volume: f64 = topology
        .faces
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| x[v as usize]);
            a.dot(&b.cross(&c))
        })
        .sum();
    let mut pressing = all.clone();
    for h in &topology.hinges {
        let [f, g] = h.faces.map(|f| topology.faces[f as usize]);
        let same = f[usize::from(h.sides[0])] == g[usize::from(h.sides[1])];
        if same {
            return all;
        }
        let [a, b, c] = f.map(|v| x[v as usize]);
        let n = (b - a).cross(&(c - a)) * volume.signum();
        let rise = n.dot(&(x[h.vertices[3] as usize] - a));
        let edge = topology.edge_of(h);
        pressing[edge] = rise < 0.0 && !flat.get(edge).is_some_and(|f| *f);
    }
    pressing
}

/// Is the edge shorter than `cell`, and is the body smooth across it? Over the length of a cell it then falls less
/// than `depth` below its tangent, m.
fn is_smooth(x: &[Vec3], h: &Hinge, cell: f64, depth: f64) -> bool {
    let [a, b, c, d] = h.vertices.map(|v| x[v as usize]);
    let (m, n) = ((b - a).cross(&(c - a)), (d - a).cross(&(b - a)));
    let (lm, ln, length) = (m.norm(), n.norm(), (b - a).norm());
    let sine = m.cross(&n).norm() / (lm * ln);
    // The curvature is the turn over the mean height of the two faces.
    let curvature = sine * 2.0 * length / (lm + ln);
    length < cell && m.dot(&n) > 0.0 && 0.5 * cell * cell * curvature < depth
}

/// Vertices at which one of these edges ends.
fn end_vertices(topology: &Topology, edges: &[bool], vertex_count: usize) -> Vec<bool> {
    let mut ends = vec![false; vertex_count];
    for (e, _) in topology.edges.iter().zip(edges).filter(|(_, p)| **p) {
        e.iter().for_each(|v| ends[*v as usize] = true);
    }
    ends
}

/// Marks, of these corners that are not marked yet, the first in each cell of a grid.
fn one_of_each_cell(x: &[Vec3], corners: impl Iterator<Item = u32>, cell: f64, marks: &mut [bool]) {
    let low = Aabb::of(x).low;
    // The conversion saturates far off, where all places count as one cell.
    let place = |v: u32| ((x[v as usize] - low) / cell).map(|c| c as u32);
    let mut others: Vec<([u32; 3], u32)> =
        corners.filter(|v| !marks[*v as usize]).map(|v| (place(v).into(), v)).collect();
    others.sort_unstable();
    others.chunk_by(|p, q| p.0 == q.0).for_each(|cell| marks[cell[0].1 as usize] = true);
}

/// Bits of the corners and edges of face `f` that are marked.
fn marked_bits(topology: &Topology, f: usize, corners: &[bool], edges: &[bool]) -> u8 {
    let of = |k: usize| {
        let [corner, edge] = [topology.faces[f][k], topology.face_edges[f][k]];
        u8::from(corners[corner as usize]) << k | u8::from(edges[edge as usize]) << (k + 3)
    };
    (0..3).fold(0, |b, k| b | of(k))
}

/// Bits of each face for the marked edges that it owns, and for the corners at which one ends.
fn owned_bits(topology: &Topology, pressing: &[bool], vertex_count: usize) -> Vec<u8> {
    let corners = end_vertices(topology, pressing, vertex_count);
    topology.owned.iter().enumerate().map(|(f, owned)| owned & marked_bits(topology, f, &corners, pressing)).collect()
}

#[cfg(test)]
mod tests {
    use crate::collision::body::Body;
    use crate::{BodyMesh, Vec3};

    fn counted(body: &Body, bits: u8) -> u32 {
        (0u32..).take(body.topology.faces.len()).map(|f| (body.features.of(f) & bits).count_ones()).sum()
    }

    /// A box whose top is a fan about its middle: neither the middle nor the spokes press.
    #[test]
    fn in_a_plane_and_in_a_hollow_nothing_presses() {
        let corner = |k: u32| Vec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        let quads = [[0, 2, 3, 1], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
        let mut triangles: Vec<[u32; 3]> =
            quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
        triangles.extend([[4, 5], [5, 7], [7, 6], [6, 4]].map(|[a, b]| [a, b, 8]));
        let pressing = |height: f64| {
            let positions = (0..8).map(corner).chain([Vec3::new(0.5, 0.5, height)]).collect();
            let body = Body::new(&BodyMesh { positions, triangles: triangles.clone() }).expect("a body");
            let count = |bits: u8| counted(&body, bits);
            [count(7), count(7 << 3)]
        };
        // A box has eight corners and twelve edges. A tip adds a corner and four edges, a dent adds none.
        assert_eq!(pressing(1.0), [8, 12]);
        assert_eq!(pressing(1.2), [9, 16]);
        assert_eq!(pressing(0.8), [8, 12]);
    }

    /// A box of two parts: each has the four edges and four corners of its open border, though these lie in planes.
    #[test]
    fn the_border_of_an_ignored_part_presses() {
        let corner = |k: u32| Vec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), 0.5 * f64::from(k >> 2));
        let sides = [[0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
        let quads = [[0, 2, 3, 1], [8, 9, 11, 10]].into_iter().chain(sides).chain(sides.map(|q| q.map(|k| k + 4)));
        let triangles = quads.flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
        let mut body = Body::new(&BodyMesh { positions: (0..12).map(corner).collect(), triangles }).expect("a body");
        let (corners, edges) = (counted(&body, 7), counted(&body, 7 << 3));
        let topology = body.topology.clone();
        let is_upper = |f: u32| topology.faces[f as usize].iter().any(|v| *v > 7);
        body.features.open_borders(&topology, |f| u32::from(is_upper(f)));
        // Four edges around the middle count once for each part, and so do the corners, of which one part had some.
        assert_eq!(edges + 8, counted(&body, 7 << 3));
        let added = counted(&body, 7) - corners;
        assert!((4..=8).contains(&added), "{added}");
        for upper in [false, true] {
            let bits = |f: &u32| body.features.of(*f);
            let own = (0..topology.faces.len() as u32).filter(|f| is_upper(*f) == upper);
            let at_border = own.flat_map(|f| (0..3).filter(move |k| bits(&f) & (1 << k) != 0).map(move |k| (f, k)));
            let mut met: Vec<u32> = at_border.map(|(f, k)| topology.faces[f as usize][k]).collect();
            met.retain(|v| (4..8).contains(v));
            met.sort_unstable();
            assert_eq!(met, [4, 5, 6, 7], "upper: {upper}");
        }
    }

    /// A lid of squares of 1 mm, bent over a tube of this radius. A point below closes its rim.
    fn lid(radius: f64) -> Body {
        const N: u32 = 40;
        let at = |i: u32, j: u32| {
            let [u, v] = [i, j].map(|k| 1e-3 * (f64::from(k) - 0.5 * f64::from(N)));
            Vec3::new(radius * libm::sin(u / radius), radius * (libm::cos(u / radius) - 1.0), v)
        };
        let positions = (0..=N).flat_map(|i| (0..=N).map(move |j| at(i, j))).chain([Vec3::new(0.0, -0.1, 0.0)]);
        let index = |i: u32, j: u32| i * (N + 1) + j;
        let cells = (0..N)
            .flat_map(|i| (0..N).map(move |j| [index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i + 1, j)]));
        let mut triangles: Vec<[u32; 3]> = cells.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let rim = (0..N).flat_map(|k| {
            [
                [index(k, 0), index(k + 1, 0)],
                [index(N, k), index(N, k + 1)],
                [index(k + 1, N), index(k, N)],
                [index(0, k + 1), index(0, k)],
            ]
        });
        triangles.extend(rim.map(|[a, b]| [a, b, (N + 1) * (N + 1)]));
        Body::new(&BodyMesh { positions: positions.collect(), triangles }).expect("a body")
    }

    #[test]
    fn coarse_cloth_is_held_off_by_fewer_corners_of_what_is_smooth() {
        let (edge, gap) = (0.03, 1e-3);
        let full = lid(0.2);
        let [corners, edges] = [counted(&full, 7), counted(&full, 7 << 3)];
        let thin = lid(0.2).decimated([edge, gap]);
        // The rim and the tip stay, and of the smooth inside one corner in every 4.5 mm.
        assert!(corners > 1600 && edges > 1600, "{corners} {edges}");
        let [left, sharp] = [counted(&thin, 7), counted(&thin, 7 << 3)];
        assert_eq!([left, sharp], [160 + 1 + 9 * 9, 160 + 4]);
    }

    /// A sharply bent body keeps all features, and finer cloth meets all features of any body.
    #[test]
    fn what_is_bent_stays_whole() {
        let whole = |radius: f64, edge: f64| {
            let (full, thin) = (lid(radius), lid(radius).decimated([edge, 1e-3]));
            counted(&full, 63) == counted(&thin, 63)
        };
        assert!(!whole(0.2, 0.03) && whole(0.02, 0.03) && whole(0.2, 0.006));
        let shared = lid(0.2);
        assert!(counted(&shared.clone().decimated([0.03, 1e-3]), 63) < counted(&shared, 63));
        assert_eq!(counted(&shared, 63), counted(&lid(0.2), 63));
    }
}
