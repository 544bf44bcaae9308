//! Copies of drawn pieces, plain or mirrored.

use super::number;
use crate::sewing::codes;
use crate::sewing::lookup;
use toile_garment::outline::{OutlineEdge, PieceLine};
use toile_garment::piece::Quantity;
use toile_garment::sewing::{CopySpec, DartSpec, EdgeNameSpec, FoldSpec, RunSpec, RunWay, SewingPlan};
use toile_garment::{Diagnostic, Garment, Piece, Vec2};

/// Adds the copies of the plan at the end of the list.
pub fn copy(garment: &mut Garment, errors: &mut Vec<Diagnostic>) {
    for spec in garment.plan.copies.clone() {
        match one(garment, &spec) {
            Ok((piece, names)) => {
                garment.pieces.push(piece);
                garment.plan.edge_names.extend(names);
                number(garment);
            }
            Err(e) => errors.push(e),
        }
    }
}

fn one(garment: &Garment, spec: &CopySpec) -> Result<(Piece, Vec<EdgeNameSpec>), Diagnostic> {
    let source = &garment.pieces[lookup::piece(garment, &spec.piece, spec.source.as_ref())?.index()];
    if garment.pieces.iter().any(|p| p.name.eq_ignore_ascii_case(&spec.name)) {
        return Err(Diagnostic::error(codes::PIECE_NAME_TAKEN, format!("there is a piece `{}` already", spec.name))
            .at(spec.source.clone())
            .hint("give the copy another name"));
    }
    let mut piece = source.clone();
    if spec.mirror {
        mirror(&mut piece);
    }
    piece.name.clone_from(&spec.name);
    piece.quantity = Quantity::default();
    let names = garment.plan.edge_names.iter().filter_map(|n| inherited(n, source, spec)).collect();
    Ok((piece, names))
}

/// A name for a part of an edge, or for a run between two points, on the copy. Names of whole edges go with the edges.
fn inherited(name: &EdgeNameSpec, source: &Piece, spec: &CopySpec) -> Option<EdgeNameSpec> {
    if !name.run.piece().eq_ignore_ascii_case(&source.name) {
        return None;
    }
    let piece = spec.name.clone();
    let run = match &name.run {
        RunSpec::Edge { .. } => return None,
        RunSpec::Part { edge, from, to, .. } if spec.mirror => {
            RunSpec::Part { piece, edge: mirrored_label(edge, source), from: from.mirrored(), to: to.mirrored() }
        }
        RunSpec::Points { from, to, way, .. } if spec.mirror => {
            let way = match way {
                RunWay::Left => RunWay::Right,
                RunWay::Right => RunWay::Left,
                same => *same,
            };
            RunSpec::Points { piece, from: flip(*from), to: flip(*to), way }
        }
        RunSpec::Line { line, .. } if spec.mirror => {
            RunSpec::Line { piece, line: line.iter().map(|p| flip(*p)).collect() }
        }
        same => {
            let mut run = same.clone();
            *run.piece_mut() = piece;
            run
        }
    };
    Some(EdgeNameSpec { run, name: name.name.clone(), source: name.source.clone() })
}

/// The darts that a plan declares, and those that copies of pieces have by it.
pub fn darts(plan: &SewingPlan) -> Vec<DartSpec> {
    let copied = |dart: &DartSpec, copy: &CopySpec| {
        let mut dart = dart.clone();
        dart.piece.clone_from(&copy.name);
        if copy.mirror {
            dart.apexes.iter_mut().chain(&mut dart.mouth).for_each(|p| *p = flip(*p));
        }
        dart
    };
    with_copies(plan, &plan.darts, |dart| &dart.piece, copied)
}

/// The folds that a plan declares, and those that copies of pieces have by it.
pub fn folds(plan: &SewingPlan) -> Vec<FoldSpec> {
    let copied = |fold: &FoldSpec, copy: &CopySpec| {
        let mut fold = FoldSpec { piece: copy.name.clone(), ..fold.clone() };
        if copy.mirror {
            fold.line.iter_mut().for_each(|p| *p = flip(*p));
        }
        fold
    };
    with_copies(plan, &plan.folds, |fold| &fold.piece, copied)
}

