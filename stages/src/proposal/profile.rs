//! The course of a stretch of outline: its heading against its chord, at stations evenly spaced by arc length.

use super::tuning::STATIONS;
use toile_garment::Vec2;

/// Headings against the chord, radians, from start to end.
pub type Profile = [f64; STATIONS];

/// An angle between −π and π.
pub fn wrapped(angle: f64) -> f64 {
    let turns = (angle / std::f64::consts::TAU).round();
    angle - turns * std::f64::consts::TAU
}

/// Heading of a direction, radians from +x.
pub fn heading(v: Vec2) -> f64 {
    libm::atan2(v.y, v.x)
}

/// Turn from one direction to another, radians, positive to the left.
pub fn turn(u: Vec2, v: Vec2) -> f64 {
    libm::atan2(u.x * v.y - u.y * v.x, u.dot(&v))
}

/// The course of a polyline. A closed one, which has no chord, is measured against its first heading.
pub fn profile(points: &[Vec2]) -> Profile {
    let mut out = [0.0; STATIONS];
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return out };
    let lengths: Vec<f64> = points.windows(2).map(|w| (w[1] - w[0]).norm()).collect();
    let total: f64 = lengths.iter().sum();
    let begin = points[1.min(points.len() - 1)] - first;
    let chord = if (last - first).norm() > 1e-3 * total { last - first } else { begin };
    let (mut at, mut done) = (0, 0.0);
    let mut angle = wrapped(heading(begin) - heading(chord));
    for (k, value) in out.iter_mut().enumerate() {
        let s = total * (k as f64 + 0.5) / STATIONS as f64;
        while at + 1 < lengths.len() && done + lengths[at] < s {
            done += lengths[at];
            angle += turn(points[at + 1] - points[at], points[at + 2] - points[at + 1]);
            at += 1;
        }
        *value = angle;
    }
    out
}

/// The course of the mirror image, walked the other way: what the same edge of a mirrored piece has.
pub fn mirrored(p: &Profile) -> Profile {
    std::array::from_fn(|k| -p[STATIONS - 1 - k])
}

/// Root of the mean square of the difference of two courses, radians.
pub fn apart(a: &Profile, b: &Profile) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum();
    (sum / STATIONS as f64).sqrt()
}

/// The course walked the other way.
pub fn reversed(p: &Profile) -> Profile {
    std::array::from_fn(|k| p[STATIONS - 1 - k])
}

/// Largest heading against the chord, radians.
pub fn bow(p: &Profile) -> f64 {
    p.iter().fold(0.0, |most, h| f64::max(most, h.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(sweep: f64, steps: usize) -> Vec<Vec2> {
        (0..=steps)
            .map(|k| sweep * k as f64 / steps as f64)
            .map(|t| Vec2::new(libm::sin(t), 1.0 - libm::cos(t)))
            .collect()
    }

    #[test]
    fn an_arc_turns_evenly_about_its_chord() {
        let p = profile(&arc(1.0, 400));
        // From half the sweep before the chord to half after it.
        let expected = |k: usize| -0.5 + (k as f64 + 0.5) / STATIONS as f64;
        assert!(p.iter().enumerate().all(|(k, h)| (h - expected(k)).abs() < 0.01), "{p:?}");
        assert!(apart(&p, &mirrored(&p)) < 1e-2);
        assert!(apart(&p, &reversed(&p)) > 0.5);
    }
}
