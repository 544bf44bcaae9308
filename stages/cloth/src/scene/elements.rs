//! Cloth triangles, and lists of them that scenes have in common.

use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// One triangle of cloth with its own rest shape (so sewn vertices may differ on both sides of a seam).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// Indices into [`crate::Scene::positions`].
    pub vertices: [u32; 3],
    /// Rest corners in the cloth's own axes: x along the weft, y along the warp, metres.
    pub rest: [[f64; 2]; 3],
    /// Index into [`crate::Scene::materials`].
    pub material: u32,
}

impl Element {
    /// Signed rest area, m².
    #[must_use]
    pub fn area(&self) -> f64 {
        let [a, b, c] = self.rest;
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    }

    /// Gradients of the three shape functions in the cloth's axes, 1/m.
    #[must_use]
    pub fn gradients(&self) -> [[f64; 2]; 3] {
        let double = 2.0 * self.area();
        [0, 1, 2].map(|k| {
            let (a, b) = (self.rest[(k + 1) % 3], self.rest[(k + 2) % 3]);
            [(a[1] - b[1]) / double, (b[0] - a[0]) / double]
        })
    }

    /// Rest length of edge `k` (from corner `k` to the next), m.
    #[must_use]
    pub fn rest_length(&self, k: usize) -> f64 {
        let (a, b) = (self.rest[k % 3], self.rest[(k + 1) % 3]);
        libm::hypot(b[0] - a[0], b[1] - a[1])
    }

    /// Rest angle at corner `k`, rad; below 0 where the triangle is turned over.
    pub(crate) fn rest_angle(&self, k: usize) -> f64 {
        let (a, b, c) = (self.rest[k], self.rest[(k + 1) % 3], self.rest[(k + 2) % 3]);
        let (p, q) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        libm::atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1])
    }

    /// The triangle with other numbers for its vertices.
    pub(crate) fn renumbered(&self, to: impl Fn(u32) -> u32) -> Self {
        Self { vertices: self.vertices.map(to), ..*self }
    }

    /// Longest of its rest lengths, m.
    pub(crate) fn longest_edge(&self) -> f64 {
        (0..3).map(|k| self.rest_length(k)).fold(0.0, f64::max)
    }

    /// Least altitude of the rest shape, m.
    pub(crate) fn altitude(&self) -> f64 {
        2.0 * self.area().abs() / self.longest_edge()
    }
}

/// Triangles that any number of scenes share, otherwise a plain list.
///
/// A clone copies nothing until one of them is changed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Elements(Arc<Vec<Element>>);

impl Deref for Elements {
    type Target = Vec<Element>;

    fn deref(&self) -> &Vec<Element> {
        &self.0
    }
}

impl DerefMut for Elements {
    fn deref_mut(&mut self) -> &mut Vec<Element> {
        Arc::make_mut(&mut self.0)
    }
}

impl From<Vec<Element>> for Elements {
    fn from(all: Vec<Element>) -> Self {
        Self(Arc::new(all))
    }
}

impl FromIterator<Element> for Elements {
    fn from_iter<I: IntoIterator<Item = Element>>(all: I) -> Self {
        Vec::from_iter(all).into()
    }
}

impl<'a> IntoIterator for &'a Elements {
    type Item = &'a Element;
    type IntoIter = std::slice::Iter<'a, Element>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
