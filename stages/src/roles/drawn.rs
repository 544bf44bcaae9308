//! Pieces and seams of a file, turned upright.
//!
//! Many systems draw their pieces lying, with the grain along x, as they lie on the cutting table. All pieces of a
//! file are turned alike. A piece that is mirrored, x to −x, is turned the other way.

use super::Join;
use super::leg_shape::is_leg;
use super::outline::{Polygon, turned};
use crate::body::section::hull;
use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_2;
use toile_garment::{Piece, Vec2};

/// The outlines and the seams of a file after the turn that brings its pieces upright.
#[derive(Clone, Debug)]
pub struct Upright {
    /// The turn of every piece, rad, counter-clockwise: 0 or a quarter to either side.
    pub turns: Vec<f64>,
    /// Turned outlines, in the order of the pieces.
    pub outlines: Vec<Polygon>,
    /// Seams between the turned pieces.
    pub joins: Vec<Join>,
}

impl Upright {
    /// Turns pieces and seams.
    #[must_use]
    pub fn of(pieces: &[Piece], joins: &[Join]) -> Self {
        let drawn: Vec<Polygon> = pieces.iter().map(Polygon::of).collect();
        let turn = turn(pieces, &drawn);
        let turns: Vec<f64> = pieces.iter().map(|p| turn * side(p)).collect();
        let outlines = drawn.iter().zip(&turns).map(|(outline, turn)| outline.map(|p| turned(p, *turn))).collect();
        let mut joins = joins.to_vec();
        for point in joins.iter_mut().flat_map(|j| &mut j.pairs).flatten() {
            point.at = turned(point.at, turns[point.piece]);
        }
        Self { turns, outlines, joins }
    }
}

/// −1 for a mirrored piece, whose top lies on the other side.
fn side(piece: &Piece) -> f64 {
    if piece.mirrored { -1.0 } else { 1.0 }
}

/// The turn that brings pieces upright.
///
/// Pieces lie where most of their area has its grain nearer to x than to y. Then the upper end is the one with the
/// hollows of the outlines: necklines, armholes and crotches lie in the upper half of a piece.
fn turn(pieces: &[Piece], outlines: &[Polygon]) -> f64 {
    let grained = || pieces.iter().zip(outlines).filter(|(p, _)| p.grain.is_some());
    let area = |lying: bool| -> f64 {
        let lies = |p: &Piece| p.warp().x.abs() > p.warp().y.abs();
        grained().filter(|(p, _)| lies(p) == lying).map(|(_, outline)| outline.area()).sum()
    };
    if area(true) <= area(false) {
        return 0.0;
    }
    // A leg stands upright where its rise lies above its crotch.
    let is_leg = |p: &Piece, outline: &Polygon, turn: f64| is_leg(&outline.map(|at| turned(at, turn * side(p))));
    let legs = |turn: f64| pieces.iter().zip(outlines).filter(|(p, outline)| is_leg(p, outline, turn)).count();
    match legs(FRAC_PI_2).cmp(&legs(-FRAC_PI_2)) {
        Ordering::Greater => return FRAC_PI_2,
        Ordering::Less => return -FRAC_PI_2,
        Ordering::Equal => {}
    }
    let to_the_right: f64 = pieces.iter().zip(outlines).map(|(p, outline)| side(p) * hollows(outline).x).sum();
    if to_the_right < 0.0 { -FRAC_PI_2 } else { FRAC_PI_2 }
}

/// Moment of the hollows of an outline about the middle of its bounds, m³. A hollow is a part of the convex hull that
/// the outline leaves out.
fn hollows(outline: &Polygon) -> Vec2 {
    let hull = Polygon { points: hull(outline.points.clone()) };
    let [low, high] = outline.bounds();
    let middle = (low + high) * 0.5;
    let moment = |p: &Polygon| (p.centroid() - middle) * p.area();
    if outline.points.is_empty() { Vec2::zeros() } else { moment(&hull) - moment(outline) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::outline::{LinePoint, PieceLine, PointKind};

    /// A front: hem at x = 0, neckline and armholes at the other end. `angle` turns it, rad.
    fn front(angle: f64) -> Piece {
        let half = [(0.0, 0.0), (0.0, 0.25), (0.4, 0.25), (0.45, 0.2), (0.62, 0.2), (0.65, 0.08), (0.55, 0.0)];
        let other = half[1..6].iter().rev().map(|(x, y)| (*x, -*y));
        let at = |(x, y): (f64, f64)| LinePoint { at: turned(Vec2::new(x, -y), angle), kind: PointKind::Turn };
        let points = half.iter().copied().chain(other).map(at).collect();
        let outline = PieceLine { points, closed: true, ..PieceLine::default() };
        let grain = [Vec2::zeros(), turned(Vec2::x(), angle)];
        Piece { outline, grain: Some(grain), ..Piece::default() }
    }

    #[test]
    fn lying_pieces_are_turned_by_a_quarter_and_upright_ones_are_not() {
        let quarter = FRAC_PI_2;
        let turn = |piece: Piece| Upright::of(&[piece], &[]).turns[0];
        assert_eq!(turn(front(quarter)), 0.0);
        assert_eq!(turn(front(0.0)), quarter);
        assert_eq!(turn(front(2.0 * quarter)), -quarter);
        assert_eq!(turn(Piece::default()), 0.0);
    }

    #[test]
    fn a_mirrored_copy_of_a_lying_piece_is_turned_the_other_way() {
        let flip = |p: Vec2| Vec2::new(-p.x, p.y);
        let drawn = front(0.0);
        let mut copy = drawn.clone();
        copy.outline.points.iter_mut().for_each(|p| p.at = flip(p.at));
        copy.outline.points.reverse();
        (copy.grain, copy.mirrored) = (copy.grain.map(|g| g.map(flip)), true);
        let upright = Upright::of(&[drawn, copy], &[]);
        assert_eq!(upright.turns, [FRAC_PI_2, -FRAC_PI_2]);
        // Both hems are below, and both tops above.
        let [low, high] = upright.outlines[0].bounds();
        let [other_low, other_high] = upright.outlines[1].bounds();
        assert!((low.y - other_low.y).abs() < 1e-12 && (high.y - other_high.y).abs() < 1e-12);
    }
}
