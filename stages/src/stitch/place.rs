//! Where every piece starts in 3D.

use super::arranged::Starts;
use super::{codes, folded};
use crate::arrange::{Cylinder, Sheet, side_angle};
use crate::codes::BODY_MISSING;
use toile_garment::body::Body;
use toile_garment::sewing::{Around, PlaceSpec, Placement};
use toile_garment::{Diagnostic, Garment, Piece, Vec2, Vec3};

/// Free arc left between neighbouring pieces on one cylinder, metres.
const SIDE_GAP: f64 = 0.01;
/// Distance between pieces stacked on one side of a segment, metres.
const STACK_GAP: f64 = 0.015;

/// Start positions of all mesh vertices, per piece.
///
/// # Errors
/// All pieces that cannot be placed, each with the reason.
pub fn place(garment: &Garment, arranged: &Starts, clearance: f64) -> Result<Vec<Vec<Vec3>>, Vec<Diagnostic>> {
    let mut errors = Vec::new();
    let specs: Vec<Option<&PlaceSpec>> = garment.pieces.iter().map(|p| spec_of(garment, p)).collect();
    let wraps = wraps(garment, &specs, clearance, &mut errors);
    let mut placed = Vec::with_capacity(garment.pieces.len());
    for (piece, spec) in garment.pieces.iter().zip(&specs) {
        match spec.map(|s| &s.placement) {
            Some(Placement::Explicit { rotation, translation }) => {
                placed.push(folded::start(piece, &garment.seams, |p| explicit(rotation, translation, p)));
            }
            Some(Placement::Around(_)) => {
                if let Some(wrap) = wraps.iter().find(|w| w.piece == piece.id.index()) {
                    placed.push(folded::start(piece, &garment.seams, |p| wrap.at(p)));
                }
            }
            moved => match arranged.start(piece) {
                Some(start) => {
                    let by = if let Some(Placement::Moved { by }) = moved { *by } else { Vec3::zeros() };
                    placed.push(folded::start(piece, &garment.seams, |p| start(p) + by));
                }
                None => errors.push(not_placed(piece)),
            },
        }
    }
    if errors.is_empty() { Ok(placed) } else { Err(errors) }
}

/// Places around the body that it does not have.
pub(super) fn faults(garment: &Garment, clearance: f64) -> Vec<Diagnostic> {
    let specs = garment.pieces.iter().filter_map(|p| Some((p, spec_of(garment, p)?)));
    let wrong = specs.filter_map(|(piece, spec)| {
        let Placement::Around(place) = &spec.placement else { return None };
        Some(Wrap::new(garment, piece, place, clearance).err()?.at(spec.source.clone()))
    });
    wrong.collect()
}

/// The place that the sewing file gives a piece.
pub(super) fn spec_of<'a>(garment: &'a Garment, piece: &Piece) -> Option<&'a PlaceSpec> {
    let places = &garment.plan.places;
    places
        .iter()
        .find(|s| s.piece == piece.name)
        .or_else(|| places.iter().find(|s| s.piece.eq_ignore_ascii_case(&piece.name)))
}

/// Does the program look for the place of a piece?
pub(super) fn is_arranged(garment: &Garment, piece: &Piece) -> bool {
    spec_of(garment, piece).is_none_or(|s| matches!(s.placement, Placement::Moved { .. }))
}

fn not_placed(piece: &Piece) -> Diagnostic {
    Diagnostic::error(codes::PIECE_NOT_PLACED, format!("nothing says where piece `{}` starts in 3D", piece.name))
        .at(piece.source.clone())
        .hint("add a [[place]] for it to the sewing file")
}

fn explicit(rotation: &[[f64; 3]; 3], translation: &Vec3, p: Vec2) -> Vec3 {
    let row = |r: &[f64; 3]| r[0] * p.x + r[1] * p.y;
    Vec3::new(row(&rotation[0]), row(&rotation[1]), row(&rotation[2])) + translation
}

