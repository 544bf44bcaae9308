//! From sewn atoms to seams: stitches that continue each other become one seam, sides are runs along the outlines.

use super::atoms::Layout;
use super::confidence::Margin;
use super::edge_parts::{EdgePart, edge_parts};
use super::openings::Closing;
use super::tuning;
use crate::sewing::shapes::Shapes;
use toile_garment::{Garment, Vec2};

/// A stretch of the outline of one piece, walked in sewing order.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Index of the piece in the garment.
    pub piece: usize,
    /// Start and end, in sewing order, metres in the plane of the piece.
    pub ends: [Vec2; 2],
    /// True where it is walked counter-clockwise.
    pub forward: bool,
    /// Points in sewing order.
    pub points: Vec<Vec2>,
    /// The edges that it covers, in sewing order; empty where they cannot be named.
    pub edges: Vec<EdgePart>,
}

/// A proposed seam.
#[derive(Clone, Debug, PartialEq)]
pub struct ProposedSeam {
    /// Name.
    pub name: String,
    /// Runs of side a.
    pub a: Vec<Run>,
    /// Runs of side b, in the order in which they meet side a.
    pub b: Vec<Run>,
    /// Does one piece lie turned over on the other?
    pub fold_over: bool,
    /// Length of side a, metres.
    pub length_a: f64,
    /// Length of side b, metres.
    pub length_b: f64,
    /// Likelihood that it is right, 0 to 1.
    pub confidence: f64,
    /// The atoms of both sides, in sewing order.
    pub atoms: Vec<[usize; 2]>,
    /// Atoms that the edges may be sewn to instead.
    pub instead: Vec<usize>,
}

impl ProposedSeam {
    /// Length of side a minus length of side b, metres.
    pub fn ease(&self) -> f64 {
        self.length_a - self.length_b
    }

    /// Lays one piece turned over on the other: the starts of both sides meet.
    pub fn turn_over(&mut self) {
        self.b.reverse();
        for run in &mut self.b {
            run.ends.reverse();
            run.points.reverse();
            run.forward = !run.forward;
            run.edges.reverse();
        }
        self.fold_over = true;
    }
}

/// One sewn pair, side a walked forward.
#[derive(Clone, Debug)]
struct Stitch {
    a: usize,
    b: usize,
    opposite: bool,
    confidence: f64,
    instead: [Option<usize>; 2],
}

/// Joins pairs to seams and finds their runs.
pub fn seams(garment: &Garment, shapes: &Shapes, layout: &Layout, margins: &[Margin]) -> Vec<ProposedSeam> {
    let mut left: Vec<Stitch> = margins
        .iter()
        .map(|m| Stitch {
            a: m.pair.a,
            b: m.pair.b,
            opposite: m.pair.opposite,
            confidence: tuning::confidence(m.margin).min(m.most),
            instead: m.instead,
        })
        .collect();
    let mut out = Vec::new();
    while !left.is_empty() {
        let mut chain = vec![left.remove(0)];
        while let Some(k) = left.iter().position(|s| follows(layout, &chain[chain.len() - 1], s)) {
            chain.push(left.remove(k));
        }
        while let Some(k) = left.iter().position(|s| follows(layout, s, &chain[0])) {
            chain.insert(0, left.remove(k));
        }
        out.push(seam(garment, shapes, layout, &chain));
    }
    out
}

/// Does one stitch go on where the other one ends, as surely and with the same ease?
fn follows(layout: &Layout, before: &Stitch, after: &Stitch) -> bool {
    let b = if before.opposite { layout.atoms[before.b].before } else { layout.atoms[before.b].next };
    let ratio = |s: &Stitch| libm::log(layout.atoms[s.a].length / layout.atoms[s.b].length);
    before.opposite == after.opposite
        && layout.atoms[before.a].next == after.a
        && b == after.b
        && layout.atoms[before.b].panel != layout.atoms[before.a].panel
        && (ratio(before) - ratio(after)).abs() < tuning::SAME_EASE
        && (before.confidence - after.confidence).abs() < tuning::AS_SURE
}

fn seam(garment: &Garment, shapes: &Shapes, layout: &Layout, chain: &[Stitch]) -> ProposedSeam {
    let opposite = chain[0].opposite;
    let a = runs(garment, shapes, layout, chain.iter().map(|s| s.a), true);
    let b = runs(garment, shapes, layout, chain.iter().map(|s| s.b), !opposite);
    let length = |side: &dyn Fn(&Stitch) -> usize| chain.iter().map(|s| layout.atoms[side(s)].length).sum();
    let weights: f64 = chain.iter().map(|s| layout.atoms[s.a].length).sum();
    let confidence = chain.iter().map(|s| s.confidence * layout.atoms[s.a].length).sum::<f64>() / weights;
    let mut instead: Vec<usize> = chain.iter().flat_map(|s| s.instead).flatten().collect();
    instead.sort_unstable();
    instead.dedup();
    ProposedSeam {
        name: format!("{} {}", label(garment, &a), label(garment, &b)),
        length_a: length(&|s| s.a),
        length_b: length(&|s| s.b),
        fold_over: !opposite,
        confidence,
        atoms: chain.iter().map(|s| [s.a, s.b]).collect(),
        instead,
        a,
        b,
    }
}

