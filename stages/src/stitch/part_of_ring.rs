//! Attached edges that go only part of the way round the body. Laid around the whole ring, they would pull the rest of
//! the garment out of its place.

use super::codes;
use crate::sewing::resolve::{ResolvedSeam, Side, Span, find, placed};
use crate::sewing::ring::{Ring, SAME};
use crate::sewing::shapes::{Shapes, mm, shapes};
use toile_garment::{Diagnostic, Garment, PieceId};

/// How far beside a place is looked at what lies there, m.
const PROBE: f64 = 1e-4;

/// A stretch of an outline that is attached, walked forward.
struct Stretch {
    piece: PieceId,
    from: f64,
    to: f64,
}

/// A place on an outline, and whether what is looked at lies ahead of it or behind it.
#[derive(Clone, Copy)]
struct End {
    piece: PieceId,
    at: f64,
    is_ahead: bool,
}

/// The error on attached edges, each as piece and number, whose ends are sewn to cloth that is not attached with them.
pub fn fault(garment: &Garment, edges: Vec<(PieceId, usize)>, to: &str) -> Option<Diagnostic> {
    let shapes = shapes(garment).ok()?;
    // Seams that cannot be found are told by the stage that sews.
    let seams = placed(find(garment, &shapes)).ok()?;
    let stretches: Vec<Stretch> =
        edges.into_iter().filter_map(|(piece, edge)| stretch(garment, &shapes, piece, edge)).collect();
    let missing = ends(&shapes, &stretches).into_iter().flat_map(|end| {
        let partners = partners(&shapes, &seams, end).into_iter();
        let is_missing = |p: &End| !goes_on(&shapes, &stretches, *p) && is_free(&shapes, &seams, *p);
        partners.filter(is_missing).map(|p| beyond(garment, &shapes, p)).collect::<Vec<_>>()
    });
    let mut missing: Vec<String> = missing.collect();
    missing.sort();
    missing.dedup();
    let message = format!(
        "the edges attached to `{to}` go only part of the way round: sewn to their ends, and not attached there, is {}",
        missing.join(", and ")
    );
    let hint = format!("add an [[attach]] with to = \"{to}\" for every edge that lies on this ring");
    (!missing.is_empty()).then(|| Diagnostic::error(codes::ATTACH_PART_OF_RING, message).hint(hint))
}

/// Where an outline vertex lies on the ring of its piece.
fn position(garment: &Garment, ring: &Ring, piece: PieceId, vertex: u32) -> Option<f64> {
    match ring.of_line.get(vertex as usize)? {
        Some(i) => ring.arc.get(*i).copied(),
        None => Some(ring.project(garment.pieces[piece.index()].outline.points.get(vertex as usize)?.at).0),
    }
}

fn stretch(garment: &Garment, shapes: &Shapes, piece: PieceId, edge: usize) -> Option<Stretch> {
    let ring = shapes[piece.index()].rings.first()?;
    let edge = garment.pieces[piece.index()].edges.get(edge)?;
    let [from, to] = [edge.from, edge.to].map(|v| position(garment, ring, piece, v));
    Some(Stretch { piece, from: from?, to: to? })
}

/// The ends of attached stretches at which no other attached stretch of the piece goes on; darts between are sewn shut.
fn ends(shapes: &Shapes, stretches: &[Stretch]) -> Vec<End> {
    let both = |s: &Stretch| [(s.to, true), (s.from, false)].map(|(at, is_ahead)| End { piece: s.piece, at, is_ahead });
    stretches.iter().flat_map(both).filter(|end| !is_attached(shapes, stretches, *end)).collect()
}

/// Does an attached stretch lie on this side of the end?
fn is_attached(shapes: &Shapes, stretches: &[Stretch], end: End) -> bool {
    let Some(ring) = shapes[end.piece.index()].rings.first() else { return false };
    let meets = |s: &Stretch| if end.is_ahead { lies(ring, end.at, s.from) } else { lies(ring, s.to, end.at) };
    stretches.iter().any(|s| s.piece == end.piece && meets(s))
}

