//! All edges of all pieces with their lengths, for tables and for proposals of what fits.

use super::lookup;
use super::marks::listed_on;
use super::ring::SAME;
use super::shapes::Shapes;
use toile_garment::outline::OutlineEdge;
use toile_garment::sewing::RunSpec;
use toile_garment::{Garment, Piece, PieceId};

/// An edge as it is sewn. Intakes of darts are left out of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// Its name in a sewing file: `FRONT.3`, or `FRONT.side-left` where it has a name.
    pub name: String,
    /// Number that drawings show.
    pub number: u32,
    /// Piece.
    pub piece: PieceId,
    /// Position of its middle on the outer ring of the piece, m.
    pub middle: f64,
    /// Sewn length, m.
    pub length: f64,
    /// Sewn ways of its notches from its start, m.
    pub notches: Vec<f64>,
    /// The labels of these notches, as `n3`.
    pub labels: Vec<String>,
}

/// All edges that are sewn; the legs of a dart are none.
#[must_use]
pub fn edges(garment: &Garment, shapes: &Shapes) -> Vec<Edge> {
    let of_piece = |piece: &Piece| {
        let labels = piece.notch_labels();
        piece.edges.iter().filter_map(|e| edge(garment, shapes, (piece, &labels), e)).collect::<Vec<_>>()
    };
    garment.pieces.iter().flat_map(of_piece).collect()
}

fn edge(garment: &Garment, shapes: &Shapes, (piece, labels): (&Piece, &[String]), edge: &OutlineEdge) -> Option<Edge> {
    let label = edge.name.clone().unwrap_or_else(|| edge.index.to_string());
    let spec = RunSpec::Edge { piece: piece.name.clone(), edge: label.clone() };
    let run = lookup::run(garment, shapes, &spec, None).ok()?;
    let shape = shapes.get(run.piece.index())?;
    let ring = shape.rings.get(run.ring)?;
    let length = ring.sewn_ahead(run.from, run.to);
    let middle = run.from + 0.5 * ring.ahead(run.from, run.to);
    let notches = listed_on(piece, shape, [run.from, run.to]);
    (length > SAME && ring.gap_around(middle).is_none()).then(|| Edge {
        name: format!("{}.{label}", piece.name),
        number: edge.index,
        piece: run.piece,
        middle,
        length,
        notches: notches.iter().map(|(_, way)| *way).collect(),
        labels: notches.iter().map(|(k, _)| labels[*k].clone()).collect(),
    })
}

/// The edges of other pieces that differ in length by no more than a share, the nearest first.
#[must_use]
pub fn as_long<'e>(edges: &'e [Edge], edge: &Edge, share: f64) -> Vec<&'e Edge> {
    let off = |other: &Edge| (other.length - edge.length).abs();
    let mut found: Vec<&Edge> =
        edges.iter().filter(|o| o.piece != edge.piece && off(o) <= share * edge.length.max(o.length)).collect();
    found.sort_by(|a, b| off(a).total_cmp(&off(b)));
    found
}
