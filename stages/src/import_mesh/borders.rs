//! What is wrong along the borders of an imported mesh: corners in the middle of a neighbour's edge, vertices that
//! stand twice. Both tear cloth that looks whole.

use std::collections::{BTreeMap, BTreeSet};
use toile_garment::mesh::PieceMesh;
use toile_garment::{Diagnostic, SourceRef, Vec2, Vec3};

/// Nearer to an edge than this share of its length is on it.
const ON: f64 = 1e-6;
/// Nearer than this is the same place, metres.
const SAME: f64 = 1e-7;

/// Places of a mesh at the start and at rest.
pub struct Borders<'a> {
    pub mesh: &'a PieceMesh,
    pub at: &'a [Vec3],
    pub file: &'a str,
}

impl Borders<'_> {
    /// Edges of one triangle, each once.
    fn edges(&self) -> Vec<[u32; 2]> {
        let mut users: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for t in &self.mesh.triangles {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                *users.entry([a.min(b), a.max(b)]).or_insert(0) += 1;
            }
        }
        users.into_iter().filter(|(_, n)| *n == 1).map(|(e, _)| e).collect()
    }

    /// Rest place of a vertex, where there is one for all its triangles.
    fn rest(&self, v: u32) -> Vec2 {
        if self.mesh.rest_corners.is_some() { Vec2::zeros() } else { self.mesh.rest[v as usize] }
    }

    /// Border vertices by their x at the start.
    fn sorted(&self, edges: &[[u32; 2]]) -> Vec<u32> {
        let used: BTreeSet<u32> = edges.iter().flatten().copied().collect();
        let mut list: Vec<u32> = used.into_iter().collect();
        list.sort_by(|a, b| self.at[*a as usize].x.total_cmp(&self.at[*b as usize].x));
        list
    }

    fn between(&self, list: &[u32], low: f64, high: f64) -> std::ops::Range<usize> {
        let from = list.partition_point(|v| self.at[*v as usize].x < low);
        let to = list.partition_point(|v| self.at[*v as usize].x <= high);
        from..to.max(from)
    }

    fn place(&self, v: u32) -> String {
        let p = self.at[v as usize] * 1e3;
        format!("vertex {v}, near ({:.0}, {:.0}, {:.0}) mm", p.x, p.y, p.z)
    }

    /// A border vertex in the middle of a border edge, at the start and at rest: the cloth would open there.
    pub fn junction(&self) -> Option<Diagnostic> {
        let edges = self.edges();
        let list = self.sorted(&edges);
        let found: Vec<u32> = edges.iter().filter_map(|e| self.on_edge(*e, &list)).collect();
        let first = found.first()?;
        let message = format!(
            "`{}`: {} vertices lie in the middle of a neighbour's edge; the first is {}",
            self.file,
            found.len(),
            self.place(*first)
        );
        let finding = Diagnostic::error("mesh-t-junction", message).at(SourceRef::file(self.file));
        Some(finding.hint("split the triangle beside it at that vertex, so that both sides have it"))
    }

    fn on_edge(&self, [a, b]: [u32; 2], list: &[u32]) -> Option<u32> {
        let (p, q) = (self.at[a as usize], self.at[b as usize]);
        let way = q - p;
        let length = way.norm();
        let off = ON * length;
        let near = self.between(list, p.x.min(q.x) - off, p.x.max(q.x) + off);
        let (r, s) = (self.rest(a), self.rest(b));
        list[near].iter().copied().find(|v| {
            let t = (self.at[*v as usize] - p).dot(&way) / (length * length);
            let away = (self.at[*v as usize] - p - way * t).norm();
            let at_rest = (self.rest(*v) - (r + (s - r) * t)).norm();
            *v != a && *v != b && t > ON && t < 1.0 - ON && away <= off && at_rest <= off
        })
    }

    /// Border vertices that stand twice at one place, at the start and at rest, and are not sewn.
    pub fn doubled(&self, stitches: &[(u32, u32)]) -> Option<Diagnostic> {
        let sewn: BTreeSet<u32> = stitches.iter().flat_map(|(a, b)| [*a, *b]).collect();
        let edges = self.edges();
        let list = self.sorted(&edges);
        // The ends of a very short edge are no doubles.
        let joined: BTreeSet<[u32; 2]> = edges.into_iter().collect();
        let same = |v: u32, w: u32| {
            (self.at[v as usize] - self.at[w as usize]).norm() <= SAME && (self.rest(v) - self.rest(w)).norm() <= SAME
        };
        let mut found = Vec::new();
        for (k, v) in list.iter().enumerate().filter(|(_, v)| !sewn.contains(v)) {
            let x = self.at[*v as usize].x;
            let near = list[k + 1..].iter().take_while(|w| self.at[**w as usize].x <= x + SAME);
            found.extend(near.copied().find(|w| same(*v, *w) && !joined.contains(&[*v.min(w), *v.max(w)])).map(|_| *v));
        }
        let first = found.first()?;
        let message = format!(
            "`{}`: {} vertices of the border stand twice at one place, and nothing sews them; the first is {}",
            self.file,
            found.len(),
            self.place(*first)
        );
        let finding = Diagnostic::error("vertices-doubled", message).at(SourceRef::file(self.file));
        Some(finding.hint("join them in the mesh, name the pairs in with.stitches, or draw a slit open"))
    }
}
