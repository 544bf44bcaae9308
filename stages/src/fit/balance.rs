//! Balance: does a hem hang level, and do the side seams hang plumb?

use super::surface::{Hem, Surface};
use toile_formats::report::Balance;
use toile_garment::{Vec2, Vec3};

/// The height of a hem at one side is the mean over all of it that lies within this angle, radians.
const WITHIN: f64 = 0.4;

/// How far a hem hangs off the level. Empty where it does not go all the way round.
pub fn of_hem(name: &str, hem: &Hem, surface: &Surface) -> Vec<Balance> {
    let ends: Vec<[Vec3; 2]> = hem.edges.iter().map(|(t, k)| ends(surface, *t, *k)).collect();
    let centre = centre(&ends);
    let height = |toward: Vec2| {
        let [sum, length] = ends.iter().fold([0.0; 2], |[sum, length], [a, b]| {
            let (middle, long) = ((a + b) * 0.5, (b - a).norm());
            let out = Vec2::new(middle.x, middle.z) - centre;
            let is_there = libm::atan2(toward.perp(&out), toward.dot(&out)).abs() < WITHIN;
            if is_there { [sum + long * middle.y, length + long] } else { [sum, length] }
        });
        (length > 0.0).then(|| sum / length)
    };
    let off = |words: &str, one: Vec2, other: Vec2| {
        let value = height(one)? - height(other)?;
        Some(Balance { name: format!("{name} {words}"), value })
    };
    let pairs = [off("front above back", Vec2::y(), -Vec2::y()), off("left above right", Vec2::x(), -Vec2::x())];
    pairs.into_iter().flatten().collect()
}

/// How far the lower end of a line of points hangs before its upper end. `None` without points.
pub fn of_seam(name: String, points: impl Iterator<Item = Vec3>) -> Option<Balance> {
    let points: Vec<Vec3> = points.collect();
    let low = points.iter().min_by(|a, b| a.y.total_cmp(&b.y))?;
    let high = points.iter().max_by(|a, b| a.y.total_cmp(&b.y))?;
    Some(Balance { name, value: low.z - high.z })
}

fn ends(surface: &Surface, triangle: usize, corner: usize) -> [Vec3; 2] {
    let corners = surface.corners(triangle);
    [corners[corner], corners[(corner + 1) % 3]]
}

/// The middle of what a line spans, seen from above.
fn centre(ends: &[[Vec3; 2]]) -> Vec2 {
    let all = || ends.iter().flatten().map(|p| Vec2::new(p.x, p.z));
    let far = Vec2::new(f64::INFINITY, f64::INFINITY);
    (all().fold(far, |low, p| low.inf(&p)) + all().fold(-far, |high, p| high.sup(&p))) * 0.5
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::tube;
    use super::*;

    /// A tube whose hem rises toward the front: by a tenth of its place.
    #[test]
    fn a_hem_that_rises_to_the_front_is_not_level() {
        let mut surface = tube(360, 4, 0.2, 1.0);
        let lowest = surface.range()[0];
        for p in surface.points.iter_mut().filter(|p| p.y < lowest + 1e-6) {
            p.y += 0.1 * p.z - 0.02 * p.x;
        }
        let hems = surface.hems();
        let hem = hems.iter().min_by(|a, b| a.height.total_cmp(&b.height)).expect("a hem");
        let found = of_hem("hem", hem, &surface);
        let names: Vec<&str> = found.iter().map(|b| b.name.as_str()).collect();
        assert_eq!(names, ["hem front above back", "hem left above right"]);
        // The mean over an arc of 2 x 0.4 rad around the front lies at sin(0.4) / 0.4 of the radius.
        let mean = libm::sin(WITHIN) / WITHIN;
        assert!((found[0].value - 0.04 * mean).abs() < 2e-4, "{}", found[0].value);
        assert!((found[1].value + 0.008 * mean).abs() < 2e-4, "{}", found[1].value);
    }

    #[test]
    fn a_seam_that_swings_forward_leans() {
        let line = [[0.2, 1.0, 0.0], [0.2, 0.5, 0.01], [0.2, 0.1, 0.03]].map(Vec3::from);
        let found = of_seam("side seam left".into(), line.into_iter()).expect("a seam");
        assert!((found.value - 0.03).abs() < 1e-12);
        assert!(of_seam(String::new(), std::iter::empty()).is_none());
    }
}
