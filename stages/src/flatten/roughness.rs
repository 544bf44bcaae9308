//! The metric of a rough surface, free of what roughness adds to lengths.
//!
//! Every vertex is taken to be off by some vector of variance `σ²` in each coordinate. That adds `3σ² Σ b bᵀ` to the
//! metric of a triangle on average, with `b` the gradients of its shape functions. The size `σ` is found by a filter
//! that lets roughness pass and shape not. Known unit roughness goes through the same filter and says how much passes.

use super::blur::Blur;
use super::metric::{edges3, sqrt_spd};
use super::source::Source;
use super::system::SystemError;
use nalgebra::{Matrix2, Matrix3x2};
use toile_garment::{Vec2, Vec3};

/// Width of the filter that tells roughness from shape, in mean mesh edges. Larger takes curvature for roughness.
const FILTER_EDGES: f64 = 1.0;

type Gradient = Vec<Matrix3x2<f64>>;

/// Width of the smoothing of an edit, in sizes of the roughness. Larger takes real edits for roughness.
const EDIT_WIDTH: f64 = 10.0;

/// Width of the smoothing of a scan's frames, in mean mesh edges, from which on they are used. A smaller width lies far
/// inside the triangles around a vertex, and the roughness is too small beside them to matter.
const FRAME_FROM: f64 = 0.5;

/// The facts about a surface.
#[derive(Clone, Copy, Debug)]
pub enum Surface<'a> {
    /// Nothing else.
    Scan,
    /// The shape before the edit that made it.
    Edited(&'a [Vec3]),
    /// It was edited afterwards.
    Before,
}

/// The metric of a surface over the stored piece, smoothed by `blur`.
///
/// The square of the roughness is averaged, so what is left of it grows with the fineness of the mesh. Where the shape
/// `before` an edit is known, the edit alone is rough. So it is smoothed first, over a length of cloth that comes from
/// the size of the roughness.
///
/// A smoothing cannot be narrower than the mesh: it averages over the triangles around a vertex at least, and so takes
/// a mesh edge of a real edit for roughness. An edit without roughness stays as it is, and so does one whose length of cloth
/// is shorter than the mean mesh edge. Smoothed all the same, a clean edit on edges of 8 mm lost 0.1° of a dart.
///
/// A scan has no shape before. Its stretch is read in a smooth frame instead: roughness then counts once and not squared,
/// and its average is none. A frame that is off by an angle costs the square of it, and only near the tip of a dart.
///
/// # Errors
/// When memory runs out.
pub fn smooth_metric(
    source: &Source<'_>,
    surface: &[Vec3],
    kind: Surface<'_>,
    blur: &mut Blur,
) -> Result<Vec<Matrix2<f64>>, SystemError> {
    let (rest, triangles) = (&source.mesh.rest, &source.mesh.triangles);
    let inverse: Vec<Matrix2<f64>> = source.stored().iter().map(|e| e.try_inverse().unwrap_or_default()).collect();
    let of = |p: &[Vec3]| -> Gradient { triangles.iter().zip(&inverse).map(|(t, i)| edges3(p, *t) * i).collect() };
    let unit: Vec<Vec3> = (0..surface.len()).map(|k| unit_roughness(k as u64)).collect();
    let edge = mean_edge(rest, triangles);
    let mut gauge = Gauge::new(Blur::new(rest, triangles, FILTER_EDGES * edge)?, &inverse, &of(&unit));
    let mut gradient = of(surface);
    let mut variance = gauge.variance(&gradient);
    let width = EDIT_WIDTH * libm::sqrt(variance);
    if matches!(kind, Surface::Scan) && width >= FRAME_FROM * edge {
        let mut near = Blur::new(rest, triangles, width)?;
        let soft = softened(&softened(&gradient, &mut near), &mut near);
        let stretch: Vec<Matrix2<f64>> = gradient.iter().zip(&soft).map(|(f, soft)| along(soft, f)).collect();
        return Ok(blur.tensors(&stretch).iter().map(|s| s * s).collect());
    }
    if let Surface::Edited(before) = kind
        && width >= edge
    {
        let before = of(before);
        let edit: Gradient = gradient.iter().zip(&before).map(|(now, before)| now - before).collect();
        let soft = softened(&edit, &mut Blur::new(rest, triangles, width)?);
        gradient = before.iter().zip(&soft).map(|(before, edit)| before + edit).collect();
        variance = gauge.variance(&gradient);
    }
    let added = Matrix2::new(6.0, 3.0, 3.0, 6.0) * variance;
    let metric: Vec<Matrix2<f64>> =
        gradient.iter().zip(&inverse).map(|(f, i)| f.transpose() * f - i.transpose() * added * i).collect();
    Ok(blur.tensors(&metric))
}

