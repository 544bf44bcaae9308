//! The curves of one piece: checked rings, and internal lines clipped to the cloth and joined where they meet.

use super::codes;
use super::crossing::{Segment, TooComplex, meetings, segments};
use super::curve::{Curve, CurveKind};
use super::lattice::distance;
use super::lyon::covers;
use crate::codes::OUTLINE_TOO_SMALL;
use crate::sewing::ring::{SAME, clean, snap};
use crate::sewing::shapes::{PieceShape, mm};
use toile_formats::codes::OUTLINE_CROSSES_ITSELF;
use toile_garment::dart::DartKind;
use toile_garment::{Code, Diagnostic, Piece, Report, Vec2};

/// A line that ends nearer to another than this share of the edge length ends on it.
const JOIN: f64 = 0.2;
/// A line nearer to the outline than this share of the edge length, all along, is the outline drawn twice.
const ON_OUTLINE: f64 = 0.1;
/// A line whose points lie this near to a fold is drawn for it, m.
const ON_FOLD: f64 = 1e-3;
/// A piece smaller than this is a drawing mistake (4 mm²).
const NO_AREA: f64 = 4e-6;
/// So many places are named per piece.
const SHOWN: usize = 8;

/// Curves of the rings of a piece, checked: the outline is curve 0, cutout k is curve 1 + k, then seam lines. Fish-eye
/// darts follow.
///
/// # Errors
/// Self-crossing or too small outlines, cutouts outside the piece, with their places.
pub fn boundary(piece: &Piece, shape: &PieceShape) -> Result<Vec<Curve>, Vec<Diagnostic>> {
    let mut curves = Vec::new();
    for (k, ring) in shape.rings.iter().enumerate() {
        curves.push(match (k, shape.seam_line(k)) {
            (_, Some(line)) => Curve::line(CurveKind::SeamLine(line), ring.line().to_vec(), false),
            (0, None) => Curve::ring(CurveKind::Outline, ring),
            (k, None) => Curve::ring(CurveKind::Cutout(k - 1), ring),
        });
    }
    for (k, dart) in piece.darts.iter().enumerate() {
        if dart.kind == DartKind::FishEye && !shape.void_darts.contains(&k) {
            let back = dart.legs[1].iter().rev().skip(1);
            let points: Vec<Vec2> = dart.legs[0].iter().chain(back).copied().collect();
            let (mut points, _) = clean(&points);
            // The legs run from apex to apex: the walk starts at the first.
            if let Some(first) = dart.legs[0].first()
                && let Some(at) = points.iter().position(|p| (p - snap(*first)).norm() < SAME)
            {
                points.rotate_left(at);
            }
            curves.push(Curve::line(CurveKind::FishEye(k), points, true));
        }
    }
    check(piece, &curves)?;
    Ok(curves)
}

fn what(piece: &Piece, kind: CurveKind) -> String {
    match kind {
        CurveKind::Outline => "outline".to_owned(),
        CurveKind::Cutout(k) => format!("cutout {k}"),
        CurveKind::FishEye(k) => format!("dart `{}`", piece.darts.get(k).map_or("", |d| &d.name)),
        CurveKind::PleatLeg(k, _) => format!("pleat `{}`", piece.darts.get(k).map_or("", |d| &d.name)),
        CurveKind::Line(k) => format!("fold line {k}"),
        CurveKind::SeamLine(k) => format!("seam line {k}"),
    }
}

