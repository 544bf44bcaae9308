//! Axis-aligned boxes.

use crate::Vec3;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aabb {
    /// Corner with the least coordinates, m.
    pub low: Vec3,
    /// Corner with the largest coordinates, m.
    pub high: Vec3,
}

impl Aabb {
    /// The box of nothing.
    pub const EMPTY: Self = Self {
        low: Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Vec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The box of some points.
    pub fn of(points: &[Vec3]) -> Self {
        points.iter().fold(Self::EMPTY, |b, p| Self { low: lower_corner(&b.low, p), high: upper_corner(&b.high, p) })
    }

    /// The box of one point.
    #[inline]
    pub fn of_one(p: &Vec3) -> Self {
        Self { low: *p, high: *p }
    }

    /// The box of two points.
    #[inline]
    pub fn of_two(a: &Vec3, b: &Vec3) -> Self {
        Self { low: lower_corner(a, b), high: upper_corner(a, b) }
    }

    /// The box of three points.
    #[inline]
    pub fn of_three(t: &[Vec3; 3]) -> Self {
        Self {
            low: lower_corner(&lower_corner(&t[0], &t[1]), &t[2]),
            high: upper_corner(&upper_corner(&t[0], &t[1]), &t[2]),
        }
    }

    /// The box of two boxes.
    #[inline]
    pub fn join(&self, o: &Self) -> Self {
        Self { low: lower_corner(&self.low, &o.low), high: upper_corner(&self.high, &o.high) }
    }

    /// The box grown on all sides, m.
    #[inline]
    pub fn grown(&self, by: f64) -> Self {
        let d = Vec3::repeat(by);
        Self { low: self.low - d, high: self.high + d }
    }

    /// Do the boxes have a point in common?
    #[inline]
    pub fn meets(&self, o: &Self) -> bool {
        self.low.x <= o.high.x
            && o.low.x <= self.high.x
            && self.low.y <= o.high.y
            && o.low.y <= self.high.y
            && self.low.z <= o.high.z
            && o.low.z <= self.high.z
    }

    /// Distance of another box, m; 0 where they meet.
    pub fn gap(&self, o: &Self) -> f64 {
        (o.low - self.high).sup(&(self.low - o.high)).sup(&Vec3::zeros()).norm()
    }
}

/// The least coordinates of two points. Comparisons without regard for NaN take fewer instructions than `f64::min`.
#[inline]
pub(crate) fn lower_corner(a: &Vec3, b: &Vec3) -> Vec3 {
    let lower = |a: f64, b: f64| if a < b { a } else { b };
    Vec3::new(lower(a.x, b.x), lower(a.y, b.y), lower(a.z, b.z))
}

/// The largest coordinates of two points.
#[inline]
pub(crate) fn upper_corner(a: &Vec3, b: &Vec3) -> Vec3 {
    let higher = |a: f64, b: f64| if a > b { a } else { b };
    Vec3::new(higher(a.x, b.x), higher(a.y, b.y), higher(a.z, b.z))
}

/// May points of two boxes meet while they are displaced by any part, the same for all, of displacements from two
/// other boxes?
#[inline]
pub(crate) fn meet_moving(a: &Aabb, da: &Aabb, b: &Aabb, db: &Aabb) -> bool {
    (0..3).all(|k| {
        let low = a.low[k] - b.high[k] + (da.low[k] - db.high[k]).min(0.0);
        let high = a.high[k] - b.low[k] + (da.high[k] - db.low[k]).max(0.0);
        low <= 0.0 && high >= 0.0
    })
}
