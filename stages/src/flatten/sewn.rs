//! Sewn edges as pairs of mesh edges, station by station.

use super::figures::length2;
use std::collections::BTreeSet;
use toile_garment::flat::PairChange;
use toile_garment::seam::{Seam, SeamSide};
use toile_garment::{Garment, MeshVertex, Vec2, Vec3};

/// Relative change of the two edges of a station against each other from which only one of them was edited.
const ALIKE: f64 = 5e-3;

/// One mesh edge on each side of a seam or dart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Station {
    /// Edge on side a.
    pub a: [MeshVertex; 2],
    /// Edge on side b.
    pub b: [MeshVertex; 2],
}

/// Mesh edges of every piece, for telling a step along the cloth from a jump between runs.
pub struct MeshEdges(Vec<BTreeSet<[u32; 2]>>);

impl MeshEdges {
    /// The sewn edges of all pieces.
    #[must_use]
    pub fn of(garment: &Garment) -> Self {
        let sides = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[a, b]| [a.min(b), a.max(b)]);
        let piece = |p: &toile_garment::Piece| p.mesh.iter().flat_map(|m| m.triangles.iter()).flat_map(sides).collect();
        Self(garment.pieces.iter().map(piece).collect())
    }

    fn joins(&self, [p, q]: [MeshVertex; 2]) -> bool {
        let side = [p.vertex.min(q.vertex), p.vertex.max(q.vertex)];
        p.piece == q.piece && self.0.get(p.piece.index()).is_some_and(|s| s.contains(&side))
    }
}

/// The stations of a seam: steps between stitches that are mesh edges on both sides.
#[must_use]
pub fn stations(seam: &Seam, edges: &MeshEdges) -> Vec<Station> {
    let step = seam.stitches.windows(2).map(|w| Station { a: [w[0].a, w[1].a], b: [w[0].b, w[1].b] });
    step.filter(|s| edges.joins(s.a) && edges.joins(s.b)).collect()
}

/// The stations of all seams, and of dart legs that no seam holds.
#[must_use]
pub fn all(garment: &Garment, edges: &MeshEdges) -> Vec<Station> {
    let mut out: Vec<Station> = garment.seams.iter().flat_map(|s| stations(s, edges)).collect();
    for piece in &garment.pieces {
        for legs in piece.darts.iter().filter_map(|d| d.mesh.as_ref()).map(|m| &m.legs) {
            let at = |vertex: u32| MeshVertex { piece: piece.id, vertex };
            let step = legs[0].windows(2).zip(legs[1].windows(2));
            out.extend(step.map(|(a, b)| Station { a: [at(a[0]), at(a[1])], b: [at(b[0]), at(b[1])] }));
        }
    }
    // A dart may stand both as a seam and in its piece, its legs swapped: one spring is enough.
    let key = |s: &Station| {
        let sorted = |[p, q]: [MeshVertex; 2]| [p.min(q), p.max(q)];
        let (a, b) = (sorted(s.a), sorted(s.b));
        [a.min(b), a.max(b)]
    };
    let mut seen = BTreeSet::new();
    out.retain(|s| edges.joins(s.a) && edges.joins(s.b) && key(s)[0] != key(s)[1] && seen.insert(key(s)));
    out
}

/// Did the edit change both edges alike? One side taken in alone makes them differ on purpose; a rounding or noise does
/// not. Where both lie on each other they are alike in any case.
#[must_use]
pub fn alike(station: &Station, before: &[&[Vec3]], now: &[&[Vec3]]) -> bool {
    let ratio = |x: &[&[Vec3]]| {
        let length = |[p, q]: [MeshVertex; 2]| {
            let at = |v: MeshVertex| x[v.piece.index()][v.vertex as usize];
            (at(q) - at(p)).norm()
        };
        length(station.a) / length(station.b)
    };
    let changed = (ratio(now) / ratio(before) - 1.0).abs();
    changed <= ALIKE || changed.is_nan()
}

/// Lengths of both sides of a seam before and after: as long as they are drawn, up to the point of a dart.
#[must_use]
pub fn change(seam: &Seam, rest: &[&[Vec2]], flat: &[&[Vec2]]) -> PairChange {
    let length = |x: &[&[Vec2]], side: &SeamSide| -> f64 {
        side.runs.iter().filter_map(|r| Some(length2(x.get(r.piece.index())?, &r.vertices))).sum()
    };
    let both = |side: &SeamSide| {
        let [before, after] = [rest, flat].map(|x| length(x, side));
        let drawn = if side.length > 0.0 { side.length } else { before };
        [drawn, if before > 0.0 { drawn * (after / before) } else { after }]
    };
    PairChange { name: seam.name.clone(), a: both(&seam.a), b: both(&seam.b) }
}
