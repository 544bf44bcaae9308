//! Cloth that tests settle.

use crate::{Element, Pin, Scene, Vec3};

/// Adds a flat square of so many squares along a `side` at a height `y`, some of its vertices `held` where they are.
#[allow(clippy::unwrap_used)]
pub fn add(scene: &mut Scene, squares: u32, side: f64, y: f64, held: impl Fn(u32, u32) -> bool) {
    let first = u32::try_from(scene.positions.len()).unwrap();
    let at = |i: u32| side * (f64::from(i) / f64::from(squares) - 0.5);
    let id = |i: u32, j: u32| first + j * (squares + 1) + i;
    for j in 0..=squares {
        for i in 0..=squares {
            let place = Vec3::new(at(i), y, at(j));
            scene.positions.push(place);
            if held(i, j) {
                scene.pins.push(Pin { vertex: id(i, j), at: place });
            }
        }
    }
    for (i, j) in (0..squares).flat_map(|j| (0..squares).map(move |i| (i, j))) {
        let q = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)];
        for c in [[0, 1, 2], [0, 2, 3]].map(|c| c.map(|k: usize| q[k])) {
            let rest = c.map(|(i, j)| [at(i), at(j)]);
            scene.triangles.push(Element { vertices: c.map(|(i, j)| id(i, j)), rest, material: 0 });
        }
    }
}
