//! Pleats keep their depth. How much cloth is laid in folds is chosen by the pattern maker; no shape asks for it.

use super::findings;
use super::lock::Lock;
use super::params::{FlattenParams, LockKind};
use super::source::Source;
use crate::solve::lines::fold_vertices;
use toile_garment::dart::{Dart, DartKind, pleat_ends};
use toile_garment::mesh::PieceMesh;
use toile_garment::{Report, Vec2};

/// Change of a width below which nothing is held, metres.
const WIDTH_UNTOUCHED: f64 = 1e-5;
/// Width that is none, metres: a lock of no length has no direction.
const SHORTEST_WIDTH: f64 = 1e-6;

/// The locks of the pleats of a piece; `free` are the positions of its vertices without locks.
pub fn find(source: &Source<'_>, free: &[Vec2], params: &FlattenParams, report: &mut Report) -> Vec<Lock> {
    let mut out = Vec::new();
    if !params.locks(LockKind::Pleats) {
        return out;
    }
    let rest = &source.mesh.rest;
    let width = |x: &[Vec2], [a, b]: [u32; 2]| (x[b as usize] - x[a as usize]).norm();
    let mut held = Vec::new();
    for pleat in source.piece.darts.iter().filter(|d| d.kind == DartKind::Pleat) {
        let pairs = across(source.mesh, pleat);
        let change = |pair: &[u32; 2]| (width(free, *pair) - width(rest, *pair)).abs();
        let Some(most) = pairs.iter().map(change).max_by(f64::total_cmp).filter(|c| *c >= WIDTH_UNTOUCHED) else {
            continue;
        };
        held.push((pleat.name.clone(), most));
        out.extend(pairs.iter().filter(|p| width(rest, **p) > SHORTEST_WIDTH).map(|pair| Lock::Distance {
            v: pair.map(|v| v + source.offset),
            length: width(rest, *pair),
            stiffness: params.pair_stiffness,
        }));
    }
    findings::held_pleats(source.piece, &held, report);
    out
}

/// Pairs of vertices across a pleat, from its mouth down its two lines.
fn across(mesh: &PieceMesh, pleat: &Dart) -> Vec<[u32; 2]> {
    let [a, b] = [0, 1].map(|side| line(mesh, pleat, side));
    let (Some(top), Some(bottom)) = (b.first(), b.last()) else { return Vec::new() };
    let at = |v: u32| mesh.rest[v as usize];
    let length = |chain: &[u32]| (at(chain[chain.len() - 1]) - at(chain[0])).norm();
    let nearest = |share: f64| {
        let place = at(*top) + (at(*bottom) - at(*top)) * share;
        let far = |v: &u32| (at(*v) - place).norm_squared();
        b.iter().copied().min_by(|v, w| far(v).total_cmp(&far(w)))
    };
    let share = |v: u32| (at(v) - at(a[0])).norm() / length(&a).max(1e-9);
    a.iter().filter_map(|v| Some([*v, nearest(share(*v))?])).collect()
}

/// The vertices along a line of a pleat: those of its fold, or of the leg that is sewn.
fn line(mesh: &PieceMesh, pleat: &Dart, side: usize) -> Vec<u32> {
    let end = pleat_ends(&pleat.mouth, &pleat.apexes)[side];
    let fold = end.map(|end| fold_vertices(mesh, &[pleat.mouth[side], end])).unwrap_or_default();
    let leg = pleat.mesh.as_ref().map(|m| m.legs[side].clone()).unwrap_or_default();
    if fold.len() > leg.len() { fold } else { leg }
}
