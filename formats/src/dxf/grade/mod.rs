//! Grading: a size that is not drawn, from the sample size and a rule table.

mod work;

use super::chain::Path;
use super::geom::{self, PointIndex};
use super::outline::{Node, Outline};
use super::piece::DrawnPiece;
use crate::rul::RuleTable;
use toile_garment::Vec2;

/// A rule text stands at its point within this, mm.
pub(super) const AT: f64 = 0.02;
/// A point of layer 2 or 3 classifies a vertex within this, mm.
const AT_VERTEX: f64 = 0.05;

/// Why a piece could not be graded.
#[derive(Clone, Debug, PartialEq)]
pub enum GradeError {
    /// The table does not know the size.
    Size,
    /// The piece names a rule that the table does not have.
    Rule(u32),
    /// The piece has no grade rule on its outline.
    NoRules,
}

/// The growth of one piece for one size.
struct Growth {
    index: PointIndex,
    by_point: Vec<Vec2>,
}

impl Growth {
    fn new(piece: &DrawnPiece, table: &RuleTable, size: usize) -> Result<Self, GradeError> {
        // Growths are in the frame of the grade reference line, whose direction is +x.
        let angle = |line: Option<[Vec2; 2]>| line.map_or(0.0, |[a, b]| libm::atan2(b.y - a.y, b.x - a.x));
        let main = angle(piece.axes.reference);
        let mut index = PointIndex::new(AT, []);
        let mut by_point = Vec::new();
        for mark in &piece.texts.rules {
            let growth = match table.rules.get(&mark.rule) {
                Some(list) => list.get(size).copied().ok_or(GradeError::Size)?,
                None if mark.rule == 0 => Vec2::zeros(),
                None => return Err(GradeError::Rule(mark.rule)),
            };
            let alternate = mark.line.and_then(|n| piece.alternate(n));
            index.insert(mark.at, by_point.len());
            by_point.push(geom::rotate(growth, if alternate.is_some() { angle(alternate) } else { main }));
        }
        Ok(Self { index, by_point })
    }

    fn at(&self, p: Vec2) -> Option<Vec2> {
        self.index.near(p, AT).first().map(|(_, i)| self.by_point[*i])
    }

    /// Growth of each point of a line: as ruled, and between ruled points by arc length. `None` without any rule.
    fn along(&self, points: &[Vec2], closed: bool) -> Option<Vec<Vec2>> {
        let n = points.len();
        let ruled: Vec<(usize, Vec2)> = (0..n).filter_map(|i| self.at(points[i]).map(|g| (i, g))).collect();
        let (first, last) = (*ruled.first()?, *ruled.last()?);
        let mut out = vec![Vec2::zeros(); n];
        let mut spread = |from: (usize, Vec2), steps: usize, to: Vec2| {
            let step = |k: usize| (points[(from.0 + k + 1) % n] - points[(from.0 + k) % n]).norm();
            let whole: f64 = (0..steps).map(step).sum();
            let mut s = 0.0;
            for k in 0..steps {
                let t = if whole > 0.0 { s / whole } else { 0.0 };
                out[(from.0 + k) % n] = from.1 + (to - from.1) * t;
                s += step(k);
            }
        };
        for pair in ruled.windows(2) {
            spread(pair[0], pair[1].0 - pair[0].0, pair[1].1);
        }
        if closed {
            spread(last, first.0 + n - last.0, first.1);
        } else {
            spread(last, n - last.0, last.1);
            out[..first.0].fill(first.1);
        }
        Some(out)
    }
}

/// A line with the growth of each of its points.
struct Moved {
    points: Vec<Vec2>,
    growth: Vec<Vec2>,
}

impl Moved {
    /// Where a point near the line goes: with the nearest place of the line.
    fn carry(&self, p: Vec2) -> Vec2 {
        let Some(foot) = geom::nearest(p, &self.points, true) else { return p };
        let (a, b) = (self.growth[foot.segment], self.growth[(foot.segment + 1) % self.points.len()]);
        p + a + (b - a) * foot.t
    }
}

