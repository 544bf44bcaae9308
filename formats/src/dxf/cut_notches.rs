//! Notches that are cut into the outline: short V, U or slit excursions between two runs that go on straight.

use super::geom;
use super::outline::Node;
use toile_garment::Vec2;
use toile_garment::notch::NotchKind;

/// Depth of a notch cut in, mm.
const DEPTH: std::ops::RangeInclusive<f64> = 2.0..=12.0;
/// Widest mouth, mm.
const MOUTH: f64 = 12.0;
/// An outward V is at most this deep, mm; a larger one is a tab.
const OUTWARD: f64 = 8.0;
/// The outline goes on in the same direction within this, degrees.
const STRAIGHT: f64 = 20.0;
/// Most vertices between the two mouth points.
const INNER: usize = 6;
/// Mouth points nearer than this are one: a slit, mm.
const SLIT: f64 = 0.1;
/// The runs before and after are at least this long, mm.
const RUN: f64 = 3.0;

/// Where another size of the piece has a notch, every limit is wider by this factor.
const IN_OTHER_SIZE: f64 = 2.0;
/// Slits grow with the size. Where another size has a notch, the depth of a slit is wider by this factor: a slit takes
/// no cloth away, so nothing else is drawn like it.
const SLIT_IN_OTHER_SIZE: f64 = 4.0;

/// A notch cut into a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutNotch {
    /// Vertex at which it starts.
    pub from: usize,
    /// Vertex at which it ends, counter-clockwise.
    pub to: usize,
    /// Shape.
    pub kind: NotchKind,
    /// Middle of the mouth.
    pub at: Vec2,
    /// Depth, mm.
    pub depth: f64,
    /// Width of the mouth, mm.
    pub width: f64,
    /// Direction from the mouth to the tip, radians.
    pub angle: f64,
}

/// All notches cut into a closed counter-clockwise line.
#[must_use]
pub fn find(nodes: &[Node]) -> Vec<CutNotch> {
    let n = nodes.len();
    let mut found: Vec<CutNotch> = Vec::new();
    if n < 6 {
        return found;
    }
    let mut i = 0;
    while i < n {
        match (2..=INNER + 1).filter(|k| k + 2 <= n).find_map(|k| test(nodes, i, (i + k) % n, k, 1.0)) {
            Some(notch) => {
                found.push(notch);
                i += (notch.to + n - notch.from) % n;
            }
            None => i += 1,
        }
    }
    found
}

/// The notch between two vertices where another size of the piece has one: every limit is wider.
#[must_use]
pub fn again(nodes: &[Node], from: usize, to: usize) -> Option<CutNotch> {
    let n = nodes.len();
    test(nodes, from, to, (to + n - from) % n, IN_OTHER_SIZE)
}

fn test(nodes: &[Node], from: usize, to: usize, steps: usize, slack: f64) -> Option<CutNotch> {
    let n = nodes.len();
    let at = |i: usize| nodes[i % n].at;
    let (a, b) = (at(from), at(to));
    let mouth = b - a;
    let width = mouth.norm();
    if width > MOUTH * slack {
        return None;
    }
    let (before, after) = (a - at(from + n - 1), at(to + 1) - b);
    if before.norm() * slack < RUN || after.norm() * slack < RUN {
        return None;
    }
    let straight = |u: Vec2, v: Vec2| geom::angle(u, v) <= STRAIGHT * slack;
    if !straight(before, after) || (width > SLIT && !(straight(before, mouth) && straight(mouth, after))) {
        return None;
    }
    let along = if width > SLIT { mouth / width } else { before / before.norm() };
    // Left of the walk is inside.
    let height = |p: Vec2| geom::cross(along, p - a);
    let inner: Vec<Vec2> = (1..steps).map(|k| at(from + k)).collect();
    let tip = inner.iter().copied().max_by(|p, q| height(*p).abs().total_cmp(&height(*q).abs()))?;
    let depth = height(tip).abs();
    let inward = height(tip) > 0.0;
    let is_slit = width <= SLIT && inner.len() <= 3;
    let deepest = *DEPTH.end() * if is_slit && slack > 1.0 { SLIT_IN_OTHER_SIZE } else { slack };
    let deep = depth * slack >= *DEPTH.start() && depth <= deepest;
    if !deep || inner.iter().any(|p| height(*p) * height(tip) < 0.0) {
        return None;
    }
    let reach = |p: &Vec2| (p - a).dot(&along);
    let spread = inner.iter().map(reach).fold(0.0_f64, |m, s| m.max(s).max(width - s)) - width;
    let bottom: Vec<Vec2> = inner.iter().copied().filter(|p| height(*p).abs() > 0.8 * depth).collect();
    if spread > MOUTH * 0.5 * slack {
        return None;
    }
    let kind = match (inner.len(), bottom.len()) {
        _ if is_slit => NotchKind::Slit,
        (1, 1) => NotchKind::V,
        (2, 2) => NotchKind::Castle,
        (_, 2..) if spread > 0.5 => NotchKind::T,
        (3.., _) => NotchKind::U,
        _ => return None,
    };
    if !inward && (kind != NotchKind::V || depth > OUTWARD * slack) {
        return None;
    }
    let normal = Vec2::new(-along.y, along.x) * height(tip).signum();
    let angle = libm::atan2(normal.y, normal.x);
    Some(CutNotch { from, to, kind, at: (a + b) * 0.5, depth, width, angle })
}

