//! A piece cut apart along a line.

use super::build::{ALLOWANCE, Altered, Part, middle};
use super::contour::{Contour, Vertex, do_cross};
use super::marks::{Motion, Region};
use super::params::{Cut, Parts, Spot};
use super::{ALTER_LINE_LEAVES_PIECE, ALTER_PLACE, spot};
use crate::sewing::ring::{Gap, Ring};
use crate::sewing::shapes::{Shapes, mm};
use toile_formats::dxf::{curve, geom};
use toile_garment::notch::{Notch, NotchKind};
use toile_garment::outline::PointKind;
use toile_garment::sewing::{RunSpec, RunWay, SeamSpec};
use toile_garment::{Diagnostic, Garment, Piece, PieceId, Vec2};

/// A place this near to the point of a dart is the point, metres.
const AT_POINT: f64 = 1e-3;
/// Chords keep this near a smooth line, metres.
const CHORD: f64 = 0.1e-3;
/// Parts are at least as large, m².
const LEAST_AREA: f64 = 1e-4;
/// Depth of a new notch where the piece has none, metres.
const NOTCH_DEPTH: f64 = 4e-3;

/// An end of the line: its place on the outline, and the dart whose point it is.
struct End<'s> {
    arc: f64,
    dart: Option<&'s Gap>,
}

/// Cuts a piece apart.
pub fn cut(garment: &Garment, shapes: &Shapes, id: PieceId, p: &Cut) -> Result<Altered, Diagnostic> {
    let piece = &garment.pieces[id.index()];
    let ring = &shapes[id.index()].rings[0];
    let [Some(first), Some(last)] = [p.along.first(), p.along.last()] else { return Err(too_short(piece)) };
    if p.along.len() < 2 {
        return Err(too_short(piece));
    }
    let ends = [end(garment, shapes, id, first)?, end(garment, shapes, id, last)?];
    let inner = p.along[1..p.along.len() - 1].iter().map(|s| spot::point(garment, shapes, id, s));
    let inner = inner.collect::<Result<Vec<Vec2>, Diagnostic>>()?;
    let mut contour = Contour::of(piece, ring);
    let arcs = [ends[0].arc, ends[1].arc];
    // The second vertex may change the number of the first.
    arcs.into_iter().for_each(|s| {
        contour.insert(s);
    });
    let [from, to] = arcs.map(|s| contour.insert(s));
    let line = line(&contour, from, &inner, to, p.smooth);
    if from == to || !contour.holds_line(&line) {
        let ends = [line[0], line[line.len() - 1]].map(mm);
        let what = match crossed_darts(piece, ring, &line) {
            darts if darts.is_empty() => "leaves the piece".to_owned(),
            darts => format!("crosses {}", darts.join(", ")),
        };
        let message = format!("the line on piece `{}` from {} to {} {what}", p.piece, ends[0], ends[1]);
        return Err(Diagnostic::error(ALTER_LINE_LEAVES_PIECE, message)
            .hint("give it more places, so that it stays inside; at a dart it may begin or end at the point alone"));
    }
    // Left of the line lies what a walk meets from its end to its start.
    let left = side(&contour, to, from, line.iter().copied());
    let right = side(&contour, from, to, line.iter().rev().copied());
    if [&left, &right].into_iter().any(|part| part.area() < LEAST_AREA) {
        let message = format!("the line on piece `{}` cuts off less than {:.0} cm²", piece.name, 1e4 * LEAST_AREA);
        return Err(Diagnostic::error(ALTER_LINE_LEAVES_PIECE, message).hint("let it run through the piece"));
    }
    let names = names(garment, piece, p, [&left, &right])?;
    let seam = seam(ring, p, &names, &ends, &line);
    let notches = notches(piece, &ends, &line);
    let part = |k: usize, contour: Contour| Part {
        name: names[k].clone(),
        contour,
        darts: Vec::new(),
        notches: notches.clone(),
        holes: Vec::new(),
    };
    let region = |k: usize, contour: &Contour| Region { polygon: contour.points(), motion: Motion::NONE, part: k };
    Ok(Altered {
        regions: vec![region(0, &left), region(1, &right)],
        parts: vec![part(0, left), part(1, right)],
        gone: ends.iter().filter_map(|e| e.dart.map(|g| g.dart)).collect(),
        is_unmarked: true,
        ring: ring.clone(),
        seam: Some(seam),
        allowance: p.allowance.map_or(ALLOWANCE, |a| a.0),
        told: format!(
            "piece `{}` was cut along {:.0} mm into `{}` and `{}`",
            piece.name,
            1e3 * geom::length(&line, false),
            names[0],
            names[1]
        ),
        findings: Vec::new(),
    })
}