/// Does the second place come right after the first, but for darts?
fn lies(ring: &Ring, first: f64, second: f64) -> bool {
    ring.sewn_ahead(first, second) < SAME
}

/// What seams that begin or end at a place, on this side of it, sew there.
fn partners(shapes: &Shapes, seams: &[ResolvedSeam], end: End) -> Vec<End> {
    let sides = seams.iter().flat_map(|s| [(&s.a, &s.b), (&s.b, &s.a)]);
    let of_side = |(own, other): (&Side, &Side)| {
        let pairs = terminals(own).into_iter().zip(terminals(other));
        let met = pairs.filter(|(own, _)| own.as_ref().is_some_and(|own| is_met(shapes, own, end)));
        met.filter_map(|(_, other)| other).collect::<Vec<_>>()
    };
    sides.flat_map(of_side).collect()
}

/// Both ends of a side of a seam that lie on outlines, each with the side on which the seam lies.
fn terminals(side: &Side) -> [Option<End>; 2] {
    let on_outline = |span: &&Span| span.ring == 0;
    let first = side.spans.first().filter(on_outline);
    let last = side.spans.last().filter(on_outline);
    [
        first.map(|s| End { piece: s.piece, at: s.from, is_ahead: s.forward }),
        last.map(|s| End { piece: s.piece, at: s.to, is_ahead: !s.forward }),
    ]
}

fn is_met(shapes: &Shapes, terminal: &End, end: End) -> bool {
    let Some(ring) = shapes[end.piece.index()].rings.first() else { return false };
    let meets = if end.is_ahead { lies(ring, end.at, terminal.at) } else { lies(ring, terminal.at, end.at) };
    terminal.piece == end.piece && terminal.is_ahead == end.is_ahead && meets
}

/// Is the cloth on the other side of a seam's end attached?
fn goes_on(shapes: &Shapes, stretches: &[Stretch], end: End) -> bool {
    is_attached(shapes, stretches, End { is_ahead: !end.is_ahead, ..end })
}

/// Does the cloth on the other side of a seam's end lie open? What is sewn on may go on elsewhere, as in a pocket.
fn is_free(shapes: &Shapes, seams: &[ResolvedSeam], end: End) -> bool {
    let Some(ring) = shapes[end.piece.index()].rings.first() else { return false };
    let before = |at: f64| (at - PROBE).rem_euclid(ring.total().max(PROBE));
    let beside = match end.is_ahead {
        false => ring.after_sewn(end.at, PROBE),
        true => ring.gap_around(before(end.at)).map_or(before(end.at), |gap| before(ring.arc[gap.from])),
    };
    let spans = seams.iter().flat_map(|s| s.a.spans.iter().chain(&s.b.spans));
    let covers = |s: &Span| {
        let from = if s.forward { s.from } else { s.to };
        ring.ahead(from, beside) <= s.length
    };
    !spans.filter(|s| s.piece == end.piece && s.ring == 0).any(covers)
}

/// The words for what goes on beside a seam's end.
fn beyond(garment: &Garment, shapes: &Shapes, end: End) -> String {
    let piece = &garment.pieces[end.piece.index()];
    let Some(ring) = shapes[end.piece.index()].rings.first() else { return format!("`{}`", piece.name) };
    let near = |e: &&toile_garment::outline::OutlineEdge| {
        let vertex = if end.is_ahead { e.to } else { e.from };
        let at = position(garment, ring, end.piece, vertex);
        at.is_some_and(|at| if end.is_ahead { lies(ring, at, end.at) } else { lies(ring, end.at, at) })
    };
    match piece.edges.iter().find(near) {
        Some(edge) => {
            let name = edge.name.clone().unwrap_or_else(|| edge.index.to_string());
            format!("edge `{name}` of `{}`", piece.name)
        }
        None => format!("`{}` at {}", piece.name, mm(ring.at(end.at))),
    }
}
