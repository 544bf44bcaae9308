//! The fold of a half piece.

use super::{Desk, DrawnPiece, mm};
use crate::dxf::geom;
use crate::dxf::ledger::Verdict;
use crate::dxf::sheet::Stroke;
use toile_garment::{Diagnostic, Vec2};

/// A mirror line lies on the boundary within this, mm.
const ON_FOLD: f64 = 0.3;

impl DrawnPiece {
    pub(super) fn find_fold(&mut self, mirrors: &[Stroke], desk: &mut Desk<'_>) {
        let longest = mirrors.iter().max_by(|a, b| {
            let l = |s: &Stroke| (s.ends[1] - s.ends[0]).norm();
            l(a).total_cmp(&l(b))
        });
        let Some(stroke) = longest else { return };
        let line = self.boundary.positions();
        let [a, b] = stroke.ends;
        if fold_run(&line, a, b).is_some() || fold_part(&line, a, b) {
            self.fold = Some([a, b]);
            desk.ledger.overrule(
                stroke.id,
                Verdict::Interpreted,
                "mirror line on the boundary: the half piece is unfolded",
            );
        } else {
            let text = format!(
                "the mirror line from {} to {} of `{}` does not lie on the boundary; the piece was not unfolded",
                mm(a),
                mm(b),
                self.label()
            );
            desk.ledger.overrule(stroke.id, Verdict::Refused, "mirror line off the boundary");
            desk.say(Diagnostic::warning("fold-off-boundary", text), &self.block, "6", stroke.line);
        }
    }
}

/// The run of boundary vertices that lies on the line from `a` to `b`: first and last index, counter-clockwise.
fn fold_run(line: &[Vec2], a: Vec2, b: Vec2) -> Option<(usize, usize)> {
    let n = line.len();
    let d = b - a;
    if d.norm() < 5.0 || n < 3 {
        return None;
    }
    let off = |p: Vec2| geom::cross(d, p - a).abs() / d.norm();
    let near =
        |p: Vec2| (0..n).filter(|i| (line[*i] - p).norm() <= 1.0 && off(line[*i]) <= ON_FOLD).collect::<Vec<_>>();
    for from in near(a).into_iter().chain(near(b)).take(16) {
        let target = if (line[from] - a).norm() <= 1.0 { b } else { a };
        let mut i = from;
        for _ in 0..n {
            i = (i + 1) % n;
            if off(line[i]) > ON_FOLD {
                break;
            }
            if (line[i] - target).norm() <= 1.0 {
                return Some((from, i));
            }
        }
    }
    None
}

/// Is at least half of the line from `a` to `b` a run of the boundary? A dart on the fold takes the rest.
fn fold_part(line: &[Vec2], a: Vec2, b: Vec2) -> bool {
    let (n, d) = (line.len(), b - a);
    let length = d.norm();
    if length < 5.0 || n < 3 {
        return false;
    }
    let along = |p: Vec2| (p - a).dot(&d) / length;
    let on = |p: Vec2| geom::cross(d, p - a).abs() / length <= ON_FOLD && (-1.0..=length + 1.0).contains(&along(p));
    let covered: f64 = (0..n)
        .map(|i| [line[i], line[(i + 1) % n]])
        .filter(|ends| ends.iter().all(|p| on(*p)))
        .map(|ends| (ends[1] - ends[0]).norm())
        .sum();
    covered >= 0.5 * length
}
