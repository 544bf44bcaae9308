//! Curves into chords: arcs, ellipses, B-splines and smooth runs through given points.

use super::model::{Spline, Vertex};
use super::{geom, limits};
use toile_garment::Vec2;

/// Most chords of one curve.
const CHORDS: usize = 20_000;

/// Points strictly between the ends of an arc: from `from` to `to` with the given bulge, deviation at most `tol`.
#[must_use]
pub fn bulge(from: Vec2, to: Vec2, bulge: f64, tol: f64) -> Vec<Vec2> {
    let chord = to - from;
    if bulge.abs() < 1e-9 || chord.norm() < 1e-9 {
        return Vec::new();
    }
    let angle = 4.0 * libm::atan(bulge);
    let radius = chord.norm() * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
    // Centre: from the middle of the chord, towards its left for a positive bulge below a half circle.
    let left = Vec2::new(-chord.y, chord.x);
    let center = (from + to) * 0.5 + left * ((1.0 - bulge * bulge) / (4.0 * bulge));
    let start = from - center;
    let n = chords(radius, angle.abs(), tol);
    (1..n).map(|i| center + geom::rotate(start, angle * i as f64 / n as f64)).collect()
}

/// Number of chords for an arc.
fn chords(radius: f64, angle: f64, tol: f64) -> usize {
    let step = 2.0 * libm::acos((1.0 - tol / radius.max(tol)).clamp(-1.0, 1.0));
    let n = libm::ceil(angle / step.clamp(1e-4, 0.35));
    if n.is_finite() { (n as usize).clamp(1, CHORDS) } else { 1 }
}

/// A polyline with its bulges flattened; `true` marks vertices of the file, `false` points added here.
#[must_use]
pub fn polyline(vertices: &[Vertex], closed: bool, tol: f64) -> Vec<(Vec2, bool)> {
    let mut out = Vec::with_capacity(vertices.len());
    for (i, v) in vertices.iter().enumerate() {
        out.push((v.at, true));
        let next =
            if i + 1 < vertices.len() { Some(vertices[i + 1]) } else { vertices.first().copied().filter(|_| closed) };
        if let Some(next) = next {
            out.extend(bulge(v.at, next.at, v.bulge, tol).into_iter().map(|p| (p, false)));
        }
        if out.len() > limits::OUTLINE_POINTS {
            break;
        }
    }
    out
}

/// An elliptic arc counter-clockwise from `start` to `end` (parameters, radians); a whole turn when they agree.
#[must_use]
pub fn ellipse(center: Vec2, major: Vec2, ratio: f64, start: f64, end: f64, tol: f64) -> Vec<Vec2> {
    let turn = 2.0 * std::f64::consts::PI;
    let mut sweep = libm::fmod(end - start, turn);
    if sweep <= 1e-9 {
        sweep += turn;
    }
    let minor = Vec2::new(-major.y, major.x) * ratio;
    let n = chords(major.norm().max(minor.norm()), sweep, tol).max(8);
    (0..=n)
        .map(|i| {
            let t = start + sweep * i as f64 / n as f64;
            center + major * libm::cos(t) + minor * libm::sin(t)
        })
        .collect()
}

impl Spline {
    /// Can it be evaluated?
    ///
    /// # Errors
    /// One sentence with the numbers that do not fit together.
    pub fn check(&self) -> Result<(), String> {
        if self.control.is_empty() {
            return if self.fit.len() >= 2 { Ok(()) } else { Err("a SPLINE without control or fit points".into()) };
        }
        if self.degree < 1 || self.degree > limits::SPLINE_DEGREE {
            return Err(format!("a SPLINE of degree {}; 1 to {} can be read", self.degree, limits::SPLINE_DEGREE));
        }
        let need = self.control.len() + self.degree + 1;
        if self.control.len() <= self.degree || self.knots.len() != need {
            let (control, knots) = (self.control.len(), self.knots.len());
            return Err(format!("a SPLINE of degree {} with {control} control points and {knots} knots", self.degree));
        }
        if self.knots.windows(2).any(|k| k[1] < k[0]) {
            return Err("the knots of a SPLINE fall".into());
        }
        if !self.weights.is_empty()
            && (self.weights.len() != self.control.len() || self.weights.iter().any(|w| *w <= 0.0))
        {
            return Err("the weights of a SPLINE do not fit its control points".into());
        }
        if self.knots[self.control.len()] <= self.knots[self.degree] {
            return Err("the knots of a SPLINE span nothing".into());
        }
        Ok(())
    }

