//! Notches along a seam: which meets which.

use super::side::Side;
use crate::sewing::codes;
use crate::sewing::marks::{AT_END, on_outline};
use crate::sewing::shapes::Shapes;
use toile_garment::sewing::SeamSpec;
use toile_garment::{Diagnostic, Garment, PieceId};

/// Matching notches may differ by this share of the side's length …
pub const TOLERANCE: f64 = 0.03;
/// … or by this length, metres.
const NEAR: f64 = 8e-3;

/// The notches along a side, its ends left out: the distance of each, its piece, and its index in the list of the piece.
fn listed(garment: &Garment, shapes: &Shapes, side: &Side) -> Vec<(f64, PieceId, usize)> {
    let mut pieces: Vec<_> = side.spans.iter().map(|s| s.piece).collect();
    pieces.sort_unstable();
    pieces.dedup();
    let mut out = Vec::new();
    for id in pieces {
        for (k, s) in on_outline(&garment.pieces[id.index()], &shapes[id.index()]) {
            out.extend(side.find(shapes, id, 0, s).into_iter().map(|t| (t, id, k)));
        }
    }
    let mut ends = side.starts();
    ends.push(side.length);
    out.retain(|(t, ..)| ends.iter().all(|e| (e - t).abs() > AT_END));
    out.sort_by(|a, b| a.0.total_cmp(&b.0));
    out.dedup_by(|a, b| (a.0 - b.0).abs() < AT_END);
    out
}

/// Distances of the notches along a side, its ends left out.
fn along(garment: &Garment, shapes: &Shapes, side: &Side) -> Vec<f64> {
    listed(garment, shapes, side).into_iter().map(|(t, ..)| t).collect()
}

/// Names of the notches of a side that are none of those at some distances.
fn alone(garment: &Garment, shapes: &Shapes, side: &Side, met: &[f64]) -> Vec<String> {
    let rest = listed(garment, shapes, side).into_iter().filter(|(t, ..)| !met.contains(t));
    rest.map(|(_, id, k)| {
        let piece = &garment.pieces[id.index()];
        format!("`{}.{}`", piece.name, piece.notch_labels()[k])
    })
    .collect()
}

/// Largest difference of relative position when both sides have equally many notches.
pub fn misfit(garment: &Garment, shapes: &Shapes, a: &Side, b: &Side) -> Option<f64> {
    let (x, y) = (along(garment, shapes, a), along(garment, shapes, b));
    if x.is_empty() || x.len() != y.len() {
        return None;
    }
    x.iter().zip(&y).map(|(s, t)| (s / a.length - t / b.length).abs()).max_by(f64::total_cmp)
}

/// Notches of a that meet notches of b, in order.
pub fn matched(
    garment: &Garment,
    shapes: &Shapes,
    spec: &SeamSpec,
    a: &Side,
    b: &Side,
    notes: &mut Vec<Diagnostic>,
) -> Vec<(f64, f64)> {
    let (x, y) = (along(garment, shapes, a), along(garment, shapes, b));
    if x.is_empty() && y.is_empty() {
        return Vec::new();
    }
    let near = |s: f64, t: f64| {
        let (s, t) = (s / a.length, t / b.length);
        (s - t).abs() <= TOLERANCE.max(NEAR / a.length.max(b.length))
    };
    if x.len() == y.len() && x.iter().zip(&y).all(|(s, t)| near(*s, *t)) {
        return x.into_iter().zip(y).collect();
    }
    let pairs = nearest_pairs(&x, &y, a.length, b.length, near);
    let (met_a, met_b): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let alone = [alone(garment, shapes, a, &met_a), alone(garment, shapes, b, &met_b)].concat();
    let message = format!(
        "seam `{}` has {} notches on one side and {} on the other, {} of them matched by their place; without a \
         partner: {}",
        spec.name,
        x.len(),
        y.len(),
        pairs.len(),
        alone.join(", ")
    );
    let finding = match exchanged(garment, [a, b]) {
        Some((piece, image)) if mirrored_meet(&x, &y, [a, b], near) > pairs.len() => {
            let hint = format!(
                "{} of them would meet with the mirror image: sew `{image}` here, and `{piece}` where `{image}` is sewn",
                mirrored_meet(&x, &y, [a, b], near)
            );
            Diagnostic::warning(codes::SEAM_NOTCHES_DIFFER, message).hint(hint)
        }
        _ => Diagnostic::info(codes::SEAM_NOTCHES_DIFFER, message),
    };
    notes.push(finding.at(spec.source.clone()));
    pairs
}

/// The piece of which one of two sides is made, and its mirror image, where the other side has neither of them.
fn exchanged<'a>(garment: &'a Garment, sides: [&Side; 2]) -> Option<(&'a str, &'a str)> {
    let name = |id: PieceId| garment.pieces[id.index()].name.as_str();
    let image = |piece: &str| {
        let mut copies = garment.plan.copies.iter().filter(|c| c.mirror);
        copies.find_map(|c| match piece {
            p if p == c.piece => Some(c.name.as_str()),
            p if p == c.name => Some(c.piece.as_str()),
            _ => None,
        })
    };
    let of = |own: &Side, other: &Side| {
        let piece = own.spans.first().map(|s| name(s.piece))?;
        let image = image(piece)?;
        let is_alone = own.spans.iter().all(|s| name(s.piece) == piece);
        let is_apart = other.spans.iter().all(|s| ![piece, image].contains(&name(s.piece)));
        (is_alone && is_apart).then_some((piece, image))
    };
    of(sides[1], sides[0]).or_else(|| of(sides[0], sides[1]))
}

/// How many notches would meet if one side were that of a mirror image, which is walked the other way.
fn mirrored_meet(x: &[f64], y: &[f64], [a, b]: [&Side; 2], near: impl Fn(f64, f64) -> bool) -> usize {
    let turned: Vec<f64> = y.iter().rev().map(|t| b.length - t).collect();
    nearest_pairs(x, &turned, a.length, b.length, near).len()
}

/// Pairs that are each other's nearest, in rising order on both sides.
fn nearest_pairs(x: &[f64], y: &[f64], la: f64, lb: f64, near: impl Fn(f64, f64) -> bool) -> Vec<(f64, f64)> {
    let gap = |s: f64, t: f64| (s / la - t / lb).abs();
    let mut out: Vec<(f64, f64)> = Vec::new();
    for s in x {
        let best = y.iter().min_by(|t, u| gap(*s, **t).total_cmp(&gap(*s, **u)));
        let Some(t) = best.filter(|t| near(*s, **t)) else { continue };
        let back = x.iter().min_by(|p, q| gap(**p, *t).total_cmp(&gap(**q, *t)));
        let rises = out.last().is_none_or(|(_, last)| t > last);
        if back == Some(s) && rises {
            out.push((*s, *t));
        }
    }
    out
}
