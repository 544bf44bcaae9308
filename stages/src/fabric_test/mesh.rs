//! Even meshes of strips and rings. No chance is in them: the same sizes give the same mesh.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};
use toile_garment::Vec3;

/// Height of an even triangle over its edge.
pub const ROW: f64 = 0.866_025_403_784_438_6;

/// Cloth that lies flat.
#[derive(Clone, Debug, Default)]
pub struct Flat {
    /// Places in the specimen's own plane, m.
    pub at: Vec<[f64; 2]>,
    /// The same places in the cloth's axes: weft, warp.
    pub rest: Vec<[f64; 2]>,
    /// Triangles, all turned alike.
    pub triangles: Vec<[u32; 3]>,
}

impl Flat {
    fn new(at: Vec<[f64; 2]>, triangles: Vec<[u32; 3]>) -> Self {
        Self { rest: at.clone(), at, triangles }
    }

    /// Cut with the warp along `[cosine, sine]` of the angle from the specimen's second axis to its first.
    pub fn cut_along(mut self, [along, aside]: [f64; 2]) -> Self {
        self.rest = self.at.iter().map(|[x, y]| [along * x - aside * y, aside * x + along * y]).collect();
        self
    }

    /// Cut on the bias: both yarns at 45° to the specimen's length.
    pub fn cut_on_bias(self) -> Self {
        self.cut_along([FRAC_1_SQRT_2, FRAC_1_SQRT_2])
    }

    /// Vertices whose place in the specimen answers to this.
    pub fn pick(&self, is: impl Fn([f64; 2]) -> bool) -> Vec<u32> {
        (0u32..).zip(&self.at).filter(|(_, p)| is(**p)).map(|(i, _)| i).collect()
    }

    /// Every vertex where its place says.
    pub fn place(&self, to: impl Fn([f64; 2]) -> Vec3) -> Vec<Vec3> {
        self.at.iter().map(|p| to(*p)).collect()
    }

    /// Rest area of a triangle, m².
    pub fn area(&self, t: &[u32; 3]) -> f64 {
        let [a, b, c] = t.map(|i| self.at[i as usize]);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    }

    /// Sum of rest areas times heights (y), m³.
    pub fn moment(&self, at: &[Vec3]) -> f64 {
        self.triangles.iter().map(|t| self.area(t) * t.iter().map(|v| at[*v as usize].y).sum::<f64>() / 3.0).sum()
    }
}

/// A strip from the origin: `columns` cells over the width (first axis), `rows` along the length (second axis), every
/// second row shifted by half a cell.
pub fn strip([width, length]: [f64; 2], columns: usize, rows: usize) -> Flat {
    let cell = width / columns as f64;
    let mut at: Vec<[f64; 2]> = Vec::new();
    let mut lines: Vec<Vec<u32>> = Vec::new();
    for j in 0..=rows {
        let shift = if j % 2 == 1 { 0.5 } else { 0.0 };
        let inner = (0..columns).map(|i| (i as f64 + shift) * cell);
        let first = if j % 2 == 1 { Some(0.0) } else { None };
        let begin = index(at.len());
        at.extend(first.into_iter().chain(inner).chain([width]).map(|x| [x, j as f64 * length / rows as f64]));
        lines.push((begin..index(at.len())).collect());
    }
    let mut triangles = Vec::new();
    for pair in lines.windows(2) {
        between(&pair[0], &pair[1], |v| at[v as usize][0], &mut triangles);
    }
    Flat::new(at, triangles)
}

/// A strip of squares, each cut by both diagonals: on cloth cut on the bias both families of yarns lie along edges, so
/// that yarns which hardly stretch let the triangles shear. Across other triangles they lock.
pub fn crossed_strip([width, length]: [f64; 2], columns: usize, rows: usize) -> Flat {
    let (dx, dy) = (width / columns as f64, length / rows as f64);
    let corners = (0..=rows).flat_map(|j| (0..=columns).map(move |i| [i as f64 * dx, j as f64 * dy]));
    let centres = (0..rows).flat_map(|j| (0..columns).map(move |i| [(i as f64 + 0.5) * dx, (j as f64 + 0.5) * dy]));
    let at: Vec<[f64; 2]> = corners.chain(centres).collect();
    let corner = |i: usize, j: usize| index(j * (columns + 1) + i);
    let mut triangles = Vec::new();
    for j in 0..rows {
        for i in 0..columns {
            let centre = index((rows + 1) * (columns + 1) + j * columns + i);
            let around = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            triangles.extend((0..4).map(|k| [around[k], around[(k + 1) % 4], centre]));
        }
    }
    Flat::new(at, triangles)
}

