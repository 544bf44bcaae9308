//! Darts turned into another place of the outline, and darts closed while an edge spreads.

use super::ALTER_LINE_LEAVES_PIECE;
use super::build::{ALLOWANCE, Altered, Part, middle};
use super::contour::{Contour, Vertex};
use super::cut::new_notch;
use super::marks::{Motion, Region, marks_of};
use super::params::{Close, Pivot, Spot};
use super::{ALTER_DART, ALTER_LEGS_DIFFER, ALTER_OVERLAPS, ALTER_PLACE, spot};
use crate::sewing::shapes::{Shapes, mm};
use toile_formats::dxf::geom::inside;
use toile_garment::dart::{Dart, DartEvidence, DartKind};
use toile_garment::outline::PointKind;
use toile_garment::piece::DrillHole;
use toile_garment::{Diagnostic, Garment, PieceId, Vec2};

/// How far the points of two darts are drawn back from each other where nothing is said, metres.
const BACK: f64 = 20e-3;
/// A drill hole stands so far before the point of its dart, metres.
const HOLE: f64 = 10e-3;
/// Legs that differ by more are told, metres.
const LEGS_DIFFER: f64 = 0.5e-3;

/// The way in which a dart is turned.
struct Turn<'a> {
    piece: &'a str,
    dart: &'a str,
    to: &'a Spot,
    /// Share of its angle.
    share: f64,
    /// How far the points of two darts are drawn back, metres.
    back: f64,
    /// Does a dart open at the new place, or does the edge spread?
    opens: bool,
}

/// Turns a dart to another place of the outline.
pub fn pivot(garment: &Garment, shapes: &Shapes, id: PieceId, p: &Pivot) -> Result<Altered, Diagnostic> {
    let share = p.share.map_or(1.0, |s| s.0);
    if !(0.05..=1.0).contains(&share) {
        let message = format!("`share` of the dart `{}` is {:.0} %; it must be 5 to 100 %", p.dart, 100.0 * share);
        return Err(Diagnostic::error(ALTER_DART, message));
    }
    let back = if share < 1.0 { p.back.map_or(BACK, |b| b.0.max(1e-3)) } else { p.back.map_or(0.0, |b| b.0.max(0.0)) };
    turn(garment, shapes, id, &Turn { piece: &p.piece, dart: &p.dart, to: &p.to, share, back, opens: true })
}

/// Closes a dart and spreads an edge.
pub fn close(garment: &Garment, shapes: &Shapes, id: PieceId, p: &Close) -> Result<Altered, Diagnostic> {
    let to = Turn { piece: &p.piece, dart: &p.dart, to: &p.to, share: 1.0, back: 0.0, opens: false };
    turn(garment, shapes, id, &to)
}

