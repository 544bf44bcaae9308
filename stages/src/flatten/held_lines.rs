//! Straight edges and right angles of the outline, which stay as they are.
//!
//! The free answer says what would become of them. An edge that bows a little is held straight. One that bows much was
//! asked to be a curve by the shape, and is let go. So it is with right angles. Both are told.

use super::features::{Chain, Features};
use super::findings::{self, Held};
use super::lock::Lock;
use super::params::{FlattenParams, LockKind};
use super::source::Source;
use std::collections::BTreeMap;
use toile_garment::{Report, Vec2};

/// Bow of a stored edge that still counts as straight, metres. Larger also holds flat curves, smaller misses edges that
/// a file rounds.
pub const STRAIGHT_BOW: f64 = 1e-4;
/// Change of a bow below which nothing is held, metres.
const BOW_UNTOUCHED: f64 = 1e-5;
/// Largest bow that is taken back, metres, and as a share of the edge. A larger one is a curve that the shape asks for.
const BOW_TAKEN_BACK: [f64; 2] = [0.015, 0.05];
/// Difference from 90° that still counts as a right angle, degrees.
const RIGHT_ANGLE_OFF: f64 = 0.25;
/// Turn of a right angle below which nothing is held, degrees.
const TURN_UNTOUCHED: f64 = 0.01;
/// Largest turn of a right angle that is taken back, degrees.
const TURN_TAKEN_BACK: f64 = 4.0;
/// Arm of an angle on a curved edge, metres.
const CURVED_ARM: f64 = 0.015;

/// The locks of a piece; `free` are the positions of its vertices without locks.
pub fn find(
    source: &Source<'_>,
    features: &Features,
    free: &[Vec2],
    params: &FlattenParams,
    report: &mut Report,
) -> Vec<Lock> {
    let mut out = Vec::new();
    let mut held = Held::default();
    if params.locks(LockKind::Straight) {
        straight(source, features, free, params, &mut out, &mut held);
    }
    if params.locks(LockKind::RightAngles) {
        right_angles(source, features, free, params, &mut out, &mut held);
    }
    findings::held(source.piece, &held, report);
    out
}

/// Largest distance of a chain from its chord.
pub fn bow(p: &[Vec2], chain: &[u32]) -> f64 {
    let at = |v: &u32| p[*v as usize];
    let (Some(a), Some(b)) = (chain.first().map(at), chain.last().map(at)) else { return 0.0 };
    let d = b - a;
    let length = d.norm();
    if length < 1e-9 {
        return 0.0;
    }
    chain.iter().map(|v| (d.perp(&(at(v) - a)) / length).abs()).fold(0.0, f64::max)
}

fn chord(p: &[Vec2], chain: &[u32]) -> f64 {
    let at = |v: &u32| p[*v as usize];
    chain.first().map(at).zip(chain.last().map(at)).map_or(0.0, |(a, b)| (b - a).norm())
}

/// Does a chain of the stored piece lie on its chord?
pub fn is_straight(rest: &[Vec2], chain: &[u32]) -> bool {
    chord(rest, chain) > 1e-6 && bow(rest, chain) <= STRAIGHT_BOW
}

fn straight(
    source: &Source<'_>,
    features: &Features,
    free: &[Vec2],
    params: &FlattenParams,
    out: &mut Vec<Lock>,
    held: &mut Held,
) {
    let rest = &source.mesh.rest;
    for edge in features.edges.iter().filter(|e| e.vertices.len() > 2 && is_straight(rest, &e.vertices)) {
        let now = bow(free, &edge.vertices);
        if now - bow(rest, &edge.vertices) < BOW_UNTOUCHED {
            continue;
        }
        let much = now > BOW_TAKEN_BACK[0] || now > BOW_TAKEN_BACK[1] * chord(free, &edge.vertices);
        if much && params.let_go {
            held.curved.push((edge.name.clone(), now));
            continue;
        }
        held.straight.push((edge.name.clone(), now));
        let n = edge.vertices.len();
        let on = |v: u32| v + source.offset;
        let (a, b) = (on(edge.vertices[0]), on(edge.vertices[n - 1]));
        out.extend(
            edge.vertices[1..n - 1]
                .iter()
                .map(|v| Lock::OnLine { v: [on(*v), a, b], stiffness: params.pair_stiffness }),
        );
    }
}

fn right_angles(
    source: &Source<'_>,
    features: &Features,
    free: &[Vec2],
    params: &FlattenParams,
    out: &mut Vec<Lock>,
    held: &mut Held,
) {
    let rest = &source.mesh.rest;
    for (_, v) in corners(rest, features) {
        let [before, corner, after] = v;
        let stored = angle(rest, v);
        let turned = (angle(free, v) - stored).to_degrees();
        if (stored.to_degrees() - 90.0).abs() > RIGHT_ANGLE_OFF || turned.abs() < TURN_UNTOUCHED {
            continue;
        }
        if turned.abs() > TURN_TAKEN_BACK && params.let_go {
            held.turned.push(turned);
            continue;
        }
        held.right.push(turned);
        let length = |v: u32| (rest[v as usize] - rest[corner as usize]).norm();
        let arm = length(before).min(length(after));
        out.push(Lock::Angle { v: v.map(|v| v + source.offset), angle: stored, arm, stiffness: params.pair_stiffness });
    }
}

/// The corners where two edges meet: names of the edges, and the vertices before, at and after.
fn corners<'f>(rest: &[Vec2], features: &'f Features) -> Vec<([&'f str; 2], [u32; 3])> {
    // The edge that ends at a vertex meets the one that begins there.
    let begins: BTreeMap<u32, &Chain> = features.edges.iter().filter_map(|e| Some((*e.vertices.first()?, e))).collect();
    let corner = |edge: &'f Chain| {
        let (corner, next) = edge.vertices.last().and_then(|v| begins.get_key_value(v))?;
        let back: Vec<u32> = edge.vertices.iter().rev().copied().collect();
        Some(([edge.name.as_str(), next.name.as_str()], [arm(rest, &back), *corner, arm(rest, &next.vertices)]))
    };
    features.edges.iter().filter_map(corner).collect()
}

/// Every corner in words, with its angle in two positions of the piece, radians.
pub fn corner_angles(rest: &[Vec2], features: &Features, both: [&[Vec2]; 2]) -> Vec<(String, [f64; 2])> {
    let told =
        |names: [&str; 2], v| (format!("the corner of {} and {}", names[0], names[1]), both.map(|p| angle(p, v)));
    corners(rest, features).into_iter().map(|(names, v)| told(names, v)).collect()
}

/// The vertex at the end of a straight chain, or a little way along a curved one.
fn arm(rest: &[Vec2], chain: &[u32]) -> u32 {
    let last = chain.len() - 1;
    if is_straight(rest, chain) {
        return chain[last];
    }
    let at = |v: u32| rest[v as usize];
    chain[1..].iter().copied().find(|v| (at(*v) - at(chain[0])).norm() >= CURVED_ARM).unwrap_or(chain[last])
}

/// Inner angle of a corner between the vertex before and the one after, radians.
fn angle(p: &[Vec2], [before, corner, after]: [u32; 3]) -> f64 {
    let at = |v: u32| p[v as usize];
    let (a, b) = (at(after) - at(corner), at(before) - at(corner));
    libm::atan2(a.perp(&b), a.dot(&b))
}
