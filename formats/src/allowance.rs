//! The cut line made from the sew line: every edge moved outwards by its allowance, corners joined, overlaps united.
//!
//! The cut line is the border of a union: the piece itself, a strip along every segment of its sew line, and at every
//! convex vertex what joins two strips. So darts, reflex corners and narrow places come out right without special
//! cases; the union is that of `i_overlay`, on a grid of about a millionth of a millimetre.

mod evened;

pub use evened::even_sizes;

use crate::codes::{EDGE_UNKNOWN, OUT_OF_RANGE};
use crate::dxf::geom::cross;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::simplify::SimplifyShape;
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::{Code, Diagnostic, Piece, Vec2};

codes! {
    pub(crate) list CODES;

    /// No cut line can be made around a piece: its outline encloses nothing. Exit code 2.
    ALLOWANCE_FAILED = "allowance-failed";

    /// The allowances of a piece grow together and enclose a hole; the cut line runs around it. Take a smaller
    /// allowance there.
    ALLOWANCE_GROWS_TOGETHER = "allowance-grows-together";
}

/// How two strips meet at a convex corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CornerKind {
    /// Both cut lines run on until they meet; cut off where that is farther than four allowances.
    #[default]
    Miter,
    /// Cut straight from one to the other.
    Bevel,
    /// An arc around the corner.
    Round,
}

/// Allowances of a piece, metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Allowance {
    /// Width for every edge that has none of its own, m.
    pub width: f64,
    /// Widths of single edges: number of the edge and width, m.
    pub edges: Vec<(u32, f64)>,
    /// Corners.
    pub corners: CornerKind,
}

/// A miter longer than this many allowances is cut off.
const MITER_LIMIT: f64 = 4.0;
/// Chords of round corners turn at most so much, radians.
const ROUND_STEP: f64 = 0.15;
/// A vertex of the cut line that turns more is a corner, degrees.
const CORNER: f64 = 20.0;
/// Widest allowance, metres.
pub const WIDEST: f64 = 0.2;
/// Vertices this near each other, in a row, are one, metres.
const SAME: f64 = 1e-8;
/// A vertex this near the line of its neighbours is none, metres.
const STRAIGHT: f64 = 2e-8;

type Ring = Vec<[f64; 2]>;

/// The cut line around the sew line (the outline) of a piece. The findings tell what a cut line cannot show.
///
/// # Errors
/// A width that is none, an edge the piece does not have, or an outline no cut line can be made of.
pub fn cut_line(piece: &Piece, allowance: &Allowance) -> Result<(PieceLine, Vec<Diagnostic>), Diagnostic> {
    let line = counter_clockwise(&piece.outline);
    let widths = widths(piece, &line, allowance)?;
    let points: Vec<Vec2> = line.iter().map(|p| p.at).collect();
    let rings = rings(&line, &widths, allowance.corners);
    let shapes = rings.simplify_shape_as::<i64>(FillRule::NonZero);
    let area = |ring: &Ring| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum::<f64>().abs()
    };
    let outer = |shape: &Vec<Ring>| shape.first().map_or(0.0, area);
    let Some(shape) = shapes.iter().max_by(|a, b| outer(a).total_cmp(&outer(b))).filter(|s| outer(s) > 0.0) else {
        let text = format!("no cut line can be made around piece `{}`: its outline encloses nothing", piece.name);
        return Err(Diagnostic::error(ALLOWANCE_FAILED, text));
    };
    let mut findings = Vec::new();
    let closed = shape.iter().skip(1).map(area).sum::<f64>();
    if closed > 1e-6 {
        let text = format!(
            "the allowance of piece `{}` grows together and leaves {:.1} cm² enclosed; the cut line runs around it",
            piece.name,
            closed * 1e4
        );
        findings.push(Diagnostic::warning(ALLOWANCE_GROWS_TOGETHER, text).hint("take a smaller allowance there"));
    }
    let ring: Vec<Vec2> = shape[0].iter().map(|p| Vec2::new(p[0], p[1])).collect();
    let corners = Corners::new(&line, &points, &widths, allowance.corners);
    let cut = PieceLine { points: named(tidy(ring, &corners), &corners), closed: true, ..PieceLine::default() };
    Ok((cut, findings))
}

fn counter_clockwise(line: &PieceLine) -> Vec<LinePoint> {
    let mut points: Vec<LinePoint> = Vec::with_capacity(line.points.len());
    for p in &line.points {
        if points.last().is_none_or(|last| (last.at - p.at).norm() > SAME) {
            points.push(p.clone());
        }
    }
    if points.len() > 1 && (points[0].at - points[points.len() - 1].at).norm() <= SAME {
        points.pop();
    }
    if line.signed_area() < 0.0 {
        points.reverse();
    }
    points
}

