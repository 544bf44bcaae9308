//! Cloth, bodies and starts that many cases share.

use crate::support::cloth::{Cloth, Law};
use crate::support::mesh::{Family, Mesh, sheet};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use toile_garment::Vec3;

/// Cotton of the catalogue.
pub fn cotton() -> Cloth {
    Cloth {
        thickness: 4e-4,
        warp: Law::Linear(2000.0),
        weft: Law::Linear(1500.0),
        ..Cloth::linear(0.15, 2000.0, 400.0, 1e-5)
    }
}

/// A square of side `w` with irregular triangles of pitch `e` (m).
pub fn del(w: f64, e: f64) -> Mesh {
    let n = (w / e).round() as usize;
    sheet::sheet([w, w], n, n, Family::Irregular, |_| false)
}

/// A rectangle with even right triangles.
pub fn even(w: f64, h: f64, e: f64) -> Mesh {
    let n = |l: f64| (l / e).round() as usize;
    sheet::sheet([w, h], n(w), n(h), Family::Right, |_| true)
}

fn size(m: &Mesh) -> [f64; 2] {
    let of = |k: usize| m.rest.iter().map(|r| r[k]).fold(0.0, f64::max);
    [of(0), of(1)]
}

/// Level, its middle over the origin.
pub fn lying(m: Mesh, z: f64) -> Mesh {
    let [w, h] = size(&m);
    m.place(|[u, v]| Vec3::new(u - 0.5 * w, v - 0.5 * h, z))
}

/// Upright in the plane y = 0, its upper edge at z = 0.
pub fn upright(m: Mesh) -> Mesh {
    let [w, h] = size(&m);
    m.place(|[u, v]| Vec3::new(u - 0.5 * w, 0.0, v - h))
}

/// The corners of the upper edge.
pub fn corners(m: &Mesh) -> Vec<usize> {
    let [w, h] = size(m);
    m.pick(|[u, v]| v > h - 1e-9 && (u < 1e-9 || u > w - 1e-9))
}

/// The whole upper edge.
pub fn top(m: &Mesh) -> Vec<usize> {
    let [_, h] = size(m);
    m.pick(|[_, v]| v > h - 1e-9)
}

/// How far the lowest vertex hangs under the highest, m.
pub fn sag(at: &[Vec3]) -> f64 {
    let high = at.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
    high - at.iter().map(|p| p.z).fold(f64::INFINITY, f64::min)
}

/// Largest distance of equal vertices, m.
pub fn apart(a: &[Vec3], b: &[Vec3]) -> f64 {
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    a.iter().zip(b).map(|(p, q)| (p - q).norm()).fold(0.0, f64::max)
}

/// Vertices that are not bit-equal after `turn`.
pub fn unequal(a: &[Vec3], b: &[Vec3], turn: impl Fn(Vec3) -> Vec3) -> usize {
    if a.len() != b.len() {
        return usize::MAX;
    }
    a.iter().zip(b).filter(|(p, q)| **p != turn(**q)).count()
}

/// Largest strain along weft or warp.
pub fn strain(m: &Mesh, at: &[Vec3]) -> f64 {
    let of = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|i| m.rest[i]);
        let (p, q) = (at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
        let (e, f) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        let det = e[0] * f[1] - e[1] * f[0];
        let (weft, warp) = ((p * f[1] - q * e[1]) / det, (q * e[0] - p * f[0]) / det);
        weft.norm().max(warp.norm()) - 1.0
    };
    m.triangles.iter().map(of).fold(0.0, f64::max)
}

/// A body of its points and faces.
pub fn body(at: Vec<Vec3>, triangles: Vec<[usize; 3]>) -> Mesh {
    Mesh { at, rest: Vec::new(), triangles }
}

/// A ball, `20 · 4ⁿ` triangles.
pub fn ball(radius: f64, centre: Vec3, n: usize) -> Mesh {
    let g = 0.5 * (1.0 + 5f64.sqrt());
    let mut at: Vec<Vec3> = Vec::new();
    for (s, t) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
        at.extend([Vec3::new(s, t * g, 0.0), Vec3::new(0.0, s, t * g), Vec3::new(t * g, 0.0, s)]);
    }
    // The faces of the icosahedron are the triples of corners two apart.
    let close = |i: usize, j: usize| ((at[i] - at[j]).norm() - 2.0).abs() < 1e-9;
    let mut triangles = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if close(i, j) && close(j, k) && close(i, k) {
                    let out = (at[j] - at[i]).cross(&(at[k] - at[i])).dot(&at[i]) > 0.0;
                    triangles.push(if out { [i, j, k] } else { [i, k, j] });
                }
            }
        }
    }
    for _ in 0..n {
        triangles = quarter(&mut at, &triangles);
    }
    let at = at.into_iter().map(|p| centre + p.normalize() * radius).collect();
    body(at, triangles)
}