fn turn(garment: &Garment, shapes: &Shapes, id: PieceId, t: &Turn<'_>) -> Result<Altered, Diagnostic> {
    let piece = &garment.pieces[id.index()];
    let ring = &shapes[id.index()].rings[0];
    let (number, dart, gap) = spot::wedge(garment, shapes, id, t.dart)?;
    let s = spot::on_outline(garment, shapes, id, t.to)?;
    if ring.gap_around(s).is_some() {
        let message = format!("the new place of dart `{}` lies in a dart of piece `{}`", t.dart, t.piece);
        return Err(Diagnostic::error(ALTER_PLACE, message).hint("give a place on an edge of the cloth"));
    }
    let mut contour = Contour::of(piece, ring);
    let slash = contour.insert(s);
    let Some([first, apex, second]) = contour.dart(ring, gap) else {
        return Err(Diagnostic::error(ALTER_DART, format!("dart `{}` is not on the outline of its piece", t.dart)));
    };
    let at = |k: usize| contour.vertices[k].at;
    let (point, cut) = (at(apex), at(slash));
    if !contour.holds_line(&[cut, point]) || slash == first || slash == second {
        let message = format!(
            "the line from {} to the point of dart `{}` leaves piece `{}`, or runs along the dart",
            mm(cut),
            t.dart,
            t.piece
        );
        return Err(Diagnostic::error(ALTER_LINE_LEAVES_PIECE, message).hint("open the dart at another place"));
    }
    // The outline from the cut forward to the dart, and from the dart forward to the cut.
    let before = contour.chain(slash, first);
    let after = contour.chain(second, slash);
    let angle = t.share * angle(at(second) - point, at(first) - point);
    let polygon = |chain: &[Vertex]| chain.iter().map(|v| v.at).chain([point]).collect::<Vec<Vec2>>();
    let polygons = [polygon(&before), polygon(&after)];
    let turned = usize::from(stays(piece, &polygons) == 0);
    let mut motions = [Motion::NONE; 2];
    motions[turned] = Motion { about: point, angle: if turned == 1 { angle } else { -angle } };
    let moved = |chain: &[Vertex], m: Motion| -> Vec<Vertex> {
        chain.iter().map(|v| Vertex { at: m.apply(v.at), ..*v }).collect()
    };
    let (mut before, mut after) = (moved(&before, motions[0]), moved(&after, motions[1]));
    let [far, near] = [after[after.len() - 1].at, before[0].at];
    let mouth = [before[before.len() - 1].at, after[0].at];
    // A dart that is drawn back points to where it pointed.
    let drawn_back = |mouth: [Vec2; 2]| {
        let way = middle(mouth[0], mouth[1]) - point;
        point + way * (t.back / way.norm().max(1e-9)).min(0.9)
    };
    let mut vertices = Vec::new();
    let mut darts = Vec::new();
    let [is_notched, is_drilled] = marks_of(piece, dart);
    let (mut notches, mut holes) = (Vec::new(), Vec::new());
    if t.share < 1.0 {
        let left = drawn_back(mouth);
        vertices.append(&mut before);
        vertices.push(Vertex::new(left, PointKind::Turn));
        darts.push(wedge(dart, dart.name.clone(), mouth, left));
    } else {
        // The cloth on both sides of the old mouth is one.
        let joint = before.len() - 1;
        before[joint].stretch = after[0].stretch.filter(|_| (mouth[0] - mouth[1]).norm() < 1e-6);
        let skip = usize::from((mouth[0] - mouth[1]).norm() < 1e-6);
        vertices.append(&mut before);
        after.drain(..skip);
    }
    vertices.append(&mut after);
    if t.opens {
        let opened = drawn_back([far, near]);
        vertices.push(Vertex::new(opened, PointKind::Turn));
        let name = if t.share < 1.0 { free_name(&piece.darts) } else { dart.name.clone() };
        darts.push(wedge(dart, name, [far, near], opened));
        // The dart is marked at its new place as it was at the old one.
        notches.extend([far, near].into_iter().filter(|_| is_notched).map(|at| new_notch(piece, at)));
        let way = middle(far, near) - opened;
        let at = opened + way * (HOLE / way.norm().max(1e-9)).min(0.5);
        holes.extend(is_drilled.then_some(DrillHole { at, diameter: None, source: None }));
    }
    let mut outline = Contour { vertices }.cleaned();
    let joints: &[Vec2] = if t.opens { &mouth } else { &[mouth[0], mouth[1], far, near] };
    if t.share >= 1.0 {
        outline.tell_kinds(joints);
    }
    if let Some(place) = outline.crossing() {
        let message = format!("piece `{}` would lie over itself at {}", t.piece, mm(place));
        return Err(Diagnostic::error(ALTER_OVERLAPS, message).hint("turn the dart to another place, or a part of it"));
    }
    let [p0, p1] = polygons;
    let regions =
        vec![Region { polygon: p0, motion: motions[0], part: 0 }, Region { polygon: p1, motion: motions[1], part: 0 }];
    let what = if t.opens { "turned" } else { "closed, and the edge spread by" };
    let width = if t.opens {
        format!("{:.1} degrees", angle.abs().to_degrees())
    } else {
        format!("{:.1} mm", 1e3 * (far - near).norm())
    };
    let told = format!("dart `{}` of piece `{}` was {what} {width} at {}", t.dart, t.piece, mm(cut));
    let part = Part { name: piece.name.clone(), contour: outline, darts, notches, holes };
    Ok(Altered {
        parts: vec![part],
        regions,
        gone: vec![number],
        is_unmarked: t.share >= 1.0,
        ring: ring.clone(),
        seam: None,
        allowance: ALLOWANCE,
        told,
        findings: legs_differ(piece.name.as_str(), dart).into_iter().collect(),
    })
}

/// The angle by which one direction is turned into another, radians.
fn angle(from: Vec2, to: Vec2) -> f64 {
    libm::atan2(from.x * to.y - from.y * to.x, from.dot(&to))
}

/// The region that stays: the one that holds the middle of the grain line, else the larger one.
fn stays(piece: &toile_garment::Piece, polygons: &[Vec<Vec2>; 2]) -> usize {
    let on = |k: usize| piece.grain.is_some_and(|g| inside(middle(g[0], g[1]), &polygons[k]));
    let area = |polygon: &[Vec2]| {
        let next = polygon.iter().cycle().skip(1);
        polygon.iter().zip(next).map(|(a, b)| a.x * b.y - a.y * b.x).sum::<f64>()
    };
    match (on(0), on(1)) {
        (true, false) => 0,
        (false, true) => 1,
        _ => usize::from(area(&polygons[1]) > area(&polygons[0])),
    }
}

fn legs_differ(piece: &str, dart: &Dart) -> Option<Diagnostic> {
    let apart = dart.leg_length(0) - dart.leg_length(1);
    (apart.abs() > LEGS_DIFFER).then(|| {
        let message = format!(
            "the legs of dart `{}` of piece `{piece}` differ by {:.1} mm, so a step is left where it was closed",
            dart.name,
            1e3 * apart.abs()
        );
        Diagnostic::warning(ALTER_LEGS_DIFFER, message).hint("make the legs equally long first")
    })
}

/// A wedge dart with straight legs.
pub fn wedge(like: &Dart, name: String, mouth: [Vec2; 2], apex: Vec2) -> Dart {
    Dart {
        name,
        kind: DartKind::Wedge,
        evidence: DartEvidence::Declared,
        apexes: vec![apex],
        mouth,
        legs: mouth.map(|m| vec![m, apex]),
        line: "cut".to_owned(),
        depth: None,
        mesh: None,
        source: like.source.clone(),
    }
}

/// A name that no dart has.
fn free_name(darts: &[Dart]) -> String {
    let is_free = |n: &String| !darts.iter().any(|d| d.name == *n);
    (1..).map(|n| format!("dart-{n}")).find(is_free).unwrap_or_default()
}
