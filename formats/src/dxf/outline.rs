//! A closed line of a piece: its drawn vertices with their kinds, and the working line through them.

use super::chain::Path;
use super::curve;
use super::cut_notches::{self, CutNotch};
use super::geom::{self, PointIndex};
use super::tolerances::Tolerances;
use std::collections::BTreeSet;
use toile_garment::Vec2;
use toile_garment::outline::PointKind;

/// Points of layers 2 and 3 coincide with vertices within this, mm.
const MATCH: f64 = 0.02;
/// Marked curve points further apart than this are control points of a smooth curve, mm.
pub(crate) const SPARSE: f64 = 3.0;
/// A point on a curve turns less than this, degrees.
const NO_CURVE: f64 = 60.0;
/// A dense copy may differ this much from the smooth curve through the points it copies, mm.
const DENSE_MOST: f64 = 2.0;
/// A corner is found again on the dense copy within this, mm.
const DENSE_MATCH: f64 = 0.1;

/// A vertex of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Position, mm.
    pub at: Vec2,
    /// Corner, curve point or neither.
    pub kind: PointKind,
    /// Does it stand in the file (and not come from a flattened curve)?
    pub drawn: bool,
}

/// How the working line was made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Making {
    /// The drawn vertices themselves.
    AsDrawn,
    /// The dense copy (layers 84, 87); largest deviation in mm.
    Dense(f64),
    /// Curve points joined by a smooth curve; largest deviation from the chords in mm.
    Smoothed(f64),
}

/// A closed outline, counter-clockwise.
#[derive(Clone, Debug)]
pub struct Outline {
    /// Vertices as drawn.
    pub drawn: Vec<Node>,
    /// Vertices to mesh and sew.
    pub work: Vec<Node>,
    /// For each drawn vertex, its place in `work`, if it is there.
    pub place: Vec<Option<usize>>,
    /// Notches cut into the drawn line; `work` runs over them.
    pub cut: Vec<CutNotch>,
    /// How `work` was made.
    pub making: Making,
    /// Line in the file.
    pub line: u64,
    /// Entities it came from.
    pub ids: Vec<u32>,
}

/// Points of layers 2 and 3 of a block, to be found by position.
#[derive(Clone, Debug)]
pub struct Marks {
    turn: PointIndex,
    curve: PointIndex,
    /// Are there any?
    pub any: bool,
    corner: f64,
}

impl Marks {
    /// Index of a block's points.
    #[must_use]
    pub fn new(turn: &[Vec2], curve: &[Vec2], tolerances: &Tolerances) -> Self {
        let index = |list: &[Vec2]| PointIndex::new(MATCH, list.iter().enumerate().map(|(i, p)| (*p, i)));
        Self {
            turn: index(turn),
            curve: index(curve),
            any: !(turn.is_empty() && curve.is_empty()),
            corner: tolerances.corner,
        }
    }

    /// The kind that a point says of the vertex at this place.
    #[must_use]
    pub fn kind(&self, at: Vec2) -> PointKind {
        if self.turn.has(at, MATCH) {
            PointKind::Turn
        } else if self.curve.has(at, MATCH) {
            PointKind::Curve
        } else {
            PointKind::Plain
        }
    }
}

impl Outline {
    /// A chained closed line, turned counter-clockwise. Kinds are not yet set.
    #[must_use]
    pub fn new(path: Path) -> Self {
        let mut drawn: Vec<Node> =
            path.points.iter().map(|(at, drawn)| Node { at: *at, kind: PointKind::Plain, drawn: *drawn }).collect();
        if geom::area(&path.positions()) < 0.0 && drawn.len() > 1 {
            drawn[1..].reverse();
        }
        let place = (0..drawn.len()).map(Some).collect();
        Self {
            work: drawn.clone(),
            drawn,
            place,
            cut: Vec::new(),
            making: Making::AsDrawn,
            line: path.line,
            ids: path.ids,
        }
    }

    /// Positions as drawn.
    #[must_use]
    pub fn positions(&self) -> Vec<Vec2> {
        self.drawn.iter().map(|n| n.at).collect()
    }

    /// Positions of the working line.
    #[must_use]
    pub fn work_positions(&self) -> Vec<Vec2> {
        self.work.iter().map(|n| n.at).collect()
    }

    /// The vertices as drawn, but for notches that are cut into the line.
    #[must_use]
    pub fn without_cut_notches(&self) -> Vec<Node> {
        kept(&self.drawn, &self.cut).into_iter().map(|(_, node)| node).collect()
    }