/// The wedge darts whose legs a line crosses.
fn crossed_darts(piece: &Piece, ring: &Ring, line: &[Vec2]) -> Vec<String> {
    let legs = |g: &Gap| g.apex.map(|apex| [g.from, apex, g.to].map(|i| ring.points[i]));
    let crosses = |g: &&Gap| {
        legs(g).is_some_and(|p| line.windows(2).any(|w| p.windows(2).any(|l| do_cross([w[0], w[1]], [l[0], l[1]]))))
    };
    let name = |g: &Gap| piece.darts.get(g.dart).map(|d| format!("dart `{}`", d.name));
    ring.gaps.iter().filter(crosses).filter_map(name).collect()
}

fn too_short(piece: &Piece) -> Diagnostic {
    Diagnostic::error(ALTER_PLACE, format!("the line on piece `{}` has fewer than two places", piece.name))
        .hint("`along` needs a place at each end")
}

/// The names of the parts left and right of the line. No other piece has them.
fn names(garment: &Garment, piece: &Piece, p: &Cut, parts: [&Contour; 2]) -> Result<[String; 2], Diagnostic> {
    let up = piece.warp();
    let (way, first, second) = match &p.into {
        Parts::Along(n) => (up, &n.upper, &n.lower),
        Parts::Across(n) => (Vec2::new(-up.y, up.x), &n.left, &n.right),
    };
    let is_taken = |name: &&String| {
        let mut others = garment.pieces.iter().filter(|q| q.id != piece.id);
        name.trim().is_empty() || others.any(|q| q.name.eq_ignore_ascii_case(name))
    };
    let bad = [first, second].into_iter().find(is_taken);
    if let Some(bad) = bad.or_else(|| Some(first).filter(|n| n.eq_ignore_ascii_case(second))) {
        let message = format!("a part of piece `{}` cannot be called `{bad}`", piece.name);
        return Err(Diagnostic::error(ALTER_PLACE, message).hint("give both parts names that no piece has"));
    }
    let [a, b] = parts.map(|c| center(&c.points()).dot(&way));
    Ok(if a > b { [first.clone(), second.clone()] } else { [second.clone(), first.clone()] })
}

/// The middle of the area of a polygon.
fn center(points: &[Vec2]) -> Vec2 {
    let next = points.iter().cycle().skip(1);
    let (mut area, mut sum) = (0.0, Vec2::new(0.0, 0.0));
    for (a, b) in points.iter().zip(next) {
        let (a, b) = (a - points[0], b - points[0]);
        let cross = a.x * b.y - a.y * b.x;
        area += cross;
        sum += (a + b) * cross;
    }
    points[0] + sum / (3.0 * area.abs().max(1e-12)) * area.signum()
}

fn end<'s>(garment: &Garment, shapes: &'s Shapes, id: PieceId, at: &Spot) -> Result<End<'s>, Diagnostic> {
    let ring = &shapes[id.index()].rings[0];
    let arc = spot::on_outline(garment, shapes, id, at)?;
    let near = |g: &&Gap| g.apex.is_some_and(|a| (ring.points[a] - ring.at(arc)).norm() < AT_POINT);
    let dart = ring.gaps.iter().find(near);
    if dart.is_none() && ring.gap_around(arc).is_some() {
        let message = format!("the line on piece `{}` ends on the leg of a dart", garment.pieces[id.index()].name);
        return Err(Diagnostic::error(ALTER_PLACE, message).hint("end it at the point of the dart, or at an edge"));
    }
    Ok(End { arc: dart.and_then(|g| g.apex).map_or(arc, |a| ring.arc[a]), dart })
}

