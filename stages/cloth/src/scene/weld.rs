//! Sewn vertices become one (the step between sewing and draping).

use crate::{Element, Pin, Scene, Vec3};

/// A scene without stitches, and where every old vertex went.
#[derive(Clone, Debug, PartialEq)]
pub struct Welded {
    /// The welded scene; its positions are the given ones.
    pub scene: Scene,
    /// New index of every old vertex.
    pub map: Vec<u32>,
}

impl Welded {
    /// Positions of the welded scene back in the order of the original vertices.
    #[must_use]
    pub fn spread(&self, positions: &[Vec3]) -> Vec<Vec3> {
        self.map.iter().map(|&i| positions[i as usize]).collect()
    }
}

/// Joins every group of stitched vertices at the mean of its `positions`; triangles keep their rest shapes, so mass
/// and stiffness of both sides are kept. Stitches with an index out of range are ignored (a scene that has such is
/// refused by `sew`).
///
/// # Panics
/// Never for a scene whose indices are in range and `positions` of the same length.
#[must_use]
pub fn weld(scene: &Scene, positions: &[Vec3]) -> Welded {
    let n = scene.positions.len();
    let group = groups(n, &scene.stitches);
    let mut map = vec![u32::MAX; n];
    let mut count = Vec::new();
    let mut sum: Vec<Vec3> = Vec::new();
    for v in 0..n {
        let root = group[v] as usize;
        if map[root] == u32::MAX {
            map[root] = u32::try_from(sum.len()).unwrap_or(u32::MAX);
            sum.push(Vec3::zeros());
            count.push(0.0);
        }
        map[v] = map[root];
        let k = map[v] as usize;
        sum[k] += positions[v];
        count[k] += 1.0;
    }
    // A group of one keeps its position to the last bit.
    let mut joined: Vec<Vec3> = sum.iter().zip(&count).map(|(s, c)| s / *c).collect();
    for v in 0..n {
        if count[map[v] as usize] == 1.0 {
            joined[map[v] as usize] = positions[v];
        }
    }
    Welded { scene: renumbered(scene, &map, joined), map }
}

fn renumbered(scene: &Scene, map: &[u32], joined: Vec<Vec3>) -> Scene {
    let mut layers = Vec::new();
    if !scene.layers.is_empty() {
        layers = vec![i32::MIN; joined.len()];
        for (v, l) in scene.layers.iter().enumerate() {
            let k = map[v] as usize;
            layers[k] = layers[k].max(*l);
        }
    }
    let mut pins: Vec<Pin> = scene.pins.iter().map(|p| Pin { vertex: map[p.vertex as usize], at: p.at }).collect();
    pins.sort_by_key(|p| p.vertex);
    pins.dedup_by_key(|p| p.vertex);
    let renamed = |t: &Element| t.renumbered(|v| map[v as usize]);
    let count = joined.len();
    // Nothing sewn: every vertex keeps its number.
    let same = joined.len() == map.len();
    let triangles = if same { scene.triangles.clone() } else { scene.triangles.iter().map(renamed).collect() };
    let loads = scene.loads.iter().map(|l| {
        let mut l = *l;
        l.vertex = map[l.vertex as usize];
        l
    });
    let to = |v: u32| Some(map[v as usize]);
    Scene {
        positions: joined,
        triangles,
        materials: scene.materials.clone(),
        pins,
        loads: loads.collect(),
        stitches: Vec::new(),
        body: scene.body.clone(),
        gravity: scene.gravity,
        layers,
        contact_filter: scene.contact_filter.joined(map, count),
        bands: scene.bands.iter().filter_map(|b| b.renumbered(to)).collect(),
        folds: scene.folds.iter().filter_map(|f| f.renumbered(to)).collect(),
    }
}

/// The smallest member of every vertex's group of stitched vertices.
pub(crate) fn groups(n: usize, stitches: &[[u32; 2]]) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..n).map(|i| u32::try_from(i).unwrap_or(u32::MAX)).collect();
    let find = |parent: &mut Vec<u32>, mut v: u32| {
        while parent[v as usize] != v {
            parent[v as usize] = parent[parent[v as usize] as usize];
            v = parent[v as usize];
        }
        v
    };
    for s in stitches {
        if s.iter().all(|v| (*v as usize) < n) {
            let (a, b) = (find(&mut parent, s[0]), find(&mut parent, s[1]));
            let (low, high) = (a.min(b), a.max(b));
            parent[high as usize] = low;
        }
    }
    (0..n).map(|v| find(&mut parent, u32::try_from(v).unwrap_or(0))).collect()
}
