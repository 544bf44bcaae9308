//! The outline of a piece as a polygon.

use toile_garment::{Piece, Vec2};

/// A piece as a polygon, counter-clockwise, in its own coordinates, m.
#[derive(Clone, Debug, Default)]
pub struct Polygon {
    /// Corners.
    pub points: Vec<Vec2>,
}

impl Polygon {
    /// The outline of a piece; that of its mesh where it has one.
    #[must_use]
    pub fn of(piece: &Piece) -> Self {
        let meshed = piece.mesh.as_ref().and_then(|mesh| {
            let chain = mesh.outline()?;
            Some(chain.vertices.iter().filter_map(|v| mesh.rest.get(*v as usize).copied()).collect())
        });
        Self { points: meshed.unwrap_or_else(|| piece.outline.positions()) }
    }

    /// The same polygon elsewhere.
    #[must_use]
    pub fn map(&self, place: impl Fn(Vec2) -> Vec2) -> Self {
        Self { points: self.points.iter().map(|p| place(*p)).collect() }
    }

    /// Sides, each from a corner to the next.
    pub fn sides(&self) -> impl Iterator<Item = [Vec2; 2]> + '_ {
        let next = self.points.iter().skip(1).chain(self.points.first());
        self.points.iter().zip(next).map(|(a, b)| [*a, *b])
    }

    /// Area, m².
    #[must_use]
    pub fn area(&self) -> f64 {
        let from = self.points.first().copied().unwrap_or_default();
        self.sides().map(|[a, b]| 0.5 * (a - from).perp(&(b - from))).sum()
    }

    /// Middle of the area.
    #[must_use]
    pub fn centroid(&self) -> Vec2 {
        let from = self.points.first().copied().unwrap_or_default();
        let moment: Vec2 =
            self.sides().map(|[a, b]| ((a - from) + (b - from)) * ((a - from).perp(&(b - from)) / 6.0)).sum();
        let area = self.area();
        if area.abs() > 1e-12 { from + moment / area } else { from }
    }

    /// Lowest and highest coordinates.
    #[must_use]
    pub fn bounds(&self) -> [Vec2; 2] {
        let far = Vec2::repeat(f64::INFINITY);
        self.points.iter().fold([far, -far], |[low, high], p| [low.inf(p), high.sup(p)])
    }

    /// Width and height.
    #[must_use]
    pub fn size(&self) -> Vec2 {
        let [low, high] = self.bounds();
        high - low
    }

    /// The side nearest to a point: its outward unit normal, and the distance, m.
    #[must_use]
    pub fn outwards(&self, p: Vec2) -> (Vec2, f64) {
        let mut best = (Vec2::zeros(), f64::INFINITY);
        for [a, b] in self.sides() {
            let along = b - a;
            let share = ((p - a).dot(&along) / along.norm_squared().max(1e-18)).clamp(0.0, 1.0);
            let away = (p - a - along * share).norm();
            if away < best.1
                && let Some(along) = along.try_normalize(1e-9)
            {
                best = (Vec2::new(along.y, -along.x), away);
            }
        }
        best
    }

    /// Returns `true` if a point lies inside.
    #[must_use]
    pub fn contains(&self, p: Vec2) -> bool {
        let crosses =
            |[a, b]: &[Vec2; 2]| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
        self.sides().filter(crosses).count() % 2 == 1
    }

    /// Returns `true` if two polygons share area.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        let ([low, high], [other_low, other_high]) = (self.bounds(), other.bounds());
        let apart = low.x >= other_high.x || other_low.x >= high.x || low.y >= other_high.y || other_low.y >= high.y;
        let crosses = |[a, b]: [Vec2; 2]| {
            other.sides().any(|[c, d]| {
                let side = |p: Vec2, q: Vec2, r: Vec2| (q - p).perp(&(r - p));
                side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
            })
        };
        !apart
            && (self.points.iter().any(|p| other.contains(*p))
                || other.points.iter().any(|p| self.contains(*p))
                || self.sides().any(crosses))
    }
}

/// Turns a point about the origin, counter-clockwise, rad.
#[must_use]
pub fn turned(p: Vec2, angle: f64) -> Vec2 {
    let (s, c) = libm::sincos(angle);
    Vec2::new(c * p.x - s * p.y, s * p.x + c * p.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64) -> Polygon {
        let points = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.1), (0.0, 0.1)];
        Polygon { points: points.map(|(a, b)| Vec2::new(a + x, b)).to_vec() }
    }

    #[test]
    fn a_rectangle_has_its_measures() {
        let p = square(1.0);
        assert!((p.area() - 0.02).abs() < 1e-12);
        assert!((p.centroid() - Vec2::new(1.1, 0.05)).norm() < 1e-12);
        assert!(p.contains(Vec2::new(1.1, 0.05)) && !p.contains(Vec2::new(0.9, 0.05)));
        let (outwards, away) = p.outwards(Vec2::new(1.21, 0.05));
        assert!((outwards - Vec2::x()).norm() < 1e-12 && (away - 0.01).abs() < 1e-12);
    }

    #[test]
    fn polygons_that_touch_do_not_overlap() {
        assert!(!square(0.0).overlaps(&square(0.2)));
        assert!(square(0.0).overlaps(&square(0.19)));
    }
}
