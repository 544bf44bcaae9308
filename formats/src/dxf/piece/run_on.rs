//! Kinds and marks that one size of a nest takes over from the sample size.

use super::DrawnPiece;
use crate::dxf::sheet::Mark;
use crate::dxf::{geom, limits};
use toile_garment::Vec2;

impl DrawnPiece {
    /// Carries kinds and notches over from the sample size.
    pub(crate) fn take_from_sample(&mut self, sample: &Self) -> bool {
        if !self.points.marked && sample.points.marked {
            if !self.boundary.classify_like(&sample.boundary) {
                return false;
            }
            if let (Some(sew), Some(like)) = (&mut self.sew, &sample.sew) {
                sew.classify_like(like);
            }
            self.points.turn_points = 0;
        }
        if self.unfinished.marks.is_empty() && self.unfinished.strokes.is_empty() {
            let (from, to) = (sample.boundary.positions(), self.boundary.positions());
            if from.len() != to.len() || sample.unfinished.marks.len() > limits::NOTCHES {
                return sample.unfinished.marks.is_empty();
            }
            self.unfinished.marks = sample.unfinished.marks.iter().filter_map(|m| carried(m, &from, &to)).collect();
        }
        true
    }
}

fn carried(mark: &Mark, from: &[Vec2], to: &[Vec2]) -> Option<Mark> {
    let foot = geom::nearest(mark.at, from, true).filter(|f| f.distance <= 0.5)?;
    let (a, b) = (to[foot.segment], to[(foot.segment + 1) % to.len()]);
    let u = from[(foot.segment + 1) % from.len()] - from[foot.segment];
    let turned = libm::atan2(geom::cross(u, b - a), u.dot(&(b - a)));
    Some(Mark { at: foot.on(to), angle: mark.angle.map(|x| x + turned), ..mark.clone() })
}
