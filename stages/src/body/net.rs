//! The half mesh being worked on: triangles with the fans around their vertices, and its local changes.
//!
//! It covers x ≥ 0 and is open along the plane x = 0 (the *midline*); the other half is its mirror image.

use toile_garment::Vec3;

/// A triangle that was removed.
const DEAD: [u32; 3] = [u32::MAX; 3];

/// Triangles of half a body.
#[derive(Clone, Debug, Default)]
pub struct Net {
    /// Vertex positions.
    pub positions: Vec<Vec3>,
    /// Does the vertex lie on the midline?
    pub midline: Vec<bool>,
    triangles: Vec<[u32; 3]>,
    fans: Vec<Vec<u32>>,
}

impl Net {
    /// From triangles; vertices with x = 0 lie on the midline.
    pub fn new(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        let midline = positions.iter().map(|p| p.x == 0.0).collect();
        let mut fans = vec![Vec::new(); positions.len()];
        for (id, corners) in (0_u32..).zip(&triangles) {
            for v in corners {
                fans[*v as usize].push(id);
            }
        }
        Self { positions, midline, triangles, fans }
    }

    /// A vertex's place.
    pub fn place(&self, v: u32) -> Vec3 {
        self.positions[v as usize]
    }

    /// Triangles still there.
    pub fn alive(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.triangles.iter().copied().filter(|t| *t != DEAD)
    }