    /// Sets the kinds from layers 2 and 3, or from the angles where a vertex is not marked.
    pub fn classify(&mut self, marks: &Marks) {
        let n = self.drawn.len();
        let limit = if marks.any { marks.corner + 10.0 } else { marks.corner }.to_radians();
        let kinds: Vec<PointKind> = (0..n)
            .map(|i| {
                let (before, node, after) = (&self.drawn[(i + n - 1) % n], &self.drawn[i], &self.drawn[(i + 1) % n]);
                if !node.drawn {
                    PointKind::Plain
                } else if marks.turn.has(node.at, MATCH) {
                    PointKind::Turn
                } else if marks.curve.has(node.at, MATCH) {
                    PointKind::Curve
                } else if geom::turn(before.at, node.at, after.at).abs() > limit
                    || (!marks.any && before.drawn != after.drawn)
                {
                    PointKind::Turn
                } else {
                    PointKind::Plain
                }
            })
            .collect();
        for (node, kind) in self.drawn.iter_mut().zip(kinds) {
            node.kind = kind;
        }
        self.work.clone_from(&self.drawn);
    }

    /// Takes the kinds of the same line in another size, when both have as many vertices and corners at like places.
    pub fn classify_like(&mut self, other: &Self) -> bool {
        if self.drawn.len() != other.drawn.len() {
            return false;
        }
        let stations = |o: &Self| {
            let p = o.positions();
            let whole = geom::length(&p, true).max(1e-9);
            let mut at = 0.0;
            (0..p.len())
                .map(|i| {
                    let here = at / whole;
                    at += (p[(i + 1) % p.len()] - p[i]).norm();
                    here
                })
                .collect::<Vec<f64>>()
        };
        let alike = stations(self).iter().zip(stations(other)).all(|(a, b)| (a - b).abs() < 0.1);
        if alike {
            for (node, like) in self.drawn.iter_mut().zip(&other.drawn) {
                node.kind = like.kind;
            }
            self.work.clone_from(&self.drawn);
        }
        alike
    }

    /// Makes the working line: the dense copy where there is a good one, else smooth runs, else the drawn line.
    /// The outcome of looking at the dense copy comes back for the report.
    pub fn make_work(&mut self, dense: Option<&Outline>, flatness: f64) -> Option<Result<f64, f64>> {
        self.smooth(flatness);
        let dense = dense.filter(|d| d.drawn.len() > self.drawn.len())?;
        let bare;
        let dense = if self.cut.is_empty() {
            dense
        } else {
            // The dense copy holds the same notches.
            let mut copy = dense.clone();
            copy.drawn = kept(&copy.drawn, &cut_notches::find(&copy.drawn)).into_iter().map(|(_, node)| node).collect();
            bare = copy;
            &bare
        };
        Some(self.take_dense(dense))
    }

    /// Finds the notches cut into the drawn line, to be left out of the working line.
    pub fn find_cut_notches(&mut self) {
        self.cut = cut_notches::find(&self.drawn);
    }

    /// Adds the notches cut into this line where another size of the piece, with as many vertices, has one.
    pub fn add_cut_notches(&mut self, known: &BTreeSet<(usize, usize)>) {
        let (inner, _) = cut_notches::covered(self.drawn.len(), &self.cut);
        let new = known.iter().filter(|(from, to)| !inner[*from] && !inner[*to]);
        let new = new.filter(|(from, to)| !self.cut.iter().any(|c| (c.from, c.to) == (*from, *to)));
        let new: Vec<CutNotch> = new.filter_map(|(from, to)| cut_notches::again(&self.drawn, *from, *to)).collect();
        self.cut.extend(new);
        self.cut.sort_by_key(|c| c.from);
    }

    fn take_dense(&mut self, dense: &Outline) -> Result<f64, f64> {
        let (ours, theirs) = (self.positions(), dense.positions());
        let smooth = self.work_positions();
        let deviation = geom::deviation(&theirs, &smooth, true).max(geom::deviation(&smooth, &theirs, true));
        if deviation > DENSE_MOST {
            return Err(deviation);
        }
        let (inner, mouth) = cut_notches::covered(self.drawn.len(), &self.cut);
        let corners: Vec<usize> = (0..self.drawn.len())
            .filter(|i| self.drawn[*i].kind == PointKind::Turn && !inner[*i] && !mouth[*i])
            .collect();
        let Some(found) = match_corners(&corners.iter().map(|i| ours[*i]).collect::<Vec<_>>(), &theirs) else {
            return Err(deviation);
        };
        let first = found.first().copied().unwrap_or(0);
        let n = theirs.len();
        let curve: Vec<_> = self.drawn.iter().filter(|p| p.kind == PointKind::Curve).map(|p| (p.at, 0)).collect();
        let curve = PointIndex::new(MATCH, curve);
        let kind = |at| if curve.has(at, MATCH) { PointKind::Curve } else { PointKind::Plain };
        self.work = (0..n).map(|k| dense.drawn[(first + k) % n]).map(|p| Node { kind: kind(p.at), ..p }).collect();
        self.place = vec![None; self.drawn.len()];
        for (corner, at) in corners.iter().zip(&found) {
            let k = (at + n - first) % n;
            self.work[k] = Node { drawn: true, ..self.drawn[*corner] };
            self.place[*corner] = Some(k);
        }
        self.making = Making::Dense(deviation);
        Ok(deviation)
    }

