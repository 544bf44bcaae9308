//! Reflections that carry one stored piece onto another, or onto itself.

use super::features::Features;
use toile_garment::Vec2;
use toile_garment::mesh::PieceMesh;

/// Distance up to which two outlines are the same, metres.
const SAME_OUTLINE: f64 = 2e-4;

/// A reflection of the plane: `x ↦ M x + t` with `M = [[c, s], [s, −c]]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflection {
    c: f64,
    s: f64,
    t: Vec2,
}

impl Reflection {
    /// The one that carries points best onto others, in the mean of squares.
    #[must_use]
    pub fn best(from: &[Vec2], onto: &[Vec2]) -> Self {
        let n = from.len().max(1) as f64;
        let (a, b) = (from.iter().sum::<Vec2>() / n, onto.iter().sum::<Vec2>() / n);
        let (mut c, mut s) = (0.0, 0.0);
        for (p, q) in from.iter().map(|p| p - a).zip(onto.iter().map(|q| q - b)) {
            c += p.x * q.x - p.y * q.y;
            s += p.x * q.y + p.y * q.x;
        }
        let norm = libm::hypot(c, s);
        let (c, s) = if norm > 0.0 { (c / norm, s / norm) } else { (1.0, 0.0) };
        let turned = Self { c, s, t: Vec2::zeros() };
        Self { t: b - turned.turned(a), ..turned }
    }

    /// The image of a point.
    #[must_use]
    pub fn of(&self, p: Vec2) -> Vec2 {
        self.turned(p) + self.t
    }

    /// The image of a direction.
    #[must_use]
    pub fn turned(&self, d: Vec2) -> Vec2 {
        Vec2::new(self.c * d.x + self.s * d.y, self.s * d.x - self.c * d.y)
    }

    /// The reflection that undoes this one.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self { t: -self.turned(self.t), ..*self }
    }
}

/// All reflections that carry the outline of one piece onto that of another.
#[must_use]
pub fn between(p: (&PieceMesh, &Features), q: (&PieceMesh, &Features)) -> Vec<Reflection> {
    let corners = |(mesh, features): (&PieceMesh, &Features)| -> Vec<Vec2> {
        features.corners.iter().map(|c| mesh.rest[c.at[1] as usize]).collect()
    };
    let (from, onto) = (corners(p), corners(q));
    let n = from.len();
    if n < 2 || n != onto.len() {
        return Vec::new();
    }
    let (Some(a), Some(b)) = (outline(p.0), outline(q.0)) else { return Vec::new() };
    if (length(&a) - length(&b)).abs() > 1e-2 * length(&a) {
        return Vec::new();
    }
    (0..n)
        .map(|k| (0..n).map(|i| onto[(k + n - i) % n]).collect::<Vec<_>>())
        .map(|image| (Reflection::best(&from, &image), image))
        .filter(|(r, image)| from.iter().zip(image).all(|(p, q)| (r.of(*p) - q).norm() <= SAME_OUTLINE))
        .map(|(r, _)| r)
        .filter(|r| a.iter().all(|p| distance(r.of(*p), &b) <= SAME_OUTLINE))
        .collect()
}

fn outline(mesh: &PieceMesh) -> Option<Vec<Vec2>> {
    Some(mesh.outline()?.vertices.iter().map(|v| mesh.rest[*v as usize]).collect())
}

fn sides(line: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> {
    line.iter().copied().zip(line.iter().copied().cycle().skip(1))
}

fn length(line: &[Vec2]) -> f64 {
    sides(line).map(|(a, b)| (b - a).norm()).sum()
}

/// Distance of a point from a closed line.
fn distance(p: Vec2, line: &[Vec2]) -> f64 {
    let to = |(a, b): (Vec2, Vec2)| {
        let d = b - a;
        let t = ((p - a).dot(&d) / d.norm_squared().max(1e-24)).clamp(0.0, 1.0);
        (a + d * t - p).norm()
    };
    sides(line).map(to).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_reflection_is_found_and_undone() {
        let p = [Vec2::new(0.1, 0.2), Vec2::new(0.5, 0.1), Vec2::new(0.3, 0.7)];
        let known = Reflection { c: libm::cos(0.8), s: libm::sin(0.8), t: Vec2::new(0.3, -0.2) };
        let q = p.map(|p| known.of(p));
        let found = Reflection::best(&p, &q);
        for (p, q) in p.iter().zip(&q) {
            assert!((found.of(*p) - q).norm() < 1e-14);
            assert!((found.inverse().of(*q) - p).norm() < 1e-14);
        }
    }
}
