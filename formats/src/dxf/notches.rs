//! Notches from points and from strokes.

use super::cut_notches::CutNotch;
use super::geom::{self, PointIndex};
use super::sheet::{Mark, Stroke};
use toile_garment::Vec2;
use toile_garment::notch::NotchKind;

/// Notches of one kind this near each other are one, mm.
const DOUBLED: f64 = 0.05;
/// A notch lies on a line within this, mm.
const ON: f64 = 0.5;
/// A notch belongs to the smooth line if that is nearer than the chords by more than this, mm.
const CLEARLY: f64 = 0.1;
/// A notch this near an edge stands on it, so that it stands on both edges of a corner, mm.
const AT_CORNER: f64 = 0.05;
/// Strokes this near each other belong to one notch, mm.
const ONE_NOTCH: f64 = 1.5;

/// A notch as drawn, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnNotch {
    /// Shape.
    pub kind: NotchKind,
    /// Base point.
    pub at: Vec2,
    /// Depth.
    pub depth: f64,
    /// Width at the line.
    pub width: f64,
    /// Inward direction, radians, where the file gives one.
    pub angle: Option<f64>,
    /// `boundary`, `sew`, `internal`, `fold` or `off`.
    pub on: &'static str,
    /// Distance from the boundary.
    pub off: f64,
    /// Line in the file.
    pub line: u64,
    /// Drawn with strokes (layer-4 LINEs) instead of marked with a POINT.
    pub strokes: bool,
    /// Cut into the outline.
    pub cut: bool,
    /// The same notch stands once more on the cut line: its place in the list.
    pub twin: Option<usize>,
}

/// A closed line that notches sit on: as it is drawn, and the smooth line through its points where that differs.
#[derive(Clone, Copy, Debug)]
pub struct EdgeLine<'a> {
    /// The line as it is drawn, counter-clockwise.
    pub drawn: &'a [Vec2],
    /// The smooth line.
    pub smooth: Option<&'a [Vec2]>,
}

impl<'a> EdgeLine<'a> {
    /// A line that is used as it is drawn.
    #[must_use]
    pub fn as_drawn(drawn: &'a [Vec2]) -> Self {
        Self { drawn, smooth: None }
    }

    /// Distance of the nearest of some points from the line as drawn and from the smooth line.
    fn offs(&self, points: &[Vec2]) -> (f64, f64) {
        let least = |line: &[Vec2]| points.iter().map(|p| geom::distance(*p, line, true)).fold(f64::INFINITY, f64::min);
        (least(self.drawn), self.smooth.map_or(f64::INFINITY, least))
    }

    fn distance(&self, p: Vec2) -> f64 {
        let (drawn, smooth) = self.offs(&[p]);
        drawn.min(smooth)
    }

    /// The form of the line that some points belong to: the smooth one if they are clearly nearer to it.
    fn form_at(&self, points: &[Vec2]) -> &'a [Vec2] {
        let (drawn, smooth) = self.offs(points);
        self.smooth.filter(|_| smooth + CLEARLY < drawn).unwrap_or(self.drawn)
    }
}

/// The lines of a piece a notch can sit on.
pub struct Ground<'a> {
    /// Cut line.
    pub boundary: EdgeLine<'a>,
    /// Sew line.
    pub sew: Option<EdgeLine<'a>>,
    /// Internal lines and whether they are closed.
    pub internal: &'a [(Vec<Vec2>, bool)],
}

impl Ground<'_> {
    /// Where a point sits, and how far from the boundary.
    #[must_use]
    pub fn place(&self, p: Vec2) -> (&'static str, f64) {
        let off = self.boundary.distance(p);
        let on = if off <= ON {
            "boundary"
        } else if self.sew.is_some_and(|s| s.distance(p) <= ON) {
            "sew"
        } else if self.internal.iter().any(|(l, closed)| geom::distance(p, l, *closed) <= ON) {
            "internal"
        } else {
            "off"
        };
        (on, off)
    }

    /// Inward normal at the boundary point nearest to `p`, radians.
    fn inward(&self, p: Vec2) -> Option<f64> {
        let line = self.boundary.form_at(&[p]);
        geom::nearest(p, line, true).and_then(|foot| normal(line, foot.segment))
    }

    /// Does an angle at `p` point out of the piece? At a corner it does if both edges say so: either of them may be
    /// the edge that the notch belongs to.
    fn is_outward(&self, p: Vec2, angle: f64) -> bool {
        let line = self.boundary.drawn;
        let n = line.len();
        let meets = |i: &usize| geom::point_segment(p, line[*i], line[(i + 1) % n]).0 <= AT_CORNER;
        let mut normals: Vec<f64> = (0..n).filter(meets).filter_map(|i| normal(line, i)).collect();
        normals.extend(self.inward(p).filter(|_| normals.is_empty()));
        !normals.is_empty() && normals.iter().all(|normal| libm::cos(angle - normal) < -1e-9)
    }
}