/// The places of the line, both ends on the outline.
fn line(contour: &Contour, from: usize, inner: &[Vec2], to: usize, smooth: bool) -> Vec<Vec2> {
    let [a, b] = [from, to].map(|k| contour.vertices[k].at);
    let places: Vec<Vec2> = std::iter::once(a).chain(inner.iter().copied()).chain([b]).collect();
    if smooth { curve::through(&places, false, CHORD) } else { places }
}

/// The part of the outline from one vertex forward to another, closed by the line.
fn side(contour: &Contour, from: usize, to: usize, line: impl Iterator<Item = Vec2>) -> Contour {
    let mut vertices = contour.chain(from, to);
    let line: Vec<Vec2> = line.collect();
    let inner = line[1..line.len() - 1].iter().map(|at| Vertex::new(*at, PointKind::Plain));
    vertices.extend(inner);
    let ends = [line[0], line[line.len() - 1]];
    let mut out = Contour { vertices }.cleaned();
    out.tell_kinds(&line[1..line.len() - 1]);
    out.tell_kinds(&ends);
    out
}

/// The seam between both parts: the line, and the legs of the darts at its ends.
fn seam(ring: &Ring, p: &Cut, names: &[String; 2], ends: &[End<'_>; 2], line: &[Vec2]) -> SeamSpec {
    // A walk along the left part comes to the line at its start. There it leaves the old outline by the first leg of the
    // dart, if one lies there, and at the end it goes on along the second leg of the other.
    let mouths = |k: usize| ends[k].dart.map(|g| [ring.points[g.from], ring.points[g.to]]);
    let [start, finish] = [line[0], line[line.len() - 1]];
    let left = [mouths(0).map_or(start, |m| m[0]), mouths(1).map_or(finish, |m| m[1])];
    let right = [mouths(0).map_or(start, |m| m[1]), mouths(1).map_or(finish, |m| m[0])];
    let run = |k: usize, ends: [Vec2; 2], way: RunWay| RunSpec::Points {
        piece: names[k].clone(),
        from: ends[0],
        to: ends[1],
        way,
    };
    SeamSpec {
        name: p.seam.clone().unwrap_or_else(|| format!("{} {}", names[0], names[1])),
        a: vec![run(0, left, RunWay::Left)],
        b: vec![run(1, right, RunWay::Right)],
        reverse: None,
        ease: None,
        gather: None,
        proposed: None,
        source: None,
    }
}

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

/// Notches of both parts: in the middle of the line, and at the points of the darts at its ends.
fn notches(piece: &Piece, ends: &[End<'_>; 2], line: &[Vec2]) -> Vec<Notch> {
    let length: f64 = line.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let mut way = length / 2.0;
    let mut half = line[0];
    for w in line.windows(2) {
        let step = (w[1] - w[0]).norm();
        if way <= step {
            half = w[0] + (w[1] - w[0]) * (way / step.max(1e-12));
            break;
        }
        way -= step;
    }
    let notch = |at: Vec2| new_notch(piece, at);
    let points = [(0, line[0]), (1, line[line.len() - 1])].into_iter().filter(|(k, _)| ends[*k].dart.is_some());
    let points: Vec<Vec2> = points.map(|(_, at)| at).collect();
    // Points of darts that lie near each other need no notch between them.
    let is_clear = points.iter().all(|p| (p - half).norm() > 3.0 * NOTCH_DEPTH);
    let middle_place =
        if is_clear { Some(half) } else { points.first().zip(points.get(1)).map(|(a, b)| middle(*a, *b)) };
    points.iter().copied().chain(middle_place.filter(|_| is_clear)).map(notch).collect()
}
