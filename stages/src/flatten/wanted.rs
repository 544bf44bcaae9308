//! The metric that every triangle of a piece should get, and the targets that lead to it.
//!
//! On a rough surface (a scan, a drape that had not settled) the metric is smoothed over a length of cloth. Roughness
//! also makes every length longer. With `F̄` the smoothed gradient of the surface, `F̄ᵀF + FᵀF̄ − F̄ᵀF̄` is the metric
//! without the part that is quadratic in the roughness.

use super::blur::Blur;
use super::metric::{carried, cauchy_green, edges2, edges3, sqrt_spd};
use super::source::{Source, bad_triangle};
use super::system::SystemError;
use nalgebra::{Matrix2, Matrix3x2};
use toile_garment::flat::FlatMetric;
use toile_garment::{Vec2, Vec3};
use toile_stage_api::StageError;

/// Width over which roughness is told from shape, in mean mesh edges. Larger takes curvature for roughness.
const ROUGHNESS_EDGES: f64 = 2.0;

/// What is wanted of a piece.
pub enum Wanted {
    /// The stored piece itself.
    Stored,
    /// A metric in every triangle.
    Metric(Vec<Matrix2<f64>>),
    /// A metric that is known after smoothing alone.
    Smooth(Vec<Matrix2<f64>>, Box<Blur>),
}

impl Wanted {
    /// The metric of a piece; `smooth` (metres) is the width of the smoothing, 0 for none.
    ///
    /// # Errors
    /// When a triangle has no area, or is not finite.
    pub fn of(source: &Source<'_>, metric: FlatMetric, smooth: f64) -> Result<Self, StageError> {
        let stored = source.stored();
        if let Some(k) = stored.iter().map(Matrix2::determinant).position(|d| d.is_nan() || d <= 0.0) {
            return Err(bad_triangle(source, k, "has no area, or lies on its wrong side, in the stored piece"));
        }
        if metric == FlatMetric::Unedited {
            return Ok(Self::Stored);
        }
        let sharp = sharp(source, metric, &stored)?;
        if smooth <= 0.0 {
            return Ok(Self::Metric(sharp));
        }
        blurred(source, metric, smooth).map_err(|e| StageError::Unstable(format!("smoothing failed: {e}")))
    }

    /// Target edges of every triangle. `x` is the answer so far: what the smoothing took from its own metric is given
    /// back, so that a metric which can be flat is not blurred. Without it the wanted metric itself is the target.
    ///
    /// # Errors
    /// When memory runs out.
    pub fn targets(&mut self, source: &Source<'_>, x: Option<&[Vec2]>) -> Result<Vec<Matrix2<f64>>, SystemError> {
        let stored = source.stored();
        let shaped = |metric: &[Matrix2<f64>]| metric.iter().zip(&stored).map(|(c, e)| sqrt_spd(c) * e).collect();
        match (self, x) {
            (Self::Stored, _) => Ok(stored),
            (Self::Metric(metric), _) | (Self::Smooth(metric, _), None) => Ok(shaped(metric)),
            (Self::Smooth(metric, blur), Some(x)) => {
                let own: Vec<Matrix2<f64>> = source
                    .mesh
                    .triangles
                    .iter()
                    .zip(&stored)
                    .map(|(t, e)| {
                        let f = edges2(x, *t) * e.try_inverse().unwrap_or_default();
                        f.transpose() * f
                    })
                    .collect();
                let soft = blur.tensors(&own)?;
                let given_back = |k: usize| {
                    let c = own[k] + metric[k] - soft[k];
                    if is_positive(&c) { c } else { metric[k] }
                };
                Ok(shaped(&(0..own.len()).map(given_back).collect::<Vec<_>>()))
            }
        }
    }

    /// Is the metric known after smoothing alone?
    pub fn is_smooth(&self) -> bool {
        matches!(self, Self::Smooth(..))
    }
}

fn is_positive(c: &Matrix2<f64>) -> bool {
    c.iter().all(|x| x.is_finite()) && c.trace() > 0.0 && c.determinant() > 1e-3
}

/// The metric as the surface has it.
fn sharp(source: &Source<'_>, metric: FlatMetric, stored: &[Matrix2<f64>]) -> Result<Vec<Matrix2<f64>>, StageError> {
    let mut out = Vec::with_capacity(stored.len());
    for (k, (t, e)) in source.mesh.triangles.iter().zip(stored).enumerate() {
        let now = cauchy_green(e, &edges3(source.surface, *t));
        let h = match metric {
            FlatMetric::Carried => {
                cauchy_green(e, &edges3(source.before, *t)).zip(now).and_then(|(b, n)| carried(&b, &n))
            }
            _ => now.as_ref().map(sqrt_spd),
        };
        let good = h.filter(|h| h.iter().all(|x| x.is_finite()) && h.determinant() > 1e-6);
        let h = good.ok_or_else(|| bad_triangle(source, k, "has no area in 3D, or is not finite"))?;
        out.push(h.transpose() * h);
    }
    Ok(out)
}

/// The smoothed metric, free of what roughness adds to lengths.
fn blurred(source: &Source<'_>, metric: FlatMetric, smooth: f64) -> Result<Wanted, SystemError> {
    let (rest, triangles) = (&source.mesh.rest, &source.mesh.triangles);
    let mut blur = Blur::new(rest, triangles, smooth)?;
    let edge = mean_edge(rest, triangles);
    let mut fine = Blur::new(rest, triangles, ROUGHNESS_EDGES * edge)?;
    let now = blur.tensors(&without_roughness(source, source.surface, &mut fine)?)?;
    let wanted = match metric {
        FlatMetric::Carried if source.before != source.surface => {
            let before = blur.tensors(&without_roughness(source, source.before, &mut fine)?)?;
            let edit = |(b, n)| carried(b, n).map_or(*n, |h| h.transpose() * h);
            before.iter().zip(&now).map(edit).collect()
        }
        FlatMetric::Carried => vec![Matrix2::identity(); now.len()],
        _ => now,
    };
    let kept = wanted.into_iter().map(|c| if is_positive(&c) { c } else { Matrix2::identity() }).collect();
    Ok(Wanted::Smooth(kept, Box::new(blur)))
}

fn without_roughness(source: &Source<'_>, p: &[Vec3], fine: &mut Blur) -> Result<Vec<Matrix2<f64>>, SystemError> {
    let gradient: Vec<Matrix3x2<f64>> = source
        .mesh
        .triangles
        .iter()
        .zip(source.stored())
        .map(|(t, e)| edges3(p, *t) * e.try_inverse().unwrap_or_default())
        .collect();
    let mut smooth = vec![Matrix3x2::zeros(); gradient.len()];
    for row in 0..3 {
        let field: Vec<Vec2> = gradient.iter().map(|f| f.row(row).transpose()).collect();
        for (out, soft) in smooth.iter_mut().zip(fine.pair(&field)?) {
            out.set_row(row, &soft.transpose());
        }
    }
    Ok(gradient
        .iter()
        .zip(&smooth)
        .map(|(f, s)| {
            let mixed = s.transpose() * f;
            mixed + mixed.transpose() - s.transpose() * s
        })
        .collect())
}

fn mean_edge(rest: &[Vec2], triangles: &[[u32; 3]]) -> f64 {
    let sides = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| rest[v as usize]);
        (b - a).norm() + (c - b).norm() + (a - c).norm()
    };
    let sum: f64 = triangles.iter().map(sides).sum();
    sum / (3.0 * triangles.len().max(1) as f64)
}