/// Inward normal of a segment of a counter-clockwise line, radians.
fn normal(line: &[Vec2], segment: usize) -> Option<f64> {
    let d = line[(segment + 1) % line.len()] - line[segment];
    (d.norm() > 0.0).then(|| libm::atan2(d.x, -d.y))
}

/// Notches from points: doubled ones merged, direction made to point inwards.
#[must_use]
pub fn from_marks(marks: &[Mark], ground: &Ground<'_>, scale: f64) -> (Vec<DrawnNotch>, Vec<u32>) {
    let mut out: Vec<DrawnNotch> = Vec::new();
    let mut doubled = Vec::new();
    let mut seen = PointIndex::new(DOUBLED, []);
    for mark in marks {
        if !seen.insert_new(mark.at, out.len(), DOUBLED) {
            doubled.push(mark.id);
            continue;
        }
        let width = mark.width.unwrap_or(0.0).abs() * scale;
        let kind = mark.kind.unwrap_or(if width > 0.0 { NotchKind::V } else { NotchKind::Slit });
        let (on, off) = ground.place(mark.at);
        let is_on_edge = on == "boundary" || on == "sew";
        let told = mark.angle.filter(|a| !(is_on_edge && ground.is_outward(mark.at, *a)));
        let angle = told.or_else(|| ground.inward(mark.at).filter(|_| is_on_edge));
        let depth = mark.depth.unwrap_or(0.0).abs() * scale;
        out.push(DrawnNotch {
            kind,
            at: mark.at,
            depth,
            width,
            angle,
            on,
            off,
            line: mark.line,
            strokes: false,
            cut: false,
            twin: None,
        });
    }
    (out, doubled)
}

/// A notch cut into the boundary.
#[must_use]
pub fn cut_in(cut: &CutNotch, line: u64) -> DrawnNotch {
    DrawnNotch {
        kind: cut.kind,
        at: cut.at,
        depth: cut.depth,
        width: cut.width,
        angle: Some(cut.angle),
        on: "boundary",
        off: 0.0,
        line,
        strokes: false,
        cut: true,
        twin: None,
    }
}

/// Pairs each notch on the sew line with the one on the cut line that marks the same: an allowance away, the nearest.
pub fn pair_twins(list: &mut [DrawnNotch]) {
    let places: Vec<(usize, Vec2)> =
        list.iter().enumerate().filter(|(_, n)| n.on == "boundary").map(|(i, n)| (i, n.at)).collect();
    for notch in list.iter_mut().filter(|n| n.on == "sew" && n.off > ON) {
        let (at, off) = (notch.at, notch.off);
        let near = places.iter().map(|(i, p)| ((p - at).norm(), *i)).filter(|(d, _)| *d <= 1.5 * off + 1.0);
        notch.twin = near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, i)| i);
    }
}

/// Notches drawn as strokes: near strokes are one notch, its base is where it meets the boundary.
#[must_use]
pub fn from_strokes(strokes: &[Stroke], ground: &Ground<'_>) -> Vec<DrawnNotch> {
    groups(strokes).iter().filter_map(|g| grouped(g, ground)).collect()
}

fn groups(strokes: &[Stroke]) -> Vec<Vec<Stroke>> {
    let mut group: Vec<usize> = (0..strokes.len()).collect();
    fn root(group: &mut [usize], mut i: usize) -> usize {
        while group[i] != i {
            group[i] = group[group[i]];
            i = group[i];
        }
        i
    }
    for i in 0..strokes.len() {
        for j in 0..i {
            if near(&strokes[i], &strokes[j]) {
                let (a, b) = (root(&mut group, i), root(&mut group, j));
                group[a.max(b)] = a.min(b);
            }
        }
    }
    let mut out: Vec<Vec<Stroke>> = vec![Vec::new(); strokes.len()];
    for (i, stroke) in strokes.iter().enumerate() {
        let r = root(&mut group, i);
        out[r].push(*stroke);
    }
    out.retain(|g| !g.is_empty());
    out
}

fn near(a: &Stroke, b: &Stroke) -> bool {
    let end = |p: Vec2, s: &Stroke| geom::point_segment(p, s.ends[0], s.ends[1]).0;
    let gap = a.ends.iter().map(|p| end(*p, b)).chain(b.ends.iter().map(|p| end(*p, a))).fold(f64::INFINITY, f64::min);
    gap <= ONE_NOTCH
}

