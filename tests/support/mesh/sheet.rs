//! Rectangles.

use super::{Family, Mesh, delaunay, jitter};
use toile_garment::Vec3;

/// A rectangle: `nx` cells over the width (u, weft), `ny` rows of cells along the length (v, warp), from the origin.
/// An irregular one is left regular where `calm(v)` holds, and its outline keeps its corners.
pub fn sheet(size: [f64; 2], nx: usize, ny: usize, family: Family, calm: impl Fn(f64) -> bool) -> Mesh {
    let [width, length] = size;
    let (dx, dy) = (width / nx as f64, length / ny as f64);
    let mut rest = Vec::new();
    let mut rows: Vec<Vec<usize>> = Vec::new();
    for j in 0..=ny {
        let shifted = family != Family::Right && j % 2 == 1;
        let places: Vec<f64> = if shifted {
            std::iter::once(0.0).chain((0..nx).map(|i| (i as f64 + 0.5) * dx)).chain([width]).collect()
        } else {
            (0..=nx).map(|i| i as f64 * dx).collect()
        };
        rows.push((rest.len()..rest.len() + places.len()).collect());
        rest.extend(places.into_iter().map(|u| [u, j as f64 * dy]));
    }
    let mut triangles = Vec::new();
    for pair in rows.windows(2) {
        join_rows(&rest, &pair[0], &pair[1], family, &mut triangles);
    }
    if family == Family::Irregular {
        let on = |a: f64, b: f64| (a - b).abs() < 1e-12;
        jitter::shake(&mut rest, 0.3 * dx.min(dy), |[u, v]| {
            let (side, end) = (on(u, 0.0) || on(u, width), on(v, 0.0) || on(v, length));
            if calm(v) || end {
                [0.0, 0.0]
            } else if side {
                [0.0, 1.0]
            } else {
                [1.0, 1.0]
            }
        });
        delaunay::flip(&rest, &mut triangles);
    }
    let at = rest.iter().map(|r| Vec3::new(r[0], r[1], 0.0)).collect();
    Mesh { at, rest, triangles }
}

/// A rectangle of square cells, each cut along both diagonals: edges run along yarns that lie at 45°.
pub fn crossed(size: [f64; 2], nx: usize, ny: usize) -> Mesh {
    let [dx, dy] = [size[0] / nx as f64, size[1] / ny as f64];
    let grid = |half: f64, nx: usize, ny: usize| {
        (0..ny).flat_map(move |j| (0..nx).map(move |i| [(i as f64 + half) * dx, (j as f64 + half) * dy]))
    };
    let rest: Vec<[f64; 2]> = grid(0.0, nx + 1, ny + 1).chain(grid(0.5, nx, ny)).collect();
    let middles = (nx + 1) * (ny + 1);
    let cell = |k: usize| {
        let (i, j) = (k % nx, k / nx);
        let ring = [j * (nx + 1) + i, j * (nx + 1) + i + 1, (j + 1) * (nx + 1) + i + 1, (j + 1) * (nx + 1) + i];
        (0..4).map(move |c| [ring[c], ring[(c + 1) % 4], middles + k])
    };
    let triangles = (0..nx * ny).flat_map(cell).collect();
    let at = rest.iter().map(|r| Vec3::new(r[0], r[1], 0.0)).collect();
    Mesh { at, rest, triangles }
}

/// Triangles between two rows: the shorter diagonal first, on squares always the same.
fn join_rows(rest: &[[f64; 2]], low: &[usize], high: &[usize], family: Family, out: &mut Vec<[usize; 3]>) {
    let (mut i, mut j) = (0, 0);
    while i + 1 < low.len() || j + 1 < high.len() {
        let step_low = if i + 1 >= low.len() {
            false
        } else if j + 1 >= high.len() {
            true
        } else if family == Family::Right {
            i == j
        } else {
            rest[low[i + 1]][0] + rest[low[i]][0] <= rest[high[j + 1]][0] + rest[high[j]][0]
        };
        if step_low {
            out.push([low[i], low[i + 1], high[j]]);
            i += 1;
        } else {
            out.push([low[i], high[j + 1], high[j]]);
            j += 1;
        }
    }
}
