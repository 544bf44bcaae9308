//! A part of a mesh around one triangle, as a small mesh of its own.

use super::cdt::{Spade, Triangulator};
use super::crossing::Segment;
use super::region::left_of;
use super::regular::{FillError, Filled, missing};
use super::smooth::Fans;
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::Vec2;

/// Rings of triangles around the middle one.
const RINGS: usize = 3;

/// A part of a mesh. Its vertices are numbered anew; those that stay come first.
pub struct Patch {
    /// The triangles of the whole mesh that it takes, by their number.
    pub taken: Vec<u32>,
    /// The vertices of the whole mesh that they are.
    pub vertices: Vec<u32>,
    /// How many of them stay: those on drawn lines and on the rim of the patch.
    pub fixed: usize,
    /// Positions and triangles.
    pub mesh: Filled,
    /// Sides without a neighbour, the patch on their left.
    rim: Vec<[u32; 2]>,
    /// Edges that are kept: drawn lines and the rim.
    kept: Vec<[u32; 2]>,
    /// Those of them that are drawn lines.
    drawn: Vec<[u32; 2]>,
}

impl Patch {
    /// Takes the triangles around one. `edges` are the drawn ones of the whole mesh, lower vertex first, in order.
    /// Vertices of the whole mesh below `fixed` lie on them.
    pub fn around(mesh: &Filled, fans: &Fans, edges: &[[u32; 2]], fixed: usize, middle: u32) -> Self {
        let taken = rings(&mesh.1, fans, middle);
        let sides = taken.iter().flat_map(|t| sides(mesh.1[*t as usize]));
        let all: BTreeSet<[u32; 2]> = sides.clone().collect();
        let rim: Vec<[u32; 2]> = all.iter().filter(|[a, b]| !all.contains(&[*b, *a])).copied().collect();
        let drawn: BTreeSet<[u32; 2]> =
            all.iter().map(|[a, b]| [*a.min(b), *a.max(b)]).filter(|e| edges.binary_search(e).is_ok()).collect();
        let on_rim: BTreeSet<u32> = rim.iter().flatten().copied().collect();
        let stays = |v: &u32| (*v as usize) < fixed || on_rim.contains(v);
        let used: BTreeSet<u32> = all.iter().flatten().copied().collect();
        let (mut vertices, free): (Vec<u32>, Vec<u32>) = used.into_iter().partition(stays);
        let fixed = vertices.len();
        vertices.extend(free);
        let number: BTreeMap<u32, u32> = vertices.iter().copied().zip(0..).collect();
        let local = |list: Vec<[u32; 2]>| -> Vec<[u32; 2]> { list.iter().map(|e| e.map(|v| number[&v])).collect() };
        let triangles = taken.iter().map(|t| mesh.1[*t as usize].map(|v| number[&v])).collect();
        let points = vertices.iter().map(|v| mesh.0[*v as usize]).collect();
        let undirected = rim.iter().map(|[a, b]| [*a.min(b), *a.max(b)]);
        let kept: BTreeSet<[u32; 2]> = undirected.chain(drawn.iter().copied()).collect();
        Self {
            taken,
            fixed,
            mesh: (points, triangles),
            rim: local(rim),
            kept: local(kept.into_iter().collect()),
            drawn: local(drawn.into_iter().collect()),
            vertices,
        }
    }

    /// The triangles of other inner points between the same lines and within the same rim.
    ///
    /// # Errors
    /// When points coincide, or lie on an edge that is kept.
    pub fn triangulate(&self, points: &[Vec2]) -> Result<Vec<[u32; 3]>, FillError> {
        let hull = Spade.triangulate(points, &self.kept)?;
        let missing = missing(&hull, &self.kept);
        if missing.is_empty() { Ok(left_of(&hull, &self.rim)) } else { Err(FillError::Conflicts(missing)) }
    }

    /// The drawn lines in the patch.
    pub fn drawn(&self) -> impl Iterator<Item = Segment> + '_ {
        let point = |v: u32| self.mesh.0[v as usize];
        self.drawn.iter().enumerate().map(move |(index, [a, b])| Segment {
            a: point(*a),
            b: point(*b),
            curve: 0,
            index,
        })
    }
}

/// The triangles that are reached over so many vertices, in order.
fn rings(triangles: &[[u32; 3]], fans: &Fans, middle: u32) -> Vec<u32> {
    let mut taken = BTreeSet::from([middle]);
    for _ in 0..RINGS {
        let vertices: BTreeSet<u32> = taken.iter().flat_map(|t| triangles[*t as usize]).collect();
        taken.extend(vertices.into_iter().flat_map(|v| fans.at(v as usize).iter().copied()));
    }
    taken.into_iter().collect()
}

fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}
