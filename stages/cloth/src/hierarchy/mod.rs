//! Coarser levels of a scene, made from its own mesh: edges are collapsed in the cloth's plane, seams together, and every
//! vertex that went remembers where on the coarser cloth it lies (docs/hierarchy.md).

pub(crate) mod charts;
pub(crate) mod collapse;
pub(crate) mod perturb;
pub(crate) mod prolong;
pub(crate) mod soften;
#[cfg(test)]
pub(crate) mod tests;

use crate::scene::bending_length;
use crate::scene::measures::mean_edge;
use crate::{Element, Scene, Vec3};
use charts::Charts;
use collapse::Mesh;

/// Edge of a coarser level over that of the finer one.
const STEP: f64 = 2.0;
/// Longest mean edge of a level, m: above it folds come out wrong.
const LONGEST: f64 = 0.045;
/// Longest mean edge of a level that only hangs, over the bending length of its softest fabric: longer ones find folds
/// that the finer cloth has to leave again.
const BENDS: f64 = 1.3;
/// Fewest triangles of a level: few and large ones lock against bending, and what they lock into, the finer keep.
const FEWEST: usize = 600;
/// A level must have fewer than this share of the triangles to be worth the while.
const SHARE: f64 = 0.5;

/// A coarser scene and how the finer one hangs on it.
#[derive(Debug)]
pub(crate) struct Level {
    pub scene: Scene,
    /// For every vertex of the finer scene, where it lies: one entry, or one for each side of a seam it lies on.
    anchors: Vec<Vec<Anchor>>,
}

/// A place on a triangle of the coarser cloth.
#[derive(Clone, Copy, Debug)]
struct Anchor {
    vertices: [u32; 3],
    weights: [f64; 3],
}

impl Level {
    /// The next coarser level; `None` when the cloth is coarse enough, or too intricate to become coarser.
    pub fn below(scene: &Scene) -> Option<Self> {
        Self::up_to(scene, LONGEST)
    }

    /// The same, only as coarse as the cloth can bend under its weight, softer in its plane so that it can, and a little shaken.
    pub fn below_folds(scene: &Scene) -> Option<Self> {
        let mut level = Self::up_to(scene, longest_that_folds(scene))?;
        let longer = mean_edge(&level.scene) / mean_edge(scene);
        soften::soften(&mut level.scene, longer);
        perturb::shake(&mut level.scene);
        Some(level)
    }

    /// May there be such a level at all, before its mesh is tried?
    pub fn may_be_below_folds(scene: &Scene) -> bool {
        may_be(scene, longest_that_folds(scene))
    }

    fn up_to(scene: &Scene, longest: f64) -> Option<Self> {
        if !may_be(scene, longest) {
            return None;
        }
        let edge = STEP * mean_edge(scene);
        let charts = Charts::new(scene);
        let mut mesh = Mesh::new(scene, charts);
        mesh.collapse(edge);
        let level = Self::from(scene, &mesh);
        let small = (level.scene.triangles.len() as f64) < SHARE * scene.triangles.len() as f64;
        (small && level.scene.triangles.len() >= FEWEST).then_some(level)
    }

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

    /// Positions of the finer scene from those here.
    pub fn spread(&self, x: &[Vec3]) -> Vec<Vec3> {
        let place = |a: &Anchor| (0..3).map(|k| x[a.vertices[k] as usize] * a.weights[k]).sum::<Vec3>();
        self.anchors.iter().map(|all| all.iter().map(place).sum::<Vec3>() / all.len().max(1) as f64).collect()
    }
}

/// May there be a level with edges of at most this length, m?
fn may_be(scene: &Scene, longest: f64) -> bool {
    STEP * mean_edge(scene) <= longest && (scene.triangles.len() as f64) * 0.25 >= FEWEST as f64
}

/// Longest mean edge with which all fabrics fold as they should under their weight, m.
fn longest_that_folds(scene: &Scene) -> f64 {
    let gravity = scene.gravity.norm();
    let lengths = scene.materials.iter().map(|m| bending_length(m.bend_warp.min(m.bend_weft), m.areal_mass, gravity));
    lengths.fold(f64::INFINITY, f64::min).min(LONGEST / BENDS) * BENDS
}

fn coarse(fine: &Scene, mesh: &Mesh, number: &[u32], kept: &[u32]) -> Scene {
    let old = fine.triangles.iter().zip(&mesh.charts.places);
    let triangles = mesh.triangles.iter().zip(old).filter_map(|(corners, (old, places))| {
        corners.map(|c| {
            let at = c.map(|c| mesh.charts.rest[c as usize]);
            Element {
                vertices: c.map(|c| number[mesh.charts.vertex[c as usize] as usize]),
                rest: if mesh.charts.curved { prolong::laid(&at, places, old) } else { at.map(|p| [p.x, p.y]) },
                material: old.material,
            }
        })
    });
    fine.part(kept, number, triangles.collect())
}

fn anchors(mesh: &Mesh, number: &[u32]) -> Vec<Vec<Anchor>> {
    let mut anchors = vec![Vec::new(); number.len()];
    for (v, n) in number.iter().enumerate().filter(|(_, n)| **n != u32::MAX) {
        anchors[v].push(Anchor { vertices: [*n; 3], weights: [1.0, 0.0, 0.0] });
    }
    for (corners, carried) in mesh.triangles.iter().zip(&mesh.carried) {
        let Some(corners) = corners else { continue };
        let rest = corners.map(|c| mesh.charts.rest[c as usize]);
        let vertices = corners.map(|c| number[mesh.charts.vertex[c as usize] as usize]);
        for c in carried {
            let v = mesh.charts.vertex[*c as usize] as usize;
            if number[v] == u32::MAX {
                anchors[v].push(Anchor { vertices, weights: prolong::weights(&rest, &mesh.charts.rest[*c as usize]) });
            }
        }
    }
    anchors
}
