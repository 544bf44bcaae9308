//! Set-in sleeves.

use crate::draft::{Edge, at, left, solve, towards};
use crate::sheet::Draft;
use toile_garment::Vec2;
use toile_garment::piece::Quantity;

/// A sleeve in one piece.
pub struct Sleeve {
    /// Lengths of both halves of the cap: front, back.
    pub caps: [f64; 2],
    /// Width at the underarm.
    pub width: f64,
    /// Width at the hem.
    pub hem: f64,
    /// Underarm to hem.
    pub length: f64,
    /// How far the middle of the hem lies above its ends; the hem is straight at 0.
    pub bow: f64,
    /// Vertices of each half of the cap.
    pub steps: usize,
}

/// One half of the cap, from the underarm at `x` to the top at height `h`.
fn half_cap(x: f64, h: f64, n: usize) -> Edge {
    let s = if x > 0.0 { -1.0 } else { 1.0 };
    Edge::start("cap", at(x, 0.0)).curve(towards(90.0 - s * 84.0), at(0.0, h), at(s, 0.0), [0.48, 0.42], n)
}

impl Sleeve {
    /// Back half and front half of the cap, and its height.
    fn cap(&self) -> (Edge, Edge, f64) {
        let [front, back] = self.caps;
        let width = self.width;
        let cap = |split: f64| {
            let h = solve(40.0, 220.0, |h| half_cap(width - split, h, self.steps).length() - back);
            (half_cap(width - split, h, self.steps), half_cap(-split, h, self.steps), h)
        };
        let split = solve(0.4 * width, 0.6 * width, |s| cap(s).1.length() - front);
        cap(split)
    }

    fn hem(&self, ends: [Vec2; 2], ups: [Vec2; 2]) -> Edge {
        let [left_end, right_end] = ends;
        let edge = Edge::start("hem", left_end);
        if self.bow == 0.0 {
            return edge.line(right_end, 8);
        }
        let middle = 0.5 * (left_end + right_end) + at(0.0, self.bow);
        let level = at(1.0, 0.0);
        edge.curve(-left(ups[0]), middle, level, [0.33; 2], 8).curve(level, right_end, -left(ups[1]), [0.33; 2], 8)
    }

    /// The left sleeve, front to the left: hem, underarm back, cap, underarm front. Notches lie at distances from the
    /// underarm, and one at the top for the shoulder.
    pub fn draft(&self, name: &'static str, back: &[f64], front: &[f64], shift: Vec2) -> Draft {
        let (back_cap, front_cap, h) = self.cap();
        let taper = (self.width - self.hem) / 2.0;
        let ends = [front_cap.first() + at(taper, -self.length), back_cap.first() - at(taper, self.length)];
        let up = |from: Vec2, to: Vec2| (to - from).normalize();
        let hem = self.hem(ends, [up(ends[0], front_cap.first()), up(ends[1], back_cap.first())]);
        let total = back_cap.length() + front_cap.length();
        let edges = vec![
            hem,
            Edge::straight("under-back", ends[1], back_cap.first()),
            back_cap.clone().then(front_cap.clone().reversed()),
            Edge::straight("under-front", front_cap.first(), ends[0]),
        ];
        let under = edges[1].length();
        let mut notches: Vec<_> = back.iter().map(|d| (2, *d)).collect();
        notches.push((2, back_cap.length()));
        notches.extend(front.iter().map(|d| (2, total - d)));
        notches.extend([(1, under - 40.0), (3, 40.0)]);
        Draft {
            name,
            notches,
            edges,
            grain: [at(0.0, 20.0 - self.length), at(0.0, h - 20.0)],
            quantity: Quantity { plain: 1, mirrored: 1 },
            annotation: "FRONT IS LEFT, CUT 1 PAIR",
            shift,
            ..Draft::default()
        }
    }
}
