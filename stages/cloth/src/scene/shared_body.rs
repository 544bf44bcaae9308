//! The body that the cloth meets, and its trees that scenes have in common.

use crate::Vec3;
use std::any::Any;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

/// The body that the cloth meets: a triangle mesh at rest.
///
/// The orientation of its triangles does not matter. Closed meshes have an inside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyMesh {
    /// Positions of the vertices, m.
    pub positions: Vec<Vec3>,
    /// Triangles.
    pub triangles: Vec<[u32; 3]>,
}

/// A body that any number of scenes share. A clone copies nothing.
///
/// The trees over its triangles are built once, by the first solver that needs them. They take half a second for a body
/// of a million triangles.
#[derive(Clone, Default)]
pub struct SharedBody(Arc<Shared>);

#[derive(Default)]
struct Shared {
    mesh: BodyMesh,
    /// Data that a solver has prepared from the mesh.
    prepared: OnceLock<Box<dyn Any + Send + Sync>>,
    /// The body after 0 to 3 quarter turns about the vertical.
    turned: [OnceLock<SharedBody>; 4],
}

impl SharedBody {
    /// A copy of the data that `make` prepares from the mesh.
    ///
    /// It is made by the first caller and kept for all others, who must want the same type.
    pub(crate) fn prepared<T: Any + Clone + Send + Sync>(&self, make: impl Fn(&BodyMesh) -> T) -> T {
        let kept = self.0.prepared.get_or_init(|| Box::new(make(&self.0.mesh)));
        kept.downcast_ref().map_or_else(|| make(&self.0.mesh), T::clone)
    }

    /// The body after some quarter turns about the vertical, where `to` turns places; itself where that changes
    /// nothing.
    pub(crate) fn turned(&self, quarters: u8, to: impl Fn(&Vec3) -> Vec3) -> Self {
        let same = |p: &Vec3| to(p).iter().zip(p.iter()).all(|(a, b)| a.to_bits() == b.to_bits());
        if self.positions.iter().all(same) {
            return self.clone();
        }
        let turn =
            || BodyMesh { positions: self.positions.iter().map(&to).collect(), triangles: self.triangles.clone() };
        self.0.turned[usize::from(quarters % 4)].get_or_init(|| turn().into()).clone()
    }
}

impl From<BodyMesh> for SharedBody {
    fn from(mesh: BodyMesh) -> Self {
        Self(Arc::new(Shared { mesh, ..Shared::default() }))
    }
}

impl Deref for SharedBody {
    type Target = BodyMesh;

    fn deref(&self) -> &BodyMesh {
        &self.0.mesh
    }
}

impl PartialEq for SharedBody {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || **self == **other
    }
}

impl std::fmt::Debug for SharedBody {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.deref().fmt(f)
    }
}