/// A seam of stretches that are sewn to each other as a whole.
pub fn closing_seam(garment: &Garment, shapes: &Shapes, layout: &Layout, closing: &Closing) -> ProposedSeam {
    let mut a = turned_by(runs(garment, shapes, layout, closing.a.iter().copied(), true), closing.lead);
    for run in a.iter_mut().filter(|r| r.edges.is_empty()) {
        let shape = &shapes[run.piece];
        run.edges = edge_parts(&garment.pieces[run.piece], shape, run.ends.map(|p| shape.rings[0].project(p).0), true);
    }
    let b = runs(garment, shapes, layout, closing.b.iter().copied(), false);
    let length = |atoms: &[usize]| atoms.iter().map(|a| layout.atoms[*a].length).sum();
    let count = closing.a.len().max(closing.b.len());
    let nth = |atoms: &[usize], k: usize| atoms[k * atoms.len() / count];
    ProposedSeam {
        name: format!("{} {}", label(garment, &a), label(garment, &b)),
        length_a: length(&closing.a),
        length_b: length(&closing.b),
        fold_over: false,
        confidence: closing.confidence,
        atoms: (0..count).map(|k| [nth(&closing.a, k), nth(&closing.b, k)]).collect(),
        instead: Vec::new(),
        a,
        b,
    }
}

/// The runs of a side that starts `lead` metres on, within its first run. That much is walked last.
fn turned_by(mut runs: Vec<Run>, lead: f64) -> Vec<Run> {
    if lead <= 0.0 || runs.is_empty() {
        return runs;
    }
    let first = runs.remove(0);
    let (mut walked, mut points) = (0.0, vec![first.points[0]]);
    for (k, ends) in first.points.windows(2).enumerate() {
        let step = (ends[1] - ends[0]).norm();
        if walked + step > lead {
            let at = ends[0] + (ends[1] - ends[0]) * ((lead - walked) / step);
            let rest: Vec<Vec2> = std::iter::once(at).chain(first.points[k + 1..].iter().copied()).collect();
            points.push(at);
            let part = |points: Vec<Vec2>| Run {
                ends: [points[0], points[points.len() - 1]],
                edges: Vec::new(),
                points,
                ..first.clone()
            };
            runs.insert(0, part(rest));
            runs.push(part(points));
            return runs;
        }
        walked += step;
        points.push(ends[1]);
    }
    runs.insert(0, first);
    runs
}

/// A side in words: the pieces, and their edges where it covers them.
fn label(garment: &Garment, runs: &[Run]) -> String {
    let of_piece = |runs: &[Run]| {
        let name = &garment.pieces[runs[0].piece].name;
        let mut edges: Vec<String> = runs.iter().flat_map(|r| &r.edges).map(|e| e.number.to_string()).collect();
        edges.dedup();
        if edges.is_empty() { name.clone() } else { format!("{name}.{}", edges.join("+")) }
    };
    runs.chunk_by(|r, s| r.piece == s.piece).map(of_piece).collect::<Vec<_>>().join("+")
}

/// Atoms that follow one another become runs; a dart between them begins a new one, and so does a pleat.
fn runs(
    garment: &Garment,
    shapes: &Shapes,
    layout: &Layout,
    atoms: impl Iterator<Item = usize>,
    forward: bool,
) -> Vec<Run> {
    let mut parts: Vec<(usize, f64, f64, Vec<Vec2>)> = Vec::new();
    for a in atoms {
        let atom = &layout.atoms[a];
        let panel = atom.panel;
        let mut own: Vec<(f64, f64, Vec<Vec2>)> = atom.parts.iter().map(|p| (p.from, p.to, p.points.clone())).collect();
        if !forward {
            own.reverse();
            own.iter_mut().for_each(|(from, to, points)| {
                std::mem::swap(from, to);
                points.reverse();
            });
        }
        for (from, to, points) in own {
            match parts.last_mut() {
                Some((p, _, end, list)) if *p == panel && (*end - from).abs() < 1e-9 => {
                    *end = to;
                    list.extend(points.into_iter().skip(1));
                }
                _ => parts.push((panel, from, to, points)),
            }
        }
    }
    parts
        .into_iter()
        .map(|(panel, from, to, points)| {
            let piece = layout.panels[panel].piece;
            let edges = edge_parts(&garment.pieces[piece], &shapes[piece], [from, to], forward);
            Run { piece, ends: [points[0], points[points.len() - 1]], forward, points, edges }
        })
        .collect()
}
