//! Sheets are kept clear of the body and of one another.

use super::dresser::{Dresser, Segment};
use super::sheet::Sheet;
use crate::roles::Part;
use crate::roles::outline::Polygon;
use std::cmp::Ordering;
use toile_garment::{Vec2, Vec3};

/// Distance around a piece within which the body counts, m.
const AROUND: f64 = 0.015;
/// Least distance of sheets that lie over each other, m.
const LAYER: f64 = 0.02;
/// Most by which a piece around the neck is opened, m. What lies farther out is no part of the neck.
const WIDER: f64 = 0.08;
/// Step by which sheets are moved apart, m, and the most steps.
const STEP: f64 = 0.004;
const STEPS: usize = 100;

/// Distance of a flat piece from the body at its start, m. Cloth over the bust and the seat has to reach around.
pub fn margin(part: Option<Part>) -> f64 {
    match part {
        Some(Part::Bodice | Part::Yoke) => 0.1,
        Some(Part::Sleeve | Part::Cuff) => 0.08,
        Some(Part::Skirt | Part::Leg | Part::Tier | Part::Godet) => 0.05,
        _ => 0.035,
    }
}

/// Moves a flat sheet along its normal to its distance from the body, or of its segment where there is no surface.
pub fn off_body(d: &mut Dresser<'_>, i: usize) {
    let Some(sheet) = d.sheets[i].clone().filter(|s| s.bend.is_none()) else { return };
    let outline = upright(&d.outlines[i], &sheet);
    let [low, high] = outline.bounds();
    let reach = Vec2::repeat(AROUND);
    let is_over = |q: Vec2| {
        let within = q >= low - reach && q <= high + reach;
        within && (outline.contains(q) || outline.outwards(q).1 < AROUND)
    };
    let lowest = if is_beside_head(d, i, &sheet) { d.form.neck.to.y } else { f64::NEG_INFINITY };
    let surface = d.form.surface.iter().filter(|p| p.y >= lowest);
    let before = surface.map(|p| sheet.seen(*p)).filter(|(q, _)| is_over(*q)).map(|(_, before)| before);
    let farthest = before.fold(f64::NEG_INFINITY, f64::max);
    let segment = d.segment(i);
    let half = segment.half_depth * sheet.normal.z.abs() + segment.half_width * (1.0 - sheet.normal.z.abs());
    let axis = sheet.seen((segment.from + segment.to) * 0.5).1;
    // A piece beside the body keeps the distance from its axis that it would have before it.
    let before = if farthest.is_finite() { farthest.max(axis) } else { axis + half };
    let by = sheet.normal * (before + margin(d.part(i)));
    let by = by + Vec3::y() * over_shoulder(d, i, &sheet, by);
    if let Some(sheet) = &mut d.sheets[i] {
        sheet.shift(by);
    }
}

/// Returns `true` for half a hood, and the like. It stands over the shoulder, and not before it.
fn is_beside_head(d: &Dresser<'_>, i: usize, sheet: &Sheet) -> bool {
    d.segments[i] == Segment::Neck && sheet.normal.x.abs() > 0.7
}

/// The way up, m, that brings a sheet beside the head over the shoulder under it.
fn over_shoulder(d: &Dresser<'_>, i: usize, sheet: &Sheet, by: Vec3) -> f64 {
    if !is_beside_head(d, i, sheet) {
        return 0.0;
    }
    let points = d.outlines[i].points.iter().map(|p| sheet.at(*p) + by);
    points.map(|p| d.form.shoulder(p.x) + LAYER - p.y).fold(0.0, f64::max)
}

/// Distances of the corners of a piece from an axis, or their heights: least and largest, m.
fn spread(d: &Dresser<'_>, i: usize, sheet: &Sheet, of: impl Fn(Vec3) -> f64) -> [f64; 2] {
    let values = d.outlines[i].points.iter().map(|p| of(sheet.at(*p)));
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
}

/// Lifts a piece that is bent around the neck until it lies over the shoulders, and opens it where the neck is wider. A
/// collar that is folded over its stand lies outside it, and takes it along.
pub fn around_neck(d: &mut Dresser<'_>, i: usize) {
    let is_bent = |d: &Dresser<'_>, k: usize| d.sheets[k].as_ref().is_some_and(|s| s.bend.is_some());
    let Some(mut sheet) = d.sheets[i].clone().filter(|_| is_bent(d, i) && d.segments[i] == Segment::Neck) else {
        return;
    };
    let neck = &d.form.neck;
    let axis = (neck.to - neck.from).normalize();
    let radius = |p: Vec3| (p - neck.from - axis * (p - neck.from).dot(&axis)).norm();
    let under: Vec<usize> = d.stands_under(i).filter(|k| is_bent(d, *k) && !d.is_given[*k]).collect();
    let outermost = |k: &usize| d.sheets[*k].as_ref().map_or(0.0, |s| spread(d, *k, s, radius)[1] + LAYER);
    let outside = under.iter().map(outermost).fold(0.0, f64::max);
    sheet.widen((outside - spread(d, i, &sheet, radius)[0]).max(0.0));
    let [inner, outer] = spread(d, i, &sheet, radius);
    let is_under = |p: &&Vec3| p.y < neck.from.y && (inner - LAYER..outer + LAYER).contains(&radius(**p));
    let shoulder = d.form.surface.iter().filter(is_under).map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let by = shoulder + LAYER - spread(d, i, &sheet, |p| p.y)[0];
    let lift = -axis * if by.is_finite() { by.max(0.0) } else { 0.0 };
    sheet.shift(lift);
    let [low, high] = spread(d, i, &sheet, |p| p.y);
    let beside = d.form.surface.iter().filter(|p| (low..high).contains(&p.y)).map(|p| radius(*p));
    let widest = beside.filter(|r| *r < inner + WIDER).fold(0.0, f64::max);
    sheet.widen((widest + AROUND - inner).max(0.0));
    for k in under {
        d.sheets[k].iter_mut().for_each(|s| s.shift(lift));
    }
    d.sheets[i] = Some(sheet);
}

