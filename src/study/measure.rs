//! Measures of a drape, and the difference of two drapes.
//!
//! Folded cloth has several states of rest. Two meshes can put the folds of one hem in different places and both be right.
//! Hem heights and girths along the cloth hardly depend on that. Folds dominate the girths by the tape and the distance of
//! the surfaces, so these two count in the same folds alone (`carried.rs`). How far apart the rests of one mesh lie is
//! measured from shaken starts.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use toile_stages::fit::{Hem, Nearest, Surface, along, folds, tape};

/// Girths are looked for at every tenth of the garment's height.
const LEVELS: u32 = 10;
/// A girth is the mean over these heights around its level, as shares of the garment's height: one plane may just graze a
/// fold.
const AROUND: [f64; 5] = [-0.02, -0.01, 0.0, 0.01, 0.02];
/// Where a girth changes by more than this over the height, a height says little about a girth: on shoulders, and where
/// sleeves end.
const STEEPEST: f64 = 1.0;

/// Hem heights and girths of one drape, in a fixed order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Lengths {
    /// Mean height of every free edge above the floor, mm.
    pub hems_mm: Vec<f64>,
    /// Girths along the cloth, mm.
    pub girths_mm: Vec<f64>,
    /// Girths by the tape, mm.
    pub tapes_mm: Vec<f64>,
    /// Depths of the folds of the free edge that has the most, the deepest first, mm.
    #[serde(default)]
    pub folds_mm: Vec<f64>,
}

impl Lengths {
    /// The lengths that make up the error: hem heights and girths along the cloth.
    pub fn mesh_dependent(&self) -> impl Iterator<Item = f64> {
        self.hems_mm.iter().chain(&self.girths_mm).copied()
    }
}

/// How far a drape is from the finest one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Error {
    /// Largest difference of a hem height or girth, mm.
    pub length_mm: f64,
    /// Largest difference of a hem height, mm.
    pub hem_mm: f64,
    /// Largest difference of a girth along the cloth, mm.
    pub girth_mm: f64,
    /// Largest difference of a girth by the tape, mm.
    pub tape_mm: f64,
    /// Distance of the surfaces, both ways, by area: mean, mm.
    pub distance_mean_mm: f64,
    /// 95th percentile, mm.
    pub distance_p95_mm: f64,
    /// Largest, mm.
    pub distance_max_mm: f64,
    /// Difference of the 95th percentile of strain.
    pub strain_p95: f64,
    /// Difference of the elastic energy over that of the finest.
    pub energy_rel: f64,
}

impl Error {
    /// The error that counts, mm: the largest of a hem height, a girth along the cloth, a girth by the tape, and the
    /// distance within which 95 % of the surface lies.
    #[must_use]
    pub fn worst_mm(&self) -> f64 {
        self.length_mm.max(self.tape_mm).max(self.distance_p95_mm)
    }
}

/// Heights at which a garment is measured, metres: for each girth those around its level on the finest drape.
#[must_use]
pub fn levels(finest: &Surface) -> Vec<[f64; 5]> {
    let [low, high] = finest.range();
    let around = |level: u32| AROUND.map(|share| low + (f64::from(level) / f64::from(LEVELS) + share) * (high - low));
    (1..LEVELS).map(around).filter(|at| is_even(finest, at)).collect()
}

/// Does the girth hardly change around this level?
fn is_even(surface: &Surface, at: &[f64; 5]) -> bool {
    let girths = at.map(|y| along(surface, y));
    let steps = girths.windows(2).zip(at.windows(2));
    steps.into_iter().all(|(g, y)| (g[1] - g[0]).abs() <= STEEPEST * (y[1] - y[0]))
}

/// Measures a drape at the given heights.
#[must_use]
pub fn lengths(surface: &Surface, levels: &[[f64; 5]]) -> Lengths {
    let mean = |girth: &dyn Fn(&Surface, f64) -> f64| {
        levels.iter().map(|at| 1e3 * at.iter().map(|y| girth(surface, *y)).sum::<f64>() / at.len() as f64).collect()
    };
    let hems = surface.hems();
    let deep = hems.iter().map(|h| folds(surface, h)).max_by(|a, b| {
        let sum = |depths: &[f64]| depths.iter().sum::<f64>();
        a.len().cmp(&b.len()).then(sum(a).total_cmp(&sum(b)))
    });
    Lengths {
        hems_mm: hems.iter().map(|h: &Hem| 1e3 * h.height).collect(),
        folds_mm: deep.unwrap_or_default().iter().map(|depth| 1e3 * depth).collect(),
        girths_mm: mean(&along),
        tapes_mm: mean(&tape),
    }
}

/// Largest differences of hem heights, of girths along the cloth and of girths by the tape, mm; `None` when the drapes
/// have other hems.
#[must_use]
pub fn difference(a: &Lengths, b: &Lengths) -> Option<[f64; 3]> {
    let largest = |a: &[f64], b: &[f64]| {
        (a.len() == b.len()).then(|| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max))
    };
    let hems = largest(&a.hems_mm, &b.hems_mm)?;
    Some([hems, largest(&a.girths_mm, &b.girths_mm)?, largest(&a.tapes_mm, &b.tapes_mm)?])
}

