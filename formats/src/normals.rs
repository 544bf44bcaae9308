//! Normals: smooth inside a piece and over closed seams.

use std::collections::BTreeMap;
use toile_garment::Vec3;

/// Unit normals per piece and vertex. Vertices at bit-equal places share one, so a welded seam shows no crease.
#[must_use]
pub fn smooth(pieces: &[(&[Vec3], &[[u32; 3]])]) -> Vec<Vec<Vec3>> {
    // Sums of doubled area vectors: first per vertex, then per place.
    let mut own: Vec<Vec<Vec3>> = pieces.iter().map(|(p, _)| vec![Vec3::zeros(); p.len()]).collect();
    let mut any: Vec<Vec<Vec3>> = own.clone();
    for (k, (positions, triangles)) in pieces.iter().enumerate() {
        for t in *triangles {
            let [Some(a), Some(b), Some(c)] = t.map(|i| positions.get(i as usize)) else { continue };
            let n = (b - a).cross(&(c - a));
            for i in t {
                own[k][*i as usize] += n;
                any[k][*i as usize] = if n.norm() > 0.0 { n } else { any[k][*i as usize] };
            }
        }
    }
    let mut place: BTreeMap<[u64; 3], Vec3> = BTreeMap::new();
    for ((positions, _), normals) in pieces.iter().zip(&own) {
        for (p, n) in positions.iter().zip(normals) {
            *place.entry(key(p)).or_insert_with(Vec3::zeros) += n;
        }
    }
    let mut out = own;
    for (k, (positions, _)) in pieces.iter().enumerate() {
        for (i, p) in positions.iter().enumerate() {
            // Where the sides of a fold cancel, the vertex keeps the normal of its own piece, then of one triangle.
            let shared = place.get(&key(p)).copied().unwrap_or_else(Vec3::zeros);
            out[k][i] = unit(shared).or_else(|| unit(out[k][i])).or_else(|| unit(any[k][i])).unwrap_or_else(Vec3::z);
        }
    }
    out
}

fn key(p: &Vec3) -> [u64; 3] {
    // −0 and 0 are one place.
    [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())
}

fn unit(n: Vec3) -> Option<Vec3> {
    let biggest = n.amax();
    // Scaled first: the squares of small triangles' normals must not vanish.
    let n = n / biggest;
    (biggest > 0.0 && biggest.is_finite()).then(|| n / n.norm())
}
