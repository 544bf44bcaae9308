//! Girths of a surface, as a measuring tape around it shows them.

use super::surface::Surface;

/// The girth at a height: the length of a tape laid around the cloth, which bridges folds; metres. `None` where the
/// height cuts no cloth.
#[must_use]
pub fn tape(surface: &Surface, height: f64) -> Option<f64> {
    let mut cut = Vec::new();
    for triangle in 0..surface.triangles.len() {
        let corners = surface.corners(triangle);
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (corners[a], corners[b]);
            if (a.y < height) != (b.y < height) {
                let t = (height - a.y) / (b.y - a.y);
                cut.push([a.x + t * (b.x - a.x), a.z + t * (b.z - a.z)]);
            }
        }
    }
    let hull = hull(cut);
    (hull.len() > 2).then(|| (0..hull.len()).map(|i| distance(hull[i], hull[(i + 1) % hull.len()])).sum())
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    (x * x + y * y).sqrt()
}

/// The convex hull of points (Andrew's monotone chain).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    let mut hull = half(points.iter());
    hull.pop();
    let mut back = half(points.iter().rev());
    back.pop();
    hull.append(&mut back);
    hull
}

fn half<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> Vec<[f64; 2]> {
    let mut line: Vec<[f64; 2]> = Vec::new();
    for p in points {
        while line.len() > 1 && turn(line[line.len() - 2], line[line.len() - 1], *p) <= 0.0 {
            line.pop();
        }
        line.push(*p);
    }
    line
}

fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::tube;
    use super::*;

    #[test]
    fn a_tape_lies_around_a_tube() {
        let girth = tape(&tube(720, 4, 0.15, 1.0), 0.4).expect("cloth");
        assert!((girth - std::f64::consts::TAU * 0.15).abs() < 1e-5, "{girth}");
        assert_eq!(tape(&tube(12, 4, 0.15, 1.0), 1.5), None);
    }

    #[test]
    fn a_tape_bridges_a_hollow() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.2], [0.0, 1.0]];
        let around = hull(square.to_vec());
        assert_eq!(around.len(), 4);
        assert!(!around.contains(&[1.0, 0.2]));
    }
}
