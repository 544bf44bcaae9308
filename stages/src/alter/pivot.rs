//! Darts turned into another place of the outline, and darts closed while an edge spreads.

use super::ALTER_LINE_LEAVES_PIECE;
use super::build::{ALLOWANCE, Altered, Gone, Part, SAME_PLACE, middle};
use super::contour::{Contour, Vertex};
use super::cut::new_notch;
use super::marks::{Region, marks_of};
use super::motion::Motion;
use super::params::{Close, Pivot, Spot};
use super::{ALTER_DART, ALTER_LEGS_DIFFER, ALTER_OVERLAPS, ALTER_PLACE, spot};
use crate::sewing::ring::Gap;
use crate::sewing::shapes::{Shapes, mm};
use toile_formats::dxf::geom::{self, inside};
use toile_garment::dart::{Dart, DartEvidence, DartKind};
use toile_garment::notch::Notch;
use toile_garment::outline::PointKind;
use toile_garment::piece::DrillHole;
use toile_garment::{Diagnostic, Garment, Piece, PieceId, Vec2};

/// How far the points of two darts are drawn back from each other where nothing is said, metres.
const BACK: f64 = 20e-3;
/// A drill hole stands so far before the point of its dart, metres.
const HOLE: f64 = 10e-3;
/// Legs that differ by more are told, metres.
pub const LEGS_DIFFER: f64 = 0.5e-3;

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
    let (number, dart, gap) = spot::wedge(garment, shapes, id, t.dart)?;
    let slash = Slash::new(garment, shapes, id, t, gap)?;
    let polygons = slash.polygons();
    let angle = t.share * slash.angle();
    let mut motions = [Motion::NONE; 2];
    let turned = 1 - stays(piece, &polygons);
    motions[turned] = Motion::turn(slash.point, if turned == 1 { angle } else { -angle });
    let Joined { outline, darts, opened } = slash.joined(piece, dart, t, motions);
    if let Some(place) = outline.crossing() {
        let message = format!("piece `{}` would lie over itself at {}", t.piece, mm(place));
        return Err(Diagnostic::error(ALTER_OVERLAPS, message).hint("turn the dart to another place, or a part of it"));
    }
    let what = if t.opens {
        format!("turned {:.1} degrees", angle.abs().to_degrees())
    } else {
        let edge = spot::edge_label(piece, slash.place);
        format!("closed, and {edge} spread by {:.1} mm", 1e3 * (opened[0] - opened[1]).norm())
    };
    let (notches, holes) = if t.opens { marks(piece, dart, &darts[darts.len() - 1]) } else { Default::default() };
    let regions = polygons.into_iter().zip(motions).map(|(polygon, motion)| Region { polygon, motion, part: 0 });
    Ok(Altered {
        parts: vec![Part { name: piece.name.clone(), contour: outline, darts, notches, holes }],
        regions: regions.collect(),
        gone: vec![Gone::new(number, t.share >= 1.0)],
        ring: shapes[id.index()].rings[0].clone(),
        seams: Vec::new(),
        allowance: ALLOWANCE,
        told: format!("dart `{}` of piece `{}` was {what} at {}", t.dart, t.piece, mm(slash.place)),
        findings: legs_differ(piece.name.as_str(), dart).into_iter().collect(),
    })
}

/// A piece that is cut from a place of its outline to the point of a dart.
struct Slash {
    /// The place, metres.
    place: Vec2,
    /// The point of the dart, metres.
    point: Vec2,
    /// The outline from the place forward to the dart, and from the dart forward to the place.
    sides: [Vec<Vertex>; 2],
}

/// The sides of a cut once the dart is turned.
struct Joined {
    outline: Contour,
    /// The rest of the dart, and the dart that opens.
    darts: Vec<Dart>,
    /// Both ends of what opens at the cut.
    opened: [Vec2; 2],
}

