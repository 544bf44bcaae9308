//! Cuts of a body at many heights.

use crate::body::section::{Section, sections};
use toile_garment::Vec3;
use toile_garment::body::Body;

/// Layers into which the triangles are sorted.
const LAYERS: usize = 64;

/// A body whose triangles are sorted by height, to be cut many times.
pub struct Slices<'a> {
    positions: &'a [Vec3],
    layers: Vec<Vec<[u32; 3]>>,
    /// Floor, metres.
    pub low: f64,
    /// Height, metres.
    pub height: f64,
    /// The plane between left and right, metres.
    pub middle: f64,
}

impl<'a> Slices<'a> {
    /// Sorts the triangles.
    pub fn new(body: &'a Body) -> Self {
        let far = Vec3::repeat(f64::INFINITY);
        let (low, high) = body.positions.iter().fold((far, -far), |(l, h), p| (l.inf(p), h.sup(p)));
        let mut out = Self {
            positions: &body.positions,
            layers: vec![Vec::new(); LAYERS],
            low: low.y,
            height: (high.y - low.y).max(0.0),
            middle: 0.5 * (low.x + high.x),
        };
        for t in &body.triangles {
            let ys = t.map(|v| body.positions[v as usize].y);
            let first = out.layer(ys.iter().copied().fold(f64::INFINITY, f64::min));
            let last = out.layer(ys.iter().copied().fold(f64::NEG_INFINITY, f64::max));
            (first..=last).for_each(|k| out.layers[k].push(*t));
        }
        out
    }

    fn layer(&self, y: f64) -> usize {
        let share = (y - self.low) / self.height.max(1e-9);
        ((share * LAYERS as f64).max(0.0) as usize).min(LAYERS - 1)
    }

    /// All outlines at a height.
    pub fn cut(&self, y: f64) -> Vec<Section> {
        sections(self.positions, &self.layers[self.layer(y)], Vec3::new(0.0, y, 0.0), Vec3::y())
    }

    /// The outline around the middle at a height.
    pub fn trunk(&self, y: f64) -> Option<Section> {
        let around = |s: &Section| {
            let (low, high) = s.bounds();
            low.x < self.middle - 0.01 && high.x > self.middle + 0.01
        };
        self.cut(y).into_iter().filter(around).max_by(|a, b| a.girth().total_cmp(&b.girth()))
    }

    /// The largest outline beside the middle at a height, on the left for a sign of 1.
    pub fn beside(&self, y: f64, sign: f64) -> Option<Section> {
        let own = self.cut(y).into_iter().filter(|s| sign * (s.centre().x - self.middle) > 0.0);
        own.max_by(|a, b| a.girth().total_cmp(&b.girth()))
    }

    /// Share of the height from which on the trunk begins; any axis may be up.
    pub fn crotch(body: &Body, up: Vec3, side: Vec3) -> Option<f64> {
        let mut turned = body.clone();
        let front = side.cross(&up);
        turned.positions.iter_mut().for_each(|p| *p = Vec3::new(p.dot(&side), p.dot(&up), p.dot(&front)));
        let slices = Slices::new(&turned);
        (20..70).map(|k| f64::from(k) / 100.0).find(|share| slices.trunk(slices.low + share * slices.height).is_some())
    }
}
