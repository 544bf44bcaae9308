//! Where the vertices of a line go from size to size.

use crate::dxf::outline::{Node, Outline};
use crate::dxf::piece::DrawnPiece;
use crate::dxf::unfold::Fold;
use toile_garment::Vec2;
use toile_garment::outline::{LinePoint, PieceLine, PointKind};

/// Millimetres in a metre.
const MM: f64 = 1e3;
/// Most corners that are tried for a corner in another size, the nearest first.
const NEAR: usize = 16;

/// A vertex in the sample size and in every size, mm.
pub struct Grown {
    pub at: Vec2,
    pub kind: PointKind,
    pub by_size: Vec<Vec2>,
}

/// The vertices of a line, unfolded.
fn nodes(piece: &DrawnPiece, outline: &Outline) -> Vec<Node> {
    piece.axes.fold.and_then(|f| Fold(f).outline(&outline.drawn)).unwrap_or_else(|| outline.drawn.clone())
}

/// The vertices of a line that stand in the file. `None` when a size has other vertices.
pub fn drawn_line(
    sample: &DrawnPiece,
    sizes: &[&DrawnPiece],
    line: impl Fn(&DrawnPiece) -> Option<&Outline>,
) -> Option<Vec<Grown>> {
    let own = nodes(sample, line(sample)?);
    let others: Vec<Vec<Node>> = sizes.iter().map(|p| line(p).map(|l| nodes(p, l))).collect::<Option<_>>()?;
    if others.iter().any(|o| o.len() != own.len()) {
        return None;
    }
    let grown = |(i, node): (usize, &Node)| Grown {
        at: node.at,
        kind: node.kind,
        by_size: others.iter().map(|o| o[i].at).collect(),
    };
    Some(own.iter().enumerate().filter(|(_, n)| n.drawn).map(grown).collect())
}

/// The vertices of a cut line made from the sew lines: all, where every size has as many of the same kinds, else the
/// corners. `None` when a size has other corners. Such lines begin anywhere.
pub fn made_line(sample: &PieceLine, sizes: &[&PieceLine]) -> Option<Vec<Grown>> {
    let corners = |l: &PieceLine| l.points.iter().filter(|p| p.kind == PointKind::Turn).cloned().collect::<Vec<_>>();
    let own = corners(sample);
    let turned: Vec<Vec<LinePoint>> =
        sizes.iter().map(|l| begun_like(&own, &corners(l), l.points.clone())).collect::<Option<_>>()?;
    let all = begun_like(&own, &own, sample.points.clone())?;
    let kinds = |list: &[LinePoint]| list.iter().map(|p| p.kind).collect::<Vec<_>>();
    let same = turned.iter().all(|t| kinds(t) == kinds(&all));
    let wanted =
        |list: Vec<LinePoint>| list.into_iter().filter(|p| same || p.kind == PointKind::Turn).collect::<Vec<_>>();
    let (all, turned) = (wanted(all), turned.into_iter().map(wanted).collect::<Vec<_>>());
    let grown = |(i, p): (usize, &LinePoint)| Grown {
        at: p.at * MM,
        kind: p.kind,
        by_size: turned.iter().map(|t| t[i].at * MM).collect(),
    };
    Some(all.iter().enumerate().map(grown).collect())
}

/// The line turned to begin at the corner that answers to the first of `own`: corners lie nearest to each other then.
pub(crate) fn begun_like(own: &[LinePoint], corners: &[LinePoint], mut line: Vec<LinePoint>) -> Option<Vec<LinePoint>> {
    let n = corners.len();
    if n != own.len() || n == 0 {
        return None;
    }
    let mut turns: Vec<usize> = (0..n).collect();
    turns.sort_by(|a, b| (corners[*a].at - own[0].at).norm().total_cmp(&(corners[*b].at - own[0].at).norm()));
    let apart = |turn: usize| (0..n).map(|i| (corners[(i + turn) % n].at - own[i].at).norm_squared()).sum::<f64>();
    let near = turns.into_iter().take(NEAR).map(|t| (apart(t), t));
    let (_, turn) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let first = line.iter().position(|p| *p == corners[turn])?;
    line.rotate_left(first);
    Some(line)
}