    /// The curve as chords, deviation about `tol`. The spline must have passed [`Self::check`].
    #[must_use]
    pub fn flatten(&self, tol: f64) -> Vec<Vec2> {
        if self.control.is_empty() {
            return through(&self.fit, self.flags & 1 != 0, tol);
        }
        let mut spans: Vec<(f64, f64)> =
            self.knots[self.degree..=self.control.len()].windows(2).map(|k| (k[0], k[1])).collect();
        spans.retain(|(a, b)| b > a);
        let mut out = Vec::new();
        for (a, b) in &spans {
            let curve = |t: f64| self.at(a + (b - a) * t);
            let piece = sample(curve, tol, CHORDS / spans.len().max(1));
            let skip = usize::from(!out.is_empty());
            out.extend(piece.into_iter().skip(skip));
        }
        out
    }

    /// De Boor's recursion in homogeneous coordinates.
    fn at(&self, t: f64) -> Vec2 {
        let (p, n) = (self.degree, self.control.len());
        let mut k = self.knots.partition_point(|u| *u <= t).saturating_sub(1).clamp(p, n - 1);
        while k > p && self.knots[k + 1] <= self.knots[k] {
            k -= 1;
        }
        let weight = |i: usize| self.weights.get(i).copied().unwrap_or(1.0);
        let mut d: Vec<[f64; 3]> = (0..=p)
            .map(|j| {
                let (c, w) = (self.control[j + k - p], weight(j + k - p));
                [c.x * w, c.y * w, w]
            })
            .collect();
        for r in 1..=p {
            for j in (r..=p).rev() {
                let (low, high) = (self.knots[j + k - p], self.knots[j + 1 + k - r]);
                let a = if high > low { (t - low) / (high - low) } else { 0.0 };
                let before = d[j - 1];
                for (now, before) in d[j].iter_mut().zip(before) {
                    *now = (1.0 - a) * before + a * *now;
                }
            }
        }
        Vec2::new(d[p][0] / d[p][2], d[p][1] / d[p][2])
    }
}

/// Samples a curve on 0..1: as many equal steps as keep the middle of each chord within `tol`, ends included.
fn sample(curve: impl Fn(f64) -> Vec2, tol: f64, most: usize) -> Vec<Vec2> {
    let mut n = 4_usize;
    loop {
        let points: Vec<Vec2> = (0..=n).map(|i| curve(i as f64 / n as f64)).collect();
        let worst = (0..n)
            .map(|i| geom::point_segment(curve((i as f64 + 0.5) / n as f64), points[i], points[i + 1]).0)
            .fold(0.0, f64::max);
        if worst <= tol || n * 2 > most.max(8) {
            return points;
        }
        n *= 2;
    }
}

/// A smooth curve through all points (centripetal Catmull–Rom, ends free), as chords.
#[must_use]
pub fn through(points: &[Vec2], closed: bool, tol: f64) -> Vec<Vec2> {
    let mut run = points.to_vec();
    if closed && points.len() > 2 && (points[0] - points[points.len() - 1]).norm() > 1e-9 {
        run.push(points[0]);
    }
    let mut out: Vec<Vec2> = run.first().copied().into_iter().collect();
    for (i, inner) in smooth(&run, tol).into_iter().enumerate() {
        out.extend(inner);
        out.push(run[i + 1]);
    }
    out
}

