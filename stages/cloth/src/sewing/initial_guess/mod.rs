//! The initial guess of sewing: flat pieces are bent isometrically, on a cylinder, towards the places that their threads lead to.
//! The way there from a plane on each side of a body then takes a quarter of the steps (docs/sewing.md).

pub(crate) mod gaps;
pub(crate) mod piece;

use crate::optimize::descent::Descent;
use crate::scene::topology::components;
use crate::sewing::tuning::GUESS_STEPS;
use crate::{Element, Scene, Vec3};
use gaps::{BentPieces, End};
use piece::Piece;

/// Triangles of one piece, and its vertices.
#[derive(Default)]
struct Part<'a> {
    vertices: Vec<u32>,
    triangles: Vec<&'a Element>,
}

/// Every connected component, at the index of its first vertex; the parts at other indices are empty.
fn parts(scene: &Scene) -> Vec<Part<'_>> {
    let n = scene.positions.len();
    let part = components(n, scene.triangles.iter().map(|t| &t.vertices));
    let mut parts: Vec<Part<'_>> = (0..n).map(|_| Part::default()).collect();
    for (v, p) in (0u32..).zip(&part) {
        parts[*p as usize].vertices.push(v);
    }
    for t in scene.triangles.iter() {
        parts[part[t.vertices[0] as usize] as usize].triangles.push(t);
    }
    parts
}

/// Bends flat pieces towards the places that their threads lead to, as far as nothing is in the way and the threads gain more
/// than the bending costs.
pub(crate) fn bend_pieces(d: &mut Descent<'_>, scene: &Scene) {
    let Some(mut guess) = flat_pieces(d, scene) else { return };
    guess.close();
    let mut moving: Vec<usize> = (0..guess.pieces.len()).filter(|k| !guess.bends[*k].is_none()).collect();
    let steps = GUESS_STEPS.get();
    for step in 1..=steps {
        if moving.is_empty() {
            break;
        }
        let part = f64::from(step) / f64::from(steps);
        // The pieces go one by one where something is in the way of all of them together.
        if !bend_to(d, &guess, &moving, part) {
            moving.retain(|k| bend_to(d, &guess, &[*k], part));
        }
    }
}

/// The pieces that are flat and held nowhere, and all threads.
fn flat_pieces(d: &Descent<'_>, scene: &Scene) -> Option<BentPieces> {
    let threads = d.objective().terms.stitches.as_ref()?;
    let (mut pieces, mut on, mut held) = (Vec::new(), vec![None; d.x.len()], vec![false; d.x.len()]);
    d.objective().unknowns.pins.iter().for_each(|(v, _)| held[*v as usize] = true);
    for Part { vertices, triangles } in parts(scene) {
        if triangles.is_empty() || vertices.iter().any(|v| held[*v as usize]) {
            continue;
        }
        if let Some(piece) = Piece::new(vertices, triangles.into_iter(), &d.x) {
            piece.vertices.iter().for_each(|v| on[*v as usize] = Some(pieces.len()));
            pieces.push(piece);
        }
    }
    let end = |v: u32| {
        let at = d.x[v as usize];
        on[v as usize].map_or(End::Still(at), |k| End::On(k, at))
    };
    Some(BentPieces::new(pieces, threads.ends(end, End::Still)))
}

/// Bends these pieces to a part of their final bend, if nothing is in the way on the straight path and energy is gained.
fn bend_to(d: &mut Descent<'_>, guess: &BentPieces, these: &[usize], part: f64) -> bool {
    let mut to = d.x.clone();
    these.iter().for_each(|k| guess.pieces[*k].put(guess.bends[*k].part(part), &mut to));
    let whole: Vec<Vec3> = to.iter().zip(&d.x).map(|(p, q)| p - q).collect();
    let mut step = whole.clone();
    d.limit(&mut step);
    if step != whole {
        return false;
    }
    let (from, energy) = (std::mem::replace(&mut d.x, to), d.energy);
    d.evaluate();
    // This is false, too, where the energy is no number.
    let gains = d.energy < energy;
    if gains {
        let x = d.x.clone();
        d.detection().into_iter().for_each(|b| b.step_taken(&x));
    } else {
        d.x = from;
        d.evaluate();
    }
    gains
}