/// Width of the allowance of every segment of the line.
fn widths(piece: &Piece, line: &[LinePoint], allowance: &Allowance) -> Result<Vec<f64>, Diagnostic> {
    let all = std::iter::once(allowance.width).chain(allowance.edges.iter().map(|e| e.1));
    if let Some(bad) = all.into_iter().find(|w| !(0.0..=WIDEST).contains(w)) {
        let text = format!("an allowance of {} mm; it must be 0 to {} mm", bad * 1e3, WIDEST * 1e3);
        return Err(Diagnostic::error(OUT_OF_RANGE, text));
    }
    let n = line.len();
    let mut out = vec![allowance.width; n];
    for (index, width) in &allowance.edges {
        let Some(edge) = piece.edges.iter().find(|e| e.index == *index) else {
            let text = format!("piece `{}` has no edge {index}; it has {}", piece.name, piece.edges.len());
            let hint = "`toile inspect FILE --svg OUT` draws their numbers";
            return Err(Diagnostic::error(EDGE_UNKNOWN, text).hint(hint));
        };
        let at = |v: u32| piece.outline.points.get(v as usize).map(|p| p.at);
        let find = |p: Vec2| (0..n).find(|i| (line[*i].at - p).norm() <= SAME);
        let ends = at(edge.from).and_then(find).zip(at(edge.to).and_then(find));
        let Some((from, to)) = ends else { continue };
        let steps = if from == to { n } else { (to + n - from) % n };
        for k in 0..steps {
            out[(from + k) % n] = *width;
        }
    }
    Ok(out)
}

/// Outward normal of a segment of a counter-clockwise line.
fn normal(a: Vec2, b: Vec2) -> Vec2 {
    let d = b - a;
    Vec2::new(d.y, -d.x) / d.norm().max(1e-12)
}

/// The piece, its strips and its corners, all counter-clockwise.
fn rings(line: &[LinePoint], widths: &[f64], corners: CornerKind) -> Vec<Ring> {
    let n = line.len();
    let xy = |p: Vec2| [p.x, p.y];
    let mut out = vec![line.iter().map(|p| xy(p.at)).collect::<Ring>()];
    for i in 0..n {
        let (a, b, c) = (line[i].at, line[(i + 1) % n].at, line[(i + 2) % n].at);
        let (w, v) = (widths[i], widths[(i + 1) % n]);
        let (m, k) = (normal(a, b), normal(b, c));
        if w > 0.0 {
            out.push([a, a + m * w, b + m * w, b].map(xy).to_vec());
        }
        let convex = cross(m, k) > 1e-12;
        if convex && (w > 0.0 || v > 0.0) {
            let kind = if line[(i + 1) % n].kind == PointKind::Turn { corners } else { CornerKind::Miter };
            out.push(join(b, [m * w, k * v], kind).into_iter().map(xy).collect());
        }
    }
    out
}

/// The join of two strips at a convex vertex, seen from the vertex.
fn join(at: Vec2, [from, to]: [Vec2; 2], kind: CornerKind) -> Vec<Vec2> {
    let (p, q) = (at + from, at + to);
    let meet = match kind {
        CornerKind::Miter => miter(at, from, to),
        _ => None,
    };
    let between = match (kind, meet) {
        (CornerKind::Miter, Some(x)) => vec![x],
        (CornerKind::Round, _) if from.norm() > 0.0 && to.norm() > 0.0 => arc(at, from, to),
        _ => Vec::new(),
    };
    std::iter::once(at).chain([p]).chain(between).chain([q]).collect()
}

/// Where the two cut lines meet; `None` when that is too far.
fn miter(at: Vec2, from: Vec2, to: Vec2) -> Option<Vec2> {
    let (u, v) = (from.norm(), to.norm());
    if u == 0.0 || v == 0.0 {
        return None;
    }
    let (m, k) = (from / u, to / v);
    // x·m = u and x·k = v.
    let det = cross(m, k);
    let x = Vec2::new(u * k.y - v * m.y, m.x * v - k.x * u) / det;
    (det.abs() > 1e-9 && x.norm() <= MITER_LIMIT * u.max(v)).then_some(at + x)
}

fn arc(at: Vec2, from: Vec2, to: Vec2) -> Vec<Vec2> {
    let turn = libm::atan2(cross(from, to), from.dot(&to));
    let steps = libm::ceil(turn / ROUND_STEP).clamp(1.0, 64.0) as usize;
    let (start, u, v) = (libm::atan2(from.y, from.x), from.norm(), to.norm());
    (1..steps)
        .map(|k| {
            let t = k as f64 / steps as f64;
            let (s, c) = libm::sincos(start + turn * t);
            at + Vec2::new(c, s) * (u + (v - u) * t)
        })
        .collect()
}

