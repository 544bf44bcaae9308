//! The error is estimated from the meshes alone: from two levels, or from a whole ladder of levels.
//!
//! Richardson's rule supposes `q(h) = q + C h^p`. A coarser mesh H then gives the error at h as
//! `|q(H) − q(h)| / ((H/h)^p − 1)`. The distance to the result of a still finer mesh f is
//! `|q(H) − q(h)| (h^p − f^p) / (H^p − h^p)`.

use super::measure::{Lengths, difference};
use serde::{Deserialize, Serialize};

/// Order of hem heights and girths in the edge length. Linear triangles give energies of second order on smooth shapes.
/// Contact and folds that are a few edges wide leave lengths of a garment little more than the first order. Over the
/// ladders of the three samples, orders from 1 to 1.5 fit alike. With this order no estimate is twice or half the error.
pub const ORDER: f64 = 1.25;

/// One mesh: its edge length in mm and what was measured.
#[derive(Clone, Copy, Debug)]
pub struct Level<'a> {
    /// Edge length, mm.
    pub edge: f64,
    /// Hem heights and girths.
    pub lengths: &'a Lengths,
}

fn power(edge: f64) -> f64 {
    libm::pow(edge, ORDER)
}

/// Estimated largest error of a hem height or girth on `this` mesh, mm, against the limit of fine meshes, or against the
/// result of a mesh of the edge length `finest`. `None` when the levels cannot be compared.
#[must_use]
pub fn estimate(coarser: Level<'_>, this: Level<'_>, finest: Option<f64>) -> Option<f64> {
    let [hem, girth, _] = difference(coarser.lengths, this.lengths)?;
    let (step, rest) = (power(coarser.edge) - power(this.edge), power(this.edge) - finest.map_or(0.0, power));
    (step > 0.0).then(|| hem.max(girth) * rest.max(0.0) / step)
}

/// Estimated error of the first of these levels, mm. The levels go from fine to coarse. Three levels give a trend, two a
/// difference. The error is against the limit, or against the result of a mesh of the edge length `finest`. No mesh
/// finer than the first level is used.
#[must_use]
pub fn error_of(levels: &[Level<'_>], finest: Option<f64>) -> Option<f64> {
    let [this, coarser, ..] = levels else { return None };
    match lines(levels) {
        Some(lines) => Some(lines.iter().fold(0.0, |most: f64, line| most.max(off(*line, this.edge, finest)))),
        None => estimate(*coarser, *this, finest),
    }
}

/// Distance of the surface of the finest mesh from the limit of fine meshes, mm: its edge length, then edge length and
/// distance from it of coarser meshes. The distances are supposed to follow `C (h^p − f^p)`. `None` without coarser ones.
#[must_use]
pub fn surface_to_limit(finest: f64, coarser: &[(f64, f64)]) -> Option<f64> {
    let step = |edge: f64| power(edge) - power(finest);
    let square: f64 = coarser.iter().map(|(edge, _)| step(*edge) * step(*edge)).sum();
    let product: f64 = coarser.iter().map(|(edge, distance)| step(*edge) * distance).sum();
    (square > 0.0).then(|| product / square * power(finest))
}

/// How lengths follow the edge length over a whole ladder of meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Trend {
    /// Steepest slope of a hem height or girth over the edge length to the power of [`ORDER`], mm.
    pub slope: f64,
    /// Largest standard deviation of a hem height or girth from its line, mm: what folds and friction decide, not the
    /// mesh.
    pub scatter_mm: f64,
}