/// The piece in another size.
///
/// # Errors
/// See [`GradeError`].
pub fn grade(sample: &DrawnPiece, table: &RuleTable, size: &str) -> Result<DrawnPiece, GradeError> {
    let column = table.size_index(size).ok_or(GradeError::Size)?;
    let growth = Growth::new(sample, table, column)?;
    let mut piece = sample.clone();
    let cut = outline(&mut piece.boundary, &growth, None).ok_or(GradeError::NoRules)?;
    let sew = piece.sew.as_mut().and_then(|s| outline(s, &growth, Some(&cut)));
    let sewn = sew.as_ref().unwrap_or(&cut);
    for notch in &mut piece.notches {
        notch.at = if notch.on == "sew" { sewn.carry(notch.at) } else { cut.carry(notch.at) };
    }
    for drill in &mut piece.inside.drills {
        let at = growth.at(drill.at).map_or_else(|| cut.carry(drill.at), |g| drill.at + g);
        drill.at = at;
    }
    let stripes = piece.inside.stripes.iter_mut().map(|s| &mut s.1);
    for path in piece.inside.internal.iter_mut().chain(&mut piece.inside.cutouts).chain(stripes) {
        line(path, &growth, &cut);
    }
    for dart in piece.darts.iter_mut().chain(&mut piece.doubts.undecided) {
        let carry = |p: Vec2| growth.at(p).map_or_else(|| sewn.carry(p), |g| p + g);
        dart.apexes.iter_mut().chain(&mut dart.mouth).for_each(|p| *p = carry(*p));
        dart.legs.iter_mut().chain(&mut dart.work).flatten().for_each(|p| *p = carry(*p));
    }
    // The fold moves with the boundary it lies on; the grain keeps its direction.
    piece.axes.fold = piece.axes.fold.map(|f| f.map(|p| cut.carry(p)));
    // Points that classify vertices go with them.
    let (before, after) = (vertices(sample), vertices(&piece));
    let index = PointIndex::new(AT_VERTEX, before.iter().copied().enumerate().map(|(i, p)| (p, i)));
    let moved = |p: Vec2| match index.near(p, AT_VERTEX).first() {
        Some((_, i)) => p + after[*i] - before[*i],
        None => cut.carry(p),
    };
    let points = &mut piece.points;
    points.turn_list.iter_mut().chain(&mut points.curve_list).for_each(|p| *p = moved(*p));
    piece.size = Some(table.sizes[column].clone());
    Ok(piece)
}

/// All vertices of the lines of a piece that points of layers 2 and 3 classify, in a fixed order.
fn vertices(piece: &DrawnPiece) -> Vec<Vec2> {
    let inside = &piece.inside;
    let paths = inside.internal.iter().chain(&inside.cutouts).chain(inside.stripes.iter().map(|s| &s.1));
    let outlines = std::iter::once(&piece.boundary).chain(&piece.sew);
    outlines.flat_map(Outline::positions).chain(paths.flat_map(Path::positions)).collect()
}

fn outline(o: &mut Outline, growth: &Growth, cut: Option<&Moved>) -> Option<Moved> {
    let points = o.positions();
    let moves = match growth.along(&points, true) {
        Some(moves) => moves,
        None => points.iter().map(|p| cut.map(|c| c.carry(*p) - *p)).collect::<Option<Vec<_>>>()?,
    };
    let moved = Moved { points, growth: moves };
    let work_growth = work::growths(o, &moved.growth);
    let shift = |nodes: &mut Vec<Node>, growth: &[Vec2]| nodes.iter_mut().zip(growth).for_each(|(n, g)| n.at += *g);
    shift(&mut o.drawn, &moved.growth);
    shift(&mut o.work, &work_growth);
    Some(moved)
}

fn line(path: &mut Path, growth: &Growth, cut: &Moved) {
    let points = path.positions();
    let moves = growth.along(&points, path.closed);
    for (i, p) in path.points.iter_mut().enumerate() {
        p.0 = moves.as_ref().map_or_else(|| cut.carry(p.0), |m| p.0 + m[i]);
    }
}