    fn smooth(&mut self, flatness: f64) {
        let nodes = kept(&self.drawn, &self.cut);
        let n = nodes.len();
        let first = (0..n).find(|i| nodes[*i].1.kind == PointKind::Turn).unwrap_or(0);
        let (mut work, mut place) = (Vec::with_capacity(n), vec![None; self.drawn.len()]);
        let mut deviation = 0.0_f64;
        let mut k = 0;
        while k < n {
            let run_end = (k + 1..n).find(|j| nodes[(first + j) % n].1.kind == PointKind::Turn).unwrap_or(n);
            let run: Vec<Node> = (k..=run_end).map(|j| nodes[(first + j) % n].1).collect();
            for (j, between) in between(&run, flatness).into_iter().enumerate() {
                place[nodes[(first + k + j) % n].0] = Some(work.len());
                work.push(run[j]);
                for p in between {
                    deviation = deviation.max(geom::point_segment(p, run[j].at, run[j + 1].at).0);
                    work.push(Node { at: p, kind: PointKind::Plain, drawn: false });
                }
            }
            k = run_end;
        }
        self.making = if work.len() > n { Making::Smoothed(deviation) } else { Making::AsDrawn };
        self.work = work;
        self.place = place;
    }

    /// Goes back to the drawn line.
    pub fn as_drawn(&mut self) {
        self.work.clone_from(&self.drawn);
        self.place = (0..self.drawn.len()).map(Some).collect();
        self.making = Making::AsDrawn;
    }

    /// Curve points that turn as no curve does become corners.
    pub fn sharpen(&mut self) {
        let n = self.drawn.len();
        let at: Vec<Vec2> = self.positions();
        for (i, node) in self.drawn.iter_mut().enumerate().filter(|(_, node)| node.kind == PointKind::Curve) {
            if geom::turn(at[(i + n - 1) % n], at[i], at[(i + 1) % n]).to_degrees().abs() > NO_CURVE {
                node.kind = PointKind::Turn;
            }
        }
    }

    /// Puts a vertex into the working line near `p` unless one is there; gives its position.
    pub fn insert_work(&mut self, p: Vec2) -> Vec2 {
        let line = self.work_positions();
        let Some(foot) = geom::nearest(p, &line, true) else { return p };
        let n = line.len();
        for end in [foot.segment, (foot.segment + 1) % n] {
            if (line[end] - p).norm() < 0.05 {
                return line[end];
            }
        }
        let at = if foot.distance < 0.01 { p } else { foot.on(&line) };
        self.work.insert(foot.segment + 1, Node { at, kind: PointKind::Plain, drawn: false });
        for place in self.place.iter_mut().flatten() {
            *place += usize::from(*place > foot.segment);
        }
        at
    }
}

/// For each chord of a run from corner to corner, the points of the smooth curve between its ends.
pub(crate) fn between(run: &[Node], flatness: f64) -> Vec<Vec<Vec2>> {
    let points: Vec<Vec2> = run.iter().map(|r| r.at).collect();
    let inner = run.get(1..run.len().saturating_sub(1)).unwrap_or_default();
    if !inner.iter().any(|r| r.kind == PointKind::Curve) {
        return vec![Vec::new(); run.len().saturating_sub(1)];
    }
    let mut chords = curve::smooth(&points, flatness);
    for (j, chord) in chords.iter_mut().enumerate() {
        let sparse = (points[j + 1] - points[j]).norm() > SPARSE;
        let smooth = [run[j], run[j + 1]].iter().all(|r| r.kind != PointKind::Plain && r.drawn);
        if !(sparse && smooth) {
            chord.clear();
        }
    }
    chords
}

/// The vertices of a line without its cut notches, with their places in it; mouth points are no corners.
fn kept(drawn: &[Node], cut: &[CutNotch]) -> Vec<(usize, Node)> {
    let (inner, mouth) = cut_notches::covered(drawn.len(), cut);
    let plain = |i: usize, node: &Node| if mouth[i] { Node { kind: PointKind::Plain, ..*node } } else { *node };
    drawn.iter().enumerate().filter(|(i, _)| !inner[*i]).map(|(i, node)| (i, plain(i, node))).collect()
}

