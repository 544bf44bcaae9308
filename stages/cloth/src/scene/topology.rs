//! Edges, hinges and neighbours of a triangle mesh.

use crate::Element;

/// Two triangles that share an edge: edge ends 0 and 1, opposite corners 2 and 3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Hinge {
    pub vertices: [u32; 4],
    pub faces: [u32; 2],
    /// Number of the edge in each face; edge k runs from corner k to the next.
    pub sides: [u8; 2],
}

impl Hinge {
    /// Ends of its edge, smaller index first.
    pub fn edge(&self) -> [u32; 2] {
        let [a, b, ..] = self.vertices;
        [a.min(b), a.max(b)]
    }
}

/// Faces as index triples with their edges; every vertex and every edge is owned by one face.
#[derive(Clone, Debug, Default)]
pub(crate) struct Topology {
    pub faces: Vec<[u32; 3]>,
    /// Ends of every edge, smaller index first.
    pub edges: Vec<[u32; 2]>,
    pub face_edges: Vec<[u32; 3]>,
    /// For every face a bit for each corner (0..3) and edge (3..6) that it owns.
    pub owned: Vec<u8>,
    pub hinges: Vec<Hinge>,
}

/// Two pairs of corners that join a triangle to one part.
pub(crate) fn links(t: &[u32; 3]) -> [[u32; 2]; 2] {
    [[t[0], t[1]], [t[1], t[2]]]
}

/// For every vertex the first vertex of its connected component through these faces.
pub(crate) fn components<'a>(vertex_count: usize, faces: impl Iterator<Item = &'a [u32; 3]>) -> Vec<u32> {
    crate::scene::weld::groups(vertex_count, &faces.flat_map(links).collect::<Vec<_>>())
}

/// Ends of an edge, the smaller index first, a face that has it, and the number of the edge in that face.
type Side = (u32, u32, u32, u8);

/// The sides of all faces, ascending; they are first sorted by counting, since a body has millions.
fn sorted_sides(vertex_count: usize, faces: &[[u32; 3]]) -> Vec<Side> {
    let of = |(f, t): (u32, &[u32; 3])| {
        let t = *t;
        [0u8, 1, 2].map(|k| {
            let (a, b) = (t[usize::from(k)], t[(usize::from(k) + 1) % 3]);
            (a.min(b), a.max(b), f, k)
        })
    };
    let each = || (0u32..).zip(faces).flat_map(of);
    let mut next = vec![0usize; vertex_count + 1];
    each().for_each(|s| next[s.0 as usize + 1] += 1);
    (0..vertex_count).for_each(|v| next[v + 1] += next[v]);
    let mut sides = vec![(0, 0, 0, 0); 3 * faces.len()];
    for s in each() {
        let place = &mut next[s.0 as usize];
        sides[*place] = s;
        *place += 1;
    }
    sides.chunk_by_mut(|s, t| s.0 == t.0).for_each(<[Side]>::sort_unstable);
    sides
}

impl Topology {
    pub fn new(vertex_count: usize, faces: Vec<[u32; 3]>) -> Self {
        let sides = sorted_sides(vertex_count, &faces);
        let mut topology =
            Self { face_edges: vec![[0; 3]; faces.len()], owned: vec![0; faces.len()], faces, ..Self::default() };
        topology.own_vertices(vertex_count);
        let mut i = 0;
        while i < sides.len() {
            let same = sides[i..].iter().take_while(|s| (s.0, s.1) == (sides[i].0, sides[i].1)).count();
            topology.add_edge(&sides[i..i + same]);
            i += same;
        }
        topology.edges.shrink_to_fit();
        topology.hinges.shrink_to_fit();
        topology
    }

    pub fn of_elements(vertex_count: usize, elements: &[Element]) -> Self {
        Self::new(vertex_count, elements.iter().map(|e| e.vertices).collect())
    }

    fn own_vertices(&mut self, vertex_count: usize) {
        let mut seen = vec![false; vertex_count];
        for (t, owned) in self.faces.iter().zip(&mut self.owned) {
            for (k, v) in t.iter().enumerate() {
                if !std::mem::replace(&mut seen[*v as usize], true) {
                    *owned |= 1 << k;
                }
            }
        }
    }

    /// Adds the edge that these sides share; more than two sides make a hinge of each neighbouring pair.
    fn add_edge(&mut self, sides: &[Side]) {
        let id = u32::try_from(self.edges.len()).unwrap_or(u32::MAX);
        let (a, b, first, k) = sides[0];
        self.edges.push([a, b]);
        self.owned[first as usize] |= 8 << k;
        for s in sides {
            self.face_edges[s.2 as usize][usize::from(s.3)] = id;
        }
        for w in sides.windows(2) {
            let opposite = |s: &Side| self.faces[s.2 as usize][(usize::from(s.3) + 2) % 3];
            let vertices = [a, b, opposite(&w[0]), opposite(&w[1])];
            if vertices[2] != vertices[3] {
                self.hinges.push(Hinge { vertices, faces: [w[0].2, w[1].2], sides: [w[0].3, w[1].3] });
            }
        }
    }

    /// Frees edges and hinges, which only the making of energies and searches needs: more than half of all memory.
    pub fn forget_hinges(&mut self) {
        (self.edges, self.hinges) = (Vec::new(), Vec::new());
    }

    /// The edge of a hinge.
    pub fn edge_of(&self, h: &Hinge) -> usize {
        self.face_edges[h.faces[0] as usize][usize::from(h.sides[0])] as usize
    }

    /// For every vertex the first vertex of its connected component ([`components`]).
    pub fn components(&self, vertex_count: usize) -> Vec<u32> {
        components(vertex_count, self.faces.iter())
    }
}
