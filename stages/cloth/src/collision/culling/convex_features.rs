//! Which corners and edges of a body cloth can press on: those that nothing outside meets first are not looked for, and on
//! cloth much coarser than the body not all that lie close beside each other.

use crate::Vec3;
use crate::collision::broad_phase::bvh::Aabb;
use crate::scene::topology::{Hinge, Topology};
use std::sync::Arc;

/// Share of the cloth's edge within which one corner of a smooth body stands for all.
const CELL: f64 = 0.15;
/// Share of the cloth's gap by which cloth may come nearer then.
const DEPTH: f64 = 0.1;

/// Per face a bit for each corner (0..3) and edge (3..6) that it owns and that counts.
#[derive(Clone)]
pub(crate) struct Sides {
    /// Of a closed, oriented mesh all but the hollow and flat edges, and the corners where only such meet.
    pressing: Arc<Vec<u8>>,
    /// Fewer, for coarser cloth.
    thinned: Option<Vec<u8>>,
}

impl Sides {
    pub fn new(x: &[Vec3], topology: &Topology, flat: &[bool]) -> Self {
        let pressing = sides(topology, &pressing(x, topology, flat), x.len());
        Self { pressing: Arc::new(pressing), thinned: None }
    }

    /// Of face `f`.
    #[inline]
    pub fn of(&self, f: u32) -> u8 {
        self.thinned.as_ref().unwrap_or(&self.pressing)[f as usize]
    }

    /// For a body that moves: a hollow edge may open, a flat one may bend.
    pub fn any(&mut self, topology: &Topology) {
        (self.pressing, self.thinned) = (Arc::new(topology.owned.clone()), None);
    }

    /// For coarser cloth of such edges and gap to the body, m. Its triangles would press on hundreds of corners of a finely
    /// meshed body; where that is smooth, one in each cell of a grid holds them off nearly as well, and no edge is needed. So the
    /// cloth may come a little nearer, and touch: only finer cloth, which is held off by all, may end there.
    pub fn thin(&mut self, x: &[Vec3], topology: &Topology, [edge, gap]: [f64; 2]) {
        let cell = CELL * edge;
        let mut stays = vec![true; topology.edges.len()];
        // Of edges with more than two faces all hinges must be smooth.
        for h in &topology.hinges {
            stays[topology.edge_of(h)] = false;
        }
        for h in topology.hinges.iter().filter(|h| !smooth(x, h, cell, DEPTH * gap)) {
            stays[topology.edge_of(h)] = true;
        }
        let mut corners = ends(topology, &stays, x.len());
        one_of_each_cell(x, self.corners(topology), cell, &mut corners);
        let counts = self.pressing.iter().enumerate().map(|(f, s)| s & bits(topology, f, &corners, &stays));
        self.thinned = Some(counts.collect());
    }

    /// Those that press.
    fn corners<'a>(&'a self, topology: &'a Topology) -> impl Iterator<Item = u32> + 'a {
        let of = |(t, bits): (&'a [u32; 3], &'a u8)| (0..3).filter(move |k| bits & (1 << k) != 0).map(move |k| t[k]);
        topology.faces.iter().zip(self.pressing.iter()).flat_map(of)
    }
}

