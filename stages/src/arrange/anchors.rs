//! Anchors of a garment: it hangs by its shoulder seams, its waist, or its bust.

use super::dresser::{Dresser, Segment};
use super::pull::Anchor;
use crate::roles::Part;
use toile_garment::Vec2;

/// Rise of the outward normal from which an edge is an upper one.
const UPPER: f64 = 0.5;
/// Distance from a seam within which an edge is sewn, m.
const SEWN: f64 = 0.012;
/// Height of a shoulder seam over the shoulder at the start, m.
const SHOULDER_EASE: f64 = 0.01;

/// Anchors of the first group that is placed on a body.
#[must_use]
pub fn anchors(d: &Dresser<'_>, group: &[usize]) -> Vec<Anchor> {
    let is_trunk = |i: &usize| matches!(d.part(*i), Some(Part::Bodice | Part::Yoke | Part::Strap));
    let trunk: Vec<usize> = group.iter().copied().filter(is_trunk).collect();
    if trunk.is_empty() {
        return at_waist(d, group);
    }
    let found = [shoulders(d, &trunk), waist_seams(d, &trunk), tops(d, &trunk)];
    found.into_iter().find(|a| !a.is_empty()).unwrap_or_default()
}

/// Direction of an outward normal of a piece in space, upwards.
fn rise(d: &Dresser<'_>, i: usize, outwards: Vec2) -> f64 {
    d.sheets[i].as_ref().map_or(0.0, |s| s.direction(outwards).y)
}

/// Seams between front and back whose edges both look up: they lie on the shoulders.
fn shoulders(d: &Dresser<'_>, group: &[usize]) -> Vec<Anchor> {
    let mut anchors = Vec::new();
    for i in group {
        let Some(sheet) = &d.sheets[*i] else { continue };
        for t in d.threads[*i].iter().filter(|t| group.contains(&t.other.piece)) {
            let apart = d.sheets[t.other.piece].as_ref().is_some_and(|o| o.normal.dot(&sheet.normal) < 0.0);
            if apart && rise(d, *i, t.outwards) > UPPER && rise(d, t.other.piece, t.other_outwards) > UPPER {
                let x = 0.5 * (sheet.at(t.at).x.abs() + d.form.arms[0].from.x.abs());
                let height = d.form.shoulder(x) + SHOULDER_EASE;
                anchors.push(Anchor { piece: *i, at: t.at, height, share: t.share });
            }
        }
    }
    anchors
}

/// Seams between the trunk and what hangs from it lie at the waist. A waistband with nothing below it is a band at the hem.
fn waist_seams(d: &Dresser<'_>, group: &[usize]) -> Vec<Anchor> {
    let hangs = |k: usize| match d.part(k) {
        Some(Part::Waistband) => d.has_below(),
        part => matches!(part, Some(Part::Skirt | Part::Leg)),
    };
    let mut anchors = Vec::new();
    for i in group {
        for t in d.threads[*i].iter().filter(|t| hangs(t.other.piece)) {
            anchors.push(Anchor { piece: *i, at: t.at, height: d.form.waist, share: t.share });
        }
    }
    anchors
}

/// The top of what has no shoulders lies under the arms, or at the neck.
fn tops(d: &Dresser<'_>, group: &[usize]) -> Vec<Anchor> {
    let has_sleeves = (0..d.roles.len()).any(|i| d.part(i) == Some(Part::Sleeve));
    let height = if has_sleeves { d.form.torso.from.y } else { d.form.armpit() };
    let top = |i: &usize| {
        let sheet = d.sheets[*i].as_ref()?;
        let rise = |p: &&Vec2| sheet.at(**p).y;
        let at = d.outlines[*i].points.iter().max_by(|a, b| rise(a).total_cmp(&rise(b)))?;
        Some(Anchor { piece: *i, at: *at, height, share: 0.1 })
    };
    group.iter().filter_map(top).collect()
}

/// Free upper edges lie at the waist.
fn at_waist(d: &Dresser<'_>, group: &[usize]) -> Vec<Anchor> {
    let on_torso = |i: &&usize| d.segments[**i] == Segment::Torso;
    let mut anchors = Vec::new();
    for i in group.iter().filter(on_torso) {
        for (at, share) in free_upper_points(d, *i) {
            anchors.push(Anchor { piece: *i, at, height: d.form.waist, share });
        }
    }
    anchors
}

/// Middles of the sides of an outline that look up and are sewn to nothing, with their lengths, m.
#[must_use]
pub fn free_upper_points(d: &Dresser<'_>, i: usize) -> Vec<(Vec2, f64)> {
    let is_free = |p: Vec2| d.threads[i].iter().all(|t| (t.at - p).norm() > SEWN.max(0.75 * t.share));
    let sides = d.outlines[i].sides().flat_map(|[a, b]| {
        // A long side may be sewn in part.
        let parts = ((b - a).norm() / 0.02).ceil().max(1.0) as usize;
        (0..parts).map(move |k| (a + (b - a) * ((k as f64 + 0.5) / parts as f64), (b - a) / parts as f64))
    });
    let looks_up = |along: Vec2| along.try_normalize(1e-9).is_some_and(|u| rise(d, i, Vec2::new(u.y, -u.x)) > UPPER);
    sides.filter(|(at, along)| looks_up(*along) && is_free(*at)).map(|(at, along)| (at, along.norm())).collect()
}
