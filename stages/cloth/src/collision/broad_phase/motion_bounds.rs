//! How far tiles of the cloth have moved against each other since a search. What it found apart stays apart until two tiles
//! have used up between them what was left; cloth that moves along together uses up nothing.

use crate::Vec3;
use crate::collision::broad_phase::bvh::{Range, Tree, higher, join_up, lower, narrow};
use crate::collision::broad_phase::packed_lists::Lists;
use crate::collision::narrow_phase::candidates::Way;

const NONE: Range = [[1e30; 4], [-1e30; 4]];

/// Moves since the search, up to both ends of a step.
#[derive(Debug, Default)]
pub(crate) struct Drift {
    /// Where the cloth was then.
    at: Vec<Vec3>,
    /// Corners of the triangles of every tile.
    corners: Lists,
    /// Of every vertex, and of every node of the tree down to the tiles.
    vertices: Vec<Range>,
    pub nodes: Vec<Range>,
}

impl Drift {
    pub fn new(tree: &Tree, vertices: usize, faces: &[[u32; 3]]) -> Self {
        let corners = Lists::new(tree.tiles(), vertices, |tile, add| {
            tree.tile(tile as usize).flat_map(|f| faces[f as usize]).for_each(add);
        });
        Self { corners, nodes: vec![NONE; 2 * tree.tiles()], ..Self::default() }
    }

    /// A search was made from here.
    pub fn start(&mut self, x: &[Vec3]) {
        self.at.clear();
        self.at.extend_from_slice(x);
    }

    pub fn forget(&mut self) {
        self.at.clear();
    }

    /// Has there been a search?
    pub fn is_known(&self) -> bool {
        !self.at.is_empty()
    }

    /// Takes the moves up to the ends of a step.
    pub fn take(&mut self, way: &Way<'_>) {
        self.vertices.clear();
        self.vertices.extend(way.x.iter().zip(way.step).zip(&self.at).map(|((p, d), at)| {
            let by = p - at;
            range(&by, &(by + d))
        }));
        let tiles = self.nodes.len() / 2;
        for tile in (0..tiles).rev() {
            let corners = self.corners.of(u32::try_from(tile).unwrap_or(u32::MAX));
            self.nodes[tiles + tile] = corners.iter().fold(NONE, |all, v| join(&all, &self.vertices[*v as usize]));
        }
        join_up(&mut self.nodes, join);
    }
}

// What rounding does is allowed for where these are compared.
#[inline]
fn range(from: &Vec3, to: &Vec3) -> Range {
    let (p, q) = (narrow(from), narrow(to));
    join(&[p, p], &[q, q])
}

#[inline]
fn join(a: &Range, b: &Range) -> Range {
    let mut both = *a;
    for k in 0..4 {
        both[0][k] = lower(a[0][k], b[0][k]);
        both[1][k] = higher(a[1][k], b[1][k]);
    }
    both
}