fn check(piece: &Piece, curves: &[Curve]) -> Result<(), Vec<Diagnostic>> {
    let mut errors = Vec::new();
    let at = || piece.outline.source.clone().or_else(|| piece.source.clone());
    for c in curves.iter().filter(|c| c.closed) {
        let area = signed_area(&c.points);
        if c.points.len() < 3 || area.abs() < NO_AREA && c.kind == CurveKind::Outline || area == 0.0 {
            let message = format!("piece `{}`: the {} encloses {:.3} mm²", piece.name, what(piece, c.kind), area * 1e6);
            let place = c.points.first().map_or(String::new(), |p| format!(" near {}", mm(*p)));
            errors.push(Diagnostic::error(OUTLINE_TOO_SMALL, message + &place).at(at()));
        } else if c.kind == CurveKind::Outline && area < 0.0 {
            let message = format!("piece `{}`: the outline runs clockwise", piece.name);
            errors.push(Diagnostic::error(codes::OUTLINE_CLOCKWISE, message).at(at()));
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let all: Vec<Segment> = curves.iter().enumerate().flat_map(|(k, c)| segments(&c.points, c.closed, k)).collect();
    let apart =
        |s: &Segment, t: &Segment| s.curve != t.curve || !neighbours(s.index, t.index, curves[s.curve].points.len());
    match meetings(all, apart, SHOWN) {
        Ok(found) if found.is_empty() => {}
        Ok(found) => errors.extend(found.iter().map(|m| {
            let (a, b) = (what(piece, curves[m.first.curve].kind), what(piece, curves[m.second.curve].kind));
            let (code, words) = if m.first.curve == m.second.curve {
                (OUTLINE_CROSSES_ITSELF, format!("the {a} crosses or touches itself"))
            } else {
                (codes::LINES_CROSS, format!("the {a} crosses or touches the {b}"))
            };
            Diagnostic::error(code, format!("piece `{}`: {words} at {}", piece.name, mm(m.at)))
                .at(at())
                .hint("redraw the line so that it encloses one area")
        })),
        Err(TooComplex) => errors.push(
            Diagnostic::error(
                codes::OUTLINE_TOO_COMPLEX,
                format!("piece `{}`: its lines overlap too often to be checked", piece.name),
            )
            .at(at()),
        ),
    }
    if errors.is_empty() {
        for c in &curves[1..] {
            let is_other_hole = |d: &&Curve| d.kind != c.kind && d.kind.bounds_cloth();
            let holes = curves[1..].iter().filter(is_other_hole).map(|d| d.points.as_slice());
            let outside = !covers([curves[0].points.as_slice()], c.points[0]);
            if outside || covers(holes, c.points[0]) {
                let where_ = if outside { "lies outside the outline" } else { "lies inside another hole" };
                let message =
                    format!("piece `{}`: the {} {where_}, at {}", piece.name, what(piece, c.kind), mm(c.points[0]));
                errors.push(Diagnostic::error(codes::HOLE_MISPLACED, message).at(at()));
            }
        }
    }
    if errors.is_empty() { Ok(()) } else { Err(errors) }
}

fn neighbours(i: usize, k: usize, n: usize) -> bool {
    let d = i.abs_diff(k);
    d <= 1 || d + 1 == n
}

/// Signed area of a closed polygon.
pub fn signed_area(points: &[Vec2]) -> f64 {
    let n = points.len();
    let Some(o) = points.first() else { return 0.0 };
    (0..n)
        .map(|i| {
            let (a, b) = (points[i] - o, points[(i + 1) % n] - o);
            0.5 * (a.x * b.y - a.y * b.x)
        })
        .sum()
}

/// Adds pleat legs, and internal lines along which the cloth is folded, to the curves, and breaks all where they meet.
/// Lines that are left out are reported. No other internal line acts on the cloth: it lies on the triangles.
pub fn add_lines(
    piece: &Piece,
    curves: &mut Vec<Curve>,
    h: f64,
    is_left_out: &dyn Fn(usize) -> bool,
    report: &mut Report,
) {
    for (k, dart) in piece.darts.iter().enumerate().filter(|(_, d)| d.kind == DartKind::Pleat) {
        for (leg, points) in dart.legs.iter().enumerate().filter(|(_, l)| l.len() > 1) {
            add(piece, curves, CurveKind::PleatLeg(k, leg), points, false, h, report);
        }
    }
    for (k, line) in piece.internal_lines.iter().enumerate().filter(|(_, line)| is_folded(piece, &line.positions())) {
        if is_left_out(k) {
            let message =
                format!("piece `{}`: fold line {k} runs too close to another line and is not folded", piece.name);
            report.push(
                Diagnostic::info(codes::FOLD_LINE_TOO_CLOSE, message)
                    .at(line.source.clone())
                    .hint("draw it farther from the other line, or use a shorter edge_length"),
            );
            continue;
        }
        add(piece, curves, CurveKind::Line(k), &line.positions(), line.closed, h, report);
    }
}

/// Is the cloth folded along a line?
fn is_folded(piece: &Piece, line: &[Vec2]) -> bool {
    let on = |fold: &[Vec2], p: &Vec2| fold.windows(2).any(|w| distance(w[0], w[1], *p) < ON_FOLD);
    piece.folds.iter().any(|fold| line.iter().all(|p| on(&fold.line, p)))
}

fn add(
    piece: &Piece,
    curves: &mut Vec<Curve>,
    kind: CurveKind,
    points: &[Vec2],
    closed: bool,
    h: f64,
    report: &mut Report,
) {
    let source = || match kind {
        CurveKind::Line(k) => piece.internal_lines.get(k).and_then(|l| l.source.clone()),
        _ => None,
    };
    let mut drop = |code: Code, why: &str| {
        let message = format!("piece `{}`: the {} {why}", piece.name, what(piece, kind));
        report.push(Diagnostic::info(code, message).at(source()));
    };
    let points = tidy(points, closed);
    let closed = closed && points.len() > 2;
    if points.len() < 2 || length(&points) < 0.05 * h {
        drop(codes::FOLD_LINE_TOO_SHORT, "is too short to be meshed and is left out");
        return;
    }
    let (line, cuts) = cut_at_boundary(curves, kind, points, closed);
    let mut left_out = 0.0;
    for (from, to) in stretches(&line, &cuts) {
        let part = part(&line, from, to);
        let middle = line.at(from + 0.5 * (to - from));
        let cloth = covers(curves.iter().filter(|c| c.kind.bounds_cloth()).map(|c| c.points.as_slice()), middle);
        let length = to - from;
        if !cloth || along_boundary(curves, &part, h) || (length < JOIN * h && !cuts.is_empty()) {
            left_out += length;
            continue;
        }
        let whole_ring = closed && cuts.is_empty();
        place(curves, Curve::line(kind, part, whole_ring), h);
    }
    if left_out > 1e-3 {
        drop(codes::FOLD_LINE_CLIPPED, &format!("lies outside the cloth or on its edge for {:.1} mm", left_out * 1e3));
    }
}

/// Clean points of an open or closed line.
fn tidy(points: &[Vec2], closed: bool) -> Vec<Vec2> {
    let mut out: Vec<Vec2> = Vec::with_capacity(points.len());
    for p in points.iter().map(|p| snap(*p)) {
        if out.last().is_none_or(|q| (p - q).norm() > SAME) {
            out.push(p);
        }
    }
    while closed && out.len() > 1 && (out[0] - out[out.len() - 1]).norm() < SAME {
        out.pop();
    }
    out
}

fn length(points: &[Vec2]) -> f64 {
    points.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
}

/// The line with its crossings of the boundary among its points, and the places of those.
fn cut_at_boundary(curves: &mut [Curve], kind: CurveKind, points: Vec<Vec2>, closed: bool) -> (Curve, Vec<f64>) {
    let own = curves.len();
    let mut all = segments(&points, closed, own);
    for (k, c) in curves.iter().enumerate().filter(|(_, c)| c.kind.bounds_cloth()) {
        all.extend(segments(&c.points, true, k));
    }
    let pair = |s: &Segment, t: &Segment| (s.curve == own) != (t.curve == own);
    let found = meetings(all, pair, 1000).unwrap_or_default();
    let mut line = Curve::line(kind, points, closed);
    let mut cuts: Vec<f64> = Vec::new();
    for m in found {
        let ring = if m.first.curve == own { m.second.curve } else { m.first.curve };
        let (s, _) = curves[ring].project(m.at);
        curves[ring].add_break(s);
        let at = curves[ring].to_break(s).map_or(m.at, |(b, _)| curves[ring].at(b));
        let (t, _) = line.project(at);
        line.insert_point(t, at);
        cuts.push(line.wrap(t));
    }
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|a, b| (*a - *b).abs() < SAME);
    (line, cuts)
}

/// Stretches between cuts, as (from, to) with to beyond the total where a closed line wraps.
fn stretches(line: &Curve, cuts: &[f64]) -> Vec<(f64, f64)> {
    let total = line.total();
    if line.closed {
        if cuts.is_empty() {
            return vec![(0.0, total)];
        }
        let n = cuts.len();
        return (0..n).map(|i| (cuts[i], if i + 1 < n { cuts[i + 1] } else { cuts[0] + total })).collect();
    }
    let stops: Vec<f64> = std::iter::once(0.0).chain(cuts.iter().copied()).chain([total]).collect();
    stops.windows(2).map(|w| (w[0], w[1])).filter(|(a, b)| b - a > SAME).collect()
}

/// Points of a stretch; a whole closed line keeps its points.
fn part(line: &Curve, from: f64, to: f64) -> Vec<Vec2> {
    if line.closed && from == 0.0 && to == line.total() {
        return line.points.clone();
    }
    line.between(from, to)
}

/// Does the line run on the boundary all along?
fn along_boundary(curves: &[Curve], part: &[Vec2], h: f64) -> bool {
    let line = Curve::line(CurveKind::Line(0), part.to_vec(), false);
    (1..16).all(|k| {
        let p = line.at(line.total() * f64::from(k) / 16.0);
        curves.iter().filter(|c| c.kind.bounds_cloth()).any(|c| c.project(p).1 < ON_OUTLINE * h)
    })
}

/// Joins a line to what is there and adds it.
fn place(curves: &mut Vec<Curve>, mut line: Curve, h: f64) {
    if !line.closed {
        let last = line.points.len() - 1;
        let ends = [line.points[0], line.points[last]];
        let joined = ends.map(|p| join(curves, p, h));
        if (joined[0] - joined[1]).norm() > SAME {
            line.points[0] = joined[0];
            line.points[last] = joined[1];
            line = Curve::line(line.kind, line.points, false);
        }
    }
    let own = curves.len();
    let n = line.points.len();
    let mut all = segments(&line.points, line.closed, own);
    for (k, c) in curves.iter().enumerate().filter(|(_, c)| !c.kind.bounds_cloth()) {
        all.extend(segments(&c.points, c.closed, k));
    }
    let closed = line.closed;
    let pair = |s: &Segment, t: &Segment| match (s.curve == own, t.curve == own) {
        (true, true) => s.index.abs_diff(t.index) > 1 && !(closed && s.index.abs_diff(t.index) + 1 == n),
        (false, false) => false,
        _ => true,
    };
    for m in meetings(all, pair, 1000).unwrap_or_default() {
        let own_places = [m.first, m.second].map(|s| (s.curve == own).then(|| place_on(&s, m.at, &line)));
        for s in own_places.into_iter().flatten() {
            line.insert_point(s, m.at);
            line.add_break(s);
        }
        for s in [m.first, m.second].iter().filter(|s| s.curve != own) {
            let (t, _) = curves[s.curve].project(m.at);
            curves[s.curve].insert_point(t, m.at);
            curves[s.curve].add_break(t);
        }
    }
    // Corners of the line itself.
    for i in 0..line.points.len() {
        if line.turn(i) > 25_f64.to_radians() {
            let s = line.arc[i];
            line.add_break(s);
        }
    }
    curves.push(line);
}

fn place_on(s: &Segment, p: Vec2, line: &Curve) -> f64 {
    // Positions shift when points are inserted: the segment's own start is found again.
    let start = line.points.iter().position(|q| *q == s.a).map_or(0.0, |i| line.arc[i]);
    start + (p - s.a).norm()
}

/// The point a line's end is drawn to: a place on a curve within reach, a break of it if one is as near.
fn join(curves: &mut [Curve], p: Vec2, h: f64) -> Vec2 {
    let reach = JOIN * h;
    let best = curves
        .iter()
        .enumerate()
        .map(|(k, c)| (k, c.project(p)))
        .filter(|(_, (_, d))| *d < reach)
        .min_by(|a, b| a.1.1.total_cmp(&b.1.1));
    let Some((k, (s, _))) = best else { return p };
    if let Some((b, d)) = curves[k].to_break(s)
        && d < reach
    {
        return curves[k].at(b);
    }
    let at = snap(curves[k].at(s));
    if !curves[k].kind.bounds_cloth() {
        curves[k].insert_point(s, at);
    }
    curves[k].add_break(s);
    curves[k].at(curves[k].wrap(s))
}