#[cfg(all(test, feature = "self-contact"))]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::collision::crossings::count;
    use crate::optimize::descent::Change;
    use crate::optimize::task::Task;
    use crate::optimize::test_sheets;
    use crate::{BodyMesh, Material, Pin, Settings};

    const SIDE: u32 = 12;
    const WIDE: f64 = 0.5;
    const APART: f64 = 0.4;
    /// Vertices of one sheet.
    const EACH: u32 = (SIDE + 1) * (SIDE + 1);

    /// Two flat squares above each other, sewn at both sides.
    fn two() -> Scene {
        let mut scene = Scene { materials: vec![Material::isotropic(0.15, 500.0, 0.0, 1e-5)], ..Scene::default() };
        for y in [0.5 * APART, -0.5 * APART] {
            test_sheets::add(&mut scene, SIDE, WIDE, y, |_, _| false);
        }
        let sides = (0..=SIDE).flat_map(|j| [0, SIDE].map(|i| j * (SIDE + 1) + i));
        scene.stitches = sides.map(|v| [v, v + EACH]).collect();
        scene
    }

    /// A box from `low` to `high`.
    fn block(low: Vec3, high: Vec3) -> BodyMesh {
        let corner = |k: usize| Vec3::from_fn(|axis, _| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        BodyMesh { positions: (0..8).map(corner).collect(), triangles }
    }

    /// The positions after the initial guess, and the root mean square of the gaps before and after it, m.
    fn bent_piece(scene: &Scene) -> (Vec<Vec3>, [f64; 2]) {
        let settings = Settings::sewing();
        let mut d = Descent::begin(scene, &settings, Task::Sew).unwrap();
        let gap = |x: &[Vec3]| {
            let all = scene.stitches.iter().map(|[a, b]| (x[*a as usize] - x[*b as usize]).norm_squared());
            (all.sum::<f64>() / scene.stitches.len() as f64).sqrt()
        };
        let before = gap(&d.x);
        d.change(|o, _| {
            let threads = o.terms.stitches.as_mut().unwrap();
            (threads.force, threads.reach) = (1.0, 0.01);
            Change::Energy
        });
        bend_pieces(&mut d, scene);
        let after = gap(&d.x);
        (d.x, [before, after])
    }

    fn crossings(scene: &Scene, x: &[Vec3]) -> usize {
        let faces: Vec<[u32; 3]> = scene.triangles.iter().map(|t| t.vertices).collect();
        let body = crate::collision::body::Body::of_scene(scene);
        count::self_crossings(x, &faces).count + body.map_or(0, |b| count::body_crossings(x, &faces, &b).count)
    }

    #[test]
    fn two_flat_pieces_come_together_round_what_is_between_them() {
        let mut scene = two();
        scene.body = Some(block(Vec3::new(-0.1, -0.1, -0.3), Vec3::new(0.1, 0.1, 0.3)).into());
        let (x, [before, after]) = bent_piece(&scene);
        assert!((before - APART).abs() < 1e-9 && after < 0.25 * before, "{before} {after}");
        assert_eq!(crossings(&scene, &x), 0);
        // One bends as the other does, and neither is drawn out.
        let (upper, lower) = x.split_at(EACH as usize);
        assert!(upper.iter().zip(lower).all(|(p, q)| (p.x - q.x).abs() < 0.02 && p.y > q.y));
        for t in scene.triangles.iter() {
            let [a, b, c] = crate::pick3(&x, &t.vertices);
            for (k, (p, q)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
                assert!(((p - q).norm() / t.rest_length(k) - 1.0).abs() < 0.01);
            }
        }
    }

    #[test]
    fn what_is_in_the_way_stops_them() {
        let free = bent_piece(&two()).1[1];
        let mut scene = two();
        // A wall beside the body, where one side of the pieces would come down.
        scene.body = Some(block(Vec3::new(0.15, -0.12, -0.3), Vec3::new(0.26, 0.12, 0.3)).into());
        let (x, [before, after]) = bent_piece(&scene);
        assert_eq!(crossings(&scene, &x), 0);
        assert!(after < before && after > 1.5 * free, "{before} {after} {free}");
    }

    #[test]
    fn what_is_held_or_lies_in_folds_stays_as_it_is() {
        let mut scene = two();
        scene.pins = [0, EACH].map(|v| Pin { vertex: v, at: scene.positions[v as usize] }).to_vec();
        assert_eq!(bent_piece(&scene).0, scene.positions);
        let mut scene = two();
        scene.positions.iter_mut().for_each(|p| p.y += 0.01 * libm::sin(20.0 * p.x));
        assert_eq!(bent_piece(&scene).0, scene.positions);
    }
}
