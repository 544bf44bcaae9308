//! Degenerate-edge collapse: the ends of edges that are tiny beside their triangles are draped as one vertex.
//!
//! A step that is short for the cloth turns such an edge right over, so that no descent gets anywhere, in any
//! precision. The ends are parted again in the result.

use crate::prepare::tuning::{DEGENERATE_EDGE_COLLAPSE, DEGENERATE_EDGE_MIN, DEGENERATE_EDGE_SHARE};
use crate::scene::weld::groups;
use crate::scene::weld::{Welded, weld};
use crate::{Outcome, Scene, Vec3};

/// A scene without tiny edges, and the offsets that bring them back.
pub(crate) struct CollapsedEdges {
    pub scene: Scene,
    welded: Welded,
    /// Rest place of every vertex from the middle of its group (weft, warp), m.
    offset: Vec<[f64; 2]>,
    /// Number of tiny edges.
    pub edges: usize,
}

/// An edge from its lower to its higher vertex, and the way along it in the cloth, m.
type Tiny = ([u32; 2], [f64; 2]);

/// All tiny edges of a scene, ascending.
fn tiny_edges(scene: &Scene) -> Vec<Tiny> {
    let mut edges = Vec::new();
    let (least, share) = (DEGENERATE_EDGE_MIN.get(), DEGENERATE_EDGE_SHARE.get());
    for t in &scene.triangles {
        let lengths = [0, 1, 2].map(|k| t.rest_length(k));
        for k in (0..3).filter(|k| (least..share * t.longest_edge()).contains(&lengths[*k])) {
            let (a, b) = (t.vertices[k], t.vertices[(k + 1) % 3]);
            let (p, q) = (t.rest[k], t.rest[(k + 1) % 3]);
            let way = [q[0] - p[0], q[1] - p[1]];
            edges.push(if a < b { ([a, b], way) } else { ([b, a], way.map(|c| -c)) });
        }
    }
    edges.sort_by_key(|e| e.0);
    edges.dedup_by_key(|e| e.0);
    edges
}

/// Places of the vertices that become one, from the middle of each group.
fn offsets(edges: &[Tiny], welded: &Welded) -> Vec<[f64; 2]> {
    let n = welded.map.len();
    let pairs: Vec<[u32; 2]> = edges.iter().map(|e| e.0).collect();
    let mut from_first: Vec<Option<[f64; 2]>> =
        (0u32..).zip(groups(n, &pairs)).map(|(v, first)| (v == first).then_some([0.0; 2])).collect();
    let mut more = true;
    while more {
        more = false;
        for ([a, b], way) in edges.iter().map(|(e, way)| (e.map(|v| v as usize), way)) {
            let step = |p: [f64; 2], sign: f64| Some([p[0] + sign * way[0], p[1] + sign * way[1]]);
            match (from_first[a], from_first[b]) {
                (Some(p), None) => from_first[b] = step(p, 1.0),
                (None, Some(q)) => from_first[a] = step(q, -1.0),
                _ => continue,
            }
            more = true;
        }
    }
    let from_first: Vec<[f64; 2]> = from_first.into_iter().map(Option::unwrap_or_default).collect();
    let (mut sum, mut count) = (vec![[0.0; 2]; welded.scene.positions.len()], vec![0.0; welded.scene.positions.len()]);
    for (v, g) in welded.map.iter().map(|g| *g as usize).enumerate() {
        sum[g] = [sum[g][0] + from_first[v][0], sum[g][1] + from_first[v][1]];
        count[g] += 1.0;
    }
    let middle = |v: usize, k: usize| sum[welded.map[v] as usize][k] / count[welded.map[v] as usize];
    (0..n).map(|v| [from_first[v][0] - middle(v, 0), from_first[v][1] - middle(v, 1)]).collect()
}

impl CollapsedEdges {
    /// `None` where there are no tiny edges, or nothing would be left.
    pub fn of(scene: &Scene) -> Option<Self> {
        let edges = tiny_edges(scene);
        if edges.is_empty() || !DEGENERATE_EDGE_COLLAPSE.is_on() || !scene.stitches.is_empty() {
            return None;
        }
        let sewn = Scene { stitches: edges.iter().map(|e| e.0).collect(), ..scene.clone() };
        let mut welded = weld(&sewn, &scene.positions);
        welded.scene.triangles.retain(|t| {
            let [a, b, c] = t.vertices;
            a != b && b != c && c != a
        });
        let offset = offsets(&edges, &welded);
        let mut used = vec![false; welded.scene.positions.len()];
        welded.scene.triangles.iter().flat_map(|t| t.vertices).for_each(|v| used[v as usize] = true);
        let whole = welded.map.iter().all(|g| used[*g as usize]);
        whole.then(|| Self { scene: welded.scene.clone(), welded, offset, edges: edges.len() })
    }

