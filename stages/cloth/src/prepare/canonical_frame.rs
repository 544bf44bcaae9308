//! Canonical frame of a scene. Quarter turns about the vertical and the order of stitches change no bit of a result.
//!
//! The scene is turned and its stitches are sorted before it is solved, and the result is turned back. Quarter turns
//! and sorting are exact.

use crate::prepare::tuning::CANONICAL_FRAME;
use crate::{ClothError, Outcome, Pin, Place, Scene, Vec3};

/// A scene in its canonical form, and the way back.
pub(crate) struct CanonicalScene {
    pub scene: Scene,
    /// Quarter turns from the given scene.
    turns: u8,
    /// Index of every stitch in the scene as it was given.
    stitches: Vec<u32>,
}

/// A place after a quarter turn about the vertical (y). The difference turns −0 into 0.
fn quarter(p: Vec3) -> Vec3 {
    Vec3::new(p.z, p.y, 0.0 - p.x)
}

fn turned(p: Vec3, quarters: u8) -> Vec3 {
    (0..quarters % 4).fold(p, |p, _| quarter(p))
}

/// Quarter turns after which the cloth lies along x, from its first corner towards the first corner that is not near.
fn facing(scene: &Scene) -> u8 {
    let mut corners = scene.triangles.iter().flat_map(|t| t.vertices).filter_map(|v| scene.positions.get(v as usize));
    let Some(first) = corners.clone().next() else { return 0 };
    let far = |p: &Vec3| (p.x - first.x) * (p.x - first.x) + (p.z - first.z) * (p.z - first.z);
    let most = corners.clone().map(far).fold(0.0, f64::max);
    let Some(way) = corners.find(|p| most > 0.0 && 4.0 * far(p) >= most).map(|p| p - first) else { return 0 };
    let along = |k: &u8| {
        let p = turned(way, *k);
        -p.x < p.z && p.z <= p.x
    };
    (0..4).find(along).unwrap_or(0)
}

/// Stitches from their lower to their higher vertex, ascending, and the former index of each.
fn sorted(stitches: &[[u32; 2]]) -> (Vec<[u32; 2]>, Vec<u32>) {
    let mut all: Vec<([u32; 2], u32)> = stitches.iter().map(|[a, b]| [*a.min(b), *a.max(b)]).zip(0..).collect();
    all.sort_unstable();
    all.into_iter().unzip()
}

impl CanonicalScene {
    /// The canonical form of a scene.
    pub fn of(scene: &Scene) -> Self {
        let turns = if CANONICAL_FRAME.is_on() { facing(scene) } else { 0 };
        let to = |p: Vec3| turned(p, turns) + Vec3::zeros();
        let all = |x: &[Vec3]| x.iter().map(|p| to(*p)).collect();
        let (ordered, stitches) = sorted(&scene.stitches);
        let body = scene.body.as_ref();
        let scene = Scene {
            positions: all(&scene.positions),
            triangles: scene.triangles.clone(),
            materials: scene.materials.clone(),
            pins: scene.pins.iter().map(|p| Pin { at: to(p.at), ..*p }).collect(),
            loads: scene.loads.iter().map(|l| crate::Load { force: to(l.force), ..*l }).collect(),
            stitches: ordered,
            body: body.map(|b| b.turned(turns, |p| to(*p))),
            gravity: to(scene.gravity),
            layers: scene.layers.clone(),
            contact_filter: scene.contact_filter.clone(),
            bands: scene.bands.clone(),
            folds: scene.folds.clone(),
        };
        Self { scene, turns, stitches }
    }

    /// The outcome for the scene as it was given.
    pub fn back(&self, result: Result<Outcome, ClothError>) -> Result<Outcome, ClothError> {
        let mut outcome = result.map_err(|e| e.placed(|p| Place { at: self.there(p.at), ..p }))?;
        outcome.positions = self.given(&outcome.positions);
        outcome.reactions.iter_mut().for_each(|r| r.force = self.there(r.force));
        for (stitch, _) in &mut outcome.open_stitches {
            *stitch = self.stitches.get(*stitch as usize).map_or(*stitch, |s| *s);
        }
        Ok(outcome)
    }

    /// Places as the scene was given.
    pub fn given(&self, x: &[Vec3]) -> Vec<Vec3> {
        x.iter().map(|p| self.there(*p)).collect()
    }

    /// Places of the scene as it was given, in the canonical form.
    pub fn told(&self, x: &[Vec3]) -> Vec<Vec3> {
        x.iter().map(|p| turned(*p, self.turns) + Vec3::zeros()).collect()
    }

    /// A vector in the frame of the scene as it was given.
    pub fn there(&self, p: Vec3) -> Vec3 {
        turned(p, 4 - self.turns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BodyMesh;

    fn scene() -> Scene {
        let at = |k: f64| Vec3::new(0.3 * k, -0.1 * k * k, 0.7 - 0.2 * k);
        Scene {
            positions: (0..5).map(|k| at(f64::from(k))).collect(),
            triangles: vec![crate::Element { vertices: [0, 2, 4], rest: [[0.0; 2]; 3], material: 0 }].into(),
            pins: vec![Pin { vertex: 1, at: at(1.5) }],
            stitches: vec![[4, 2], [0, 3], [1, 4]],
            body: Some(BodyMesh { positions: vec![at(9.0)], triangles: Vec::new() }.into()),
            gravity: Vec3::new(0.5, -9.81, 0.25),
            ..Scene::default()
        }
    }

    fn turn(s: &Scene, quarters: u8) -> Scene {
        let all = |x: &[Vec3]| x.iter().map(|p| turned(*p, quarters)).collect();
        Scene {
            positions: all(&s.positions),
            pins: s.pins.iter().map(|p| Pin { at: turned(p.at, quarters), ..*p }).collect(),
            body: s.body.as_ref().map(|b| BodyMesh { positions: all(&b.positions), ..BodyMesh::default() }.into()),
            gravity: turned(s.gravity, quarters),
            ..s.clone()
        }
    }

    #[test]
    fn a_turned_scene_is_the_same_scene() {
        for k in 0..4 {
            let canonical = CanonicalScene::of(&turn(&scene(), k));
            assert_eq!(canonical.scene, CanonicalScene::of(&scene()).scene, "{k} quarters");
            let back: Vec<Vec3> = canonical.scene.positions.iter().map(|p| canonical.there(*p)).collect();
            assert_eq!(back, turn(&scene(), k).positions);
        }
    }

    #[test]
    fn stitches_in_any_order_are_the_same_and_keep_their_names() {
        let other = Scene { stitches: vec![[1, 4], [2, 4], [3, 0]], ..scene() };
        let (a, b) = (CanonicalScene::of(&scene()), CanonicalScene::of(&other));
        assert_eq!((a.scene, a.stitches), (b.scene, vec![1, 2, 0]));
        assert_eq!(b.stitches, [2, 0, 1]);
    }
}