/// A drape by which another one of the same garment is measured, and their [`distance`]. Where the garment is symmetric, the
/// mirror image is as right: the nearer one is taken.
#[must_use]
pub fn nearer<'s>(drape: &Surface, from: &'s Surface, is_symmetric: bool) -> (Cow<'s, Surface>, [f64; 3]) {
    let straight = distance(drape, from);
    if !is_symmetric || straight[2] == 0.0 {
        return (Cow::Borrowed(from), straight);
    }
    let count = from.points.len().max(1) as f64;
    let middle = from.points.iter().map(|p| p.x).sum::<f64>() / count;
    let mut image = from.clone();
    image.points.iter_mut().for_each(|p| p.x = 2.0 * middle - p.x);
    let mirrored = distance(drape, &image);
    if mirrored[1] < straight[1] { (Cow::Owned(image), mirrored) } else { (Cow::Borrowed(from), straight) }
}

/// Distance of two surfaces, both ways: mean, 95th percentile and largest, mm. Every triangle counts by its area, at
/// its middle; corners count for the largest.
#[must_use]
pub fn distance(a: &Surface, b: &Surface) -> [f64; 3] {
    let mut samples = one_way(a, b);
    samples.extend(one_way(b, a));
    samples.sort_by(|x, y| x.0.total_cmp(&y.0));
    let whole: f64 = samples.iter().map(|s| s.1).sum();
    let mean = samples.iter().map(|(d, area)| d * area).sum::<f64>() / whole.max(f64::MIN_POSITIVE);
    let mut seen = 0.0;
    let p95 = samples.iter().find(|(_, area)| {
        seen += area;
        seen >= 0.95 * whole
    });
    let largest = samples.last().map_or(0.0, |s| s.0);
    [mean, p95.map_or(largest, |s| s.0), largest].map(|d| 1e3 * d)
}

/// Distances from the middles and corners of `from` to `to`, with the area each stands for.
fn one_way(from: &Surface, to: &Surface) -> Vec<(f64, f64)> {
    let tree = Nearest::new(to);
    let mut samples = Vec::new();
    for t in 0..from.triangles.len() {
        let [a, b, c] = from.corners(t);
        let area = 0.5 * (b - a).cross(&(c - a)).norm();
        samples.push((tree.distance(&((a + b + c) / 3.0)), area));
    }
    let mut corners: Vec<u32> = from.triangles.iter().flatten().copied().collect();
    corners.sort_unstable();
    corners.dedup();
    samples.extend(corners.iter().map(|v| (tree.distance(&from.points[*v as usize]), 0.0)));
    samples
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::Vec3;

    /// A tube of `n` sides and `rows` rows around the y axis: radius and height in metres.
    fn tube(n: u32, rows: u32, radius: f64, height: f64) -> Surface {
        let ring = |row: u32| {
            (0..n).map(move |k| {
                let (s, c) = libm::sincos(f64::from(k) * std::f64::consts::TAU / f64::from(n));
                Vec3::new(radius * c, height * f64::from(row) / f64::from(rows), radius * s)
            })
        };
        let cells = (0..rows).flat_map(|row| (0..n).map(move |k| (row * n + k, row * n + (k + 1) % n)));
        let triangles: Vec<_> = cells.flat_map(|(a, b)| [[a, b, a + n], [b, b + n, a + n]]).collect();
        let piece = vec![0; triangles.len()];
        Surface { points: (0..=rows).flat_map(ring).collect(), triangles, piece }
    }

    #[test]
    fn a_wider_tube_is_further_by_its_radius() {
        let (narrow, wide) = (tube(360, 20, 0.20, 0.5), tube(360, 20, 0.21, 0.5));
        let [mean, p95, largest] = distance(&narrow, &wide);
        assert!((mean - 10.0).abs() < 0.02 && (p95 - 10.0).abs() < 0.02 && (largest - 10.0).abs() < 0.02);
        let at = levels(&narrow);
        let [hem, girth, tape] = difference(&lengths(&narrow, &at), &lengths(&wide, &at)).expect("same hems");
        assert!(hem < 1e-9 && [girth, tape].iter().all(|g| (g - std::f64::consts::TAU * 10.0).abs() < 0.01));
    }

    #[test]
    fn the_mirror_image_of_a_symmetric_garment_is_as_right() {
        let mut leans = tube(360, 20, 0.20, 0.5);
        leans.points.iter_mut().for_each(|p| p.x += 0.2 * (p.y - 0.25));
        let mut other = leans.clone();
        other.points.iter_mut().for_each(|p| p.x = -p.x);
        let [one, both] = [false, true].map(|symmetric| nearer(&leans, &other, symmetric).1[1]);
        assert!(one > 5.0 && both < 2.0, "{one}, {both}");
    }

    #[test]
    fn a_girth_is_not_taken_where_cloth_lies_flat() {
        let mut hat = tube(360, 40, 0.2, 1.0);
        for p in hat.points.iter_mut().filter(|p| p.y > 0.65) {
            let shrink = 1.0 - 2.0 * (p.y - 0.65);
            (p.x, p.z) = (p.x * shrink, p.z * shrink);
        }
        assert_eq!(levels(&hat).len(), 6, "below the crown, where girths shrink by 2.5 mm a millimetre");
    }

    #[test]
    fn other_hems_are_not_compared() {
        let a = Lengths { hems_mm: vec![1.0], ..Lengths::default() };
        assert_eq!(difference(&a, &Lengths::default()), None);
    }
}