/// Where the corners of the sew line have gone, sorted by x.
struct Corners(Vec<Vec2>);

impl Corners {
    fn new(line: &[LinePoint], points: &[Vec2], widths: &[f64], kind: CornerKind) -> Self {
        let n = points.len();
        let mut out = Vec::new();
        for i in (0..n).filter(|i| line[*i].kind == PointKind::Turn) {
            let (a, b, c) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
            let (from, to) = (normal(a, b) * widths[(i + n - 1) % n], normal(b, c) * widths[i]);
            let pointed = kind == CornerKind::Miter || cross(from, to) <= 0.0;
            match miter(b, from, to).filter(|_| pointed) {
                Some(x) => out.push(x),
                None => out.extend([b + from, b + to]),
            }
        }
        out.sort_by(|a, b| a.x.total_cmp(&b.x));
        Self(out)
    }

    fn has(&self, p: Vec2) -> bool {
        let first = self.0.partition_point(|q| q.x < p.x - 1e-6);
        self.0[first..].iter().take_while(|q| q.x <= p.x + 1e-6).any(|q| (q - p).norm() <= 1e-6)
    }
}

/// Does `p` lie on the way from `a` on to `b`?
fn straight(a: Vec2, p: Vec2, b: Vec2) -> bool {
    let chord = b - a;
    cross(chord, p - a).abs() <= STRAIGHT * chord.norm() && chord.dot(&(p - a)) > 0.0
}

/// Without doubled vertices, and without those that only tell where two strips meet on a straight line.
fn tidy(ring: Vec<Vec2>, corners: &Corners) -> Vec<Vec2> {
    let n = ring.len();
    let mut out: Vec<Vec2> = Vec::with_capacity(n);
    for (i, p) in ring.iter().enumerate() {
        let next = ring[(i + 1) % n];
        let Some(last) = out.last() else {
            out.push(*p);
            continue;
        };
        if (corners.has(*p) || !straight(*last, *p, next)) && (last - p).norm() > 1e-6 {
            out.push(*p);
        }
    }
    let loose = |out: &[Vec2]| {
        let (first, last, second) = (out[0], out[out.len() - 1], out[1]);
        (first - last).norm() <= 1e-6 || (straight(last, first, second) && !corners.has(first))
    };
    while out.len() > 3 && loose(&out) {
        out.remove(0);
    }
    out
}

