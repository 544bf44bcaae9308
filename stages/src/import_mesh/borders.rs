//! Mistakes along the borders of an imported mesh: corners in the middle of a neighbour's edge, vertices that
//! stand twice. Both tear cloth that looks whole.

use super::boundary::users;
use super::codes;
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::mesh::PieceMesh;
use toile_garment::{Code, Diagnostic, SourceRef, Vec2, Vec3};

/// Nearer to an edge than this share of its length is on it.
const ON: f64 = 1e-6;
/// Nearer than this is the same place, metres.
const SAME: f64 = 1e-7;

/// Places of a mesh at the start and at rest.
pub struct Borders<'a> {
    pub mesh: &'a PieceMesh,
    pub at: &'a [Vec3],
    pub file: &'a str,
    /// Edges of one triangle, each once.
    edges: BTreeSet<[u32; 2]>,
    /// Their vertices, by their x at the start.
    list: Vec<u32>,
}

impl<'a> Borders<'a> {
    /// Checks the borders of a mesh whose vertices stand at `at`.
    pub fn new(mesh: &'a PieceMesh, at: &'a [Vec3], file: &'a str) -> Self {
        let edges: BTreeSet<[u32; 2]> = users(mesh).into_iter().filter(|(_, u)| u.count == 1).map(|(e, _)| e).collect();
        let used: BTreeSet<u32> = edges.iter().flatten().copied().collect();
        let mut list: Vec<u32> = used.into_iter().collect();
        list.sort_by(|a, b| at[*a as usize].x.total_cmp(&at[*b as usize].x));
        Self { mesh, at, file, edges, list }
    }

    /// The neighbours of every border vertex along its border edges.
    pub fn neighbours(&self) -> BTreeMap<u32, Vec<u32>> {
        let mut beside: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for [a, b] in &self.edges {
            beside.entry(*a).or_default().push(*b);
            beside.entry(*b).or_default().push(*a);
        }
        beside
    }

    /// Rest place of a vertex, where there is one for all its triangles.
    fn rest(&self, v: u32) -> Vec2 {
        if self.mesh.rest_corners.is_some() { Vec2::zeros() } else { self.mesh.rest[v as usize] }
    }

    /// Border vertices with an x from `low` to `high`.
    fn between(&self, low: f64, high: f64) -> &[u32] {
        let from = self.list.partition_point(|v| self.at[*v as usize].x < low);
        let to = self.list.partition_point(|v| self.at[*v as usize].x <= high);
        &self.list[from..to.max(from)]
    }

    /// An error at these vertices, if there are any.
    fn finding(&self, code: Code, found: &[u32], what: &str, remedy: &str) -> Option<Diagnostic> {
        let first = *found.first()?;
        let (n, p) = (found.len(), self.at[first as usize] * 1e3);
        let message = format!(
            "`{}`: {n} vertices {what}; the first is vertex {first}, near ({:.0}, {:.0}, {:.0}) mm",
            self.file, p.x, p.y, p.z
        );
        Some(Diagnostic::error(code, message).at(SourceRef::file(self.file)).hint(remedy))
    }

    /// A border vertex in the middle of a border edge, at the start and at rest: the cloth would open there.
    pub fn junction(&self) -> Option<Diagnostic> {
        let found: Vec<u32> = self.edges.iter().filter_map(|e| self.on_edge(*e)).collect();
        let remedy = "split the triangle beside it at that vertex, so that both sides have it";
        self.finding(codes::MESH_T_JUNCTION, &found, "lie in the middle of a neighbour's edge", remedy)
    }

    fn on_edge(&self, [a, b]: [u32; 2]) -> Option<u32> {
        let (p, q) = (self.at[a as usize], self.at[b as usize]);
        let way = q - p;
        let length = way.norm();
        let off = ON * length;
        let near = self.between(p.x.min(q.x) - off, p.x.max(q.x) + off);
        let (r, s) = (self.rest(a), self.rest(b));
        near.iter().copied().find(|v| {
            let t = (self.at[*v as usize] - p).dot(&way) / (length * length);
            let away = (self.at[*v as usize] - p - way * t).norm();
            let at_rest = (self.rest(*v) - (r + (s - r) * t)).norm();
            *v != a && *v != b && t > ON && t < 1.0 - ON && away <= off && at_rest <= off
        })
    }

    /// Border vertices that stand twice at one place, at the start and at rest, and are not sewn.
    pub fn doubled(&self, stitches: &[(u32, u32)]) -> Option<Diagnostic> {
        let sewn: BTreeSet<u32> = stitches.iter().flat_map(|(a, b)| [*a, *b]).collect();
        let same = |v: u32, w: u32| {
            (self.at[v as usize] - self.at[w as usize]).norm() <= SAME && (self.rest(v) - self.rest(w)).norm() <= SAME
        };
        // The ends of a very short edge are no doubles.
        let joined = |v: u32, w: u32| self.edges.contains(&[v.min(w), v.max(w)]);
        let mut found = Vec::new();
        for (k, v) in self.list.iter().enumerate().filter(|(_, v)| !sewn.contains(v)) {
            let x = self.at[*v as usize].x;
            let near = self.list[k + 1..].iter().take_while(|w| self.at[**w as usize].x <= x + SAME);
            found.extend(near.copied().find(|w| same(*v, *w) && !joined(*v, *w)).map(|_| *v));
        }
        let what = "of the border stand twice at one place, and nothing sews them";
        let remedy = "join them in the mesh, name the pairs in with.stitches, or draw a slit open";
        self.finding(codes::VERTICES_DOUBLED, &found, what, remedy)
    }
}
