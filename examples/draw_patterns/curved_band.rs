//! Bands that are cut from a ring: stands and collars.

use crate::draft::{Edge, at, turned};
use crate::sheet::Draft;
use toile_garment::Vec2;

/// Lengths of a band that is cut from a ring, and its height.
pub struct Curved {
    pub low: f64,
    pub top: f64,
    pub height: f64,
}

/// A band whose longer edge lies below: lower edge, right end, upper edge, left end. The middle of the lower edge is at 0.
pub fn curved(name: &'static str, names: [&'static str; 4], c: Curved) -> Draft {
    let angle = (c.low - c.top) / c.height;
    let radius = c.low / angle;
    let (about, half) = (at(0.0, radius), 0.5 * angle.to_degrees());
    let ends = |r: f64| [-half, half].map(|a| turned(about - at(0.0, r), about, a));
    let ([low_left, low_right], [top_left, top_right]): ([Vec2; 2], [Vec2; 2]) =
        (ends(radius), ends(radius - c.height));
    Draft {
        name,
        edges: vec![
            Edge::start(names[0], low_left).arc(about, 2.0 * half, 24),
            Edge::straight(names[1], low_right, top_right),
            Edge::start(names[2], top_right).arc(about, -2.0 * half, 24),
            Edge::straight(names[3], top_left, low_left),
        ],
        grain: [at(-60.0, 0.5 * c.height + 4.0), at(60.0, 0.5 * c.height + 4.0)],
        // The centre back.
        notches: vec![(0, 0.5 * c.low), (2, 0.5 * c.top)],
        ..Draft::default()
    }
}
