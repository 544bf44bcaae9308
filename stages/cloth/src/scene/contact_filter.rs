//! Contact filter: parts of the body that some vertices of the cloth do not meet.
//!
//! A skirt that is sewn around the legs does not meet the hands that hang beside it. The book's page on starts says when.

use std::sync::Arc;

/// Parts of the body, and the parts that each vertex of the cloth ignores. A part is one bit, so there are up to 32.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ContactFilter {
    /// Parts that each triangle of the body belongs to, as bits. Cloth ignores a triangle if it ignores all its parts.
    pub body_parts: Arc<Vec<u32>>,
    /// Parts that each vertex of the cloth ignores, as bits. Empty where all cloth meets all of the body.
    pub ignored: Vec<u32>,
}

impl ContactFilter {
    /// Returns `true` if some vertex ignores some part.
    #[must_use]
    pub fn ignores_any(&self) -> bool {
        self.ignored.iter().any(|i| *i != 0)
    }

    /// The filter of the vertices `kept` alone.
    pub(crate) fn part(&self, kept: &[u32]) -> Self {
        let ignored = kept.iter().filter_map(|v| self.ignored.get(*v as usize).copied()).collect();
        Self { body_parts: self.body_parts.clone(), ignored }
    }

    /// The filter of `count` joined vertices, where `map` gives the new number of each vertex. A joined vertex ignores what
    /// all its members ignore.
    pub(crate) fn joined(&self, map: &[u32], count: usize) -> Self {
        if self.ignored.is_empty() {
            return self.clone();
        }
        let mut ignored = vec![u32::MAX; count];
        for (to, mine) in map.iter().zip(&self.ignored) {
            ignored[*to as usize] &= mine;
        }
        Self { body_parts: self.body_parts.clone(), ignored }
    }
}

/// The parts of one body that are met by the vertices and triangles of one cloth.
#[derive(Clone, Debug, Default)]
pub(crate) struct MetParts {
    /// Parts of each triangle of the body, as bits.
    body: Arc<Vec<u32>>,
    /// Parts that each vertex ignores.
    given: Arc<Vec<u32>>,
    /// Parts that all triangles around each vertex ignore.
    around: Arc<Vec<u32>>,
}

impl MetParts {
    /// Prepares a filter for cloth triangles. `kept` are the triangles of the body that are in use, in their order.
    pub fn new(
        filter: &ContactFilter,
        faces: impl Iterator<Item = [u32; 3]>,
        kept: impl Iterator<Item = usize>,
    ) -> Self {
        if !filter.ignores_any() {
            return Self::default();
        }
        let body = kept.map(|g| filter.body_parts.get(g).copied().unwrap_or(u32::MAX)).collect();
        let mut around = filter.ignored.clone();
        for t in faces {
            let all = ignored_by_all(&filter.ignored, &t);
            t.iter().for_each(|v| around[*v as usize] &= all);
        }
        Self { body: Arc::new(body), given: Arc::new(filter.ignored.clone()), around: Arc::new(around) }
    }

    /// Parts that a triangle of the cloth ignores: those that all its corners ignore.
    pub fn ignored_by_face(&self, corners: &[u32; 3]) -> u32 {
        if self.given.is_empty() { 0 } else { ignored_by_all(&self.given, corners) }
    }

    /// Parts that a vertex or an edge of the cloth ignores: those that all triangles around it ignore.
    pub fn ignored_by<const N: usize>(&self, vertices: [u32; N]) -> u32 {
        if self.around.is_empty() { 0 } else { ignored_by_all(&self.around, &vertices) }
    }

    /// Parts that a piece of cloth ignores, by one of its vertices.
    pub fn ignored_by_piece(&self, vertex: usize) -> u32 {
        self.given.get(vertex).copied().unwrap_or(0)
    }

    /// Parts that triangle `g` of the body belongs to.
    pub fn parts_of(&self, g: u32) -> u32 {
        self.body[g as usize]
    }

    /// Is triangle `g` of the body met by cloth that ignores these parts?
    #[inline]
    pub fn is_met(&self, g: u32, ignored: u32) -> bool {
        ignored == 0 || self.body[g as usize] & !ignored != 0
    }
}

fn ignored_by_all(ignored: &[u32], vertices: &[u32]) -> u32 {
    vertices.iter().fold(u32::MAX, |all, v| all & ignored[*v as usize])
}
