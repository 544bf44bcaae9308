//! Wedges into which another piece is sewn: its point has two sides as long as their legs (a godet).

use super::dart::DrawnDart;
use super::thresholds::{
    CORNERS_OF_INSERT, DIFFERENCE_OF_INSERT, DISTANCE_OF_INSERT, DISTANCE_OF_MOUTH_VERTEX, TURN_OF_INSERT_CORNER,
    TURN_OF_INSERT_POINT, VERTICES_OF_INSERT,
};
use crate::dxf::geom;
use crate::dxf::piece::DrawnPiece;
use toile_garment::outline::PointKind;

/// The points of all pieces that may be those of an insert.
pub(super) struct Inserts {
    /// For each piece, lengths of the two edges at each sharp convex corner, mm.
    points: Vec<Vec<[f64; 2]>>,
}

impl Inserts {
    pub fn new(pieces: &[DrawnPiece]) -> Self {
        Self { points: pieces.iter().map(convex_points).collect() }
    }

    /// Tells whether another piece of the same size has a point whose sides are as long as the legs.
    pub fn fit(&self, dart: &DrawnDart, i: usize, pieces: &[DrawnPiece]) -> bool {
        let legs = [dart.leg_path(0), dart.leg_path(1)];
        let near = |a: f64, b: f64| (a - b).abs() <= (DIFFERENCE_OF_INSERT * b).max(DISTANCE_OF_INSERT);
        let fits =
            |p: &[f64; 2]| (near(p[0], legs[0]) && near(p[1], legs[1])) || (near(p[0], legs[1]) && near(p[1], legs[0]));
        let (name, size) = (&pieces[i].name, &pieces[i].size);
        let other =
            |j: &usize| *j != i && pieces[*j].size == *size && (pieces[*j].name.is_none() || pieces[*j].name != *name);
        (0..self.points.len()).filter(other).any(|j| self.points[j].iter().any(fits))
    }
}

/// Lengths of the two edges at each sharp convex corner. At the mouth of a wedge one of them is a leg, which is no side of
/// an insert.
fn convex_points(piece: &DrawnPiece) -> Vec<[f64; 2]> {
    let nodes = &piece.sewn().drawn;
    let n = nodes.len();
    let corners: Vec<usize> = (0..n)
        .filter(|i| {
            let turn = geom::turn(nodes[(i + n - 1) % n].at, nodes[*i].at, nodes[(i + 1) % n].at).to_degrees();
            nodes[*i].kind == PointKind::Turn && turn.abs() > TURN_OF_INSERT_CORNER
        })
        .collect();
    let m = corners.len();
    if m < CORNERS_OF_INSERT || n > VERTICES_OF_INSERT {
        return Vec::new();
    }
    let run = |from: usize, to: usize| {
        let steps = (to + n - from) % n;
        (0..steps).map(|k| (nodes[(from + k + 1) % n].at - nodes[(from + k) % n].at).norm()).sum::<f64>()
    };
    (0..m)
        .filter_map(|k| {
            let (a, c, b) = (corners[(k + m - 1) % m], corners[k], corners[(k + 1) % m]);
            let turn = geom::turn(nodes[(c + n - 1) % n].at, nodes[c].at, nodes[(c + 1) % n].at).to_degrees();
            let at_mouth = || {
                piece.darts.iter().flat_map(|d| d.mouth).any(|p| (p - nodes[c].at).norm() < DISTANCE_OF_MOUTH_VERTEX)
            };
            (turn > TURN_OF_INSERT_POINT && !at_mouth()).then(|| [run(a, c), run(c, b)])
        })
        .collect()
}
