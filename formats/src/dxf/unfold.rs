//! Half pieces on a fold made whole.

use super::darts::DrawnDart;
use super::geom;
use super::outline::Node;
use toile_garment::Vec2;
use toile_garment::outline::PointKind;

/// Vertices this near the fold lie on it, mm.
const ON_FOLD: f64 = 0.5;
/// A corner on the fold that turns less after unfolding is none, degrees.
const CORNER: f64 = 20.0;

/// The fold line of a half piece.
#[derive(Clone, Copy, Debug)]
pub struct Fold(pub [Vec2; 2]);

impl Fold {
    /// Mirrored at the fold.
    #[must_use]
    pub fn mirror(&self, p: Vec2) -> Vec2 {
        geom::mirror(p, self.0[0], self.0[1])
    }

    /// Distance from the fold's line.
    #[must_use]
    pub fn distance(&self, p: Vec2) -> f64 {
        let d = self.0[1] - self.0[0];
        geom::cross(d, p - self.0[0]).abs() / d.norm().max(1e-9)
    }

    /// The ends of the fold in the order in which these points lie to its left: so the half that was drawn is known
    /// again when the piece is whole.
    #[must_use]
    pub fn with_left(&self, half: &[Vec2]) -> [Vec2; 2] {
        let [from, to] = self.0;
        let side: f64 = half.iter().map(|p| geom::cross(to - from, p - from)).sum();
        if side < 0.0 { [to, from] } else { [from, to] }
    }

    /// Does a place lie on the fold?
    #[must_use]
    pub fn passes(&self, p: Vec2) -> bool {
        self.distance(p) <= ON_FOLD
    }

    /// The place on the fold's line nearest to this one.
    #[must_use]
    pub fn onto(&self, p: Vec2) -> Vec2 {
        (p + self.mirror(p)) * 0.5
    }

    /// Does a place of a closed half line lie on the fold alone, so that the whole line passes it nowhere?
    #[must_use]
    pub fn holds_alone(&self, p: Vec2, half: &[Vec2]) -> bool {
        let n = half.len();
        let on = |i: usize| self.passes(half[i % n]);
        let beside = (0..n).filter(|i| !(on(*i) && on(i + 1)));
        let near = |i: usize| geom::point_segment(p, half[i], half[(i + 1) % n]).0 <= ON_FOLD;
        self.passes(p) && !beside.into_iter().any(near)
    }

    /// A closed half line made whole: everything but the run on the fold, and its mirror image. `None` when no run lies
    /// on the fold.
    #[must_use]
    pub fn outline(&self, half: &[Node]) -> Option<Vec<Node>> {
        let n = half.len();
        let (start, end) = self.run(half)?;
        // From the end of the fold run counter-clockwise round to its start.
        let steps = (start + n - end) % n;
        let mut whole: Vec<Node> = (0..=steps).map(|k| half[(end + k) % n]).collect();
        if whole.len() < 3 {
            return None;
        }
        let mirrored: Vec<Node> =
            whole[1..whole.len() - 1].iter().rev().map(|node| Node { at: self.mirror(node.at), ..*node }).collect();
        let turn_back = whole.len() - 1;
        whole.extend(mirrored);
        let m = whole.len();
        for i in [0, turn_back] {
            let (before, here, after) = (whole[(i + m - 1) % m].at, whole[i].at, whole[(i + 1) % m].at);
            let corner = geom::turn(before, here, after).to_degrees().abs() > CORNER;
            whole[i].kind = if corner { PointKind::Turn } else { PointKind::Plain };
        }
        Some(whole)
    }

    /// Longest run of neighbouring vertices on the fold.
    fn run(&self, half: &[Node]) -> Option<(usize, usize)> {
        let n = half.len();
        let on: Vec<bool> = half.iter().map(|node| self.passes(node.at)).collect();
        let first_off = on.iter().position(|o| !o)?;
        let mut best: Option<(f64, usize, usize)> = None;
        let mut from: Option<usize> = None;
        for k in 1..=n {
            let i = (first_off + k) % n;
            if on[i] {
                from.get_or_insert(i);
            } else if let Some(start) = from.take() {
                let end = (i + n - 1) % n;
                let length = (half[end].at - half[start].at).norm();
                if start != end && best.is_none_or(|b| length > b.0) {
                    best = Some((length, start, end));
                }
            }
        }
        best.map(|(_, start, end)| (start, end))
    }

    /// The mirror image of a dart, its legs again in counter-clockwise order.
    #[must_use]
    pub fn dart(&self, dart: &DrawnDart) -> DrawnDart {
        let line = |points: &Vec<Vec2>| points.iter().map(|p| self.mirror(*p)).collect::<Vec<_>>();
        DrawnDart {
            apexes: dart.apexes.iter().map(|p| self.mirror(*p)).collect(),
            mouth: [self.mirror(dart.mouth[1]), self.mirror(dart.mouth[0])],
            legs: [line(&dart.legs[1]), line(&dart.legs[0])],
            work: [line(&dart.work[1]), line(&dart.work[0])],
            ..dart.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_becomes_whole() {
        let node = |x: f64, y: f64| Node { at: Vec2::new(x, y), kind: PointKind::Turn, drawn: true };
        let half = [node(0.0, 0.0), node(150.0, 0.0), node(150.0, 600.0), node(0.0, 590.0), node(0.0, 300.0)];
        let fold = Fold([Vec2::new(0.0, 600.0), Vec2::new(0.0, 0.0)]);
        let whole = fold.outline(&half).expect("whole");
        let positions: Vec<Vec2> = whole.iter().map(|n| n.at).collect();
        let half_area = geom::area(&half.iter().map(|n| n.at).collect::<Vec<_>>());
        assert!((geom::area(&positions) - 2.0 * half_area).abs() < 1e-9);
        assert_eq!(whole.len(), 6);
        // The hem runs straight over the fold, so there is no corner there.
        assert_eq!(whole[0].at, Vec2::new(0.0, 0.0));
        assert_eq!(whole[0].kind, PointKind::Plain);
    }
}