/// For each chord of a run, the points to put between its ends so that the run becomes smooth.
///
/// Hermite form of the centripetal Catmull–Rom spline; the parameter step is the square root of the chord. At a free
/// end the tangent makes the first span a parabola, which follows an arc much better than a straight end does.
#[must_use]
pub fn smooth(run: &[Vec2], tol: f64) -> Vec<Vec<Vec2>> {
    let n = run.len();
    if n < 3 {
        return vec![Vec::new(); n.saturating_sub(1)];
    }
    let h: Vec<f64> = run.windows(2).map(|w| libm::sqrt((w[1] - w[0]).norm()).max(1e-6)).collect();
    let slope: Vec<Vec2> = run.windows(2).zip(&h).map(|(w, h)| (w[1] - w[0]) / *h).collect();
    let mut tangent = vec![Vec2::zeros(); n];
    for i in 1..n - 1 {
        tangent[i] = (slope[i - 1] * h[i] + slope[i] * h[i - 1]) / (h[i - 1] + h[i]);
    }
    tangent[0] = slope[0] * 2.0 - tangent[1];
    tangent[n - 1] = slope[n - 2] * 2.0 - tangent[n - 2];
    (0..n - 1)
        .map(|i| {
            let curve = |t: f64| {
                let (t2, t3) = (t * t, t * t * t);
                run[i] * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + tangent[i] * (h[i] * (t3 - 2.0 * t2 + t))
                    + run[i + 1] * (3.0 * t2 - 2.0 * t3)
                    + tangent[i + 1] * (h[i] * (t3 - t2))
            };
            let points = sample(curve, tol, 256);
            points[1..points.len() - 1].to_vec()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_circle_by_bulge() {
        let (a, b) = (Vec2::new(200.0, 0.0), Vec2::new(200.0, 100.0));
        let arc = bulge(a, b, 1.0, 0.05);
        let center = Vec2::new(200.0, 50.0);
        assert!(arc.iter().all(|p| ((p - center).norm() - 50.0).abs() < 1e-9 && p.x > 200.0));
        // Sagitta of the chords stays under the tolerance.
        assert!(50.0 - ((arc[0] + arc[1]) * 0.5 - center).norm() <= 0.05);
        let back = bulge(a, b, -1.0, 0.05);
        assert!(back.iter().all(|p| p.x < 200.0));
    }

    #[test]
    fn quarter_circle_as_rational_spline() {
        let w = libm::sqrt(0.5);
        let spline = Spline {
            degree: 2,
            flags: 4,
            knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            weights: vec![1.0, w, 1.0],
            control: vec![Vec2::new(10.0, 0.0), Vec2::new(10.0, 10.0), Vec2::new(0.0, 10.0)],
            fit: vec![],
        };
        spline.check().expect("good spline");
        let points = spline.flatten(0.01);
        assert!(points.iter().all(|p| (p.norm() - 10.0).abs() < 1e-9));
        assert!((points[points.len() - 1] - Vec2::new(0.0, 10.0)).norm() < 1e-12);
    }

    #[test]
    fn smooth_run_follows_a_circle() {
        let run: Vec<Vec2> =
            (0..=6).map(|i| geom::rotate(Vec2::new(100.0, 0.0), f64::from(i) * 15.0_f64.to_radians())).collect();
        let curve = through(&run, false, 0.02);
        let worst = curve.iter().map(|p| (p.norm() - 100.0).abs()).fold(0.0, f64::max);
        assert!(worst < 0.05, "{worst} mm off a circle of 100 mm");
    }

    #[test]
    fn ellipse_stays_on_itself() {
        let points = ellipse(Vec2::new(1.0, 2.0), Vec2::new(30.0, 0.0), 0.5, 0.0, 0.0, 0.05);
        for p in points {
            let (x, y) = ((p.x - 1.0) / 30.0, (p.y - 2.0) / 15.0);
            assert!((x * x + y * y - 1.0).abs() < 1e-9);
        }
    }
}