/// The stretch of a gradient in the frame of a smooth one.
fn along(smooth: &Matrix3x2<f64>, f: &Matrix3x2<f64>) -> Matrix2<f64> {
    let frame = smooth * sqrt_spd(&(smooth.transpose() * smooth)).try_inverse().unwrap_or_default();
    let in_frame = frame.transpose() * f;
    (in_frame + in_frame.transpose()) * 0.5
}

/// Measures roughness by a filter.
struct Gauge<'a> {
    filter: Blur,
    inverse: &'a [Matrix2<f64>],
    /// How much of the roughness of variance 1 passes.
    unit: f64,
}

impl<'a> Gauge<'a> {
    fn new(filter: Blur, inverse: &'a [Matrix2<f64>], unit: &Gradient) -> Self {
        let mut gauge = Self { filter, inverse, unit: 0.0 };
        gauge.unit = gauge.passed(unit);
        gauge
    }

    /// The variance of every coordinate of the vertices, m².
    fn variance(&mut self, gradient: &Gradient) -> f64 {
        if self.unit > 0.0 { self.passed(gradient) / self.unit } else { 0.0 }
    }

    fn passed(&mut self, gradient: &Gradient) -> f64 {
        let soft = softened(gradient, &mut self.filter);
        let each = gradient.iter().zip(&soft).zip(self.inverse);
        trimmed_mean(each.map(|((f, s), i)| (f - s).norm_squared() / i.norm_squared()))
    }
}

fn softened(gradient: &Gradient, blur: &mut Blur) -> Gradient {
    let mut out = vec![Matrix3x2::zeros(); gradient.len()];
    for row in 0..3 {
        let field: Vec<Vec2> = gradient.iter().map(|f| f.row(row).transpose()).collect();
        for (out, soft) in out.iter_mut().zip(blur.pair(&field)) {
            out.set_row(row, &soft.transpose());
        }
    }
    out
}

/// A normal vector of variance 1 in each coordinate, always the same for a vertex (the mixing of SplitMix64).
fn unit_roughness(vertex: u64) -> Vec3 {
    let share = |k: u64| {
        let mut z = (6 * vertex + k + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (((z ^ (z >> 31)) >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    };
    let normal =
        |k: u64| libm::sqrt(-2.0 * libm::log(share(2 * k))) * libm::cos(std::f64::consts::TAU * share(2 * k + 1));
    Vec3::new(normal(0), normal(1), normal(2))
}

/// Mean of the smaller nine tenths. The tenth left out is where shape passes the filter: tips of darts, sharp folds.
fn trimmed_mean(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let kept = values.len().div_ceil(10) * 9;
    values.truncate(kept.max(1));
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

fn mean_edge(rest: &[Vec2], triangles: &[[u32; 3]]) -> f64 {
    let sides = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| rest[v as usize]);
        (b - a).norm() + (c - b).norm() + (a - c).norm()
    };
    let sum: f64 = triangles.iter().map(sides).sum();
    sum / (3.0 * triangles.len().max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unit_roughness_has_variance_one_and_no_mean() {
        let all: Vec<Vec3> = (0..20_000).map(unit_roughness).collect();
        let n = all.len() as f64;
        let mean = all.iter().sum::<Vec3>() / n;
        let square = all.iter().map(|v| v.norm_squared()).sum::<f64>() / (3.0 * n);
        assert!(mean.norm() < 0.03 && (square - 1.0).abs() < 0.02, "{mean} {square}");
    }
}
