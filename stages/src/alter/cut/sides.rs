//! The cloth on both sides of a line that runs from place to place of an outline.

use super::line::Drawn;
use crate::alter::contour::{Contour, Vertex};
use toile_garment::Vec2;
use toile_garment::outline::PointKind;

/// A part of the line between two vertices of the outline. It holds the fish-eye darts that it crosses.
pub struct Path {
    /// Vertex where it begins.
    pub from: usize,
    /// Vertex where it ends.
    pub to: usize,
    /// What lies between them, as the cloth left and right of the line has it, in the direction of the line.
    sides: [Vec<Vertex>; 2],
    /// Numbers of its stretches of the line.
    pub stretches: Vec<usize>,
}

/// A region of the flat piece beside the line.
pub struct Beside {
    /// Numbers of the paths that it lies at, ascending.
    pub paths: Vec<usize>,
    /// Its outline.
    pub contour: Contour,
}

/// The paths of a line from one vertex to another. `at_leg` has the vertices where it crosses the legs of every dart
/// that begins at the outline.
pub fn paths(drawn: &Drawn<'_>, [from, to]: [usize; 2], at_leg: &[Option<[usize; 2]>]) -> Vec<Path> {
    let begin = |from: usize| Path { from, to, sides: Default::default(), stretches: Vec::new() };
    let mut out: Vec<Path> = Vec::new();
    let mut path = begin(from);
    for (k, stretch) in drawn.stretches.iter().enumerate() {
        let inner = stretch.iter().skip(1).take(stretch.len().saturating_sub(2));
        let inner: Vec<Vertex> = inner.map(|p| Vertex::new(*p, PointKind::Plain)).collect();
        path.sides.iter_mut().for_each(|side| side.extend(inner.iter().copied()));
        path.stretches.push(k);
        let Some(crossing) = drawn.crossings.get(k) else { continue };
        match at_leg.get(k).copied().flatten() {
            Some([leaves, goes_on]) => {
                path.to = leaves;
                out.push(std::mem::replace(&mut path, begin(goes_on)));
            }
            None => {
                for (side, vertices) in path.sides.iter_mut().enumerate() {
                    vertices.extend(around_point(&crossing.tip(side)));
                }
            }
        }
    }
    out.push(path);
    out
}

/// The legs around the point of a dart as vertices: its ends and its middle are corners.
fn around_point([down, up]: &[Vec<Vec2>; 2]) -> Vec<Vertex> {
    let corner = |k: usize, n: usize| if k == 0 || k + 1 == n { PointKind::Turn } else { PointKind::Plain };
    let leg = |leg: &[Vec2]| -> Vec<Vertex> {
        leg.iter().enumerate().map(|(k, p)| Vertex::new(*p, corner(k, leg.len()))).collect()
    };
    let mut out = leg(down);
    out.extend(leg(up).into_iter().rev().skip(1));
    out
}

/// The regions left (0) or right (1) of the line. `None` where paths cross each other.
pub fn beside(contour: &Contour, paths: &[Path], side: usize) -> Option<Vec<Beside>> {
    let [leaves, enters]: [Vec<usize>; 2] = [1 - side, side].map(|end| {
        // Left of the line a walk around the cloth goes along a path and leaves it at its end.
        paths.iter().map(|p| if end == 1 { p.to } else { p.from }).collect()
    });
    let n = contour.vertices.len();
    let next = |from: usize| {
        let ahead = |v: usize| (v + n - from) % n;
        let nearest = (0..paths.len()).min_by_key(|i| ahead(enters[*i]))?;
        let way = ahead(enters[nearest]);
        let is_free = way > 0 && leaves.iter().all(|v| *v == from || ahead(*v) > way);
        is_free.then_some(nearest)
    };
    let mut is_done = vec![false; paths.len()];
    let mut out: Vec<Beside> = Vec::new();
    for first in 0..paths.len() {
        if is_done[first] {
            continue;
        }
        let mut region = Beside { paths: Vec::new(), contour: Contour::default() };
        let mut at = first;
        loop {
            let to = next(leaves[at])?;
            let vertices = &mut region.contour.vertices;
            vertices.extend(contour.chain(leaves[at], enters[to]));
            match side {
                0 => vertices.extend(paths[to].sides[0].iter().copied()),
                _ => vertices.extend(paths[to].sides[1].iter().rev().copied()),
            }
            if std::mem::replace(&mut is_done[to], true) {
                return None;
            }
            region.paths.push(to);
            at = to;
            if at == first {
                break;
            }
        }
        region.paths.sort_unstable();
        out.push(region);
    }
    Some(out)
}
