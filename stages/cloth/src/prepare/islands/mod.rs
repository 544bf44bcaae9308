//! Islands: parts of cloth that cannot meet are draped each by itself, side by side where there are threads.
//!
//! No island changes a bit of another one's rest, and their times add. A held part stays within the length of its cloth
//! of where it is held. Parts whose boxes meet are one island. A part that nothing holds may get anywhere.

pub(crate) mod solve_each;
pub(crate) mod thread_pool;

pub(crate) use solve_each::each;

use crate::collision::broad_phase::aabb::Aabb;
use crate::prepare::tuning::{ISLAND_STRETCH, ISLANDS, ISLANDS_MAX};
use crate::scene::measures::held;
use crate::scene::topology::links;
use crate::scene::weld::groups;
use crate::{Scene, Settings, Switch, Vec3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Parts that may meet each other, as a scene of their own.
pub(crate) struct Island {
    pub scene: Scene,
    /// Numbers of its vertices in the whole scene.
    vertices: Vec<u32>,
    /// Numbers of its triangles in the whole scene.
    triangles: Vec<u32>,
    /// Numbers of its stitches in the whole scene.
    stitches: Vec<u32>,
    /// Box in which it stays.
    within: Aabb,
}

/// The islands of a scene, at least two; `None` where all parts may meet.
pub(crate) fn islands(scene: &Scene, settings: &Settings) -> Option<Vec<Island>> {
    let n = scene.positions.len();
    let sides = scene.triangles.iter().flat_map(|t| links(&t.vertices));
    let links: Vec<[u32; 2]> = sides.chain(scene.stitches.iter().copied()).collect();
    let part = groups(n, &links);
    let mut used = vec![false; n];
    links.iter().flatten().for_each(|v| used[*v as usize] = true);
    // Vertices of no triangle stay out of all groups, and where they are.
    let roots: Vec<u32> = (0u32..).take(n).filter(|v| used[*v as usize] && part[*v as usize] == *v).collect();
    if !(2..=ISLANDS_MAX.get()).contains(&roots.len()) || !ISLANDS.is_on() {
        return None;
    }
    let boxes = boxes(scene, settings, &part, &roots);
    let meets = |i: usize, j: usize| settings.effects.self_contact != Switch::Off && boxes[i].meets(&boxes[j]);
    let mut meeting = Vec::new();
    for i in 0..roots.len() {
        meeting.extend((0..i).filter(|j| meets(i, *j)).map(|j| [roots[i], roots[j]]));
    }
    let group = groups(n, &meeting);
    let mut all: Vec<u32> = roots.iter().map(|r| group[*r as usize]).collect();
    all.sort_unstable();
    all.dedup();
    let of = |v: u32| group[part[v as usize] as usize];
    let within = |g: u32| {
        let own = roots.iter().zip(&boxes).filter(|(r, _)| group[**r as usize] == g);
        own.fold(Aabb::EMPTY, |a, (_, b)| a.join(b))
    };
    (all.len() > 1)
        .then(|| all.iter().map(|g| Island::new(scene, within(*g), |v| of(v) == *g && used[v as usize])).collect())
}

/// The box in which each part stays.
fn boxes(scene: &Scene, settings: &Settings, part: &[u32], roots: &[u32]) -> Vec<Aabb> {
    let pins = held(scene);
    let around = neighbours(scene);
    let gap = settings.self_gap.max(scene.materials.iter().map(|m| m.thickness).fold(0.0, f64::max));
    let everywhere = Aabb { low: Vec3::repeat(f64::NEG_INFINITY), high: Vec3::repeat(f64::INFINITY) };
    let of = |root: &u32| {
        let own: Vec<(u32, Vec3)> = pins.iter().copied().filter(|p| part[p.0 as usize] == *root).collect();
        let Some(first) = own.first() else { return everywhere };
        let far = |p: &&(u32, Vec3)| (p.1 - first.1).norm();
        let last = own.iter().max_by(|p, q| far(p).total_cmp(&far(q))).unwrap_or(first);
        [first, last].iter().fold(everywhere, |b, (v, at)| {
            let ball = Aabb { low: *at, high: *at }.grown(ISLAND_STRETCH.get() * farthest(&around, *v) + gap);
            Aabb { low: b.low.sup(&ball.low), high: b.high.inf(&ball.high) }
        })
    };
    roots.iter().map(of).collect()
}

/// Neighbours of every vertex with their distances along the cloth, m.
type Lengths = Vec<Vec<(u32, f64)>>;

/// Neighbours of every vertex, and their distances along the cloth, m.
fn neighbours(scene: &Scene) -> Lengths {
    let mut around = vec![Vec::new(); scene.positions.len()];
    let mut join = |a: u32, b: u32, length: f64| {
        around[a as usize].push((b, length));
        around[b as usize].push((a, length));
    };
    for t in &scene.triangles {
        (0..3).for_each(|k| join(t.vertices[k], t.vertices[(k + 1) % 3], t.rest_length(k)));
    }
    scene.stitches.iter().for_each(|[a, b]| join(*a, *b, 0.0));
    around
}

/// Longest of the shortest ways along the cloth from a vertex, m (Dijkstra 1959).
fn farthest(around: &Lengths, from: u32) -> f64 {
    let mut way = vec![f64::INFINITY; around.len()];
    way[from as usize] = 0.0;
    let mut open = BinaryHeap::from([Reverse((0u64, from))]);
    let mut longest = 0.0;
    while let Some(Reverse((bits, v))) = open.pop() {
        let here = way[v as usize];
        // Numbers that are not negative are ordered as their bits.
        if bits != here.to_bits() {
            continue;
        }
        longest = here;
        for (w, length) in &around[v as usize] {
            if here + length < way[*w as usize] {
                way[*w as usize] = here + length;
                open.push(Reverse((way[*w as usize].to_bits(), *w)));
            }
        }
    }
    longest
}

impl Island {
    fn new(scene: &Scene, within: Aabb, mine: impl Fn(u32) -> bool) -> Self {
        let stitches: Vec<u32> = (0u32..).zip(&scene.stitches).filter(|(_, s)| mine(s[0])).map(|(k, _)| k).collect();
        let triangles: Vec<u32> =
            (0u32..).zip(&scene.triangles).filter(|(_, t)| mine(t.vertices[0])).map(|(k, _)| k).collect();
        let (own, vertices) = scene.only(mine);
        Self { scene: own, vertices, triangles, stitches, within }
    }

    /// Puts the positions of this group into those of the whole scene.
    fn put(&self, positions: &[Vec3], all: &mut [Vec3]) {
        self.vertices.iter().zip(positions).for_each(|(v, p)| all[*v as usize] = *p);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Element, Material, Outcome, Pin};

    /// Strips of three cells of 20 mm that hang from their first two vertices, each `step` metres from the one before.
    fn strips(count: u32, step: f64) -> Scene {
        let mut scene = Scene {
            materials: vec![Material::isotropic(0.15, 500.0, 0.3, 1e-5)],
            gravity: Vec3::new(0.0, -9.81, 0.0),
            ..Scene::default()
        };
        for s in 0..count {
            let (first, x) = (8 * s, f64::from(s) * step);
            let rest: Vec<[f64; 2]> =
                (0..4).flat_map(|r| [[0.0, 0.02 * f64::from(r)], [0.02, 0.02 * f64::from(r)]]).collect();
            scene.positions.extend(rest.iter().map(|r| Vec3::new(x + r[0], -0.9 * r[1], 0.3 * r[1])));
            for c in 0..3 {
                let (a, b) = (2 * c, 2 * c + 1);
                for v in [[a, b, b + 2], [a, b + 2, a + 2]] {
                    let rest = v.map(|i| rest[i as usize]);
                    scene.triangles.push(Element { vertices: v.map(|i| first + i), rest, material: 0 });
                }
            }
            let pin = |v: u32| Pin { vertex: first + v, at: scene.positions[(first + v) as usize] };
            let pins = [pin(0), pin(1)];
            scene.pins.extend(pins);
        }
        scene
    }

    fn rest(scene: &Scene) -> Outcome {
        crate::drape(scene, &Settings::default(), &mut crate::Silent).expect("a drape")
    }

    #[test]
    fn parts_within_reach_are_one_group_and_others_are_not() {
        let settings = Settings::default();
        assert!(islands(&strips(2, 0.1), &settings).is_none(), "both reach 95 mm");
        let groups = islands(&strips(3, 0.3), &settings).expect("groups");
        assert_eq!(groups.iter().map(|g| g.vertices.len()).collect::<Vec<_>>(), [8, 8, 8]);
        let mut loose = strips(3, 0.3);
        loose.pins.retain(|p| p.vertex >= 8);
        assert!(islands(&loose, &settings).is_none(), "what nothing holds may get anywhere");
    }

    #[test]
    fn a_part_rests_as_it_does_alone_and_sums_are_of_all() {
        let (alone, all) = (rest(&strips(1, 0.3)), rest(&strips(3, 0.3)));
        assert_eq!(all.positions[..8], alone.positions[..]);
        assert!(all.settled && all.positions.len() == 24 && all.steps > alone.steps);
        assert_eq!(all.reactions.iter().map(|r| r.vertex).collect::<Vec<_>>(), [0, 1, 8, 9, 16, 17]);
        let weight = 3.0 * 0.15 * 0.02 * 0.06 * 9.81;
        let held: f64 = all.reactions.iter().map(|r| r.force.y).sum();
        assert!((held / weight - 1.0).abs() < 0.02, "{held} N of {weight} N");
    }

    #[test]
    fn groups_side_by_side_rest_to_the_same_bits() {
        let scene = strips(5, 0.3);
        let rests = [1, 2, 8].map(|threads| {
            let settings = Settings { threads, ..Settings::default() };
            crate::drape(&scene, &settings, &mut crate::Silent).expect("a drape")
        });
        let told = rests.each_ref().map(|o| (&o.positions, o.steps, o.energy.to_bits(), &o.reactions));
        assert!(told[0] == told[1] && told[0] == told[2]);
    }

    #[test]
    fn a_part_that_gets_farther_is_draped_with_all_others() {
        let scene = strips(2, 0.3);
        let groups = islands(&scene, &Settings::default()).expect("groups");
        let far = Outcome { positions: vec![Vec3::repeat(9.0); 8], ..rest(&strips(1, 0.3)) };
        let none = each(&scene, &groups, 2, &mut crate::Silent, |_, _| Ok(far.clone())).expect("no error");
        assert!(none.is_none());
    }
}