/// Concentric circles of vertices `edge` apart around the origin, at rising radii.
pub fn ring(radii: &[f64], edge: f64) -> Flat {
    let mut at: Vec<[f64; 2]> = Vec::new();
    let mut angles: Vec<f64> = Vec::new();
    let mut circles: Vec<Vec<u32>> = Vec::new();
    for (k, r) in radii.iter().enumerate() {
        let count = (TAU * r / edge).round().max(6.0) as u32;
        let shift = if k % 2 == 1 { 0.5 } else { 0.0 };
        let begin = index(at.len());
        let turns = (0..count).map(|i| (f64::from(i) + shift) * TAU / f64::from(count));
        angles.extend(turns.clone());
        at.extend(turns.map(|a| [r * libm::cos(a), r * libm::sin(a)]));
        circles.push((begin..index(at.len())).collect());
    }
    // Each circle ends where it begins, a full turn on.
    let mut triangles = Vec::new();
    let n = index(at.len());
    let ends: Vec<f64> = circles.iter().map(|c| angles[c[0] as usize] + TAU).collect();
    angles.extend(ends);
    for (k, pair) in circles.windows(2).enumerate() {
        let ends = [n + index(k), n + index(k + 1)];
        let low: Vec<u32> = pair[0].iter().copied().chain([ends[0]]).collect();
        let high: Vec<u32> = pair[1].iter().copied().chain([ends[1]]).collect();
        between(&low, &high, |v| angles[v as usize], &mut triangles);
    }
    let first = |v: u32| if v < n { v } else { circles[(v - n) as usize][0] };
    // Circles run against the sense of rows.
    let triangles = triangles.into_iter().map(|[a, b, c]| [first(a), first(c), first(b)]).collect();
    Flat::new(at, triangles)
}

/// Triangles between two lines of vertices, walking along `place`.
fn between(low: &[u32], high: &[u32], place: impl Fn(u32) -> f64, out: &mut Vec<[u32; 3]>) {
    let (mut i, mut j) = (0, 0);
    while i + 1 < low.len() || j + 1 < high.len() {
        let middle = |line: &[u32], k: usize| line.get(k + 1).map_or(f64::INFINITY, |v| place(line[k]) + place(*v));
        if middle(low, i) <= middle(high, j) {
            out.push([low[i], low[i + 1], high[j]]);
            i += 1;
        } else {
            out.push([low[i], high[j + 1], high[j]]);
            j += 1;
        }
    }
}

fn index(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn areas(flat: &Flat) -> (f64, f64) {
        let areas: Vec<f64> = flat.triangles.iter().map(|t| flat.area(t)).collect();
        (areas.iter().sum(), areas.iter().copied().fold(f64::INFINITY, f64::min))
    }

    #[test]
    fn strips_cover_their_rectangle_evenly() {
        let flat = strip([0.025, 0.05], 6, 13);
        let (sum, least) = areas(&flat);
        assert!((sum - 0.025 * 0.05).abs() < 1e-12);
        assert!(least > 0.2 * sum / flat.triangles.len() as f64);
        assert_eq!(flat.pick(|[_, y]| y < 1e-9).len(), 7);
    }

    #[test]
    fn crossed_strips_have_their_yarns_along_edges() {
        let flat = crossed_strip([0.02, 0.04], 4, 8).cut_on_bias();
        let (sum, least) = areas(&flat);
        assert!((sum - 8e-4).abs() < 1e-12 && (least * flat.triangles.len() as f64 / sum - 1.0).abs() < 1e-9);
        for t in &flat.triangles {
            let [a, b, c] = t.map(|v| flat.rest[v as usize]);
            let along = |p: [f64; 2]| (p[0] - c[0]).abs() < 1e-12 || (p[1] - c[1]).abs() < 1e-12;
            assert!(along(a) && along(b));
        }
    }

    #[test]
    fn rings_close_and_cover_the_annulus() {
        let radii: Vec<f64> = (0..=15).map(|k| 0.09 + 0.004 * f64::from(k)).collect();
        let flat = ring(&radii, 0.0046);
        let (sum, least) = areas(&flat);
        let annulus = PI * (0.15 * 0.15 - 0.09 * 0.09);
        // Chords cut a little off both circles.
        assert!((sum / annulus - 1.0).abs() < 1e-3, "{sum} of {annulus}");
        assert!(least > 0.5 * sum / flat.triangles.len() as f64);
        // A closed ring: as many edges as vertices and triangles together.
        let mut edges: Vec<[u32; 2]> = flat
            .triangles
            .iter()
            .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        assert_eq!(flat.at.len() + flat.triangles.len(), edges.len());
    }
}
