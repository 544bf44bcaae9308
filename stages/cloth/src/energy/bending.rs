//! Bending (class 3 of the paper, its flexion springs), by the curvature of every triangle: E = ½ A Σ D κ².
//!
//! The curvature comes from the folds over the edges of a triangle (docs/bending.md). The form is quadratic in the
//! positions, so its Hessian is constant. It needs lengths only, so it works across seams.

use crate::energy::Energy;
use crate::energy::patch::{Fold, Parts, Share, curvature, voigt};
use crate::energy::springs::Springs;
use crate::energy::tuning::{
    BENDING_FIRMNESS, FIRMNESS_LINEAR, FIRMNESS_QUADRATIC, FIRMNESS_SOFTENING_MAX, SLIM_ALTITUDE_SHARE,
    SURROGATE_ALTITUDE_MIN, SURROGATE_NARROW_PARTS, SURROGATE_SPRING_SHARE,
};
use crate::scene::bending_length;
use crate::scene::lines::folded_edges;
use crate::scene::measures::or_earth;
use crate::scene::topology::{Hinge, Topology};
use crate::{Element, Material, Scene, Vec3, power_of_two};
use nalgebra::{Vector2, Vector3};

/// Springs between the six vertices of a patch.
const PATCH_SPRINGS: usize = 15;

/// A triangle and the corners across its edges.
pub(crate) struct Patch {
    pub vertices: [u32; 6],
    /// Rows of the form E = ½ Σ |row · x|², √(N/m).
    pub rows: [[f64; 6]; 3],
    /// Value of the rows for cloth with its curvature at rest, along its normal, √J.
    pub rest: [f64; 3],
}

/// The bending energy of a cloth.
pub(crate) struct Flexion {
    /// All patches but the slim ones, summed as springs.
    springs: Springs,
    /// Patches of slim triangles, summed by themselves.
    slim: Box<[Patch]>,
    /// The slim patches as springs, for all but energy and forces.
    slim_springs: Springs,
    /// The surrogate Hessian: springs for wide triangles, their patches for the others.
    surrogate: Option<Springs>,
    /// Unit of the rigidities of the patches, N·m: a power of two, so that cloth twice as stiff has the same patches.
    size: f64,
}

/// Rigidities against (κ₀₀, κ₁₁, 2 κ₀₁), N·m: weft, warp, twist; no coupling (a Poisson ratio of 0).
pub(crate) fn rigidity(m: &Material) -> Vector3<f64> {
    Vector3::new(m.bending.weft, m.bending.warp, m.bending.twist())
}

/// Curvature without load as (κ₀₀, κ₁₁, 2 κ₀₁), 1/m: weft, warp, no twist.
fn curvature_at_rest(m: &Material) -> Vector3<f64> {
    let [warp, weft] = m.bending.rest_curvature;
    Vector3::new(weft, warp, 0.0)
}

/// The first hinge on each side of a face: number, and which of its two faces this is.
type Sides = [Option<(usize, usize)>; 3];

/// The hinges on the sides of every face over which the cloth goes on. A pressed fold has an energy of its own and is an
/// open side here.
fn hinges_of_faces(scene: &Scene, topology: &Topology) -> Vec<Sides> {
    let mut of_faces = vec![[None; 3]; topology.faces.len()];
    let folded = folded_edges(&scene.folds);
    let mut first = 0;
    for of_edge in topology.hinges.chunk_by(|g, h| g.edge() == h.edge()) {
        for (n, h) in of_edge.iter().enumerate().filter(|(_, h)| folded.binary_search(&h.edge()).is_err()) {
            let is_flat_seam = of_edge.len() == 1 && lies_flat(scene, h);
            for own in (0..2).filter(|_| is_flat_seam || is_one_cloth(scene, h)) {
                of_faces[h.faces[own] as usize][usize::from(h.sides[own])].get_or_insert((first + n, own));
            }
        }
        first += of_edge.len();
    }
    of_faces
}

/// Returns `true` where both triangles of a hinge are one cloth: their edge has the same places at rest.
fn is_one_cloth(scene: &Scene, h: &Hinge) -> bool {
    let place = |wing: usize, vertex: u32| {
        let e = &scene.triangles[h.faces[wing] as usize];
        (0..3).find(|k| e.vertices[*k] == vertex).map(|k| e.rest[k])
    };
    h.vertices[..2].iter().all(|v| place(0, *v) == place(1, *v))
}

