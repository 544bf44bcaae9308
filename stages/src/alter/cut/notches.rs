//! Notches of a new seam.

use super::Sides;
use super::join::Group;
use toile_garment::notch::{Notch, NotchKind};
use toile_garment::{Piece, Vec2};

/// Depth of a new notch where the piece has none, metres.
const NOTCH_DEPTH: f64 = 4e-3;

/// A notch as the piece has others.
pub fn new_notch(piece: &Piece, at: Vec2) -> Notch {
    let like = piece.notches.first();
    Notch {
        kind: like.map_or(NotchKind::Slit, |n| n.kind),
        at,
        depth: like.map_or(NOTCH_DEPTH, |n| n.depth),
        width: like.map_or(0.0, |n| n.width),
        angle: None,
        on: "boundary".to_owned(),
        name: None,
        source: None,
    }
}

impl Sides<'_, '_> {
    /// The notches of a part: at the points of the darts at the ends of the line, where it crosses darts, and in its
    /// middle.
    pub fn notches(&self, group: &Group) -> Vec<Notch> {
        let points = self.marked();
        // Places that lie near each other need no notch between them.
        let half = self.half().filter(|(_, at)| points.iter().all(|(_, p)| (p - at).norm() > 3.0 * NOTCH_DEPTH));
        let mut places: Vec<Vec2> = Vec::new();
        for (stretch, at) in points.into_iter().chain(half) {
            let path = self.paths.iter().position(|p| p.stretches.contains(&stretch));
            let place = path.and_then(|p| group.motion(p)).map(|m| m.apply(at));
            // Both legs of a closed dart meet in one place.
            places.extend(place.filter(|p| places.iter().all(|q| (p - q).norm() > 1e-6)));
        }
        places.into_iter().map(|at| new_notch(self.piece, at)).collect()
    }

    /// Places with the numbers of their stretches: the points of darts at both ends, and the legs that are crossed.
    fn marked(&self) -> Vec<(usize, Vec2)> {
        let stretches = &self.drawn.stretches;
        let last = stretches.len() - 1;
        let ends = [(0, stretches[0].first()), (last, stretches[last].last())];
        let ends = ends.into_iter().zip(self.ends).filter(|(_, end)| end.dart.is_some());
        let points = ends.filter_map(|((k, at), _)| Some((k, *at?)));
        let legs = self.drawn.crossings.iter().enumerate().flat_map(|(k, crossing)| {
            let [leaves, goes_on] = crossing.ends();
            [(k, leaves), (k + 1, goes_on)]
        });
        points.chain(legs).collect()
    }

    /// The place in the middle of the line, with the number of its stretch.
    fn half(&self) -> Option<(usize, Vec2)> {
        let mut way = self.drawn.length() / 2.0;
        for (k, stretch) in self.drawn.stretches.iter().enumerate() {
            for w in stretch.windows(2) {
                let step = (w[1] - w[0]).norm();
                if way <= step {
                    return Some((k, w[0] + (w[1] - w[0]) * (way / step.max(1e-12))));
                }
                way -= step;
            }
        }
        None
    }
}