    /// Deformed directions of weft and warp at every vertex, as sums over its triangles, and the number of these.
    ///
    /// Half of a fold along tiny edges is on either side.
    fn axes(&self, x: &[Vec3]) -> Vec<([Vec3; 2], f64)> {
        let mut axes = vec![([Vec3::zeros(); 2], 0.0); x.len()];
        for t in &self.scene.triangles {
            let w = t.gradients();
            let along = |k: usize| (0..3).map(|i| x[t.vertices[i] as usize] * w[i][k]).sum::<Vec3>();
            for v in t.vertices {
                let ([weft, warp], count) = &mut axes[v as usize];
                *weft += along(0);
                *warp += along(1);
                *count += 1.0;
            }
        }
        axes
    }

    /// Positions with the ends parted again, as the cloth around them is stretched and turned, m.
    pub fn parted(&self, x: &[Vec3]) -> Vec<Vec3> {
        let axes = self.axes(x);
        let place = |(v, [a, b]): (usize, &[f64; 2])| {
            let g = self.welded.map[v] as usize;
            let ([weft, warp], count) = axes[g];
            x[g] + (weft * *a + warp * *b) / count
        };
        self.offset.iter().enumerate().map(place).collect()
    }

    /// The outcome for the scene with its tiny edges.
    pub fn back(&self, mut outcome: Outcome) -> Outcome {
        let positions = self.parted(&outcome.positions);
        for r in &mut outcome.reactions {
            // The first vertex of a group is held in the name of all.
            let first = self.welded.map.iter().position(|g| *g == r.vertex);
            r.vertex = first.and_then(|v| u32::try_from(v).ok()).unwrap_or(r.vertex);
        }
        Outcome { positions, joined: self.edges, ..outcome }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Element, Material, StopReason};

    /// A strip of three cells, the middle one 10 µm wide.
    fn strip() -> Scene {
        let columns = [0.0, 0.02, 0.02001, 0.04];
        let rest: Vec<[f64; 2]> = columns.iter().flat_map(|u| [[*u, 0.0], [*u, 0.02]]).collect();
        let cell = |k: u32| [[2 * k, 2 * k + 2, 2 * k + 3], [2 * k, 2 * k + 3, 2 * k + 1]];
        let element = |v: [u32; 3]| Element { vertices: v, rest: v.map(|i| rest[i as usize]), material: 0 };
        Scene {
            positions: rest.iter().map(|r| Vec3::new(r[0], 0.0, r[1])).collect(),
            triangles: (0..3).flat_map(cell).map(element).collect(),
            materials: vec![Material::isotropic(0.1, 500.0, 0.0, 1e-5)],
            ..Scene::default()
        }
    }

    #[test]
    fn ends_of_tiny_edges_are_one_and_come_apart_again() {
        let collapsed = CollapsedEdges::of(&strip()).expect("tiny edges");
        assert_eq!((collapsed.edges, collapsed.scene.positions.len(), collapsed.scene.triangles.len()), (2, 6, 4));
        let turn = |p: &Vec3| Vec3::new(-p.z, 2.0 * p.x, p.y);
        let outcome = Outcome {
            positions: collapsed.scene.positions.iter().map(turn).collect(),
            steps: 0,
            seconds: 0.0,
            settled: true,
            stop_reason: StopReason::Settled,
            energy: 0.0,
            speed_max: 0.0,
            residual_rel: 0.0,
            seam_gap_max: 0.0,
            open_stitches: Vec::new(),
            effects: Vec::new(),
            reactions: Vec::new(),
            repaired: (0, 0.0),
            joined: 0,
        };
        let back = collapsed.back(outcome);
        assert_eq!(back.joined, 2);
        // Both neighbouring cells lost half of the width of the collapsed one, and all is turned and twice as long.
        for (p, q) in strip().positions.iter().zip(&back.positions) {
            assert!((turn(p) - q).norm() < 1.1e-5, "{p} {q}");
        }
        let edge = back.positions[4] - back.positions[2];
        assert!((edge - Vec3::new(0.0, 2e-5, 0.0)).norm() < 1e-8, "{edge}");
    }

    #[test]
    fn plain_cloth_is_left_alone() {
        let mut scene = strip();
        scene.triangles.truncate(2);
        assert!(CollapsedEdges::of(&scene).is_none());
    }
}
