//! A stretch of an outline as edges and parts of edges, the way a sewing file names it.

use crate::sewing::marks::notches_on;
use crate::sewing::ring::Ring;
use crate::sewing::shapes::PieceShape;
use toile_garment::Piece;
use toile_garment::sewing::{EdgePlace, EdgeWay};

/// Positions on an outline nearer than this are one, m.
const ONE_PLACE: f64 = 1e-6;
/// A place nearer to a notch than this is the notch, m.
const AT_NOTCH: f64 = 5e-5;

/// An edge, or a part of it.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgePart {
    /// Number of the edge.
    pub number: u32,
    /// Both ends of the part; `None` for the whole edge.
    pub places: Option<[EdgePlace; 2]>,
}

impl EdgePart {
    /// Both parts as one, where one of them begins where the other one ends on the same edge, on either side of a pleat.
    #[must_use]
    pub fn with(&self, other: &Self) -> Option<Self> {
        let ([from, to], [start, end]) = (self.places?, other.places?);
        let is_number = self.number == other.number;
        let places = match is_number {
            true if is_at(to, start) => [from, end],
            true if is_at(end, from) => [start, to],
            _ => return None,
        };
        let is_end = |place: EdgePlace, from_end| place == EdgePlace { way: EdgeWay::Share(0.0), from_end };
        let is_whole = is_end(places[0], false) && is_end(places[1], true);
        Some(Self { number: self.number, places: Some(places).filter(|_| !is_whole) })
    }
}

/// Are two places measured by their length the same?
fn is_at(a: EdgePlace, b: EdgePlace) -> bool {
    match (a.way, b.way) {
        (EdgeWay::Length(x), EdgeWay::Length(y)) => a.from_end == b.from_end && (x - y).abs() < AT_NOTCH,
        _ => false,
    }
}

/// The edges and parts of edges between two positions on the outline, in sewing order; empty where an edge ends within a
/// dart.
pub fn edge_parts(piece: &Piece, shape: &PieceShape, ends: [f64; 2], forward: bool) -> Vec<EdgePart> {
    let Some(ring) = shape.rings.first() else { return Vec::new() };
    let [start, end] = if forward { ends } else { [ends[1], ends[0]] };
    let at = |vertex: u32| ring.of_line.get(vertex as usize).copied().flatten().map(|i| ring.arc[i]);
    let (mut out, mut here) = (Vec::new(), start);
    // One edge may be met twice: a run that goes once round begins and ends on it.
    for _ in 0..=piece.edges.len() {
        let holds = |[from, to]: [f64; 2]| ring.ahead(from, here) < ring.ahead(from, to) - ONE_PLACE;
        let span = |e: &toile_garment::outline::OutlineEdge| Some([at(e.from)?, at(e.to)?]);
        let Some((edge, whole)) = piece.edges.iter().find_map(|e| Some((e, span(e).filter(|s| holds(*s))?))) else {
            return Vec::new();
        };
        let left = if out.is_empty() && is_one(ring, here, end) { ring.total() } else { ring.ahead(here, end) };
        let is_last = left <= ring.ahead(here, whole[1]) + ONE_PLACE;
        let to = if is_last { end } else { whole[1] };
        out.push(part(piece, shape, edge.index, whole, [here, to]));
        here = to;
        if is_last {
            if !forward {
                out.reverse();
            }
            return out;
        }
    }
    Vec::new()
}

fn is_one(ring: &Ring, s: f64, t: f64) -> bool {
    f64::min(ring.ahead(s, t), ring.ahead(t, s)) < ONE_PLACE
}

fn part(piece: &Piece, shape: &PieceShape, number: u32, whole: [f64; 2], ends: [f64; 2]) -> EdgePart {
    let ring = &shape.rings[0];
    if is_one(ring, whole[0], ends[0]) && is_one(ring, whole[1], ends[1]) {
        return EdgePart { number, places: None };
    }
    let notches = notches_on(piece, shape, whole);
    let place = |s: f64| {
        let from_end = is_one(ring, s, whole[1]);
        if from_end || is_one(ring, s, whole[0]) {
            return EdgePlace { way: EdgeWay::Share(0.0), from_end };
        }
        let way = ring.sewn_ahead(whole[0], s);
        let notch = (1u32..).zip(&notches).find(|(_, n)| (*n - way).abs() < AT_NOTCH);
        EdgePlace { way: notch.map_or(EdgeWay::Length(way), |(k, _)| EdgeWay::Notch(k)), from_end: false }
    };
    EdgePart { number, places: Some(ends.map(place)) }
}