/// The outline of a piece in its sheet's plane.
fn upright(outline: &Polygon, sheet: &Sheet) -> Polygon {
    outline.map(|p| crate::roles::outline::turned(p, sheet.turn))
}

/// The outline of a piece seen in the plane of another sheet.
fn seen_in(outline: &Polygon, sheet: &Sheet, plane: &Sheet) -> Polygon {
    outline.map(|p| plane.seen(sheet.at(p)).0)
}

/// Returns `true` if two flat sheets look the same way.
fn is_parallel(a: &Sheet, b: &Sheet) -> bool {
    a.bend.is_none() && b.bend.is_none() && a.normal.dot(&b.normal) > 0.9
}

/// Two sheets that overlap as seen along their normals, and their distance, m: positive where the second lies outside.
fn overlap(d: &Dresser<'_>, i: usize, k: usize) -> Option<f64> {
    let (a, b) = (d.sheets[i].as_ref()?, d.sheets[k].as_ref()?);
    if !is_parallel(a, b) {
        return None;
    }
    let other = seen_in(&d.outlines[k], b, a);
    let own = upright(&d.outlines[i], a);
    let middle = b.at(d.outlines[k].centroid());
    own.overlaps(&other).then(|| a.seen(middle).1)
}

/// Moves sheets of one group apart in their common plane until none overlaps: beside one another, or one under another.
/// Sheets that are sewn flat onto each other, and those of different layers, stay over each other.
pub fn side_by_side(d: &mut Dresser<'_>, group: &[usize]) {
    let lie_over = |d: &Dresser<'_>, i, k| overlap(d, i, k).is_some_and(|before| before.abs() < LAYER);
    for (n, i) in group.iter().enumerate() {
        for k in &group[n + 1..] {
            if d.are_sewn_flat(*i, *k) || d.layers[*i] != d.layers[*k] || !lie_over(d, *i, *k) {
                continue;
            }
            // The last step is one more than is needed, or they would touch.
            for _ in 0..STEPS {
                let goes_on = lie_over(d, *i, *k);
                step_apart(d, *i, *k);
                if !goes_on {
                    break;
                }
            }
        }
    }
}

/// Moves two sheets one step apart in their plane: beside one another, or one under another.
fn step_apart(d: &mut Dresser<'_>, i: usize, k: usize) {
    let (Some(a), Some(b)) = (d.sheets[i].clone(), d.sheets[k].clone()) else { return };
    let (own, other) = (upright(&d.outlines[i], &a), seen_in(&d.outlines[k], &b, &a));
    let apart = other.centroid() - own.centroid();
    let size = own.size() + other.size();
    let is_level = apart.x.abs() * size.y > apart.y.abs() * size.x;
    let way = if is_level { a.right * apart.x.signum() } else { a.up * apart.y.signum() };
    move_pair(d, [i, k], way * (0.5 * STEP));
}

fn move_pair(d: &mut Dresser<'_>, [i, k]: [usize; 2], by: Vec3) {
    for (piece, by) in [(i, -by), (k, by)] {
        if !d.is_given[piece]
            && let Some(sheet) = &mut d.sheets[piece]
        {
            sheet.shift(by);
        }
    }
}

/// Moves sheets that lie over each other in nearly one plane apart along their normals. `order` is that of placing;
/// what is placed later goes outside, but sleeves and lower layers stay inside. A lapel that folds over goes outside from
/// behind, too.
pub fn layers(d: &mut Dresser<'_>, order: &[usize]) {
    for _ in 0..4 {
        let mut moved = false;
        for (n, i) in order.iter().enumerate() {
            for k in &order[n + 1..] {
                let Some(before) = overlap(d, *i, *k) else { continue };
                let is_on_arm = |p: usize| matches!(d.segments[p], Segment::Arm(_));
                // The one that goes outside, and how far outside it is already.
                let (outer, already) = match d.layers[*i].cmp(&d.layers[*k]) {
                    Ordering::Less => (*k, before),
                    Ordering::Greater => (*i, -before),
                    Ordering::Equal if !is_on_arm(*i) && is_on_arm(*k) => (*i, -before),
                    Ordering::Equal if before < -LAYER && !d.folds_over(*k, *i) && !d.are_sewn_flat(*k, *i) => continue,
                    Ordering::Equal => (*k, before),
                };
                if already < LAYER
                    && !d.is_given[outer]
                    && let Some(sheet) = &mut d.sheets[outer]
                {
                    sheet.shift(sheet.normal * (LAYER - already));
                    moved = true;
                }
            }
        }
        if !moved {
            return;
        }
    }
}

/// Moves the flat panels of a ring away from the axis until neighbours have room beside one another.
pub fn ring_room(d: &mut Dresser<'_>, ring: &[(usize, f64)]) {
    let total: f64 = ring.iter().map(|(i, _)| d.outlines[*i].size().x).sum();
    for (i, _) in ring {
        let half = 0.5 * d.outlines[*i].size().x;
        let away = half / libm::tan(std::f64::consts::TAU * half / total).max(0.05);
        let axis = (d.segment(*i).from + d.segment(*i).to) * 0.5;
        if let Some(sheet) = &mut d.sheets[*i] {
            let by = away - (sheet.origin - axis).dot(&sheet.normal);
            if by > 0.0 {
                sheet.shift(sheet.normal * by);
            }
        }
    }
}