impl Slash {
    fn new(garment: &Garment, shapes: &Shapes, id: PieceId, t: &Turn<'_>, gap: &Gap) -> Result<Self, Diagnostic> {
        let ring = &shapes[id.index()].rings[0];
        let s = spot::on_outline(garment, shapes, id, t.to)?;
        if ring.gap_around(s).is_some() {
            let message = format!("the new place of dart `{}` lies in a dart of piece `{}`", t.dart, t.piece);
            return Err(Diagnostic::error(ALTER_PLACE, message).hint("give a place on an edge of the cloth"));
        }
        let mut contour = Contour::of(&garment.pieces[id.index()], ring);
        let slash = contour.insert(s);
        let Some([first, apex, second]) = contour.dart(ring, gap) else {
            return Err(Diagnostic::error(ALTER_DART, format!("dart `{}` is not on the outline of its piece", t.dart)));
        };
        let [place, point] = [slash, apex].map(|k| contour.vertices[k].at);
        if !contour.holds_line(&[place, point]) || slash == first || slash == second {
            let (from, dart, piece) = (mm(place), t.dart, t.piece);
            let message = format!(
                "the line from {from} to the point of dart `{dart}` leaves piece `{piece}`, or runs along the dart"
            );
            return Err(Diagnostic::error(ALTER_LINE_LEAVES_PIECE, message).hint("open the dart at another place"));
        }
        Ok(Self { place, point, sides: [contour.chain(slash, first), contour.chain(second, slash)] })
    }

    /// The regions on both sides of the cut.
    fn polygons(&self) -> [Vec<Vec2>; 2] {
        self.sides.each_ref().map(|side| side.iter().map(|v| v.at).chain([self.point]).collect())
    }

    /// The angle of the dart, radians: that by which its second leg comes to lie on the first.
    fn angle(&self) -> f64 {
        let [before, after] = &self.sides;
        angle(after[0].at - self.point, before[before.len() - 1].at - self.point)
    }

    /// The outline after both sides have moved.
    fn joined(&self, piece: &Piece, dart: &Dart, t: &Turn<'_>, motions: [Motion; 2]) -> Joined {
        let moved = |k: usize| -> Vec<Vertex> {
            self.sides[k].iter().map(|v| Vertex { at: motions[k].apply(v.at), ..*v }).collect()
        };
        let (mut vertices, mut after) = (moved(0), moved(1));
        let last = vertices.len() - 1;
        let (opened, mouth) = ([after[after.len() - 1].at, vertices[0].at], [vertices[last].at, after[0].at]);
        // A dart that is drawn back points to where it pointed.
        let drawn_back = |mouth: [Vec2; 2]| {
            let way = middle(mouth[0], mouth[1]) - self.point;
            self.point + way * (t.back / way.norm().max(1e-9)).min(0.9)
        };
        let mut darts = Vec::new();
        if t.share < 1.0 {
            let left = drawn_back(mouth);
            vertices.push(Vertex::new(left, PointKind::Turn));
            darts.push(wedge(dart, dart.name.clone(), mouth, left));
        } else if (mouth[0] - mouth[1]).norm() < SAME_PLACE {
            // The cloth on both sides of the old mouth is one.
            vertices[last].stretch = after.remove(0).stretch;
        }
        vertices.append(&mut after);
        if t.opens {
            let point = drawn_back(opened);
            vertices.push(Vertex::new(point, PointKind::Turn));
            let name = if t.share < 1.0 { free_name(&piece.darts) } else { dart.name.clone() };
            darts.push(wedge(dart, name, opened, point));
        }
        let mut outline = Contour { vertices }.cleaned();
        if t.share >= 1.0 {
            outline.tell_kinds(&mouth);
        }
        if !t.opens {
            outline.tell_kinds(&opened);
        }
        Joined { outline, darts, opened }
    }
}

/// The marks of a new dart: as the old one has notches and a drill hole.
fn marks(piece: &Piece, old: &Dart, new: &Dart) -> (Vec<Notch>, Vec<DrillHole>) {
    let [is_notched, is_drilled] = marks_of(piece, old);
    let notches = new.mouth.into_iter().filter(|_| is_notched).map(|at| new_notch(piece, at)).collect();
    let point = new.apexes[0];
    let way = middle(new.mouth[0], new.mouth[1]) - point;
    let at = point + way * (HOLE / way.norm().max(1e-9)).min(0.5);
    (notches, is_drilled.then_some(DrillHole { at, diameter: None, source: None }).into_iter().collect())
}

/// The angle by which one direction is turned into another, radians.
fn angle(from: Vec2, to: Vec2) -> f64 {
    libm::atan2(geom::cross(from, to), from.dot(&to))
}

/// The region that stays: the one that holds the middle of the grain line, else the larger one.
fn stays(piece: &Piece, polygons: &[Vec<Vec2>; 2]) -> usize {
    let on = |k: usize| piece.grain.is_some_and(|g| inside(middle(g[0], g[1]), &polygons[k]));
    match (on(0), on(1)) {
        (true, false) => 0,
        (false, true) => 1,
        _ => usize::from(geom::area(&polygons[1]) > geom::area(&polygons[0])),
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
