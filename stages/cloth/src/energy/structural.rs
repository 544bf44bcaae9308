//! Structural springs of the paper (class 1: the cloth's stretch, equations 2 and 3), on the mesh edges.
//!
//! Details: docs/structural.md.
//!
//! An edge at angle φ from the weft carries cos⁴φ of the weft curve and sin⁴φ of the warp curve; its cross-section is
//! the area of its triangles over its length (Van Gelder's weight).

use crate::energy::Energy;
use crate::energy::law::{Fabric, Law};
use crate::linear::hessian::Hessian;
use crate::scene::topology::Topology;
use crate::{Scene, Settings, Vec3};

/// Squared cosine of 22.5°, with room for rounding: edges at least this near a yarn are springs along it.
const YARN_SQUARED_COSINE_MIN: f64 = 0.853_553;

/// One triangle's part of an edge spring.
pub(crate) struct Spring {
    pub ends: [u32; 2],
    pub fabric: u32,
    pub length: f64,
    /// Area / length, m.
    pub section: f64,
    /// Shares of weft curve, warp curve and shear stiffness; 0 where the fabric gives the constant.
    pub share: [f64; 3],
    /// Stiffness of the constant that the fabric gives, N per strain; 0 for none.
    bare: f64,
}

/// The springs of all triangle sides, those of one edge merged where both sides agree.
pub(crate) fn springs(scene: &Scene, topology: &Topology) -> Vec<Spring> {
    let mut of_edge: Vec<Option<Spring>> = topology.edges.iter().map(|_| None).collect();
    let mut extra = Vec::new();
    for (t, ids) in scene.triangles.iter().zip(&topology.face_edges) {
        for k in 0..3 {
            let s = side(t, k, scene.materials[t.material as usize].springs);
            match &mut of_edge[ids[k] as usize] {
                slot @ None => *slot = Some(s),
                Some(o) if o.fabric == s.fabric && alike(o, &s) => {
                    o.section += s.section;
                    o.bare += s.bare;
                }
                Some(_) => extra.push(s),
            }
        }
    }
    of_edge.into_iter().flatten().chain(extra).collect()
}

fn alike(a: &Spring, b: &Spring) -> bool {
    let close = |p: f64, q: f64| (p - q).abs() <= 1e-9;
    close(a.length, b.length) && (0..3).all(|k| close(a.share[k], b.share[k]))
}

fn side(t: &crate::Element, k: usize, constants: Option<[f64; 2]>) -> Spring {
    let (a, b) = (t.rest[k], t.rest[(k + 1) % 3]);
    let length = t.rest_length(k);
    let (c, s) = ((b[0] - a[0]) / length, (b[1] - a[1]) / length);
    let (cc, ss) = (c * c, s * s);
    // Each side of an edge has half of its spring, so that the rim has half springs.
    let bare =
        constants.map(|[yarn, bias]| 0.5 * length * if cc.max(ss) >= YARN_SQUARED_COSINE_MIN { yarn } else { bias });
    Spring {
        ends: [t.vertices[k], t.vertices[(k + 1) % 3]],
        fabric: t.material,
        length,
        section: t.area().abs() / length,
        share: if bare.is_some() { [0.0; 3] } else { [cc * cc, ss * ss, 4.0 * cc * ss] },
        bare: bare.unwrap_or(0.0),
    }
}

/// The structural springs of a cloth.
pub(crate) struct Structural {
    springs: Vec<Spring>,
    fabrics: Vec<Fabric>,
}

impl Structural {
    pub fn new(scene: &Scene, topology: &Topology, settings: &Settings) -> Self {
        let mut springs = springs(scene, topology);
        springs.retain(|s| s.share[0] + s.share[1] > 1e-12 || s.bare > 0.0);
        Self { springs, fabrics: scene.materials.iter().map(|m| Fabric::new(m, settings)).collect() }
    }
}

/// Pulls the ends of a spring together with a force.
#[inline]
pub(crate) fn pull(x: &[Vec3], f: &mut [Vec3], s: &Spring, force: impl Fn(f64) -> f64) {
    let [a, b] = s.ends.map(|v| v as usize);
    let d = x[b] - x[a];
    let l = d.norm();
    if l > 0.0 {
        let p = d * (force(l / s.length - 1.0) / l);
        f[a] += p;
        f[b] -= p;
    }
}

/// Adds the row sums of a spring of stiffness `k` (N/m between its ends).
pub(crate) fn row_sums(ends: [u32; 2], k: f64, rows: &mut [f64]) {
    for v in ends {
        rows[v as usize] += 2.0 * k;
    }
}

/// Adds the second derivatives of a spring: `slope` (N per strain) along it, `force` over its length across it.
pub(crate) fn add_spring_hessian(x: &[Vec3], s: &Spring, force: f64, slope: f64, convex: bool, h: &mut Hessian) {
    let d = x[s.ends[1] as usize] - x[s.ends[0] as usize];
    let l = d.norm();
    if l <= 0.0 {
        return;
    }
    let along = d * d.transpose() / (l * l);
    let across = if convex { force.max(0.0) / l } else { force / l };
    let block = along * (slope / s.length - across) + nalgebra::Matrix3::identity() * across;
    h.spread(&s.ends, &[1.0, -1.0], &block);
}

fn strain(x: &[Vec3], s: &Spring) -> f64 {
    (x[s.ends[1] as usize] - x[s.ends[0] as usize]).norm() / s.length - 1.0
}

impl Structural {
    /// Sum of a value of both curves by their shares and the section, or the fabric's constant times `bare`.
    fn sum(&self, s: &Spring, of: impl Fn(&Law) -> f64, bare: f64) -> f64 {
        if s.bare > 0.0 {
            return s.bare * bare;
        }
        let law = &self.fabrics[s.fabric as usize];
        s.section * (s.share[0] * of(&law.weft) + s.share[1] * of(&law.warp))
    }

    /// Force of a spring at a strain, N (equation 2).
    fn force(&self, s: &Spring, e: f64) -> f64 {
        self.sum(s, |law| law.tension(e), e)
    }
}

impl Energy for Structural {
    fn add_forces(&self, x: &[Vec3], f: &mut [Vec3]) {
        for s in &self.springs {
            pull(x, f, s, |e| self.force(s, e));
        }
    }

    fn energy(&self, x: &[Vec3]) -> f64 {
        let of = |s: &Spring| {
            let e = strain(x, s);
            s.length * self.sum(s, |law| law.energy(e), 0.5 * e * e)
        };
        self.springs.iter().map(of).sum()
    }

    fn strain(&self, x: &[Vec3]) -> f64 {
        self.springs.iter().map(|s| strain(x, s)).fold(f64::NEG_INFINITY, f64::max)
    }

    fn add_stiffness(&self, x: &[Vec3], k: &mut [f64]) {
        for s in &self.springs {
            let e = strain(x, s);
            row_sums(s.ends, self.sum(s, |law| law.tangent(e), 1.0) / s.length, k);
        }
    }

    fn add_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        pairs.extend(self.springs.iter().map(|s| s.ends));
    }

    fn add_hessian(&self, x: &[Vec3], convex: bool, h: &mut Hessian) {
        for s in &self.springs {
            let e = strain(x, s);
            add_spring_hessian(x, s, self.force(s, e), self.sum(s, |law| law.slope(e), 1.0), convex, h);
        }
    }
}