/// A piece on its way around a segment.
pub(super) struct Wrap {
    piece: usize,
    segment: String,
    /// Angle of the middle, from the front.
    angle: f64,
    turn: f64,
    /// Way of the middle along the girth, metres.
    shift: f64,
    middle: Vec2,
    /// Half of the width, metres.
    half: f64,
    /// Extent along the axis, metres from its start.
    span: [f64; 2],
    /// Pieces that lie below it on the same side.
    stack: usize,
    cylinder: Cylinder,
}

impl Wrap {
    /// A piece around a segment of the body, its middle on a side, its top at a height (on an arm, at a distance from
    /// the joint), m, after a turn, rad.
    ///
    /// # Errors
    /// There is no body, or it has no such segment or side.
    pub(super) fn new(garment: &Garment, piece: &Piece, place: &Around, clearance: f64) -> Result<Self, Diagnostic> {
        let Around { segment, side, height, turn, shift } = place;
        let body = garment.body.as_ref().ok_or_else(|| {
            Diagnostic::error(
                BODY_MISSING,
                format!("piece `{}` is placed around `{segment}`, but there is no body", piece.name),
            )
            .hint("give the stage `stitch` a body: with.body = \"…obj\"")
        })?;
        let shape = body.segments.get(segment).ok_or_else(|| unknown_segment(body, piece, segment))?;
        let angle = side_angle(side).ok_or_else(|| {
            Diagnostic::error(codes::PLACE_SIDE_UNKNOWN, format!("piece `{}`: side `{side}` is not known", piece.name))
                .hint("use front, back, left or right")
        })?;
        let cylinder = Cylinder::new(shape, clearance).ok_or_else(|| {
            Diagnostic::error(codes::BODY_SEGMENT_FLAT, format!("the axis of body segment `{segment}` has no length"))
        })?;
        let (middle, size) = extent(piece, *turn);
        let top = if segment.starts_with("arm") { Some(*height) } else { cylinder.axial_of_height(*height) };
        let top = top.ok_or_else(|| {
            Diagnostic::error(
                codes::PLACE_HEIGHT,
                format!("the axis of body segment `{segment}` lies level: a height says nothing"),
            )
        })?;
        Ok(Wrap {
            piece: piece.id.index(),
            segment: segment.clone(),
            angle,
            turn: *turn,
            shift: *shift,
            middle,
            half: 0.5 * size.x,
            span: [top, top + size.y],
            stack: 0,
            cylinder,
        })
    }

    /// The same as a sheet.
    pub(super) fn sheet(&self, garment: &Garment) -> Option<Sheet> {
        let segment = garment.body.as_ref()?.segments.get(&self.segment)?;
        let middle = rotate(self.middle, self.turn) - Vec2::new(self.shift, 0.0);
        Sheet::around(segment, 0.02, self.turn, middle, self.angle, 0.5 * (self.span[0] + self.span[1]))
    }

    /// How far it reaches from the middle of its side along the girth, metres.
    fn reach(&self) -> f64 {
        self.half + self.shift.abs()
    }

    fn at(&self, p: Vec2) -> Vec3 {
        let q = rotate(p - self.middle, self.turn);
        self.cylinder.at(self.cylinder.arc_at(self.angle) + self.shift + q.x, 0.5 * (self.span[0] + self.span[1]) - q.y)
    }
}

fn rotate(p: Vec2, angle: f64) -> Vec2 {
    let (s, c) = libm::sincos(angle);
    Vec2::new(c * p.x - s * p.y, s * p.x + c * p.y)
}

