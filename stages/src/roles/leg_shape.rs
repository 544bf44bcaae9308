//! Pieces of trousers, told from their outlines: beside the upper part lies the rise, a hollow above a point that juts out.

use super::outline::Polygon;
use toile_garment::Vec2;

// The limits were chosen by a few drawn trousers, and by bodices and skirts that must not count as legs.

/// Height of the crotch over that of the piece.
const CROTCH: std::ops::Range<f64> = 0.4..0.92;
/// The crotch juts out beyond the waist by more, and beyond the hem, as shares of the width.
const BEYOND: [f64; 2] = [0.06, 0.04];
/// The rise is hollow by more than this share of the width, and bulges by less.
const HOLLOW: f64 = 0.02;
/// The outseam is hollow by less than this share of the width, above the crotch.
const OUTSEAM: f64 = 0.06;
/// What lies above this share of the height is the top, and what lies below the other one is the hem.
const ENDS: [f64; 2] = [0.9, 0.05];

/// Is an upright outline that of a front or a back of trousers?
pub fn is_leg(outline: &Polygon) -> bool {
    [1.0, -1.0].into_iter().any(|side| has_rise(&outline.map(|p| Vec2::new(side * p.x, p.y))))
}

/// Has an outline a rise on its right?
fn has_rise(outline: &Polygon) -> bool {
    let ([low, high], size) = (outline.bounds(), outline.size());
    let n = outline.points.len();
    let height = |k: &usize| (outline.points[*k].y - low.y) / size.y.max(1e-9);
    let x = |k: &usize| outline.points[*k].x;
    let rightmost = |all: &mut dyn Iterator<Item = usize>| all.max_by(|i, k| x(i).total_cmp(&x(k)));
    let leftmost = |all: &mut dyn Iterator<Item = usize>| all.min_by(|i, k| x(i).total_cmp(&x(k)));
    let crotch = rightmost(&mut (0..n));
    let top = rightmost(&mut (0..n).filter(|k| height(k) > ENDS[0]));
    let hem = rightmost(&mut (0..n).filter(|k| height(k) < ENDS[1]));
    let side = leftmost(&mut (0..n).filter(|k| height(k) > ENDS[0]));
    let (Some(crotch), Some(top), Some(hem), Some(side)) = (crotch, top, hem, side) else { return false };
    let hip = leftmost(&mut (0..n).filter(|k| *k == side || height(k) > height(&crotch)));
    let juts = |k: usize, by: f64| x(&crotch) - x(&k) > by * (high.x - low.x);
    if !CROTCH.contains(&height(&crotch)) || !juts(top, BEYOND[0]) || !juts(hem, BEYOND[1]) {
        return false;
    }
    let [into, out] = off(outline, crotch, top);
    let [outseam, _] = off(outline, hip.unwrap_or(side), side);
    into > HOLLOW * size.x && out < HOLLOW * size.x && outseam < OUTSEAM * size.x
}

/// How far the outline lies inside and outside the straight line between two of its points, m. Of the two ways round
/// the shorter one is taken.
fn off(outline: &Polygon, from: usize, to: usize) -> [f64; 2] {
    let n = outline.points.len();
    let forward = (to + n - from) % n;
    let way =
        |count: usize, step: usize| (0..=count).map(|k| outline.points[(from + k * step) % n]).collect::<Vec<_>>();
    let ways = [way(forward, 1), way(n - forward, n - 1)];
    let length = |points: &[Vec2]| points.windows(2).map(|w| (w[1] - w[0]).norm()).sum::<f64>();
    let is_forward = length(&ways[0]) <= length(&ways[1]);
    let is_left = is_forward == (outline.area() > 0.0);
    let points = &ways[usize::from(!is_forward)];
    let chord = outline.points[to] - outline.points[from];
    // The cloth lies on the left of a walk counter-clockwise.
    let inwards = if is_left { Vec2::new(-chord.y, chord.x) } else { Vec2::new(chord.y, -chord.x) };
    let inwards = inwards.try_normalize(1e-9).unwrap_or_default();
    let away = points.iter().map(|p| (p - outline.points[from]).dot(&inwards));
    away.fold([0.0, 0.0], |[into, out], d| [f64::max(into, d), f64::max(out, -d)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(points: &[(f64, f64)]) -> Polygon {
        Polygon { points: points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect() }
    }

    /// The front of trousers: hem, inseam, crotch, rise, waist, outseam.
    fn front() -> Polygon {
        let rise = [(0.31, 0.78), (0.28, 0.79), (0.26, 0.82), (0.252, 0.87), (0.246, 1.02)];
        outline(&[&[(0.07, 0.0), (0.24, 0.0)][..], &rise, &[(0.02, 1.03), (0.0, 0.86), (0.02, 0.7)]].concat())
    }

    #[test]
    fn a_leg_has_a_rise_above_its_crotch() {
        assert!(is_leg(&front()));
        // Upside down it has none.
        assert!(!is_leg(&front().map(|p| -p)));
    }

    #[test]
    fn the_half_of_a_bodice_is_no_leg_and_neither_is_a_skirt() {
        let armhole = [(0.28, 0.52), (0.22, 0.54), (0.21, 0.6), (0.21, 0.68), (0.228, 0.72)];
        let bodice =
            outline(&[&[(0.0, 0.0), (0.28, 0.0)][..], &armhole, &[(0.078, 0.77), (0.06, 0.7), (0.0, 0.68)]].concat());
        assert!(!is_leg(&bodice));
        assert!(!is_leg(&outline(&[(0.0, 0.0), (0.25, 0.0), (0.25, 0.4), (0.2, 0.6), (0.0, 0.6)])));
    }
}
