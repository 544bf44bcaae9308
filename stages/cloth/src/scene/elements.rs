//! Cloth triangles that scenes have in common.

use crate::Element;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

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