/// An edge that is hollow seen from outside cannot be the first thing a straight edge outside meets, nor can one between two
/// faces of a plane; and that would push cloth along the plane. Where the mesh is not closed or not oriented, nothing is known
/// and every edge counts.
fn pressing(x: &[Vec3], topology: &Topology, flat: &[bool]) -> Vec<bool> {
    let all = vec![true; topology.edges.len()];
    if topology.hinges.len() * 2 != topology.faces.len() * 3 || topology.edges.len() != topology.hinges.len() {
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

/// Is the edge shorter than `cell`, and does the body bend so little across it that over the length of a cell it falls less
/// than `depth` below its tangent?
fn smooth(x: &[Vec3], h: &Hinge, cell: f64, depth: f64) -> bool {
    let [a, b, c, d] = h.vertices.map(|v| x[v as usize]);
    let (m, n) = ((b - a).cross(&(c - a)), (d - a).cross(&(b - a)));
    let (lm, ln, length) = (m.norm(), n.norm(), (b - a).norm());
    let sine = m.cross(&n).norm() / (lm * ln);
    // Turn over the mean height of the two faces.
    let curvature = sine * 2.0 * length / (lm + ln);
    length < cell && m.dot(&n) > 0.0 && 0.5 * cell * cell * curvature < depth
}

/// Vertices at which one of these edges ends.
fn ends(topology: &Topology, edges: &[bool], vertex_count: usize) -> Vec<bool> {
    let mut ends = vec![false; vertex_count];
    for (e, _) in topology.edges.iter().zip(edges).filter(|(_, p)| **p) {
        e.iter().for_each(|v| ends[*v as usize] = true);
    }
    ends
}

/// Marks of these corners that are not marked yet the first in each cell of a grid.
fn one_of_each_cell(x: &[Vec3], corners: impl Iterator<Item = u32>, cell: f64, marks: &mut [bool]) {
    let low = Aabb::of(x).low;
    // Saturates far off, where all count as one cell.
    let place = |v: u32| ((x[v as usize] - low) / cell).map(|c| c as u32);
    let mut others: Vec<([u32; 3], u32)> =
        corners.filter(|v| !marks[*v as usize]).map(|v| (place(v).into(), v)).collect();
    others.sort_unstable();
    others.chunk_by(|p, q| p.0 == q.0).for_each(|cell| marks[cell[0].1 as usize] = true);
}

/// What a face has of these corners and edges.
fn bits(topology: &Topology, f: usize, corners: &[bool], edges: &[bool]) -> u8 {
    let of = |k: usize| {
        let [corner, edge] = [topology.faces[f][k], topology.face_edges[f][k]];
        u8::from(corners[corner as usize]) << k | u8::from(edges[edge as usize]) << (k + 3)
    };
    (0..3).fold(0, |b, k| b | of(k))
}

/// What each face owns of the edges that press, and of the corners at which one ends.
fn sides(topology: &Topology, pressing: &[bool], vertex_count: usize) -> Vec<u8> {
    let corners = ends(topology, pressing, vertex_count);
    topology.owned.iter().enumerate().map(|(f, owned)| owned & bits(topology, f, &corners, pressing)).collect()
}

#[cfg(test)]
mod tests {
    use crate::collision::body::Body;
    use crate::{BodyMesh, Vec3};

    fn counted(body: &Body, bits: u8) -> u32 {
        (0u32..).take(body.topology.faces.len()).map(|f| (body.sides.of(f) & bits).count_ones()).sum()
    }

    /// Of a box whose top is a fan about its middle: at the middle nothing presses, nor along the spokes.
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
        // Eight corners and twelve edges of a box; a tip has a corner and four edges more, a dent as few as a plane.
        assert_eq!(pressing(1.0), [8, 12]);
        assert_eq!(pressing(1.2), [9, 16]);
        assert_eq!(pressing(0.8), [8, 12]);
    }

    /// A lid of squares of 1 mm, bent over a tube of this radius, its rim closed by a point below.
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
        let thin = lid(0.2).held_off([edge, gap]);
        // The rim and the tip stay; of the smooth inside one in every 4.5 mm.
        assert!(corners > 1600 && edges > 1600, "{corners} {edges}");
        let [left, sharp] = [counted(&thin, 7), counted(&thin, 7 << 3)];
        assert_eq!([left, sharp], [160 + 1 + 9 * 9, 160 + 4]);
    }

    /// What bends as sharply as the cloth's gap can tell stays as it is, and so does all for finer cloth.
    #[test]
    fn what_is_bent_stays_whole() {
        let whole = |radius: f64, edge: f64| {
            let (full, thin) = (lid(radius), lid(radius).held_off([edge, 1e-3]));
            counted(&full, 63) == counted(&thin, 63)
        };
        assert!(!whole(0.2, 0.03) && whole(0.02, 0.03) && whole(0.2, 0.006));
        let shared = lid(0.2);
        assert!(counted(&shared.clone().held_off([0.03, 1e-3]), 63) < counted(&shared, 63));
        assert_eq!(counted(&shared, 63), counted(&lid(0.2), 63));
    }
}
