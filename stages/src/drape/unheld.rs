//! Pieces that nothing holds: their weight is borne, so that they stay about where they were sewn, and the rest of the
//! garment comes to rest without them.

use super::UNHELD;
use crate::solve::Layout;
use std::collections::BTreeMap;
use toile_cloth::{ClothError, Element, Outcome, Pin, Scene, Settings, StopReason, Vec3, Watch};
use toile_garment::{Diagnostic, Garment, MeshVertex, Piece};

/// Cloth that moved by a larger share of the longest way fell.
const FALLEN: f64 = 0.5;

/// Drapes the cloth of a scene. The weight of parts that fall is borne, and all is draped again. Says for every vertex
/// whether its weight is borne. Where all falls, the places are those of the start, and the reason of the stop tells it.
///
/// # Errors
/// As [`toile_cloth::drape`].
pub fn drape(
    scene: &mut Scene,
    settings: &Settings,
    watch: &mut dyn Watch,
) -> Result<(Outcome, Vec<bool>), ClothError> {
    let part = scene.parts();
    let mut held = vec![false; part.len()];
    loop {
        let outcome = toile_cloth::drape(scene, settings, watch)?;
        if outcome.stop_reason != StopReason::Unheld {
            return Ok((outcome, held));
        }
        let fallen = fallen(&part, &scene.positions, &outcome.positions);
        let is_new = |v: usize| fallen.contains(&part[v]) && !held[v];
        let new: Vec<u32> = (0..part.len()).filter(|v| is_new(*v)).map(|v| v as u32).collect();
        let is_all = (0..part.len()).all(|v| held[v] || is_new(v));
        if new.is_empty() || is_all {
            // All of it falls. It is of more use where it was sewn.
            return Ok((Outcome { positions: scene.positions.clone(), ..outcome }, held));
        }
        scene.bear_weight(&new);
        fallen.iter().for_each(|number| pin_triangle(scene, &part, *number));
        new.iter().for_each(|v| held[*v as usize] = true);
    }
}

/// Pins a triangle of a part, so that the part stays. Without weight the rest of it stays beside.
fn pin_triangle(scene: &mut Scene, part: &[u32], number: u32) {
    let in_part = |e: &&Element| part[e.vertices[0] as usize] == number;
    let Some(corners) = scene.triangles.iter().find(in_part).map(|e| e.vertices) else { return };
    let pin = |v: u32| Pin { vertex: v, at: scene.positions[v as usize] };
    scene.pins.extend(corners.map(pin));
}

/// The parts of the cloth that fell, by their numbers.
fn fallen(part: &[u32], start: &[Vec3], end: &[Vec3]) -> Vec<u32> {
    let mut ways: BTreeMap<u32, (f64, f64)> = BTreeMap::new();
    for ((part, from), to) in part.iter().zip(start).zip(end) {
        let way = ways.entry(*part).or_default();
        *way = (way.0 + (to - from).norm(), way.1 + 1.0);
    }
    let mean = |(sum, count): (f64, f64)| sum / count;
    let longest = ways.values().map(|way| mean(*way)).fold(0.0, f64::max);
    ways.into_iter().filter(|(_, way)| mean(*way) > FALLEN * longest).map(|(part, _)| part).collect()
}

/// The names of the pieces that are held. `map` tells where each vertex of the garment went in the scene.
pub fn names(garment: &Garment, layout: &Layout, map: &[u32], held: &[bool]) -> Vec<String> {
    let is_held = |piece: &&Piece| {
        let first = layout.index(MeshVertex { piece: piece.id, vertex: 0 });
        piece.mesh.is_some() && map.get(first as usize).is_some_and(|v| held[*v as usize])
    };
    garment.pieces.iter().filter(is_held).map(|piece| piece.name.clone()).collect()
}

/// A finding on the pieces that nothing holds.
pub fn finding(unheld: &[String]) -> Option<Diagnostic> {
    let message = format!("nothing holds `{}`: the drape left it where it was sewn", unheld.join("`, `"));
    let hint =
        "sew it to the garment, correct a seam of it that is open, or leave it out of the sewing file (leave_out)";
    (!unheld.is_empty()).then(|| Diagnostic::warning(UNHELD, message).hint(hint))
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_cloth::{Elements, Material, Silent};

    /// A strip of `n` squares of 50 mm along x, its first corner at `origin`.
    fn strip(scene: &mut Scene, origin: Vec3, n: u32) {
        let first = scene.positions.len() as u32;
        let at = |i: u32, k: u32| [0.05 * f64::from(i), 0.05 * f64::from(k)];
        for i in 0..=n {
            scene.positions.extend([0, 1].map(|k| origin + Vec3::new(at(i, k)[0], 0.0, at(i, k)[1])));
        }
        let corner = |i: u32, k: u32| (first + 2 * i + k, at(i, k));
        for i in 0..n {
            for three in [[(i, 0), (i + 1, 0), (i + 1, 1)], [(i, 0), (i + 1, 1), (i, 1)]] {
                let corners = three.map(|(i, k)| corner(i, k));
                let element = Element { vertices: corners.map(|c| c.0), rest: corners.map(|c| c.1), material: 0 };
                scene.triangles.push(element);
            }
        }
    }

    #[test]
    fn loose_cloth_stays_where_it_was_sewn_and_the_rest_hangs() {
        let mut scene = Scene {
            triangles: Elements::default(),
            materials: vec![Material::isotropic(0.12, 3000.0, 0.3, 1e-5)],
            gravity: Vec3::new(0.0, -9.81, 0.0),
            ..Scene::default()
        };
        strip(&mut scene, Vec3::zeros(), 6);
        strip(&mut scene, Vec3::new(0.0, 0.0, 0.5), 2);
        scene.pins = [0, 1].map(|v| Pin { vertex: v, at: scene.positions[v as usize] }).to_vec();
        let start = scene.positions.clone();
        let (outcome, held) = drape(&mut scene, &Settings::default(), &mut Silent).expect("a drape");
        assert!(outcome.settled, "{:?}", outcome.stop_reason);
        assert_eq!(held.iter().filter(|h| **h).count(), 6);
        assert!(held[14..].iter().all(|h| *h));
        let moved = outcome.positions[14..].iter().zip(&start[14..]).map(|(p, q)| (p - q).norm());
        assert!(moved.fold(0.0, f64::max) < 1e-3);
        let lowest = outcome.positions[..14].iter().map(|p| p.y).fold(0.0, f64::min);
        assert!((-0.31..-0.28).contains(&lowest), "the pinned strip hangs down: {lowest}");
    }

    #[test]
    fn cloth_that_nothing_holds_falls_where_there_is_no_other() {
        let mut scene = Scene {
            materials: vec![Material::isotropic(0.12, 3000.0, 0.3, 1e-5)],
            gravity: Vec3::new(0.0, -9.81, 0.0),
            ..Scene::default()
        };
        strip(&mut scene, Vec3::zeros(), 2);
        let (outcome, held) = drape(&mut scene, &Settings::default(), &mut Silent).expect("a drape");
        assert_eq!(outcome.stop_reason, StopReason::Unheld);
        assert!(!held.contains(&true));
        assert_eq!(outcome.positions, scene.positions);
    }
}