/// Finds the corners one after the other on the dense line, which may pass a place twice.
fn match_corners(corners: &[Vec2], dense: &[Vec2]) -> Option<Vec<usize>> {
    let Some(first) = corners.first() else { return Some(Vec::new()) };
    let n = dense.len();
    let starts = (0..n).filter(|i| (dense[*i] - first).norm() <= DENSE_MATCH).take(8);
    for start in starts {
        let mut found = vec![start];
        let mut k = 0;
        for corner in &corners[1..] {
            let off = |j: usize| (dense[(start + j) % n] - corner).norm();
            let Some(mut next) = (k + 1..n).find(|j| off(*j) <= DENSE_MATCH) else {
                break;
            };
            // A vertex nearer to the corner may follow at once.
            while next + 1 < n && off(next + 1) < off(next) {
                next += 1;
            }
            k = next;
            found.push((start + k) % n);
        }
        if found.len() == corners.len() {
            return Some(found);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLATNESS: f64 = 0.05;

    fn outline(points: &[(f64, f64)]) -> Outline {
        let points = points.iter().map(|(x, y)| (Vec2::new(*x, *y), true)).collect();
        Outline::new(Path { ids: vec![0], line: 1, points, closed: true })
    }

    #[test]
    fn kinds_from_layers_and_from_angles() {
        let mut o = outline(&[(0.0, 0.0), (50.0, 1.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)]);
        o.classify(&Marks::new(&[], &[], &Tolerances::default()));
        let turns = o.drawn.iter().filter(|n| n.kind == PointKind::Turn).count();
        assert_eq!(turns, 4);
        o.classify(&Marks::new(&[Vec2::new(0.0, 0.005)], &[Vec2::new(50.0, 1.0)], &Tolerances::default()));
        assert_eq!(o.drawn[0].kind, PointKind::Turn);
        assert_eq!(o.drawn[1].kind, PointKind::Curve);
    }

    #[test]
    fn sparse_circle_becomes_round() {
        // A quarter disc with seven curve points on its arc of 100 mm.
        let mut points = vec![(0.0, 0.0)];
        let arc: Vec<(f64, f64)> = (0..=8)
            .map(|i| f64::from(i) * 11.25_f64.to_radians())
            .map(|a| (100.0 * libm::cos(a), 100.0 * libm::sin(a)))
            .collect();
        points.extend(&arc);
        let mut o = outline(&points);
        let v = |p: &(f64, f64)| Vec2::new(p.0, p.1);
        o.classify(&Marks::new(
            &[v(&points[0]), v(&arc[0]), v(&arc[8])],
            &arc[1..8].iter().map(v).collect::<Vec<_>>(),
            &Tolerances::default(),
        ));
        assert_eq!(o.make_work(None, FLATNESS), None);
        let exact = std::f64::consts::PI * 2500.0;
        let (rough, smooth) = (geom::area(&o.positions()), geom::area(&o.work_positions()));
        assert!((rough - exact).abs() / exact > 5e-3);
        // A chord FLATNESS inside an arc of 100 mm loses at most 2·FLATNESS/100 of the area.
        assert!((smooth - exact).abs() / exact < 2.0 * FLATNESS / 100.0, "{smooth} against {exact}");
        assert!(matches!(o.making, Making::Smoothed(_)));
    }

    #[test]
    fn dense_copy_is_taken_when_it_agrees() {
        let mut o = outline(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)]);
        o.classify(&Marks::new(&[], &[], &Tolerances::default()));
        let dense = outline(&[(100.0, 0.0), (100.7, 50.0), (100.0, 100.0), (0.0, 100.0), (0.0, 0.0), (50.0, 0.0)]);
        assert!(o.make_work(Some(&dense), FLATNESS).is_some_and(|v| v.is_ok()));
        assert_eq!(o.work.len(), 6);
        assert_eq!(o.work[o.place[1].expect("corner")].at, Vec2::new(100.0, 0.0));
        let far = outline(&[(100.0, 0.0), (113.0, 50.0), (100.0, 100.0), (0.0, 100.0), (0.0, 0.0)]);
        let mut o = outline(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)]);
        o.classify(&Marks::new(&[], &[], &Tolerances::default()));
        assert!(o.make_work(Some(&far), FLATNESS).is_some_and(|v| v.is_err()));
        assert_eq!(o.making, Making::AsDrawn);
    }
}
