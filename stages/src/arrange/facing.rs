//! Which segment a piece lies on, and which way it faces.

use super::dresser::{Dresser, Segment, across_segment};
use crate::roles::{Facing, Lateral, Part};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use toile_garment::Vec3;

/// Length of the mean of the directions to what a piece is sewn to, below which it goes around the body.
const AROUND: f64 = 0.5;
/// Angle to front, side or back within which a piece faces just there, rad.
const SQUARE: f64 = 0.6;

/// The way a piece is laid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lie {
    /// Flat, facing an azimuth about its segment, from the front to the left, rad.
    Flat(f64),
    /// Bent around its segment; its middle at the azimuth where that is known.
    Bent(Option<f64>),
}

/// The segment of a piece by its part and by what it is sewn to.
pub fn segment_of(d: &Dresser<'_>, i: usize) -> Segment {
    match d.part(i) {
        Some(Part::Sleeve) => Segment::Arm(side_of(d, i).unwrap_or(0)),
        Some(Part::Collar | Part::Stand | Part::Hood) => Segment::Neck,
        Some(Part::Bodice | Part::Yoke | Part::Waistband | Part::Skirt | Part::Leg) => Segment::Torso,
        _ => segment_of_partner(d, i),
    }
}

/// The side on which a piece is sewn on, or lies by its name: 0 left, 1 right.
fn side_of(d: &Dresser<'_>, i: usize) -> Option<usize> {
    let x: f64 = d.hung(i).map(|(t, p)| t.share * (p.x - d.form.torso.from.x)).sum();
    // A piece of an arm that is sewn to other pieces of it alone follows them.
    let fellows = || d.threads[i].iter().filter(|t| t.other.piece != i && d.part(t.other.piece) == d.part(i));
    let beside: f64 = fellows().flat_map(|t| d.hung(t.other.piece).map(|(u, p)| u.share * p.x)).sum();
    let named = match d.roles[i].lateral {
        Some(Lateral::Left) => Some(0),
        Some(Lateral::Right) => Some(1),
        _ => None,
    };
    let by_sign = |x: f64| (x.abs() > 1e-9).then_some(usize::from(x < 0.0));
    by_sign(x).or_else(|| by_sign(beside)).or(named)
}

/// The side of a leg in one piece: 0 left, 1 right. Its back rise is longer than its front rise, and lies to the right as
/// drawn on a left leg.
fn leg_side(d: &Dresser<'_>, i: usize) -> usize {
    let middle = d.outlines[i].centroid().x;
    let rises = d.threads[i].iter().filter(|t| t.other.piece != i && d.part(t.other.piece) == Some(Part::Leg));
    let longer: f64 = rises.map(|t| t.share * (t.at.x - middle).signum()).sum();
    match d.roles[i].lateral {
        Some(Lateral::Left) => 0,
        Some(Lateral::Right) => 1,
        _ => usize::from(longer < 0.0),
    }
}

/// The segment of most of what a piece is sewn to; a leg where that is a piece of trousers.
fn segment_of_partner(d: &Dresser<'_>, i: usize) -> Segment {
    let mut best: Option<(Segment, f64)> = None;
    for (t, p) in d.hung(i) {
        let is_leg = d.part(t.other.piece) == Some(Part::Leg) && d.part(i) == Some(Part::Cuff);
        let segment = if is_leg { Segment::Leg(usize::from(p.x < 0.0)) } else { d.segments[t.other.piece] };
        let weight: f64 = d
            .hung(i)
            .filter(|(u, _)| d.segments[u.other.piece] == d.segments[t.other.piece])
            .map(|(u, _)| u.share)
            .sum();
        if best.is_none_or(|(_, w)| weight > w) {
            best = Some((segment, weight));
        }
    }
    best.map_or(Segment::Torso, |(segment, _)| segment)
}

/// How a piece lies, as far as its name and what is placed tell; `None` where nothing does.
pub fn lie_of(d: &Dresser<'_>, i: usize) -> Option<Lie> {
    let on_arm = matches!(d.segments[i], Segment::Arm(_));
    if d.is_whole_leg(i) {
        return Some(Lie::Bent(Some(if leg_side(d, i) == 0 { FRAC_PI_2 } else { -FRAC_PI_2 })));
    }
    if d.is_tube(i) {
        return Some(Lie::Bent(d.named_azimuth(i).filter(|_| !on_arm)));
    }
    if let Some(azimuth) = d.named_azimuth(i) {
        return Some(Lie::Flat(azimuth));
    }
    if on_arm && let Some(lie) = lie_on_arm(d, i) {
        return Some(lie);
    }
    let (azimuth, length) = mean_direction(d, i)?;
    Some(if length < AROUND { Lie::Bent(None) } else { Lie::Flat(squared(d, i, azimuth)) })
}