fn wraps(garment: &Garment, specs: &[Option<&PlaceSpec>], clearance: f64, errors: &mut Vec<Diagnostic>) -> Vec<Wrap> {
    let mut wraps = Vec::new();
    for (piece, spec) in garment.pieces.iter().zip(specs) {
        let Some(spec) = spec else { continue };
        let Placement::Around(place) = &spec.placement else { continue };
        match Wrap::new(garment, piece, place, clearance) {
            Ok(wrap) => wraps.push(wrap),
            Err(finding) => errors.push(finding.at(spec.source.clone())),
        }
    }
    stack(&mut wraps);
    widen(garment.body.as_ref(), &mut wraps, clearance);
    wraps
}

fn unknown_segment(body: &Body, piece: &Piece, segment: &str) -> Diagnostic {
    let known: Vec<&str> = body.segments.keys().map(String::as_str).collect();
    let hint = if known.is_empty() {
        "this body names no segments: give a rotation and a translation, or a side file with [segments]".to_owned()
    } else {
        format!("this body has: {}", known.join(", "))
    };
    Diagnostic::error(
        codes::BODY_SEGMENT_UNKNOWN,
        format!("piece `{}`: the body has no segment `{segment}`", piece.name),
    )
    .hint(hint)
}

/// Middle and size of a piece's box after turning it, the middle in piece coordinates. A piece without a mesh is as
/// large as its outline.
fn extent(piece: &Piece, turn: f64) -> (Vec2, Vec2) {
    let mut low = Vec2::repeat(f64::INFINITY);
    let mut high = Vec2::repeat(f64::NEG_INFINITY);
    let drawn = piece.outline.points.iter().filter(|_| piece.mesh.is_none()).map(|p| p.at);
    for p in piece.mesh.iter().flat_map(|m| &m.rest).copied().chain(drawn) {
        let q = rotate(p, turn);
        low = low.inf(&q);
        high = high.sup(&q);
    }
    (rotate((low + high) * 0.5, -turn), high - low)
}

fn same_ring(a: &Wrap, b: &Wrap) -> bool {
    a.segment == b.segment && a.span[0] < b.span[1] && b.span[0] < a.span[1]
}

/// Pieces on the same side at the same height lie over each other, in the order they were named, but for those that are
/// shifted past each other.
fn stack(wraps: &mut [Wrap]) {
    for i in 0..wraps.len() {
        let meets = |a: &Wrap, b: &Wrap| a.angle == b.angle && (a.shift - b.shift).abs() < a.half + b.half;
        wraps[i].stack = (0..i).filter(|j| same_ring(&wraps[i], &wraps[*j]) && meets(&wraps[i], &wraps[*j])).count();
    }
}

/// Widens the cylinder of every ring until its pieces have room side by side.
fn widen(body: Option<&Body>, wraps: &mut [Wrap], clearance: f64) {
    let Some(body) = body else { return };
    let rings: Vec<f64> = (0..wraps.len())
        .map(|i| {
            let mut away = clearance;
            while away < 2.0 && !fits(body, wraps, i, away) {
                away += 0.005;
            }
            away
        })
        .collect();
    for i in 0..wraps.len() {
        let ring = (0..wraps.len()).filter(|j| same_ring(&wraps[i], &wraps[*j])).map(|j| rings[j]);
        let away = ring.fold(clearance, f64::max) + STACK_GAP * wraps[i].stack as f64;
        if let Some(cylinder) = body.segments.get(&wraps[i].segment).and_then(|s| Cylinder::new(s, away)) {
            wraps[i].cylinder = cylinder;
        }
    }
}

