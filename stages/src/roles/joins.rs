//! Who is sewn to whom, as pairs of points: the same from meshes, from a sewing file and from a proposal.

use crate::sewing::resolve::{ResolvedSeam, Side};
use crate::sewing::shapes::Shapes;
use toile_garment::mesh::ChainKind;
use toile_garment::seam::{Seam, SeamKind};
use toile_garment::{Garment, MeshVertex, Vec2};

/// Pairs along a seam of a sewing file, at least.
const PAIRS_LEAST: usize = 9;
/// Distance of pairs along a seam of a sewing file, m.
const PAIR_STEP: f64 = 0.02;

/// A point of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PiecePoint {
    /// Index of the piece.
    pub piece: usize,
    /// In its coordinates, m.
    pub at: Vec2,
    /// True where it lies on a line inside the piece, and not on its outline.
    pub is_inside: bool,
}

/// A seam between pieces or of a piece with itself: points that meet, evenly along it, in sewing order. No dart.
#[derive(Clone, Debug, PartialEq)]
pub struct Join {
    /// Name of the seam.
    pub name: String,
    /// Points that meet.
    pub pairs: Vec<[PiecePoint; 2]>,
    /// Mean length of both sides, m.
    pub length: f64,
}

impl Join {
    /// Returns `true` if the seam joins a piece with itself only.
    #[must_use]
    pub fn is_own(&self) -> bool {
        self.pairs.iter().all(|[a, b]| a.piece == b.piece)
    }

    /// Part of the length that one pair stands for, m.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.length / self.pairs.len().max(1) as f64
    }
}

/// The seams of a garment whose pieces have meshes, one pair between each two stitches that follow one another. Stitches
/// themselves lie on corners, too, where an outline has no direction.
#[must_use]
pub fn joins_of_meshes(garment: &Garment) -> Vec<Join> {
    let at = |v: MeshVertex| {
        let mesh = garment.pieces.get(v.piece.index())?.mesh.as_ref()?;
        let mut lines = mesh.chains.iter().filter(|c| c.kind == ChainKind::SeamLine);
        let is_inside = lines.any(|c| c.vertices.contains(&v.vertex));
        Some(PiecePoint { piece: v.piece.index(), at: *mesh.rest.get(v.vertex as usize)?, is_inside })
    };
    let join = |seam: &Seam| {
        let stitches: Vec<[PiecePoint; 2]> = seam.stitches.iter().filter_map(|s| Some([at(s.a)?, at(s.b)?])).collect();
        let between = |w: &[[PiecePoint; 2]]| Some([middle(&w[0][0], &w[1][0])?, middle(&w[0][1], &w[1][1])?]);
        let pairs: Vec<_> = stitches.windows(2).filter_map(between).collect();
        let pairs = if pairs.is_empty() { stitches } else { pairs };
        Join { name: seam.name.clone(), pairs, length: 0.5 * (seam.a.length + seam.b.length) }
    };
    garment.seams.iter().filter(|s| matches!(s.kind, SeamKind::Seam)).map(join).collect()
}

/// The point half way between two points of one piece.
fn middle(a: &PiecePoint, b: &PiecePoint) -> Option<PiecePoint> {
    let is_inside = a.is_inside && b.is_inside;
    (a.piece == b.piece).then(|| PiecePoint { piece: a.piece, at: (a.at + b.at) * 0.5, is_inside })
}

/// The seams of a sewing file, as they were found on the outlines.
#[must_use]
pub fn joins_of_plan(seams: &[ResolvedSeam], shapes: &Shapes) -> Vec<Join> {
    let join = |seam: &ResolvedSeam| {
        let length = 0.5 * (seam.a.length + seam.b.length);
        let count = PAIRS_LEAST.max((length / PAIR_STEP).ceil() as usize);
        let pair = |k: usize| {
            let share = (k as f64 + 0.5) / count as f64;
            Some([point_on(&seam.a, shapes, share)?, point_on(&seam.b, shapes, share)?])
        };
        Join { name: seam.name.clone(), pairs: (0..count).filter_map(pair).collect(), length }
    };
    seams.iter().map(join).collect()
}

/// The point of a side at a share of its length.
fn point_on(side: &Side, shapes: &Shapes, share: f64) -> Option<PiecePoint> {
    let along = share * side.length;
    let starts = side.starts();
    let k = starts.iter().rposition(|start| *start <= along)?;
    let span = &side.spans[k];
    let shape = shapes.get(span.piece.index())?;
    let ring = shape.rings.get(span.ring)?;
    let way = along - starts[k];
    let at = ring.at(if span.forward { span.from + way } else { span.from - way });
    Some(PiecePoint { piece: span.piece.index(), at, is_inside: shape.seam_line(span.ring).is_some() })
}
