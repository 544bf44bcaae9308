//! The metric that every triangle of a piece should get, and the targets that lead to it.
//!
//! On a rough surface (a scan, a drape that had not settled) the metric is smoothed over a length of cloth. Roughness
//! also makes every length longer. As much as its size says on average is taken off; see [`super::roughness`].

use super::blur::Blur;
use super::metric::{carried, cauchy_green, edges2, edges3, sqrt_spd};
use super::roughness::{Surface, smooth_metric};
use super::source::{Source, bad_triangle};
use super::system::SystemError;
use nalgebra::Matrix2;
use toile_garment::Vec2;
use toile_garment::flat::FlatMetric;
use toile_stage_api::StageError;

/// Repeats of the solve that give back what the smoothing took from a real edit. More also bring roughness back.
pub const REFINEMENTS: usize = 4;
/// Width of the smoothing as a share of the length that is asked for. The length is then about the diameter of the
/// disc of cloth from which half of an average comes.
const WIDTH_SHARE: f64 = 0.5;

/// The shape that is wanted of a piece.
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
    /// back, so that a metric which can be flat is not blurred. Without it the wanted metric is the target.
    pub fn targets(&mut self, source: &Source<'_>, x: Option<&[Vec2]>) -> Vec<Matrix2<f64>> {
        let stored = source.stored();
        let shaped = |metric: &[Matrix2<f64>]| metric.iter().zip(&stored).map(|(c, e)| sqrt_spd(c) * e).collect();
        match (self, x) {
            (Self::Stored, _) => stored,
            (Self::Metric(metric), _) | (Self::Smooth(metric, _), None) => shaped(metric),
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
                let soft = blur.tensors(&own);
                let given_back = |k: usize| {
                    let c = own[k] + metric[k] - soft[k];
                    if is_positive(&c) { c } else { own[k] }
                };
                shaped(&(0..own.len()).map(given_back).collect::<Vec<_>>())
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
    let mut blur = Blur::new(rest, triangles, WIDTH_SHARE * smooth)?;
    let is_edited = source.before != source.surface;
    let kind = if is_edited { Surface::Edited(source.before) } else { Surface::Scan };
    let now = smooth_metric(source, source.surface, kind, &mut blur)?;
    let wanted = match metric {
        FlatMetric::Carried if is_edited => {
            let before = smooth_metric(source, source.before, Surface::Before, &mut blur)?;
            let edit = |(b, n)| carried(b, n).map_or(*n, |h| h.transpose() * h);
            before.iter().zip(&now).map(edit).collect()
        }
        FlatMetric::Carried => vec![Matrix2::identity(); now.len()],
        _ => now,
    };
    let kept = wanted.into_iter().map(|c| if is_positive(&c) { c } else { Matrix2::identity() }).collect();
    Ok(Wanted::Smooth(kept, Box::new(blur)))
}