/// Returns `true` where two sheets that are sewn together lie beside each other. Their edge is walked in opposite senses.
/// Sheets that are sewn face to face are folded back by the seam already.
fn lies_flat(scene: &Scene, h: &Hinge) -> bool {
    let start = |wing: usize| scene.triangles[h.faces[wing] as usize].vertices[usize::from(h.sides[wing])];
    start(0) != start(1)
}

/// Direction of the only side without a hinge; `None` where there is none or more than one.
fn open_side(e: &Element, sides: &Sides) -> Option<Vector2<f64>> {
    let mut open = (0..3).filter(|k| sides[*k].is_none());
    let k = open.next().filter(|_| open.next().is_none())?;
    let way = Vector2::from(e.rest[(k + 1) % 3]) - Vector2::from(e.rest[k]);
    Some(way / e.rest_length(k))
}

/// The folds of a triangle, their hinges, and the parts of its curvature by each fold.
struct Bend {
    folds: Vec<Fold>,
    hinges: Vec<usize>,
    parts: Option<Parts>,
}

impl Bend {
    fn new(e: &Element, sides: &Sides, topology: &Topology, scene: &Scene) -> Self {
        let folds: Vec<Fold> =
            sides.iter().flatten().map(|(n, own)| Fold::new(&topology.hinges[*n], *own, scene)).collect();
        let parts = curvature(&folds, open_side(e, sides));
        Self { hinges: sides.iter().flatten().map(|s| s.0).collect(), folds, parts }
    }

    /// Hinges, folds and parts of a triangle inside the cloth, which has three of them.
    fn whole(&self) -> Option<impl Iterator<Item = (usize, &Fold, &Vector3<f64>)>> {
        let parts = self.parts.as_ref().filter(|_| self.folds.len() == 3)?;
        Some(self.hinges.iter().zip(&self.folds).zip(parts).map(|((h, f), p)| (*h, f, p)))
    }
}

/// The shares of all folds in the firmness; `None` where that mechanism is off.
fn shares_of_hinges<'a>(
    bends: impl Iterator<Item = Bend>,
    areas: impl Iterator<Item = &'a f64>,
    hinges: usize,
) -> Option<Vec<Share>> {
    if !BENDING_FIRMNESS.is_on() {
        return None;
    }
    let mut shares = vec![Share::default(); hinges];
    for (bend, area) in bends.zip(areas) {
        bend.whole().into_iter().flatten().for_each(|(h, _, part)| shares[h].add(*area, part));
    }
    Some(shares)
}

/// Factor on the bending stiffness of a triangle of this area, m², with which its mesh bends like the cloth.
fn firmness(bend: &Bend, area: f64, shares: &[Share]) -> f64 {
    let softer: f64 =
        bend.whole().into_iter().flatten().map(|(h, f, _)| 0.5 * shares[h].softening(f.length, f.normal)).sum();
    let softer = (softer / area).min(FIRMNESS_SOFTENING_MAX.get());
    1.0 + softer * (FIRMNESS_LINEAR.get() + FIRMNESS_QUADRATIC.get() * softer)
}

impl Patch {
    /// The patch of a triangle with this area, m², whose cloth has the curvature `rest` without load.
    fn new(e: &Element, bend: &Bend, area: f64, stiffness: &Vector3<f64>, rest: &Vector3<f64>) -> Self {
        let mut patch = Self::around(e, &bend.folds);
        match &bend.parts {
            Some(parts) => {
                let scale = (stiffness * area).map(f64::sqrt);
                patch.rest = scale.component_mul(rest).into();
                for (fold, part) in bend.folds.iter().zip(parts) {
                    (0..3).for_each(|row| patch.add(row, scale[row] * part[row], fold));
                }
            }
            // Each fold counts by itself and is shared with the other wing.
            None => {
                for (row, fold) in bend.folds.iter().enumerate() {
                    let scale = across(fold, stiffness).sqrt();
                    patch.rest[row] = scale * fold.along.dot(rest);
                    patch.add(row, scale, fold);
                }
            }
        }
        patch
    }

    fn around(e: &Element, folds: &[Fold]) -> Self {
        let mut vertices = [e.vertices[0]; 6];
        vertices[..3].copy_from_slice(&e.vertices);
        for (slot, fold) in vertices[3..].iter_mut().zip(folds) {
            *slot = if e.vertices.contains(&fold.vertices[2]) { fold.vertices[3] } else { fold.vertices[2] };
        }
        Self { vertices, rows: [[0.0; 6]; 3], rest: [0.0; 3] }
    }

