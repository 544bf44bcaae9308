//! Wedges in the middle of a whole piece that are V necklines. Those of half pieces are denied in `on_fold.rs`.

use super::codes;
use super::dart::{DECLARE, Denied, DrawnDart, Form};
use super::thresholds::{
    ANGLE_OF_BLUNT_NECKLINE, ANGLE_OF_NECKLINE, ANGLE_OF_SHOULDER, CORNERS_OF_NECKED_PIECE, DISTANCE_OF_MIRROR_IMAGE,
    DISTANCE_OF_MOUTH_VERTEX, LENGTH_OF_SLOPE, SAMPLES_OF_SYMMETRY, SHARE_OF_MIRROR_IMAGES, WIDTH_OF_BLUNT_NECKLINE,
    WIDTH_OF_COLLARED_NECKLINE, WIDTH_OF_NECKLINE,
};
use crate::dxf::desk::Desk;
use crate::dxf::geom;
use crate::dxf::piece::{DrawnPiece, mm};
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Vec2};

impl DrawnPiece {
    /// Is the outline its own mirror image at this axis?
    pub(crate) fn symmetric_about(line: &[Vec2], axis: [Vec2; 2]) -> bool {
        let points: Vec<Vec2> = line.iter().step_by(line.len() / SAMPLES_OF_SYMMETRY + 1).copied().collect();
        let twins = points
            .iter()
            .filter(|p| geom::distance(geom::mirror(**p, axis[0], axis[1]), line, true) <= DISTANCE_OF_MIRROR_IMAGE)
            .count();
        let least = SHARE_OF_MIRROR_IMAGES;
        twins * least.1 >= points.len() * least.0
    }

    /// A wide wedge in the middle of a symmetric piece is a V neckline.
    pub(in crate::dxf) fn deny_necklines(&mut self, desk: &mut Desk<'_>) {
        let nodes = &self.sewn().drawn;
        let line: Vec<Vec2> = nodes.iter().map(|n| n.at).collect();
        let corners = nodes.iter().filter(|n| n.kind == PointKind::Turn).count();
        let mut denied = Vec::new();
        self.darts.retain(|dart| {
            let apex = dart.apexes[0];
            let axis = [apex, (dart.mouth[0] + dart.mouth[1]) * 0.5];
            let (u, v) = (dart.mouth[0] - apex, dart.mouth[1] - apex);
            let angle = geom::angle(u, v);
            let width = dart.width();
            let wide = width > WIDTH_OF_NECKLINE && angle > ANGLE_OF_NECKLINE;
            let narrow = width > WIDTH_OF_COLLARED_NECKLINE
                || (angle > ANGLE_OF_BLUNT_NECKLINE && width > WIDTH_OF_BLUNT_NECKLINE);
            let neckline = dart.form == Form::Wedge
                && corners >= CORNERS_OF_NECKED_PIECE
                && (wide || narrow && between_shoulders(dart, &line))
                && Self::symmetric_about(&line, axis);
            if neckline {
                denied.push((apex, dart.line));
            }
            !neckline
        });
        for (at, file_line) in denied {
            let why = "it is wide and in the middle of a symmetric piece: a V neckline";
            let text = format!("the wedge at {} of `{}` was not taken as a dart: {why}", mm(at), self.label());
            desk.say(Diagnostic::warning(codes::WEDGE_NOT_A_DART, text).hint(DECLARE), &self.block, "1", file_line);
            self.doubts.denied.push(Denied { at, why, form: Form::Wedge });
        }
    }
}

/// Does the outline fall away on both sides of the mouth, towards the apex?
fn between_shoulders(dart: &DrawnDart, line: &[Vec2]) -> bool {
    let [a, b] = dart.mouth;
    let inward = dart.apexes[0] - (a + b) * 0.5;
    [(a, a - b), (b, b - a)].into_iter().all(|(end, outward)| {
        let n = line.len();
        let Some(at) = (0..n).find(|i| (line[*i] - end).norm() <= DISTANCE_OF_MOUTH_VERTEX) else { return false };
        let away = |step: usize| {
            (1..n).map(|k| line[(at + k * step) % n] - end).find(|d| d.norm() >= LENGTH_OF_SLOPE).unwrap_or_default()
        };
        // The other way leads along the leg.
        let [p, q] = [away(1), away(n - 1)];
        let beside = if p.dot(&outward) * q.norm() > q.dot(&outward) * p.norm() { p } else { q };
        let (fall, run) = (beside.dot(&inward) / inward.norm(), beside.dot(&outward) / outward.norm());
        libm::atan2(fall, run).to_degrees() > ANGLE_OF_SHOULDER
    })
}
