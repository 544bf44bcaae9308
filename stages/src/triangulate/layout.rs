//! The vertices and edges that the lines of one piece become.

use super::counts::Counts;
use super::crossing::Segment;
use super::curve::{Curve, CurveKind};
use super::lyon::places_along;
use crate::sewing::ring::{SAME, snap};
use std::collections::BTreeMap;
use toile_garment::Vec2;

/// Fixed vertices of a piece.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// Positions.
    pub points: Vec<Vec2>,
    /// Per curve: vertex ids in order (a closed curve does not repeat its first).
    pub chains: Vec<Vec<u32>>,
    /// Per curve and edge: the stretch it came from.
    pub stretch: Vec<Vec<usize>>,
    /// Per curve, per break: its vertex.
    pub at_break: Vec<Vec<u32>>,
    /// Curves, as kinds and closed flags.
    pub kinds: Vec<(CurveKind, bool)>,
}

/// Vertices by place; places nearer than a thousandth of a millimetre are one.
#[derive(Default)]
struct Table {
    points: Vec<Vec2>,
    cells: BTreeMap<(i64, i64), Vec<u32>>,
}

impl Table {
    fn vertex(&mut self, p: Vec2) -> u32 {
        let p = snap(p);
        let cell = |x: f64| (x / (2.0 * SAME)).floor() as i64;
        let (cx, cy) = (cell(p.x), cell(p.y));
        for x in cx - 1..=cx + 1 {
            for y in cy - 1..=cy + 1 {
                let near = self.cells.get(&(x, y)).into_iter().flatten();
                if let Some(v) = near.copied().find(|v| (self.points[*v as usize] - p).norm() < SAME) {
                    return v;
                }
            }
        }
        let v = self.points.len() as u32;
        self.points.push(p);
        self.cells.entry((cx, cy)).or_default().push(v);
        v
    }
}

/// Samples the curves of a piece by arc length.
pub fn layout(piece: usize, curves: &[Curve], counts: &Counts) -> Layout {
    let mut table = Table::default();
    let mut out = Layout::default();
    for (k, c) in curves.iter().enumerate() {
        let (mut chain, mut stretch, mut at_break) = (Vec::new(), Vec::new(), Vec::new());
        for s in 0..c.stretches() {
            let (from, length) = c.stretch(s);
            let places = places_along(&c.between(from, from + length), &counts.cuts((piece, k), s));
            for (j, place) in places.into_iter().enumerate() {
                let v = table.vertex(place);
                if j == 0 {
                    at_break.push(v);
                }
                if chain.last() != Some(&v) {
                    chain.push(v);
                    stretch.push(s);
                }
            }
        }
        if !c.closed {
            let v = table.vertex(c.at(c.total()));
            at_break.push(v);
            chain.push(v);
        }
        out.chains.push(chain);
        out.stretch.push(stretch);
        out.at_break.push(at_break);
        out.kinds.push((c.kind, c.closed));
    }
    out.points = table.points;
    out
}

impl Layout {
    /// Edges of a curve, in chain order.
    pub fn edges(&self, curve: usize) -> impl Iterator<Item = [u32; 2]> + '_ {
        let chain = &self.chains[curve];
        let n = chain.len();
        let count = if self.kinds[curve].1 { n } else { n.saturating_sub(1) };
        (0..count).map(move |i| [chain[i], chain[(i + 1) % n]])
    }

    /// All edges once, lower vertex first, with curve and number within it; repeated edges are listed apart.
    pub fn all_edges(&self) -> (Vec<[u32; 2]>, Vec<(usize, usize)>) {
        let mut seen: BTreeMap<[u32; 2], (usize, usize)> = BTreeMap::new();
        let mut repeated = Vec::new();
        for k in 0..self.chains.len() {
            for (i, [a, b]) in self.edges(k).enumerate() {
                let edge = [a.min(b), a.max(b)];
                if a == b {
                    repeated.push((k, i));
                } else if let Some(first) = seen.get(&edge) {
                    repeated.extend([*first, (k, i)]);
                } else {
                    seen.insert(edge, (k, i));
                }
            }
        }
        (seen.into_keys().collect(), repeated)
    }

    /// Directed boundary edges with the cloth on their left.
    pub fn boundary(&self) -> Vec<[u32; 2]> {
        let mut out = Vec::new();
        for (k, (kind, _)) in self.kinds.iter().enumerate().filter(|(_, (kind, _))| kind.bounds_cloth()) {
            let forward = (super::lines::signed_area(&self.places(k)) > 0.0) == (*kind == CurveKind::Outline);
            out.extend(self.edges(k).map(|[a, b]| if forward { [a, b] } else { [b, a] }));
        }
        out
    }

    /// Rings that bound the cloth.
    pub fn rings(&self) -> Vec<Vec<Vec2>> {
        let bounds = |k: &usize| self.kinds[*k].0.bounds_cloth();
        (0..self.chains.len()).filter(bounds).map(|k| self.places(k)).collect()
    }

    /// Positions of the vertices of a curve.
    fn places(&self, curve: usize) -> Vec<Vec2> {
        self.chains[curve].iter().map(|v| self.points[*v as usize]).collect()
    }

    /// Segments of the curves that `wanted` asks for.
    pub fn segments(&self, wanted: impl Fn(CurveKind) -> bool) -> Vec<Segment> {
        let mut out = Vec::new();
        for k in (0..self.chains.len()).filter(|k| wanted(self.kinds[*k].0)) {
            for (index, [a, b]) in self.edges(k).enumerate() {
                out.push(Segment { a: self.points[a as usize], b: self.points[b as usize], curve: k, index });
            }
        }
        out
    }

    /// Area of the sampled cloth, square metres.
    pub fn area(&self) -> f64 {
        let area = |k: usize| super::lines::signed_area(&self.places(k)).abs();
        let bounds = |k: &usize| self.kinds[*k].0.bounds_cloth();
        (0..self.chains.len())
            .filter(bounds)
            .map(|k| if self.kinds[k].0 == CurveKind::Outline { area(k) } else { -area(k) })
            .sum()
    }
}