/// Corners are where a corner of the sew line went, and where the line turns.
fn named(ring: Vec<Vec2>, corners: &Corners) -> Vec<LinePoint> {
    let n = ring.len();
    (0..n)
        .map(|i| {
            let (a, p, b) = (ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
            let turn = libm::atan2(cross(p - a, b - p), (p - a).dot(&(b - p))).to_degrees().abs();
            let kind = if turn > CORNER || corners.has(p) { PointKind::Turn } else { PointKind::Plain };
            LinePoint { at: p, kind }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::outline::OutlineEdge;

    fn piece(points: &[(f64, f64)]) -> Piece {
        let points: Vec<LinePoint> = points
            .iter()
            .map(|(x, y)| LinePoint { at: Vec2::new(x * 1e-3, y * 1e-3), kind: PointKind::Turn })
            .collect();
        let n = points.len() as u32;
        let edges = (0..n).map(|i| OutlineEdge { index: i, name: None, from: i, to: (i + 1) % n }).collect();
        let outline = PieceLine { points, closed: true, ..PieceLine::default() };
        Piece { name: "P".into(), outline, edges, ..Piece::default() }
    }

    fn cut(points: &[(f64, f64)], allowance: &Allowance) -> PieceLine {
        let (line, findings) = cut_line(&piece(points), allowance).expect("cut line");
        assert_eq!(findings, []);
        line
    }

    fn ten(corners: CornerKind) -> Allowance {
        Allowance { width: 0.01, edges: Vec::new(), corners }
    }

    const RECTANGLE: [(f64, f64); 4] = [(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (0.0, 600.0)];

    #[test]
    fn corners_of_a_rectangle() {
        // 320 × 620; less four triangles of 10 × 10 / 2; less four squares outside quarter circles.
        let miter = cut(&RECTANGLE, &ten(CornerKind::Miter));
        assert_eq!(miter.points.len(), 4);
        assert!((miter.signed_area() - 0.1984).abs() < 1e-9);
        assert!(miter.points.iter().all(|p| p.kind == PointKind::Turn));
        assert!((cut(&RECTANGLE, &ten(CornerKind::Bevel)).signed_area() - 0.1982).abs() < 1e-9);
        // A quarter circle in chords of at most 0.15 rad: eleven triangles of π/22 at the corner.
        let quarter = 11.0 * 0.5 * libm::sin(std::f64::consts::PI / 22.0);
        let round = 0.1984 - 4.0 * (1.0 - quarter) * 1e-4;
        assert!((cut(&RECTANGLE, &ten(CornerKind::Round)).signed_area() - round).abs() < 1e-9);
    }

    #[test]
    fn each_edge_has_its_own_width() {
        // Hem 40 mm, right side 0: 310 wide, 650 high; the hem runs on to the line of the side.
        let allowance = Allowance { edges: vec![(0, 0.04), (1, 0.0)], ..ten(CornerKind::Miter) };
        let line = cut(&RECTANGLE, &allowance);
        assert!((line.signed_area() - 0.31 * 0.65).abs() < 1e-9, "{}", line.signed_area());
    }

    #[test]
    fn a_dart_becomes_narrower_by_its_allowance() {
        // 30 mm wide, 100 mm deep. Its legs move inwards by 10 mm, and the apex goes down by 10 / sin(half angle) less
        // than the legs reach. So the cut wedge is a like triangle. At the cut line's height (610) it is as wide as 30
        // · (100 + 10 − h) / 100 with h = 10 / sin(atan(0.15)).
        let line =
            [(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (165.0, 600.0), (150.0, 500.0), (135.0, 600.0), (0.0, 600.0)];
        let cut = cut(&line, &ten(CornerKind::Miter));
        let h = 10.0 / libm::sin(libm::atan(0.15));
        let apex = cut.points.iter().map(|p| p.at).find(|p| (p.x - 0.15).abs() < 1e-9).expect("apex");
        assert!((apex.y - (0.5 + h * 1e-3)).abs() < 1e-9, "{apex}");
        // Area: that of the rectangle less the triangle of height 110 − h.
        let depth = 110.0 - h;
        let triangle = 0.5 * depth * (0.3 * depth) * 1e-6;
        let miter_is_long = 0.1984 - triangle;
        assert!((cut.signed_area() - miter_is_long).abs() < 1e-9, "{} {}", cut.signed_area(), miter_is_long);
    }

    #[test]
    fn long_points_are_cut_off_and_curves_stay_smooth() {
        // 10 degrees: a miter would be 11 allowances long.
        let spike = cut(&[(0.0, 0.0), (400.0, 0.0), (0.0, 70.0)], &ten(CornerKind::Miter));
        assert!(spike.points.iter().all(|p| p.at.x < 0.42));
        let circle: Vec<(f64, f64)> = (0..180)
            .map(|i| {
                let (s, c) = libm::sincos(f64::from(i) * std::f64::consts::PI / 90.0);
                (100.0 * c, 100.0 * s)
            })
            .collect();
        let mut round = piece(&circle);
        round.outline.points.iter_mut().skip(1).for_each(|p| p.kind = PointKind::Curve);
        let (line, _) = cut_line(&round, &ten(CornerKind::Miter)).expect("circle");
        // The chords keep 10 mm from the chords: circumscribed about 100 · cos 1° + 10.
        let inner = 100.0 * libm::cos(std::f64::consts::PI / 180.0) + 10.0;
        let outer = inner / libm::cos(std::f64::consts::PI / 180.0);
        assert!(line.points.iter().all(|p| (p.at.norm() * 1e3 - outer).abs() < 1e-6));
        assert!(line.points.iter().filter(|p| p.kind == PointKind::Turn).count() <= 1);
    }

    #[test]
    fn what_cannot_be_done_is_said() {
        let wide = Allowance { width: 0.5, ..Allowance::default() };
        assert_eq!(cut_line(&piece(&RECTANGLE), &wide).expect_err("too wide").code, "out-of-range");
        let edge = Allowance { edges: vec![(9, 0.01)], ..ten(CornerKind::Miter) };
        assert_eq!(cut_line(&piece(&RECTANGLE), &edge).expect_err("no edge").code, "edge-unknown");
        // A C of 10 mm gap closes.
        let c = [
            (0.0, 0.0),
            (300.0, 0.0),
            (300.0, 145.0),
            (100.0, 145.0),
            (100.0, 100.0),
            (50.0, 100.0),
            (50.0, 200.0),
            (100.0, 200.0),
            (100.0, 155.0),
            (300.0, 155.0),
            (300.0, 300.0),
            (0.0, 300.0),
        ];
        let (_, findings) = cut_line(&piece(&c), &ten(CornerKind::Miter)).expect("closed");
        assert_eq!(findings[0].code, "allowance-grows-together");
    }
}
