//! The fold of a half piece.

use super::codes;
use super::{Desk, DrawnPiece, mm};
use crate::dxf::geom;
use crate::dxf::ledger::Verdict;
use crate::dxf::sheet::Stroke;
use toile_garment::{Diagnostic, Vec2};

/// A mirror line lies on the boundary within this, mm.
const ON_FOLD: f64 = 0.3;
/// Most mirror lines of a piece that are looked at.
const MIRRORS: usize = 64;

impl DrawnPiece {
    pub(super) fn find_fold(&mut self, mirrors: &[Stroke], desk: &mut Desk<'_>) {
        let mut joined = joined(mirrors);
        joined.sort_by(|a, b| length(b).total_cmp(&length(a)));
        let Some(stroke) = joined.first() else { return };
        let line = self.boundary.positions();
        let [a, b] = stroke.ends;
        self.say_other_folds(&joined, desk);
        let fold = fold_run(&line, a, b).map(|_| [a, b]).or_else(|| fold_part(&line, a, b));
        if fold.is_some() {
            self.axes.fold = fold;
            desk.overrule(stroke.id, Verdict::Interpreted, "mirror line on the boundary: the half piece is unfolded");
        } else {
            let text = format!(
                "the mirror line from {} to {} of `{}` does not lie on the boundary; the piece was not unfolded",
                mm(a),
                mm(b),
                self.label()
            );
            desk.overrule(stroke.id, Verdict::Refused, "mirror line off the boundary");
            let hint = "draw the mirror line on a straight edge of the half piece, or draw the whole piece";
            desk.say(Diagnostic::warning(codes::FOLD_OFF_BOUNDARY, text).hint(hint), &self.block, "6", stroke.line);
        }
    }

    /// A piece has one fold: further mirror lines are not used.
    fn say_other_folds(&self, joined: &[Stroke], desk: &mut Desk<'_>) {
        let [first, others @ ..] = joined else { return };
        for stroke in others {
            let text = format!(
                "`{}` has a second mirror line from {} to {}; only the longest, from {} to {}, counts",
                self.label(),
                mm(stroke.ends[0]),
                mm(stroke.ends[1]),
                mm(first.ends[0]),
                mm(first.ends[1])
            );
            desk.overrule(stroke.id, Verdict::Refused, "second mirror line");
            let hint = "draw a piece that is folded twice unfolded once";
            desk.say(Diagnostic::warning(codes::FOLD_SECOND, text).hint(hint), &self.block, "6", stroke.line);
        }
    }
}

fn length(s: &Stroke) -> f64 {
    (s.ends[1] - s.ends[0]).norm()
}

/// Mirror lines with those on the same line that meet or overlap made one.
fn joined(mirrors: &[Stroke]) -> Vec<Stroke> {
    let mut out: Vec<Stroke> = Vec::new();
    for stroke in mirrors.iter().take(MIRRORS) {
        let mut whole = *stroke;
        while let Some((i, both)) = out.iter().enumerate().find_map(|(i, s)| one_line(s, &whole).map(|b| (i, b))) {
            out.remove(i);
            whole = both;
        }
        out.push(whole);
    }
    out
}

/// Two strokes as one, if they lie on one line and meet.
fn one_line(a: &Stroke, b: &Stroke) -> Option<Stroke> {
    let (long, short) = if length(a) >= length(b) { (a, b) } else { (b, a) };
    let d = long.ends[1] - long.ends[0];
    let n = d.norm();
    if n < 1e-6 {
        return None;
    }
    let t = short.ends.map(|p| (p - long.ends[0]).dot(&d) / n);
    let on = short.ends.iter().all(|p| geom::cross(d, p - long.ends[0]).abs() / n <= ON_FOLD);
    let (lo, hi) = (t[0].min(t[1]), t[0].max(t[1]));
    let meets = on && lo <= n + ON_FOLD && hi >= -ON_FOLD;
    let (lo, hi) = (lo.min(0.0), hi.max(n));
    // A line that reaches no further keeps its ends to the last digit.
    let end = |t: f64, own: Vec2| if t < 0.0 || t > n { long.ends[0] + d * (t / n) } else { own };
    meets.then(|| Stroke { ends: [end(lo, long.ends[0]), end(hi, long.ends[1])], ..*long })
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

/// The fold, where at least half of the line from `a` to `b` is boundary; a dart on the fold takes the rest.
///
/// A line drawn at net length ends an allowance short of the cut edge. The fold reaches as far as that edge.
fn fold_part(line: &[Vec2], a: Vec2, b: Vec2) -> Option<[Vec2; 2]> {
    let (n, length) = (line.len(), (b - a).norm());
    if length < 5.0 || n < 3 {
        return None;
    }
    let d = (b - a) / length;
    let on = |p: Vec2| geom::cross(d, p - a).abs() <= ON_FOLD;
    let sides = (0..n).map(|i| [line[i], line[(i + 1) % n]]).filter(|ends| ends.iter().all(|p| on(*p)));
    let ranges: Vec<[f64; 2]> =
        sides.map(|ends| ends.map(|p| (p - a).dot(&d))).map(|[p, q]| [p.min(q), p.max(q)]).collect();
    let covered: f64 = ranges.iter().map(|[from, to]| (to.min(length) - from.max(0.0)).max(0.0)).sum();
    let [from, to] = ranges.iter().fold([0.0, length], |[low, high], [from, to]| {
        if *from < length && *to > 0.0 { [low.min(*from), high.max(*to)] } else { [low, high] }
    });
    let end = |own: Vec2, way: f64, drawn: f64| if (way - drawn).abs() <= 1.0 { own } else { a + d * way };
    (covered >= 0.5 * length).then(|| [end(a, from, 0.0), end(b, to, length)])
}