impl Trend {
    /// Straight lines through the lengths of at least three levels (least squares). Two neighbours alone would take the
    /// scatter for a slope.
    #[must_use]
    pub fn of(levels: &[Level<'_>]) -> Option<Self> {
        lines(levels).map(|lines| {
            lines.iter().fold(Self::default(), |t, [slope, scatter]| Self {
                slope: t.slope.max(slope.abs()),
                scatter_mm: t.scatter_mm.max(*scatter),
            })
        })
    }

    /// Error on a mesh of this edge length against the limit, or against a mesh of the edge length `finest`, mm. Slope and
    /// scatter have nothing to do with each other, so their squares add up.
    #[must_use]
    pub fn error(&self, edge: f64, finest: Option<f64>) -> f64 {
        off([self.slope, self.scatter_mm], edge, finest)
    }
}

/// The error of a figure by the line of its trend. Every mesh scatters: two of them differ by √2 of one's deviation.
fn off([slope, scatter]: [f64; 2], edge: f64, finest: Option<f64>) -> f64 {
    match finest {
        Some(finest) => libm::hypot(slope * (power(edge) - power(finest)), std::f64::consts::SQRT_2 * scatter),
        None => libm::hypot(slope * power(edge), scatter),
    }
}

/// The line of every hem height and girth through at least three levels.
fn lines(levels: &[Level<'_>]) -> Option<Vec<[f64; 2]>> {
    let [first, _, _, ..] = levels else { return None };
    let edges: Vec<f64> = levels.iter().map(|l| power(l.edge)).collect();
    let of = |k: usize| {
        let values: Option<Vec<f64>> = levels.iter().map(|l| l.lengths.mesh_dependent().nth(k)).collect();
        line(&edges, &values?)
    };
    (0..first.lengths.mesh_dependent().count()).map(of).collect()
}

/// Slope of the line through at least three points, and their standard deviation from it: the line took two degrees of
/// freedom.
fn line(x: &[f64], y: &[f64]) -> Option<[f64; 2]> {
    let n = x.len() as f64;
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let sxx: f64 = x.iter().map(|x| (x - mx) * (x - mx)).sum();
    let sxy: f64 = x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum();
    let slope = (sxx > 0.0).then(|| sxy / sxx)?;
    let rest = x.iter().zip(y).map(|(x, y)| y - my - slope * (x - mx));
    Some([slope, (rest.map(|r| r * r).sum::<f64>() / (n - 2.0)).sqrt()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_error_of_a_quantity_of_that_order() {
        let at = |h: f64| Lengths {
            hems_mm: vec![300.0 + 0.5 * power(h)],
            girths_mm: vec![900.0 - 0.8 * power(h)],
            ..Lengths::default()
        };
        let (coarse, fine) = (at(16.0), at(11.0));
        let levels = (Level { edge: 16.0, lengths: &coarse }, Level { edge: 11.0, lengths: &fine });
        let all = estimate(levels.0, levels.1, None).expect("levels");
        assert!((all - 0.8 * power(11.0)).abs() < 1e-9);
        let to_finest = estimate(levels.0, levels.1, Some(8.0)).expect("levels");
        assert!((to_finest - 0.8 * (power(11.0) - power(8.0))).abs() < 1e-9);
        assert_eq!(estimate(levels.1, levels.0, None), None, "the coarser one comes first");
    }

    #[test]
    fn the_surface_of_the_finest_is_as_far_off_as_the_ladder_says() {
        let ladder = [32.0, 22.0, 16.0].map(|edge| (edge, 0.3 * (power(edge) - power(8.0))));
        let off = surface_to_limit(8.0, &ladder).expect("a ladder");
        assert!((off - 0.3 * power(8.0)).abs() < 1e-9);
        assert_eq!(surface_to_limit(8.0, &[]), None);
    }

    #[test]
    fn scatter_is_not_taken_for_a_slope() {
        let off = [0.0, 0.6, -0.6, 0.6, -0.6];
        let edges = [32.0, 22.0, 16.0, 11.0, 8.0];
        let all: Vec<Lengths> = edges
            .iter()
            .zip(off)
            .map(|(h, off)| Lengths { hems_mm: vec![300.0 + 0.15 * power(*h) + off], ..Lengths::default() })
            .collect();
        let levels: Vec<Level<'_>> =
            edges.iter().zip(&all).map(|(edge, lengths)| Level { edge: *edge, lengths }).collect();
        let trend = Trend::of(&levels).expect("a trend");
        assert!((trend.slope - 0.15).abs() < 0.015 && (0.5..0.8).contains(&trend.scatter_mm), "{trend:?}");
        assert!((trend.error(8.0, None) - 0.15 * power(8.0)).abs() < 0.5);
        let two = estimate(levels[3], levels[4], None).expect("levels");
        assert!(two > 1.8 * trend.error(8.0, None), "two neighbours: {two}");
        assert_eq!(Trend::of(&levels[..2]), None);
        let fine_first: Vec<Level<'_>> = levels.iter().rev().copied().collect();
        let all = error_of(&fine_first, None).expect("five levels");
        assert!((all - trend.error(8.0, None)).abs() < 1e-12);
        assert_eq!(error_of(&fine_first[..2], None), Some(two), "two levels are two levels");
        assert_eq!(error_of(&fine_first[..1], None), None);
    }
}
