//! The shadow of draped cloth under parallel light from above, read along rays from the centre of the disc.

use std::f64::consts::TAU;
use toile_garment::Vec3;

/// Rays around the disc.
pub const RAYS: usize = 720;

/// The line along which the drapemeter's paper ring would be cut.
#[derive(Clone, Debug)]
pub struct Shadow {
    /// Area with the disc, m².
    pub area: f64,
    /// Outer radius on every ray, m; the first ray looks along +x, the others follow towards −z (seen from above, +x to
    /// the right and −z upwards: counter-clockwise).
    pub outline: Vec<f64>,
}

/// The shadow of triangles on a disc around the y axis.
pub fn shadow(at: &[Vec3], triangles: &[[u32; 3]], disc: f64) -> Shadow {
    let mut rays: Vec<Vec<[f64; 2]>> = vec![vec![[0.0, disc]]; RAYS];
    for t in triangles {
        let corners = t.map(|v| {
            let p = at[v as usize];
            [p.x, -p.z]
        });
        cast(corners, &mut rays);
    }
    let outline = rays.iter().map(|r| r.iter().map(|i| i[1]).fold(0.0, f64::max)).collect();
    let step = TAU / RAYS as f64;
    let area = rays.into_iter().map(|r| 0.5 * step * lit(r)).sum();
    Shadow { area, outline }
}

/// Adds the pieces of all rays that a triangle covers. It is small against its distance from the centre.
fn cast(corners: [[f64; 2]; 3], rays: &mut [Vec<[f64; 2]>]) {
    let first = libm::atan2(corners[0][1], corners[0][0]);
    let turns = corners.map(|c| {
        let turn = libm::atan2(c[1], c[0]) - first;
        turn - TAU * (turn / TAU).round()
    });
    let low = turns.iter().copied().fold(f64::INFINITY, f64::min);
    let high = turns.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let step = TAU / RAYS as f64;
    let (from, to) = (((first + low) / step).ceil() as i64, ((first + high) / step).floor() as i64);
    for k in from..=to {
        let angle = k as f64 * step;
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        if let Some(piece) = cut(corners, [cosine, sine]) {
            rays[k.rem_euclid(RAYS as i64) as usize].push(piece);
        }
    }
}

/// The piece of a ray inside a triangle, by the distance from the centre.
fn cut(corners: [[f64; 2]; 3], [dx, dy]: [f64; 2]) -> Option<[f64; 2]> {
    let (mut near, mut far) = (f64::INFINITY, f64::NEG_INFINITY);
    for k in 0..3 {
        let (p, q) = (corners[k], corners[(k + 1) % 3]);
        // Signed distances from the ray's line, and distances along it.
        let (a, b) = (dx * p[1] - dy * p[0], dx * q[1] - dy * q[0]);
        if a * b > 0.0 || a == b {
            continue;
        }
        let share = a / (a - b);
        let along = |c: [f64; 2]| dx * c[0] + dy * c[1];
        let r = along(p) + share * (along(q) - along(p));
        near = near.min(r);
        far = far.max(r);
    }
    (far > near).then_some([near, far])
}

/// `Σ (far² − near²)` over the union of the pieces.
fn lit(mut pieces: Vec<[f64; 2]>) -> f64 {
    pieces.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let (mut sum, mut reached) = (0.0, 0.0_f64);
    for [near, far] in pieces {
        let near = near.max(reached);
        if far > near {
            sum += far * far - near * near;
            reached = far;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::mesh::ring;
    use super::*;
    use std::f64::consts::PI;

    fn flat(radii: &[f64], to: impl Fn([f64; 2]) -> Vec3) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let cloth = ring(radii, 0.004);
        (cloth.place(to), cloth.triangles)
    }

    #[test]
    fn cloth_that_lies_flat_shades_all_of_itself() {
        let (at, triangles) = flat(&[0.088, 0.092, 0.11, 0.13, 0.15], |[x, y]| Vec3::new(x, 0.3, -y));
        let s = shadow(&at, &triangles, 0.09);
        assert!((s.area / (PI * 0.15 * 0.15) - 1.0).abs() < 5e-4, "{}", s.area);
        assert!(s.outline.iter().all(|r| (r - 0.15).abs() < 1e-4));
    }

    #[test]
    fn an_ellipse_is_read_along_its_axes() {
        let (at, triangles) = flat(&[0.05, 0.08, 0.1], |[x, y]| Vec3::new(1.2 * x, 0.0, -0.8 * y));
        let s = shadow(&at, &triangles, 0.03);
        assert!((s.outline[0] - 0.12).abs() < 1e-4 && (s.outline[RAYS / 4] - 0.08).abs() < 1e-4);
        // A hole stays light between the disc and the inner rim.
        let expected = PI * (0.12 * 0.08 - 0.06 * 0.04 + 0.03 * 0.03);
        assert!((s.area / expected - 1.0).abs() < 2e-3, "{} {expected}", s.area);
    }

    #[test]
    fn layers_over_each_other_shade_once() {
        let (at, triangles) = flat(&[0.09, 0.12], |[x, y]| Vec3::new(x, 0.0, -y));
        let once = shadow(&at, &triangles, 0.09).area;
        let twice: Vec<[u32; 3]> = triangles.iter().chain(&triangles).copied().collect();
        assert_eq!(shadow(&at, &twice, 0.09).area, once);
    }
}
