//! What drill holes and notches alone say of darts: candidates.

use super::super::darts::{DrawnDart, wedge_test};
use super::super::geom;
use super::lens::{LENS_LENGTH, LENS_WIDTH};
use toile_garment::Vec2;

/// Three drill holes along the grain: both tips and one at the widest place, on the axis or beside it. Tip, middle, tip.
#[must_use]
pub fn threes(drills: &[Vec2], darts: &[DrawnDart], grain: Option<Vec2>) -> Vec<[Vec2; 3]> {
    let near = |p: &Vec2| darts.iter().any(|d| d.apexes.iter().chain(&d.mouth).any(|q| (p - q).norm() < 30.0));
    let free: Vec<Vec2> = drills.iter().copied().filter(|p| !near(p)).take(60).collect();
    // Only exactly three: among more holes there is no telling, and a row of buttons has more.
    let [a, b, c] = free.as_slice() else { return Vec::new() };
    let orders = [[*a, *b, *c], [*b, *a, *c], [*a, *c, *b]];
    let fits = |[s, m, t]: &[Vec2; 3]| {
        let axis = t - s;
        let length = axis.norm();
        let along = (m - s).dot(&axis) / (length * length).max(1e-9);
        let beside = (geom::cross(axis, m - s) / length.max(1e-9)).abs();
        let up = grain.is_none_or(|g| libm::atan2(geom::cross(axis, g).abs(), axis.dot(&g).abs()).to_degrees() <= 25.0);
        (80.0..=*LENS_LENGTH.end()).contains(&length) && (0.25..=0.75).contains(&along) && beside <= length / 8.0 && up
    };
    orders.into_iter().find(fits).into_iter().collect()
}

/// Four drill holes in the shape of a slim kite: its two tips first.
#[must_use]
pub fn kites(drills: &[Vec2], darts: &[DrawnDart]) -> Vec<[Vec2; 4]> {
    let near = |p: &Vec2| darts.iter().any(|d| d.apexes.iter().chain(&d.mouth).any(|q| (p - q).norm() < 30.0));
    let free: Vec<Vec2> = drills.iter().copied().filter(|p| !near(p)).take(60).collect();
    // Only exactly four: among more holes there is no telling.
    let [a, b, c, d] = free.as_slice() else { return Vec::new() };
    let orders =
        [[*a, *b, *c, *d], [*a, *c, *b, *d], [*a, *d, *b, *c], [*c, *d, *a, *b], [*b, *d, *a, *c], [*b, *c, *a, *d]];
    orders
        .into_iter()
        .find(|[s, t, p, q]| {
            let (axis, across) = (t - s, q - p);
            let (length, width) = (axis.norm(), across.norm());
            let along = |r: &Vec2| (r - s).dot(&axis) / (length * length);
            LENS_LENGTH.contains(&length)
                && LENS_WIDTH.contains(&width)
                && length >= 2.5 * width
                && axis.dot(&across).abs() <= 0.05 * length * width
                && (geom::cross(axis, (p + q) * 0.5 - s) / length).abs() <= 0.1 * width
                && [p, q].iter().all(|r| (0.2..=0.8).contains(&along(r)))
        })
        .into_iter()
        .collect()
}

/// Two notches at a mouth and a drill hole near the apex: only a candidate, a person must say. The hole lies on the
/// axis of the mouth, and no other hole claims the same mouth.
#[must_use]
pub fn candidates(notches: &[Vec2], drills: &[Vec2], darts: &[DrawnDart]) -> Vec<(Vec2, [Vec2; 2])> {
    let mut found: Vec<(Vec2, [Vec2; 2])> = Vec::new();
    for drill in drills.iter().take(200) {
        let taken = darts.iter().any(|d| {
            let polygon: Vec<Vec2> = d.legs[0].iter().chain(d.legs[1].iter().rev()).copied().collect();
            d.apexes.iter().any(|a| (a - drill).norm() < 30.0) || geom::inside(*drill, &polygon)
        });
        if taken {
            continue;
        }
        let near: Vec<Vec2> =
            notches.iter().copied().filter(|p| (25.0..=400.0).contains(&(p - drill).norm())).take(200).collect();
        let pair =
            near.iter().enumerate().flat_map(|(i, a)| near[i + 1..].iter().map(move |b| (*a, *b))).find(|(a, b)| {
                let (u, v) = ((a - drill).norm(), (b - drill).norm());
                (u - v).abs() <= 0.02 * u.max(v) && wedge_test(*drill, *a, *b, 5.0).is_ok()
            });
        found.extend(pair.map(|(a, b)| (*drill, [a, b])));
    }
    let all = found.clone();
    found.retain(|(drill, mouth)| !all.iter().any(|(d, m)| d != drill && m.iter().any(|p| mouth.contains(p))));
    found
}
