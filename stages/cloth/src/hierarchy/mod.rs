//! Multiresolution hierarchy: coarser levels of a scene, made from its own mesh (docs/hierarchy.md).
//!
//! Edges are collapsed in the plane of the cloth, the two sides of a seam together. Every vertex that went has a place
//! on the coarser cloth, from which it is moved.

pub(crate) mod charts;
pub(crate) mod collapse;
pub(crate) mod membrane_softening;
pub(crate) mod perturb;
pub(crate) mod prolong;
pub(crate) mod rest_places;
#[cfg(test)]
pub(crate) mod tests;
pub(crate) mod tuning;

use crate::scene::bending_length;
use crate::scene::measures::mean_edge;
use crate::{Element, Scene, Vec3};
use charts::Charts;
use collapse::Mesh;
use prolong::{Anchor, anchors};
use tuning::{
    LEVEL_EDGE_BENDING_LENGTHS, LEVEL_EDGE_MAX, LEVEL_EDGE_RATIO, LEVEL_TRIANGLE_SHARE_MAX, LEVEL_TRIANGLES_MIN,
};

/// Expected number of triangles of a level over that of the finer cloth: edges are about twice as long.
const EXPECTED_TRIANGLE_SHARE: f64 = 0.25;

/// A coarser scene, and the places of the finer vertices on it.
#[derive(Debug)]
pub(crate) struct Level {
    pub scene: Scene,
    /// Places of every vertex of the finer scene: one, or one for each side of a seam.
    anchors: Vec<Vec<Anchor>>,
}

impl Level {
    /// The next coarser level; `None` when the cloth is coarse enough, or too intricate to become coarser.
    pub fn below(scene: &Scene) -> Option<Self> {
        Self::up_to(scene, LEVEL_EDGE_MAX.get())
    }

    /// The next coarser level for a drape; `None` as for [`Self::below`].
    ///
    /// It is only as coarse as the cloth can bend under its weight, softer in its plane, and a little perturbed.
    pub fn below_folds(scene: &Scene) -> Option<Self> {
        let mut level = Self::up_to(scene, longest_that_folds(scene))?;
        let longer = mean_edge(&level.scene) / mean_edge(scene);
        membrane_softening::soften_membrane(&mut level.scene, longer);
        perturb::perturb(&mut level.scene);
        Some(level)
    }

    /// Positions of the finer scene from those of the level, m.
    pub fn spread(&self, x: &[Vec3]) -> Vec<Vec3> {
        prolong::prolong(&self.anchors, x)
    }

    /// Returns `true` if there may be a level for a drape, before its mesh is tried.
    pub fn may_be_below_folds(scene: &Scene) -> bool {
        may_be(scene, longest_that_folds(scene))
    }

    /// The next coarser level with a mean edge of at most `longest`, m.
    fn up_to(scene: &Scene, longest: f64) -> Option<Self> {
        if !may_be(scene, longest) {
            return None;
        }
        let edge = LEVEL_EDGE_RATIO.get() * mean_edge(scene);
        let charts = Charts::new(scene);
        let mut mesh = Mesh::new(scene, charts);
        mesh.collapse(edge);
        let level = Self::from(scene, &mesh);
        let small =
            (level.scene.triangles.len() as f64) < LEVEL_TRIANGLE_SHARE_MAX.get() * scene.triangles.len() as f64;
        (small && level.scene.triangles.len() >= LEVEL_TRIANGLES_MIN.get()).then_some(level)
    }

    /// The level of a collapsed mesh.
    fn from(scene: &Scene, mesh: &Mesh) -> Self {
        let mut number = vec![u32::MAX; scene.positions.len()];
        let mut kept = Vec::new();
        for corners in mesh.triangles.iter().flatten() {
            for c in corners {
                number[mesh.charts.vertex[*c as usize] as usize] = 0;
            }
        }
        for (v, n) in (0u32..).zip(&mut number).filter(|(_, n)| **n == 0) {
            *n = u32::try_from(kept.len()).unwrap_or(u32::MAX);
            kept.push(v);
        }
        let scene = coarse(scene, mesh, &number, &kept);
        let anchors = anchors(mesh, &number);
        Self { scene, anchors }
    }
}

/// Returns `true` if there may be a level with a mean edge of at most `longest`, m.
fn may_be(scene: &Scene, longest: f64) -> bool {
    LEVEL_EDGE_RATIO.get() * mean_edge(scene) <= longest
        && (scene.triangles.len() as f64) * EXPECTED_TRIANGLE_SHARE >= LEVEL_TRIANGLES_MIN.get() as f64
}

/// Longest mean edge with which all fabrics still fold rightly under their weight, m.
fn longest_that_folds(scene: &Scene) -> f64 {
    let gravity = scene.gravity.norm();
    let lengths = scene.materials.iter().map(|m| bending_length(m.bending.softer(), m.areal_mass, gravity));
    lengths.fold(f64::INFINITY, f64::min).min(LEVEL_EDGE_MAX.get() / LEVEL_EDGE_BENDING_LENGTHS.get())
        * LEVEL_EDGE_BENDING_LENGTHS.get()
}

/// The scene of a collapsed mesh; `number` gives the new numbers of the vertices `kept`.
fn coarse(fine: &Scene, mesh: &Mesh, number: &[u32], kept: &[u32]) -> Scene {
    let old = fine.triangles.iter().zip(&mesh.charts.places);
    let triangles = mesh.triangles.iter().zip(old).filter_map(|(corners, (old, places))| {
        corners.map(|c| {
            let at = c.map(|c| mesh.charts.rest[c as usize]);
            Element {
                vertices: c.map(|c| number[mesh.charts.vertex[c as usize] as usize]),
                rest: if mesh.charts.curved {
                    rest_places::in_cloth_axes(&at, places, old)
                } else {
                    at.map(|p| [p.x, p.y])
                },
                material: old.material,
            }
        })
    });
    fine.part(kept, number, triangles.collect())
}