    fn add(&mut self, row: usize, factor: f64, fold: &Fold) {
        for (v, w) in fold.vertices.iter().zip(fold.weights) {
            if let Some(k) = self.vertices.iter().position(|p| p == v) {
                self.rows[row][k] += factor * w;
            }
        }
    }

    /// The rows at `x`: vectors of curvature along weft, warp and twist, √J.
    #[inline]
    pub fn bend(&self, x: &[Vec3]) -> [Vec3; 3] {
        let mut bend = [Vec3::zeros(); 3];
        for (k, v) in self.vertices.iter().enumerate() {
            let p = x[*v as usize];
            bend[0] += p * self.rows[0][k];
            bend[1] += p * self.rows[1][k];
            bend[2] += p * self.rows[2][k];
        }
        bend
    }

    #[inline]
    fn push(&self, bend: &[Vec3; 3], f: &mut [Vec3]) {
        for (k, v) in self.vertices.iter().enumerate() {
            f[*v as usize] -= bend[0] * self.rows[0][k] + bend[1] * self.rows[1][k] + bend[2] * self.rows[2][k];
        }
    }

    /// Second derivative by two of its vertices, N/m.
    fn stiffness(&self, i: usize, j: usize) -> f64 {
        self.rows.iter().map(|r| r[i] * r[j]).sum()
    }

    /// The same form as springs between its vertices.
    fn springs(&self) -> impl Iterator<Item = ([u32; 2], f64)> + '_ {
        let pair = |i: usize, j: usize| ([self.vertices[i], self.vertices[j]], -self.stiffness(i, j));
        (0..6).flat_map(move |i| (0..i).map(move |j| pair(i, j)))
    }
}

fn half_square(bend: &[Vec3; 3]) -> f64 {
    0.5 * (bend[0].norm_squared() + bend[1].norm_squared() + bend[2].norm_squared())
}

/// The patches of all triangles that have neighbours, with the number of their triangle.
///
/// `rigidities` are those of each material against (κ₀₀, κ₁₁, 2 κ₀₁), N·m. The folds of all triangles together would take
/// several times the memory of the patches, so they are computed twice and never kept.
pub(crate) fn patches(scene: &Scene, topology: &Topology, rigidities: &[Vector3<f64>]) -> Vec<(usize, Patch)> {
    let of_faces = hinges_of_faces(scene, topology);
    let bends = || scene.triangles.iter().zip(&of_faces).map(|(e, sides)| Bend::new(e, sides, topology, scene));
    let areas: Vec<f64> = scene.triangles.iter().map(|e| e.area().abs()).collect();
    let shares = shares_of_hinges(bends(), areas.iter(), topology.hinges.len());
    let mut patches = Vec::with_capacity(areas.len());
    for (f, (bend, area)) in bends().zip(&areas).enumerate() {
        let e = &scene.triangles[f];
        let stiffness = &rigidities[e.material as usize];
        if !bend.folds.is_empty() && stiffness.amax() > 0.0 {
            let firmness = shares.as_ref().map_or(1.0, |shares| firmness(&bend, *area, shares));
            let rest = curvature_at_rest(&scene.materials[e.material as usize]);
            patches.push((f, Patch::new(e, &bend, area * firmness, stiffness, &rest)));
        }
    }
    patches
}

/// The surrogate Hessian; `None` where too many triangles are narrow.
fn surrogate(
    scene: &Scene,
    topology: &Topology,
    rigidities: &[Vector3<f64>],
    patches: &[(usize, Patch)],
) -> Option<Springs> {
    let gravity = or_earth(scene.gravity.norm());
    let length = |m: &Material| bending_length(m.bending.softer(), m.areal_mass, gravity);
    let lengths: Vec<f64> = scene.materials.iter().map(length).collect();
    let wide = |f: usize| is_wide(&scene.triangles[f], lengths[scene.triangles[f].material as usize]);
    let narrow = patches.iter().filter(|(f, _)| !wide(*f));
    if SURROGATE_NARROW_PARTS.get() * narrow.clone().count() >= patches.len() {
        return None;
    }
    let mut springs: Vec<_> = narrow.flat_map(|(_, p)| p.springs()).collect();
    let of_faces = hinges_of_faces(scene, topology);
    for (f, _) in patches.iter().filter(|(f, _)| wide(*f)) {
        let folds = of_faces[*f].iter().flatten().map(|(h, own)| Fold::new(&topology.hinges[*h], *own, scene));
        folds.for_each(|fold| {
            add_surrogate_springs(&fold, &rigidities[scene.triangles[*f].material as usize], &mut springs)
        });
    }
    Some(Springs::new(scene.positions.len(), springs))
}