fn grouped(group: &[Stroke], ground: &Ground<'_>) -> Option<DrawnNotch> {
    let ends: Vec<Vec2> = group.iter().flat_map(|s| s.ends).collect();
    let line = ground.boundary.form_at(&ends);
    let offs: Vec<f64> = ends.iter().map(|p| geom::distance(*p, line, true)).collect();
    let nearest = offs.iter().copied().fold(f64::INFINITY, f64::min);
    let depth = offs.iter().copied().fold(0.0, f64::max) - nearest;
    let base: Vec<Vec2> = ends.iter().zip(&offs).filter(|(_, o)| **o <= nearest + 0.1).map(|(p, _)| *p).collect();
    let (lo, hi) = geom::bounds(base.iter().copied())?;
    let (middle, width) = ((lo + hi) * 0.5, (hi - lo).norm());
    let shares_end = |a: &Stroke, b: &Stroke| a.ends.iter().any(|p| b.ends.iter().any(|q| (p - q).norm() < 0.01));
    let kind = match group {
        [_] => NotchKind::Slit,
        [a, b] if shares_end(a, b) => NotchKind::V,
        [_, _] => NotchKind::T,
        [_, _, _] => NotchKind::Castle,
        _ => NotchKind::U,
    };
    // A V that stands on its tip: its width is that of its open end.
    let width = match group {
        [a, b] if kind == NotchKind::V && width < 0.1 => {
            let far =
                |s: &Stroke| s.ends.iter().copied().max_by(|p, q| (p - middle).norm().total_cmp(&(q - middle).norm()));
            far(a).zip(far(b)).map_or(width, |(p, q)| (p - q).norm())
        }
        _ => width,
    };
    let (on, off) = ground.place(middle);
    Some(DrawnNotch {
        kind,
        at: middle,
        depth,
        width,
        angle: ground.inward(middle),
        on,
        off,
        line: group[0].line,
        strokes: true,
        cut: false,
        twin: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Vec<Vec2> {
        [(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)].map(|(x, y)| Vec2::new(x, y)).to_vec()
    }

    fn mark(x: f64, y: f64, angle: Option<f64>) -> Mark {
        let at = Vec2::new(x, y);
        Mark { id: 0, line: 1, at, depth: Some(-4.0), width: Some(3.0), angle, kind: None }
    }

    #[test]
    fn doubled_points_merge_and_outward_angles_turn() {
        let line = square();
        let ground = Ground { boundary: EdgeLine::as_drawn(&line), sew: None, internal: &[] };
        // On the right edge inwards is -x, 180 degrees; the file says 0.
        let marks = [mark(100.0, 50.0, Some(0.0)), mark(100.0, 50.03, None), mark(60.0, 50.0, None)];
        let (notches, doubled) = from_marks(&marks, &ground, 1.0);
        assert_eq!((notches.len(), doubled.len()), (2, 1));
        assert!((notches[0].angle.expect("angle") - std::f64::consts::PI).abs() < 1e-9);
        assert_eq!((notches[0].kind, notches[0].depth, notches[0].on), (NotchKind::V, 4.0, "boundary"));
        assert_eq!((notches[1].on, notches[1].off), ("off", 40.0));
    }

    /// The reader gives the same angle wherever the outline begins, so that a file that is written keeps it.
    #[test]
    fn a_notch_at_a_corner_may_be_square_to_either_edge() {
        let half_turn = std::f64::consts::PI;
        // A corner of 91 degrees: the normal of one edge points a little out of the other.
        let corner = Vec2::new(98.0, 100.0);
        for first in 0..4 {
            let mut line = square();
            line[2] = corner;
            line.rotate_left(first);
            let ground = Ground { boundary: EdgeLine::as_drawn(&line), sew: None, internal: &[] };
            let side = normal(&line, (5 - first) % 4).expect("side");
            for (given, wanted) in [(-half_turn / 2.0, -half_turn / 2.0), (side, side)] {
                let (notches, _) = from_marks(&[mark(corner.x, corner.y, Some(given))], &ground, 1.0);
                assert!((notches[0].angle.expect("angle") - wanted).abs() < 1e-12, "{first} {given}");
            }
            let (notches, _) = from_marks(&[mark(corner.x, corner.y, Some(half_turn / 4.0))], &ground, 1.0);
            let turned = notches[0].angle.expect("angle");
            assert!([-half_turn / 2.0, side].iter().any(|a| (a - turned).abs() < 1e-12), "{first}: {turned}");
        }
    }

    #[test]
    fn strokes_group_into_notches() {
        let line = square();
        let ground = Ground { boundary: EdgeLine::as_drawn(&line), sew: None, internal: &[] };
        let stroke =
            |a: (f64, f64), b: (f64, f64)| Stroke { id: 0, line: 1, ends: [Vec2::new(a.0, a.1), Vec2::new(b.0, b.1)] };
        let strokes = [
            stroke((100.0, 80.0), (95.0, 80.0)),
            stroke((95.0, 30.0), (100.0, 33.0)),
            stroke((95.0, 30.0), (100.0, 27.0)),
            stroke((100.0, 50.0), (95.0, 50.0)),
            stroke((95.0, 48.0), (95.0, 52.0)),
        ];
        let notches = from_strokes(&strokes, &ground);
        let kinds: Vec<NotchKind> = notches.iter().map(|n| n.kind).collect();
        assert_eq!(kinds, [NotchKind::Slit, NotchKind::V, NotchKind::T]);
        assert!((notches[1].at - Vec2::new(100.0, 30.0)).norm() < 1e-9 && (notches[1].width - 6.0).abs() < 1e-9);
        assert!((notches[0].depth - 5.0).abs() < 1e-9);
    }
}
