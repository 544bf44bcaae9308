//! Boxes with the boxes of their displacements, in single precision.

use crate::Vec3;
use crate::collision::broad_phase::aabb::Aabb;

/// A box and the box of its displacements in single precision, rounded outwards. Four coordinates fit in one
/// register.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SweptBox {
    /// Least and largest coordinates of the box at the beginning of the step, m.
    low: [f32; 4],
    high: [f32; 4],
    /// Least and largest displacements, m.
    least_move: [f32; 4],
    most_move: [f32; 4],
}

/// Bound of the rounding in differences of two swept boxes, over their largest coordinate.
const ROUNDING_OF_SWEPT_BOXES: f64 = 1e-6;

/// Positions and moves of all vertices in single precision, rounded once for all triangles at them.
#[derive(Clone, Debug, Default)]
pub(crate) struct RoundedMotion {
    /// Positions, m.
    at: Vec<[f32; 4]>,
    /// Moves, m.
    by: Vec<[f32; 4]>,
    /// The largest coordinate, m.
    size: f64,
}

impl RoundedMotion {
    /// Sets new positions, and a step from them.
    pub fn set(&mut self, x: &[Vec3], step: &[Vec3]) {
        let mut size = [0.0; 3];
        for p in x.iter().chain(step) {
            (0..3).for_each(|k| size[k] = if p[k].abs() > size[k] { p[k].abs() } else { size[k] });
        }
        self.size = size.into_iter().fold(0.0, f64::max);
        for (target, source) in [(&mut self.at, x), (&mut self.by, step)] {
            target.clear();
            target.extend(source.iter().map(rounded));
        }
    }

    /// Returns the swept box of a triangle, grown by `margin`, m, and by the rounding.
    pub fn swept(&self, margin: f64) -> impl Fn(&[u32; 3]) -> SweptBox + '_ {
        let rounding = ROUNDING_OF_SWEPT_BOXES * (self.size + margin);
        let [margin, rounding, ..] = rounded(&Vec3::new(margin + rounding, rounding, 0.0));
        move |[a, b, c]| {
            let (a, b, c) = (*a as usize, *b as usize, *c as usize);
            let [low, high] = bounds(&self.at[a], &self.at[b], &self.at[c], margin);
            let [least_move, most_move] = bounds(&self.by[a], &self.by[b], &self.by[c], rounding);
            SweptBox { low, high, least_move, most_move }
        }
    }
}

/// The vector in single precision. Boxes are grown by more than this rounding.
#[allow(clippy::cast_possible_truncation)]
#[inline]
pub(crate) fn rounded(p: &Vec3) -> [f32; 4] {
    [p.x as f32, p.y as f32, p.z as f32, 0.0]
}

/// Least and largest coordinates of three points, grown.
#[inline]
fn bounds(a: &[f32; 4], b: &[f32; 4], c: &[f32; 4], grown: f32) -> [[f32; 4]; 2] {
    let mut both = [[0.0; 4]; 2];
    for k in 0..4 {
        both[0][k] = lower(lower(a[k], b[k]), c[k]) - grown;
        both[1][k] = higher(higher(a[k], b[k]), c[k]) + grown;
    }
    both
}

impl SweptBox {
    /// The swept box of nothing.
    pub const NONE: Self = Self { low: [1e30; 4], high: [-1e30; 4], least_move: [1e30; 4], most_move: [-1e30; 4] };

    /// The swept box of a box and the box of its displacements.
    pub fn new(place: &Aabb, moves: &Aabb) -> Self {
        let size = [place.low, place.high, moves.low, moves.high].iter().map(|p| p.amax()).fold(0.0, f64::max);
        let (place, moves) = (place.grown(ROUNDING_OF_SWEPT_BOXES * size), moves.grown(ROUNDING_OF_SWEPT_BOXES * size));
        let [low, high, least_move, most_move] = [place.low, place.high, moves.low, moves.high].map(|p| rounded(&p));
        Self { low, high, least_move, most_move }
    }

    /// The swept box of two swept boxes.
    #[inline]
    pub fn join(&self, o: &Self) -> Self {
        let mut both = *self;
        for k in 0..4 {
            both.low[k] = lower(both.low[k], o.low[k]);
            both.high[k] = higher(both.high[k], o.high[k]);
            both.least_move[k] = lower(both.least_move[k], o.least_move[k]);
            both.most_move[k] = higher(both.most_move[k], o.most_move[k]);
        }
        both
    }

    /// Like [`meet_moving`]: `true` wherever that is true.
    #[inline]
    pub fn meets(&self, o: &Self) -> bool {
        let mut apart = false;
        for k in 0..4 {
            let (come, go) = (self.least_move[k] - o.most_move[k], self.most_move[k] - o.least_move[k]);
            apart |= self.low[k] - o.high[k] + lower(come, 0.0) > 0.0;
            apart |= self.high[k] - o.low[k] + higher(go, 0.0) < 0.0;
        }
        !apart
    }
}

/// The lower of two numbers that are not NaN.
#[inline]
fn lower(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The higher of two numbers that are not NaN.
#[inline]
fn higher(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