/// What is said of drawn pieces, then what copies inherit from it in their order, then what is said of copies.
fn with_copies<T: Clone>(
    plan: &SewingPlan,
    said: &[T],
    piece: impl Fn(&T) -> &str,
    copied: impl Fn(&T, &CopySpec) -> T,
) -> Vec<T> {
    let is_copy = |t: &&T| plan.copies.iter().any(|c| c.name.eq_ignore_ascii_case(piece(t)));
    let mut out: Vec<T> = said.iter().filter(|t| !is_copy(t)).cloned().collect();
    for copy in &plan.copies {
        let of_source = |t: &&T| piece(t).eq_ignore_ascii_case(&copy.piece);
        let inherited: Vec<T> = out.iter().filter(of_source).map(|t| copied(t, copy)).collect();
        out.extend(inherited);
    }
    out.extend(said.iter().filter(is_copy).cloned());
    out
}

/// The label of an edge on the mirrored piece, whose numbers run the other way. Names stay.
fn mirrored_label(edge: &str, source: &Piece) -> String {
    let number = edge.parse::<usize>().ok().and_then(|k| source.edges.len().checked_sub(1 + k));
    number.map_or_else(|| edge.to_owned(), |k| k.to_string())
}

fn flip(p: Vec2) -> Vec2 {
    Vec2::new(-p.x, p.y)
}

/// Mirrors a piece, x to −x. The outline is counter-clockwise again, its first vertex stays first, and edge k becomes
/// edge n − 1 − k: the numbers run round the same way as on every piece.
pub fn mirror(piece: &mut Piece) {
    let n = piece.outline.points.len();
    line(&mut piece.outline, true);
    mirror_edges(&mut piece.edges, n);
    if let Some(cut) = &mut piece.cut_line {
        line(cut, true);
    }
    for cutout in &mut piece.cutouts {
        line(cutout, true);
    }
    for internal in &mut piece.internal_lines {
        line(internal, false);
    }
    for notch in &mut piece.notches {
        notch.at = flip(notch.at);
        notch.angle = notch.angle.map(|a| std::f64::consts::PI - a);
    }
    for hole in &mut piece.drill_holes {
        hole.at = flip(hole.at);
    }
    for text in &mut piece.texts {
        text.at = flip(text.at);
    }
    for axis in [&mut piece.grain, &mut piece.fold].into_iter().flatten() {
        *axis = axis.map(flip);
    }
    for dart in &mut piece.darts {
        let flipped = |points: &[Vec2]| points.iter().map(|p| flip(*p)).collect::<Vec<_>>();
        dart.apexes = flipped(&dart.apexes);
        // What was met second is met first now.
        dart.mouth = [flip(dart.mouth[1]), flip(dart.mouth[0])];
        dart.legs = [flipped(&dart.legs[1]), flipped(&dart.legs[0])];
    }
    for fold in &mut piece.folds {
        fold.line.iter_mut().for_each(|p| *p = flip(*p));
    }
    piece.mesh = None;
    piece.mirrored = !piece.mirrored;
}

fn line(line: &mut PieceLine, turn: bool) {
    for p in &mut line.points {
        p.at = flip(p.at);
    }
    if turn && line.closed && !line.points.is_empty() {
        line.points[1..].reverse();
    }
}

fn mirror_edges(edges: &mut [OutlineEdge], n: usize) {
    let count = edges.len();
    let image = |v: u32| if v == 0 || v as usize >= n { v } else { (n - v as usize) as u32 };
    for edge in edges.iter_mut() {
        (edge.from, edge.to) = (image(edge.to), image(edge.from));
    }
    edges.reverse();
    for (k, edge) in edges.iter_mut().enumerate().take(count) {
        edge.index = k as u32;
    }
}