/// Adds springs from the corners of the wings to the ends of the hinge.
///
/// They are as stiff as a share of the fold against a corner that goes up alone.
fn add_surrogate_springs(fold: &Fold, stiffness: &Vector3<f64>, springs: &mut Vec<([u32; 2], f64)>) {
    let k = SURROGATE_SPRING_SHARE.get() * across(fold, stiffness);
    for (c, w) in fold.vertices.iter().zip(fold.weights).skip(2) {
        springs.extend(fold.vertices[..2].iter().map(|a| ([*a, *c], k * w * w)));
    }
}

/// Returns `true` for a triangle so slim that its patch as springs is a small difference of large energies.
fn is_slim(e: &Element) -> bool {
    let longest = (0..3).map(|k| e.rest_length(k)).fold(0.0, f64::max);
    e.altitude() < SLIM_ALTITUDE_SHARE.get() * longest
}

/// Returns `true` for a triangle so wide that weight and stretch hold folds over it, not bending.
fn is_wide(e: &Element, bending_length: f64) -> bool {
    e.altitude() >= SURROGATE_ALTITUDE_MIN.get() * bending_length
}

/// Half of the stiffness of a fold by itself, the part of one wing, in units of the rigidities.
fn across(fold: &Fold, stiffness: &Vector3<f64>) -> f64 {
    let across = voigt(fold.normal, fold.normal);
    0.5 * across.component_mul(&across).dot(stiffness) * fold.slimness
}

impl Flexion {
    /// The bending energy of a scene.
    pub fn new(scene: &Scene, topology: &Topology) -> Self {
        let mut rigidities: Vec<Vector3<f64>> = scene.materials.iter().map(rigidity).collect();
        let size = power_of_two(rigidities.iter().map(Vector3::amax).fold(0.0, f64::max));
        rigidities.iter_mut().for_each(|r| *r /= size);
        let patches = patches(scene, topology, &rigidities);
        let surrogate = surrogate(scene, topology, &rigidities, &patches);
        let is_slim = |p: &&(usize, Patch)| is_slim(&scene.triangles[p.0]);
        let springs_of = |slim: bool| {
            let some = || patches.iter().filter(|p| is_slim(p) == slim);
            let mut all = Vec::with_capacity(PATCH_SPRINGS * some().count());
            all.extend(some().flat_map(|(_, p)| p.springs()));
            Springs::new(scene.positions.len(), all)
        };
        let (springs, slim_springs) = (springs_of(false), springs_of(true));
        let slim: Vec<Patch> = patches.into_iter().filter(|p| is_slim(&p)).map(|p| p.1).collect();
        Self { springs, slim: slim.into_boxed_slice(), slim_springs, surrogate, size }
    }
}

impl Energy for Flexion {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        self.evaluate(x, f);
    }

    fn noise(&self, x: &[Vec3]) -> f64 {
        self.springs.noise(self.size, x)
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        let slim = self.size * self.slim.iter().map(|p| half_square(&p.bend(x))).sum::<f64>();
        slim + self.springs.energy(self.size, x)
    }

    fn evaluate(&self, x: &[Vec3], f: &mut [Vec3]) -> f64 {
        let mut slim = 0.0;
        for p in &self.slim {
            let bend = p.bend(x);
            slim += half_square(&bend);
            p.push(&bend.map(|b| b * self.size), f);
        }
        slim * self.size + self.springs.evaluate(self.size, x, f)
    }

    fn add_stiffness(&self, _: &[Vec3], k: &mut [f64]) {
        [&self.springs, &self.slim_springs].iter().for_each(|s| s.add_stiffness(self.size, k));
    }

    fn springs(&self, add: &mut dyn FnMut([u32; 2], f64)) {
        for s in [&self.springs, &self.slim_springs] {
            s.all().for_each(|(ends, k)| add(ends, self.size * k));
        }
    }

    fn has_surrogate(&self) -> bool {
        self.surrogate.is_some()
    }

    fn surrogate_springs(&self, add: &mut dyn FnMut([u32; 2], f64)) {
        self.surrogate.iter().flat_map(Springs::all).for_each(|(ends, k)| add(ends, self.size * k));
    }
}