    /// Triangles around a vertex.
    pub fn fan(&self, v: u32) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.fans[v as usize].iter().map(|t| self.triangles[*t as usize])
    }

    /// Vertices joined to a vertex by an edge, sorted.
    pub fn neighbours(&self, v: u32) -> Vec<u32> {
        let mut found: Vec<u32> = self.fan(v).flatten().filter(|n| *n != v).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// All edges with the smaller vertex first, sorted.
    pub fn edges(&self) -> Vec<(u32, u32)> {
        let mut edges: Vec<(u32, u32)> = self
            .alive()
            .flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])])
            .map(|(a, b)| (a.min(b), a.max(b)))
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Length of an edge.
    pub fn length(&self, a: u32, b: u32) -> f64 {
        (self.place(a) - self.place(b)).norm()
    }

    fn around(&self, a: u32, b: u32) -> Vec<u32> {
        self.fans[a as usize].iter().copied().filter(|t| self.triangles[*t as usize].contains(&b)).collect()
    }

    /// The vertices opposite to an edge: two inside, one on the midline, none when it is no edge.
    pub fn opposite(&self, a: u32, b: u32) -> Vec<u32> {
        self.around(a, b)
            .iter()
            .filter_map(|t| self.triangles[*t as usize].into_iter().find(|v| *v != a && *v != b))
            .collect()
    }

    /// Puts a new vertex into an edge.
    pub fn split(&mut self, a: u32, b: u32, at: Vec3) {
        let around = self.around(a, b);
        let Ok(new) = u32::try_from(self.positions.len()) else { return };
        self.positions.push(at);
        self.midline.push(around.len() == 1);
        self.fans.push(Vec::new());
        for t in around {
            let old = self.triangles[t as usize];
            let swap = |from: u32| old.map(|v| if v == from { new } else { v });
            let (first, second) = (swap(b), swap(a));
            self.replace(t, first);
            self.fans[b as usize].retain(|f| *f != t);
            self.fans[new as usize].push(t);
            self.add(second);
        }
    }

    fn add(&mut self, corners: [u32; 3]) {
        let Ok(id) = u32::try_from(self.triangles.len()) else { return };
        self.triangles.push(corners);
        for v in corners {
            self.fans[v as usize].push(id);
        }
    }

    fn replace(&mut self, t: u32, corners: [u32; 3]) {
        self.triangles[t as usize] = corners;
    }

    /// Draws vertex `gone` into vertex `kept`, which moves to `at`; false where that would tear or fold the mesh.
    pub fn collapse(&mut self, kept: u32, gone: u32, at: Vec3, longest: f64) -> bool {
        let around = self.around(kept, gone);
        let (ours, theirs) = (self.neighbours(kept), self.neighbours(gone));
        let shared = ours.iter().filter(|v| theirs.binary_search(v).is_ok()).count();
        let bridge = self.midline[kept as usize] && self.midline[gone as usize] && around.len() != 1;
        if shared != around.len() || bridge || (self.midline[gone as usize] && !self.midline[kept as usize]) {
            return false;
        }
        if ours.len() + theirs.len() < shared + 6 || theirs.iter().any(|v| (self.place(*v) - at).norm() > longest) {
            return false;
        }
        if self.folds(kept, gone, at) || self.folds(gone, kept, at) {
            return false;
        }
        for t in &around {
            for v in std::mem::replace(&mut self.triangles[*t as usize], DEAD) {
                self.fans[v as usize].retain(|f| f != t);
            }
        }
        for t in std::mem::take(&mut self.fans[gone as usize]) {
            let moved = self.triangles[t as usize].map(|v| if v == gone { kept } else { v });
            self.replace(t, moved);
            self.fans[kept as usize].push(t);
        }
        self.positions[kept as usize] = at;
        true
    }

    /// Would a triangle of `v` (without those that hold `other`) turn over or become a sliver when `v` moves?
    fn folds(&self, v: u32, other: u32, at: Vec3) -> bool {
        self.fan(v).filter(|t| !t.contains(&other)).any(|t| {
            let before = self.normal(t);
            let [a, b, c] = t.map(|w| if w == v { at } else { self.place(w) });
            let after = (b - a).cross(&(c - a));
            after.dot(&before) < 0.6 * after.norm() * before.norm() || sharpest([a, b, c]) < 0.17
        })
    }

    /// Normal of a triangle, twice its area long.
    pub fn normal(&self, t: [u32; 3]) -> Vec3 {
        let [a, b, c] = t.map(|v| self.place(v));
        (b - a).cross(&(c - a))
    }

    /// Turns the edge inside its two triangles when that makes their smallest angle larger.
    pub fn flip(&mut self, a: u32, b: u32) -> bool {
        let around = self.around(a, b);
        let ([left, right], [c, d]) = (&around[..], &self.opposite(a, b)[..]) else { return false };
        let (left, right, c, d) = (*left, *right, *c, *d);
        if c == d || !self.around(c, d).is_empty() || (self.midline[c as usize] && self.midline[d as usize]) {
            return false;
        }
        let old = [self.triangles[left as usize], self.triangles[right as usize]];
        let new = [old[0].map(|v| if v == a { d } else { v }), old[1].map(|v| if v == b { c } else { v })];
        if !self.better(old, new) {
            return false;
        }
        self.replace(left, new[0]);
        self.replace(right, new[1]);
        self.fans[a as usize].retain(|f| *f != left);
        self.fans[b as usize].retain(|f| *f != right);
        self.fans[d as usize].push(left);
        self.fans[c as usize].push(right);
        true
    }

    fn better(&self, old: [[u32; 3]; 2], new: [[u32; 3]; 2]) -> bool {
        let angle = |t: [u32; 3]| sharpest(t.map(|v| self.place(v)));
        let (before, after) = (angle(old[0]).min(angle(old[1])), angle(new[0]).min(angle(new[1])));
        let facing = self.normal(old[0]).normalize() + self.normal(old[1]).normalize();
        let upright = new.iter().all(|t| {
            let n = self.normal(*t);
            n.dot(&facing) > 0.7 * n.norm() * facing.norm()
        });
        upright && after > before + 1e-3
    }

    /// The whole body: this half and its mirror image, unused vertices left out.
    pub fn whole(&self) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let mut positions = Vec::new();
        let (mut left, mut right) = (vec![u32::MAX; self.positions.len()], vec![u32::MAX; self.positions.len()]);
        for (v, p) in self.positions.iter().enumerate().filter(|(v, _)| !self.fans[*v].is_empty()) {
            left[v] = u32::try_from(positions.len()).unwrap_or(u32::MAX);
            right[v] = left[v];
            positions.push(*p);
            if !self.midline[v] {
                right[v] = left[v].saturating_add(1);
                positions.push(Vec3::new(-p.x, p.y, p.z));
            }
        }
        let mut triangles = Vec::new();
        for [a, b, c] in self.alive() {
            triangles.push([left[a as usize], left[b as usize], left[c as usize]]);
            triangles.push([right[a as usize], right[c as usize], right[b as usize]]);
        }
        (positions, triangles)
    }

    /// Is the vertex part of the mesh?
    pub fn used(&self, v: u32) -> bool {
        !self.fans[v as usize].is_empty()
    }
}

/// The smallest angle of a triangle, radians; zero where two corners meet.
pub fn sharpest(p: [Vec3; 3]) -> f64 {
    (0..3)
        .map(|i| {
            let (u, v) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            libm::atan2(u.cross(&v).norm(), u.dot(&v))
        })
        .fold(f64::INFINITY, f64::min)
}
