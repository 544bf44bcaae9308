//! Heights of two bodies that belong together.

use crate::body::curve::Curve;
use crate::fit::level_height;
use std::collections::BTreeMap;
use toile_garment::body::Body;

/// Heights at which girth can be added, by the names of the report.
pub const LEVELS: [&str; 4] = ["bust", "under_bust", "waist", "hip"];
/// Further heights that belong together, by the beginning of the names of their landmarks.
const LANDMARKS: [&str; 4] = ["crotch", "underarm", "shoulder", "neck-side"];
/// Heights that lie nearer together on the first body are one, metres.
const APART: f64 = 0.03;

/// Over the height of the first body it tells the height on the second one, and the girth that is added; metres.
#[derive(Clone, Debug)]
pub struct Heights(Curve<2>);

impl Heights {
    /// Heights of `from` and `to` that belong together; `add` is girth by the name of its level.
    pub fn new(from: &Body, to: &Body, add: &BTreeMap<String, f64>) -> Self {
        let mut keys = pairs(from, to);
        keys.sort_by(|a, b| a.0.total_cmp(&b.0));
        let girths = girths(from, add);
        let mut kept: Vec<(f64, [f64; 2])> = Vec::new();
        for (own, other, is_level) in keys {
            let is_near = kept.last().is_some_and(|last| own - last.0 < APART);
            if is_near && !is_level {
                continue;
            }
            // A level decides over what lies beside it.
            if is_near {
                kept.pop();
            }
            kept.push((own, [other - own, girth_at(&girths, own)]));
        }
        Self(Curve::new(&kept))
    }

    /// The height on the second body.
    pub fn moved(&self, height: f64) -> f64 {
        height + self.0.at(height).0[0]
    }

    /// The girth that is added at a height of the first body.
    pub fn added(&self, height: f64) -> f64 {
        self.0.at(height).0[1]
    }
}

/// Heights on both bodies. Is it a level, at which girth can be added?
fn pairs(from: &Body, to: &Body) -> Vec<(f64, f64, bool)> {
    let level = |name: &str| Some((level_height(name, from)?, level_height(name, to)?, true));
    let mark = |body: &Body, name: &str| {
        body.landmarks.iter().find(|(key, _)| key.starts_with(name)).map(|(_, place)| place.y)
    };
    let landmark = |name: &str| Some((mark(from, name)?, mark(to, name)?, false));
    let ends = |body: &Body| {
        let heights = || body.positions.iter().map(|p| p.y);
        [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)]
    };
    let (a, b) = (ends(from), ends(to));
    let mut pairs: Vec<_> = LEVELS.into_iter().filter_map(level).collect();
    pairs.extend(LANDMARKS.into_iter().filter_map(landmark));
    pairs.extend([(a[0], b[0], false), (a[1], b[1], false)]);
    pairs
}

/// Heights of the first body with the girth that is added there, ascending.
fn girths(from: &Body, add: &BTreeMap<String, f64>) -> Vec<(f64, f64)> {
    let known = LEVELS.iter().filter_map(|name| Some((level_height(name, from)?, add.get(*name).copied()?)));
    let mut known: Vec<(f64, f64)> = known.collect();
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    known
}

/// Girth at a height: even between two levels, and that of the last level beyond it.
fn girth_at(known: &[(f64, f64)], height: f64) -> f64 {
    let above = known.iter().find(|k| k.0 >= height);
    let below = known.iter().rev().find(|k| k.0 <= height);
    match (below, above) {
        (Some(a), Some(b)) if b.0 > a.0 => a.1 + (b.1 - a.1) * (height - a.0) / (b.0 - a.0),
        (Some(a), _) => a.1,
        (None, Some(b)) => b.1,
        (None, None) => 0.0,
    }
}