/// Which vertices lie between the mouth points of notches, and which are mouth points.
#[must_use]
pub fn covered(nodes: usize, notches: &[CutNotch]) -> (Vec<bool>, Vec<bool>) {
    let (mut inner, mut mouth) = (vec![false; nodes], vec![false; nodes]);
    for notch in notches {
        let steps = (notch.to + nodes - notch.from) % nodes;
        (1..steps).for_each(|k| inner[(notch.from + k) % nodes] = true);
        mouth[notch.from] = true;
        if notch.width > SLIT {
            mouth[notch.to] = true;
        } else {
            inner[notch.to] = true;
        }
    }
    (inner, mouth)
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::outline::PointKind;

    /// Points of the top edge, kind, depth, width.
    type Case = (&'static [(f64, f64)], NotchKind, f64, f64);

    fn with(top: &[(f64, f64)]) -> Vec<Node> {
        let mut list = vec![(0.0, 0.0), (300.0, 0.0), (300.0, 200.0)];
        list.extend(top);
        list.push((0.0, 200.0));
        list.into_iter().map(|(x, y)| Node { at: Vec2::new(x, y), kind: PointKind::Turn, drawn: true }).collect()
    }

    #[test]
    fn shapes_are_told_apart() {
        let cases: [Case; 5] = [
            (&[(103.0, 200.0), (100.0, 194.0), (97.0, 200.0)], NotchKind::V, 6.0, 6.0),
            (&[(100.0, 200.0), (100.0, 195.0), (100.0, 200.0)], NotchKind::Slit, 5.0, 0.0),
            (&[(103.0, 200.0), (103.0, 196.0), (97.0, 196.0), (97.0, 200.0)], NotchKind::Castle, 4.0, 6.0),
            (&[(103.0, 200.0), (102.5, 196.0), (100.0, 194.5), (97.5, 196.0), (97.0, 200.0)], NotchKind::U, 5.5, 6.0),
            (&[(103.0, 200.0), (100.0, 205.0), (97.0, 200.0)], NotchKind::V, 5.0, 6.0),
        ];
        for (top, kind, depth, width) in cases {
            let found = find(&with(top));
            assert_eq!(found.len(), 1, "{top:?}");
            assert_eq!(found[0].kind, kind, "{top:?}");
            assert!((found[0].depth - depth).abs() < 1e-9 && (found[0].width - width).abs() < 1e-9);
            assert!((found[0].at - Vec2::new(100.0, 200.0)).norm() < 1e-9);
            assert!((libm::sin(found[0].angle).abs() - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn darts_steps_corners_and_tabs_are_none() {
        let cases: [&[(f64, f64)]; 5] = [
            // A dart.
            &[(115.0, 200.0), (100.0, 100.0), (85.0, 200.0)],
            // A step of 8 mm.
            &[(100.0, 200.0), (100.0, 192.0), (90.0, 192.0), (80.0, 192.0)],
            // A shallow dent.
            &[(103.0, 200.0), (100.0, 198.5), (97.0, 200.0)],
            // A tab.
            &[(105.0, 200.0), (105.0, 210.0), (95.0, 210.0), (95.0, 200.0)],
            // The outline turns at it.
            &[(103.0, 200.0), (100.0, 194.0), (97.0, 203.0), (50.0, 260.0)],
        ];
        for top in cases {
            assert_eq!(find(&with(top)), [], "{top:?}");
        }
    }
}