fn fits(body: &Body, wraps: &[Wrap], i: usize, away: f64) -> bool {
    let me = &wraps[i];
    let Some(cylinder) = body.segments.get(&me.segment).and_then(|s| Cylinder::new(s, away)) else { return true };
    let mut room = cylinder.girth();
    for other in wraps.iter().filter(|o| same_ring(me, o) && o.angle != me.angle) {
        let apart = (cylinder.arc_at(other.angle) - cylinder.arc_at(me.angle)).abs();
        let apart = apart.min(cylinder.girth() - apart);
        if me.reach() + other.reach() + SIDE_GAP > apart {
            return false;
        }
        room = room.min(cylinder.girth());
    }
    2.0 * me.reach() + SIDE_GAP <= room
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arrange::Laid;
    use toile_garment::PieceId;
    use toile_garment::body::BodySegment;
    use toile_garment::mesh::PieceMesh;

    fn strip(id: usize, name: &str, width: f64) -> Piece {
        let rest = vec![Vec2::new(0.0, 0.0), Vec2::new(width, 0.0), Vec2::new(width, 0.3), Vec2::new(0.0, 0.3)];
        let mesh = PieceMesh { rest, triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() };
        Piece { id: PieceId::from(id), name: name.into(), mesh: Some(mesh), ..Piece::default() }
    }

    fn garment(width: f64) -> Garment {
        let segment = BodySegment {
            from: Vec3::new(0.0, 1.4, 0.0),
            to: Vec3::new(0.0, 0.8, 0.0),
            half_width: 0.15,
            half_depth: 0.1,
        };
        let place = |piece: &str, side: &str| PlaceSpec {
            piece: piece.into(),
            placement: Placement::Around(Around {
                segment: "torso".into(),
                side: side.into(),
                height: 1.2,
                ..Around::default()
            }),
            ignores: None,
            source: None,
        };
        let mut g = Garment { pieces: vec![strip(0, "front", width), strip(1, "back", width)], ..Garment::default() };
        g.plan.places = vec![place("front", "front"), place("BACK", "back")];
        g.body = Some(Body { segments: [("torso".to_owned(), segment)].into(), ..Body::default() });
        g
    }

    #[test]
    fn front_and_back_stand_apart_even_when_wide() {
        let placed = place(&garment(0.7), &Starts::default(), 0.02).expect("placed");
        let top = placed[0][3];
        assert!((top.y - 1.2).abs() < 1e-12);
        assert!(placed[0].iter().all(|p| p.z > -0.01), "{:?}", placed[0]);
        let gap = (placed[0][1] - placed[1][0]).norm();
        assert!(gap > 0.005, "front's left edge to back's right edge: {gap}");
    }

    #[test]
    fn a_moved_piece_starts_beside_the_place_that_is_found() {
        let (mut g, by) = (garment(0.4), Vec3::new(0.01, 0.03, -0.02));
        let sheet = Sheet { origin: Vec3::new(0.0, 0.9, 0.2), ..Sheet::facing(Vec3::z(), Vec3::y(), 0.0) };
        let arranged = Starts { by_piece: vec![Some((sheet, Laid::default())), None] };
        let front = |g: &Garment| place(g, &arranged, 0.02).expect("placed").remove(0);
        g.plan.places.remove(0);
        let found = front(&g);
        let moved = PlaceSpec { placement: Placement::Moved { by }, piece: "front".into(), ..g.plan.places[0].clone() };
        g.plan.places.push(moved);
        assert!(found.iter().zip(front(&g)).all(|(p, q)| (p + by - q).norm() < 1e-12));
        assert!(is_arranged(&g, &g.pieces[0]) && !is_arranged(&g, &g.pieces[1]));
    }

    #[test]
    fn a_piece_without_a_place_is_named() {
        let mut g = garment(0.4);
        g.plan.places.pop();
        let errors = place(&g, &Starts::default(), 0.02).expect_err("one is missing");
        assert_eq!((errors.len(), errors[0].code.as_str()), (1, "piece-not-placed"));
        assert!(errors[0].message.contains("back"));
    }

    #[test]
    fn explicit_places_follow_the_contract() {
        let mut g = garment(0.4);
        g.plan.places[0].placement = Placement::Explicit {
            rotation: [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
            translation: Vec3::new(0.1, 0.2, -0.3),
        };
        let placed = place(&g, &Starts::default(), 0.02).expect("placed");
        assert!((placed[0][2] - Vec3::new(-0.3, 0.5, -0.3)).norm() < 1e-15);
    }
}
