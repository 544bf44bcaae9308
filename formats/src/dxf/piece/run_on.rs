//! Kinds and marks that one size of a nest takes over from the sample size.

use super::DrawnPiece;
use crate::dxf::piece::Outline;
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
            let line = |of: &Outline| of.positions();
            let cut = [line(&sample.boundary), line(&self.boundary)];
            if cut[0].len() != cut[1].len() || sample.unfinished.marks.len() > limits::NOTCHES {
                return sample.unfinished.marks.is_empty();
            }
            let sew = sample.sew.as_ref().map(|like| [line(like), self.sew.as_ref().map_or_else(Vec::new, line)]);
            let lines: Vec<[Vec<Vec2>; 2]> = std::iter::once(cut).chain(sew).collect();
            self.unfinished.marks = sample.unfinished.marks.iter().filter_map(|m| carried(m, &lines)).collect();
        }
        true
    }
}

/// The mark of the sample size in another size, beside the same segment of the line that it lies nearest to. The lines
/// are given in the sample size and in the other one. `None` where the other size does not have that line.
///
/// A mark on a curve stands off the chord by the height of the arc there. That height grows with the chord.
fn carried(mark: &Mark, lines: &[[Vec<Vec2>; 2]]) -> Option<Mark> {
    let feet = lines.iter().filter_map(|[from, to]| Some((geom::nearest(mark.at, from, true)?, from, to)));
    let (foot, from, to) = feet.min_by(|(a, ..), (b, ..)| a.distance.total_cmp(&b.distance))?;
    if from.len() != to.len() {
        return None;
    }
    let side = |line: &[Vec2]| line[(foot.segment + 1) % line.len()] - line[foot.segment];
    let (u, v) = (side(from), side(to));
    let turned = libm::atan2(geom::cross(u, v), u.dot(&v));
    let growth = if u.norm() > 0.0 { v.norm() / u.norm() } else { 1.0 };
    let off = (mark.at - foot.on(from)) * growth;
    let (sin, cos) = (libm::sin(turned), libm::cos(turned));
    let off = Vec2::new(cos * off.x - sin * off.y, sin * off.x + cos * off.y);
    Some(Mark { at: foot.on(to) + off, angle: mark.angle.map(|x| x + turned), ..mark.clone() })
}