/// Upper and under sleeves lie around the arm; halves of a sleeve follow the front and the back.
fn lie_on_arm(d: &Dresser<'_>, i: usize) -> Option<Lie> {
    let Segment::Arm(k) = d.segments[i] else { return None };
    let outside = if k == 0 { FRAC_PI_2 } else { -FRAC_PI_2 };
    match d.roles[i].facing {
        Some(Facing::Upper) => return Some(Lie::Bent(Some(outside))),
        Some(Facing::Under) => return Some(Lie::Bent(Some(outside + PI))),
        _ => {}
    }
    let front: f64 = d
        .hung(i)
        .filter_map(|(t, _)| Some((t.share, d.sheets[t.other.piece].as_ref()?.normal.z)))
        .map(|(s, z)| s * z)
        .sum();
    let all: f64 = d.hung(i).map(|(t, _)| t.share).sum();
    match front / all.max(1e-9) {
        f if f > 0.4 => Some(Lie::Flat(0.0)),
        f if f < -0.4 => Some(Lie::Flat(PI)),
        _ if all > 0.0 => Some(Lie::Bent(None)),
        _ => None,
    }
}

/// A direction that is nearly square to the body is made square. Panels of a ring keep theirs.
fn squared(d: &Dresser<'_>, i: usize, azimuth: f64) -> f64 {
    let square = (azimuth / FRAC_PI_2).round() * FRAC_PI_2;
    let is_panel = matches!(d.part(i), Some(Part::Skirt | Part::Bodice));
    if !is_panel && (azimuth - square).abs() < SQUARE { square } else { azimuth }
}

/// Azimuth of a place about the segment of a piece, rad.
pub fn azimuth_of(d: &Dresser<'_>, i: usize, p: Vec3) -> f64 {
    let segment = d.segment(i);
    let [front, left] = across_segment(segment);
    libm::atan2((p - segment.from).dot(&left), (p - segment.from).dot(&front))
}

/// Mean direction to what a piece is sewn to, and its length, from 0 (all around) to 1 (one direction).
///
/// A neckline is long and narrow. So where the plain mean says nothing, width and depth count alike: half a neckline
/// lies to one side, and a whole one all around.
pub fn mean_direction(d: &Dresser<'_>, i: usize) -> Option<(f64, f64)> {
    let segment = d.segment(i);
    let axes = across_segment(segment);
    let ends: Vec<(f64, [f64; 2])> =
        d.hung(i).map(|(t, p)| (t.share, axes.map(|a| (p - segment.from).dot(&a)))).collect();
    let all: f64 = ends.iter().map(|e| e.0).sum();
    let mean = |f: &dyn Fn(&[f64; 2]) -> f64| ends.iter().map(|(w, e)| w * f(e)).sum::<f64>() / all.max(1e-12);
    let plain = [0, 1].map(|k| mean(&|e| e[k] / libm::hypot(e[0], e[1]).max(1e-6)));
    let even = [0, 1].map(|k| mean(&|e| e[k]) / mean(&|e| e[k] * e[k]).sqrt().max(1e-6));
    let length = |[front, left]: [f64; 2]| libm::hypot(front, left);
    let [front, left] = if length(plain) >= AROUND { plain } else { even };
    (all > 0.0).then(|| (libm::atan2(left, front), length([front, left]).min(1.0)))
}

/// Azimuths of pieces of which none faces a known way, in their order around the body: each follows the one whose right
/// edge it is sewn to. The first faces the front.
pub fn ring(d: &Dresser<'_>, group: &[usize]) -> Vec<(usize, f64)> {
    let width = |i: usize| d.outlines[i].size().x;
    let total: f64 = group.iter().map(|i| width(*i)).sum();
    let mut found: Vec<(usize, f64)> = group.first().map(|i| (*i, 0.0)).into_iter().collect();
    let mut next = 0;
    while next < found.len() {
        let (i, azimuth) = found[next];
        next += 1;
        for t in &d.threads[i] {
            let k = t.other.piece;
            let level = t.outwards.x.abs() > 0.7;
            if level && group.contains(&k) && found.iter().all(|(f, _)| *f != k) {
                let step = TAU * 0.5 * (width(i) + width(k)) / total;
                found.push((k, azimuth + step * t.outwards.x.signum()));
            }
        }
    }
    found
}