fn quarter(at: &mut Vec<Vec3>, triangles: &[[usize; 3]]) -> Vec<[usize; 3]> {
    let mut middle: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    let mut out = Vec::new();
    for t in triangles {
        let m: Vec<usize> = (0..3)
            .map(|k| {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                *middle.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    at.push((at[a].normalize() + at[b].normalize()) * 0.5);
                    at.len() - 1
                })
            })
            .collect();
        out.extend([[t[0], m[0], m[2]], [t[1], m[1], m[0]], [t[2], m[2], m[1]], [m[0], m[1], m[2]]]);
    }
    out
}

/// A box between two corners.
pub fn block(low: Vec3, high: Vec3) -> Mesh {
    let pick = |i: usize, k: usize| if i >> k & 1 == 1 { high[k] } else { low[k] };
    let at = (0..8).map(|i| Vec3::new(pick(i, 0), pick(i, 1), pick(i, 2))).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    body(at, quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
}

/// A solid round the z axis: (radius, height) from below to above; the ends are closed.
pub fn turned(profile: &[[f64; 2]], sides: usize) -> Mesh {
    let mut at = Vec::new();
    for [r, z] in profile {
        at.extend((0..sides).map(|i| {
            let a = TAU * i as f64 / sides as f64;
            Vec3::new(r * libm::cos(a), r * libm::sin(a), *z)
        }));
    }
    let (foot, head) = (at.len(), at.len() + 1);
    at.extend([Vec3::z() * profile[0][1], Vec3::z() * profile[profile.len() - 1][1]]);
    let last = (profile.len() - 1) * sides;
    let mut triangles = Vec::new();
    for i in 0..sides {
        let j = (i + 1) % sides;
        for row in (0..last).step_by(sides) {
            triangles.extend([[row + i, row + j, row + sides + j], [row + i, row + sides + j, row + sides + i]]);
        }
        triangles.extend([[foot, j, i], [head, last + i, last + j]]);
    }
    body(at, triangles)
}

/// A needle or cone whose tip is at `tip`, pointing up.
pub fn spike(tip: Vec3, half_angle: f64, height: f64, sides: usize) -> Mesh {
    let radius = height * libm::tan(half_angle);
    let mut at: Vec<Vec3> = (0..sides)
        .map(|i| {
            let a = TAU * (i as f64 + 0.5) / sides as f64;
            tip + Vec3::new(radius * libm::cos(a), radius * libm::sin(a), -height)
        })
        .collect();
    let (foot, head) = (sides, sides + 1);
    at.extend([tip - Vec3::z() * height, tip]);
    let sides = (0..sides).flat_map(|i| [[i, (i + 1) % sides, head], [(i + 1) % sides, i, foot]]);
    body(at, sides.collect())
}

/// A blade along y with its edge through the origin, `width` wide at its foot 0.3 m below.
pub fn blade(width: f64, length: f64) -> Mesh {
    let (w, l) = (0.5 * width, 0.5 * length);
    let at = [-l, l].into_iter().flat_map(|y| [Vec3::new(-w, y, -0.3), Vec3::new(w, y, -0.3), Vec3::new(0.0, y, 0.0)]);
    let triangles = vec![[0, 1, 2], [3, 5, 4], [0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [2, 5, 3], [2, 3, 0]];
    body(at.collect(), triangles)
}

/// A rod of many sides along y through (0, 0, −radius).
pub fn rod(radius: f64, length: f64, sides: usize) -> Mesh {
    let m = turned(&[[radius, -0.5 * length], [radius, 0.5 * length]], sides);
    body(m.at.iter().map(|p| Vec3::new(p.x, p.z, -p.y - radius)).collect(), m.triangles)
}

/// A trunk: 0.17 × 0.12 m at the chest, 0.14 × 0.10 m at the waist, 0.6 m high.
pub fn torso(rings: usize, sides: usize) -> Mesh {
    let profile: Vec<[f64; 2]> = (0..=rings)
        .map(|k| {
            let t = k as f64 / rings as f64;
            let waist = 0.5 + 0.5 * libm::cos(TAU * t);
            [0.14 + 0.03 * waist * if t > 0.5 { 1.0 } else { 0.8 }, 0.6 * t]
        })
        .collect();
    let round = turned(&profile, sides);
    body(round.at.iter().map(|p| Vec3::new(p.x, p.y * 0.72, p.z)).collect(), round.triangles)
}

/// Turned about the vertical by quarters: exact.
pub fn quarter_turns(p: Vec3, n: usize) -> Vec3 {
    (0..n % 4).fold(p, |p, _| Vec3::new(-p.y, p.x, p.z))
}

/// Turned about the vertical.
pub fn turned_by(p: Vec3, angle: f64) -> Vec3 {
    let (s, c) = (libm::sin(angle), libm::cos(angle));
    Vec3::new(c * p.x - s * p.y, s * p.x + c * p.y, p.z)
}

/// A cylinder start: the sheet's width once round an upright axis.
pub fn rolled(m: Mesh, share: f64) -> Mesh {
    let [w, _] = size(&m);
    let radius = w * share / TAU;
    m.place(|[u, v]| {
        let a = TAU * u / w - 0.5 * PI;
        Vec3::new(radius * libm::cos(a), radius * libm::sin(a), v)
    })
}
