//! Intersection resolution for a sewn start that crosses itself at a few places.
//!
//! Seams that closed over a fold leave a pinch behind. The cloth around each crossing is smoothed until none is left.

use crate::Vec3;
use crate::collision::crossings::count;
use crate::prepare::tuning::{
    UNTANGLE_PAIRS_MAX, UNTANGLE_PULL, UNTANGLE_ROUNDS, UNTANGLE_SHARE_MAX, UNTANGLE_WIDEN_ROUNDS,
};
use crate::scene::topology::Topology;

/// Smooths the cloth around its crossings; held vertices stay. Returns the pairs of triangles that still cross.
pub(crate) fn resolve_intersections(x: &mut [Vec3], topology: &Topology, held: &[bool]) -> Vec<[u32; 2]> {
    let mut found = count::self_crossings(x, &topology.faces);
    if found.count == 0 {
        return found.pairs;
    }
    let neighbours = neighbours(x.len(), topology);
    let most = (UNTANGLE_SHARE_MAX.get() * topology.faces.len() as f64).max(UNTANGLE_PAIRS_MAX.get()) as usize;
    for round in 0..UNTANGLE_ROUNDS.get() {
        if found.count == 0 || found.count > most {
            break;
        }
        let smoothed =
            vertices_around(x.len(), topology, &neighbours, &found.pairs, 1 + round / UNTANGLE_WIDEN_ROUNDS.get());
        let before = x.to_vec();
        for i in (0..x.len()).filter(|i| smoothed[*i] && !held[*i] && !neighbours[*i].is_empty()) {
            let sum: Vec3 = neighbours[i].iter().map(|j| before[*j as usize]).sum();
            x[i] += (sum / neighbours[i].len() as f64 - before[i]) * UNTANGLE_PULL.get();
        }
        found = count::self_crossings(x, &topology.faces);
    }
    found.pairs
}

/// Neighbours of every vertex, ascending. A border vertex has only those along the border, so that hems keep their
/// place.
fn neighbours(n: usize, topology: &Topology) -> Vec<Vec<u32>> {
    let mut edges: Vec<(u32, u32)> = Vec::new();
    for t in &topology.faces {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            edges.push((a.min(b), a.max(b)));
        }
    }
    edges.sort_unstable();
    let mut all = vec![Vec::new(); n];
    let mut border = vec![Vec::new(); n];
    for same in edges.chunk_by(|a, b| a == b) {
        let (a, b) = same[0];
        for (i, j) in [(a, b), (b, a)] {
            all[i as usize].push(j);
            if same.len() == 1 {
                border[i as usize].push(j);
            }
        }
    }
    all.into_iter().zip(border).map(|(all, border)| if border.is_empty() { all } else { border }).collect()
}

/// Vertices of the crossing triangles and some rings around them.
fn vertices_around(
    n: usize,
    topology: &Topology,
    neighbours: &[Vec<u32>],
    pairs: &[[u32; 2]],
    rings: usize,
) -> Vec<bool> {
    let mut near = vec![false; n];
    for v in pairs.iter().flatten().flat_map(|f| topology.faces[*f as usize]) {
        near[v as usize] = true;
    }
    for _ in 0..rings {
        let now = near.clone();
        for i in (0..n).filter(|i| now[*i]) {
            for j in &neighbours[i] {
                near[*j as usize] = true;
            }
        }
    }
    near
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Element, Scene};

    /// A flat sheet of n × n cells with one inner vertex pulled through the cloth beside it.
    fn pinched(n: u32) -> (Vec<Vec3>, Topology) {
        let mut x = Vec::new();
        for j in 0..=n {
            for i in 0..=n {
                x.push(Vec3::new(f64::from(i) * 0.01, f64::from(j) * 0.01, 0.0));
            }
        }
        let mut triangles = Vec::new();
        for j in 0..n {
            for i in 0..n {
                let a = j * (n + 1) + i;
                for t in [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]] {
                    let rest = t.map(|v| [x[v as usize].x, x[v as usize].y]);
                    triangles.push(Element { vertices: t, rest, material: 0 });
                }
            }
        }
        let scene = Scene { positions: x.clone(), triangles: triangles.into(), ..Scene::default() };
        let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
        pinch(&mut x, n, 5);
        (x, topology)
    }

    /// Pulls the fifth vertex of a row through the cloth beside it.
    fn pinch(x: &mut [Vec3], n: u32, row: u32) {
        let v = (row * (n + 1) + 5) as usize;
        x[v] += Vec3::new(0.022, 0.004, 0.004);
        x[v + 1] += Vec3::new(0.0, 0.0, 0.008);
    }

    #[test]
    fn a_pinch_is_smoothed_away_and_the_rest_stays() {
        let (mut x, topology) = pinched(12);
        assert!(count::self_crossings(&x, &topology.faces).count > 0);
        let corner = x[0];
        let held = vec![false; x.len()];
        assert!(resolve_intersections(&mut x, &topology, &held).is_empty());
        assert_eq!(count::self_crossings(&x, &topology.faces).count, 0);
        assert_eq!(x[0], corner);
    }

    /// Two pinches at once in cloth of few triangles make more pairs than the share allows in large cloth.
    #[test]
    fn two_pinches_in_small_cloth_are_smoothed_away() {
        let (mut x, topology) = pinched(12);
        pinch(&mut x, 12, 9);
        let found = count::self_crossings(&x, &topology.faces).count;
        assert!(found as f64 > UNTANGLE_SHARE_MAX.get() * topology.faces.len() as f64 && found > 8, "{found}");
        let held = vec![false; x.len()];
        assert!(resolve_intersections(&mut x, &topology, &held).is_empty());
    }
}
