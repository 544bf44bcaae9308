//! Names of pieces and edges, points on outlines.

use super::codes;
use super::edge_part;
use super::ring::SAME;
use super::shapes::{PieceShape, Shapes, mm};
use crate::codes::{OUTLINE_TOO_SMALL, PIECE_UNKNOWN};
use toile_formats::codes::EDGE_UNKNOWN;
use toile_garment::outline::PointKind;
use toile_garment::sewing::{RunSpec, RunWay, SewingPlan};
use toile_garment::{Diagnostic, Garment, Piece, PieceId, SourceRef, Vec2};

/// Points of the sewing file are drawn to this distance.
const POINT_TOLERANCE: f64 = 1e-3;
/// Two ways round an outline nearer in length than this cannot be told apart by length.
const SAME_WAY: f64 = 0.01;

/// One run as the file names it, found on a ring. A run from a point to itself is the whole ring.
#[derive(Clone, Debug, PartialEq)]
pub struct RawRun {
    /// Piece.
    pub piece: PieceId,
    /// Ring of the piece.
    pub ring: usize,
    /// Arc position at which it starts, in sewing order.
    pub from: f64,
    /// Arc position at which it ends.
    pub to: f64,
    /// True where it is walked forward (counter-clockwise on the outline).
    pub forward: bool,
    /// Does the file state the direction (two points), or was `forward` only assumed (an edge)?
    pub stated: bool,
}

impl RawRun {
    /// The same run walked the other way.
    pub fn turned(&self) -> Self {
        Self { from: self.to, to: self.from, forward: !self.forward, ..self.clone() }
    }

    /// Ends in walking-forward order.
    pub fn span(&self) -> (f64, f64) {
        if self.forward { (self.from, self.to) } else { (self.to, self.from) }
    }

    /// Length walking along the ring, intakes included.
    pub fn walk(&self, shape: &PieceShape) -> f64 {
        let (from, to) = self.span();
        let ring = &shape.rings[self.ring];
        let d = ring.ahead(from, to);
        if d < SAME { ring.total() } else { d }
    }
}

/// A piece by name; case matters only when two names differ by it.
pub fn piece(garment: &Garment, name: &str, at: Option<&SourceRef>) -> Result<PieceId, Diagnostic> {
    if let Some(id) = garment.piece_named(name) {
        return Ok(id);
    }
    let mut same = garment.pieces.iter().filter(|p| p.name.eq_ignore_ascii_case(name));
    match (same.next(), same.next()) {
        (Some(p), None) => Ok(p.id),
        (Some(a), Some(b)) => {
            Err(Diagnostic::error(codes::PIECE_AMBIGUOUS, format!("`{name}` can be `{}` or `{}`", a.name, b.name))
                .at(at.cloned())
                .hint("write the name in the case of the pattern file"))
        }
        _ => {
            let names: Vec<_> = garment.pieces.iter().map(|p| p.name.as_str()).collect();
            let is_left_out = garment.plan.leave_out.iter().any(|out| out.eq_ignore_ascii_case(name));
            let (message, hint) = if is_left_out {
                let hint = "take it out of `leave_out`, or remove what names it";
                (format!("piece `{name}` is left out of the garment"), hint.to_owned())
            } else {
                (format!("there is no piece `{name}`"), nearest(name, &names))
            };
            Err(Diagnostic::error(PIECE_UNKNOWN, message).at(at.cloned()).hint(hint))
        }
    }
}

/// The name that is likely meant by another.
fn near<'k>(word: &str, known: &[&'k str]) -> Option<&'k str> {
    let lower = word.to_lowercase();
    let distance = |k: &&'k str| (strsim::damerau_levenshtein(&lower, &k.to_lowercase()), *k);
    let (distance, name) = known.iter().map(distance).min()?;
    (distance <= 1 + word.chars().count() / 3).then_some(name)
}

/// The piece that is likely meant by a name.
pub fn near_piece<'g>(garment: &'g Garment, name: &str) -> Option<&'g Piece> {
    let names: Vec<_> = garment.pieces.iter().map(|p| p.name.as_str()).collect();
    garment.piece_named(near(name, &names)?).map(|id| &garment.pieces[id.index()])
}

/// "did you mean …", or the list of what there is.
pub fn nearest(word: &str, known: &[&str]) -> String {
    match near(word, known) {
        Some(k) => format!("did you mean `{k}`?"),
        _ if known.is_empty() => "there is none".to_owned(),
        _ => format!("there are: {}", known.iter().take(40).copied().collect::<Vec<_>>().join(", ")),
    }
}

/// Finds a run.
pub fn run(garment: &Garment, shapes: &Shapes, spec: &RunSpec, at: Option<&SourceRef>) -> Result<RawRun, Diagnostic> {
    match spec {
        RunSpec::Edge { piece: name, edge } => {
            let id = piece(garment, name, at)?;
            edge_run(garment, shapes, id, edge, at)
        }
        RunSpec::Part { piece: name, edge, from, to } => {
            let id = piece(garment, name, at)?;
            let whole = edge_run(garment, shapes, id, edge, at)?;
            edge_part::run(&garment.pieces[id.index()], &shapes[id.index()], edge, &whole, [*from, *to])
                .map_err(|d| d.at(at.cloned()))
        }
        RunSpec::Points { piece: name, from, to, way } => {
            let id = piece(garment, name, at)?;
            points_run(&garment.pieces[id.index()], &shapes[id.index()], *from, *to, *way, at)
        }
        RunSpec::Line { piece: name, line } => {
            let id = piece(garment, name, at)?;
            line_run(garment, shapes, id, line).map_err(|d| d.at(at.cloned()))
        }
    }
}

/// A run by edge name or number.
fn edge_run(
    garment: &Garment,
    shapes: &Shapes,
    id: PieceId,
    edge: &str,
    at: Option<&SourceRef>,
) -> Result<RawRun, Diagnostic> {
    let (p, shape) = (&garment.pieces[id.index()], &shapes[id.index()]);
    let mut found: Vec<_> = p.edges.iter().filter(|e| e.name.as_deref() == Some(edge)).collect();
    if found.is_empty() {
        found = p.edges.iter().filter(|e| e.name.as_deref().is_some_and(|n| n.eq_ignore_ascii_case(edge))).collect();
    }
    if found.is_empty()
        && let Some(spec) = overlay(&garment.plan, &p.name, edge)
    {
        let is_line = matches!(spec, RunSpec::Line { .. });
        return run(garment, shapes, spec, at).map(|r| RawRun { stated: is_line, ..r });
    }
    if found.is_empty()
        && let Ok(number) = edge.parse::<u32>()
    {
        found = p.edges.iter().filter(|e| e.index == number).collect();
    }
    join_edges(p, shape, &found).ok_or_else(|| {
        if found.is_empty() { unknown_edge(&garment.plan, p, edge) } else { scattered(p, edge) }.at(at.cloned())
    })
}

/// A name of the sewing file that covers no whole edges.
fn overlay<'p>(plan: &'p SewingPlan, piece: &str, edge: &str) -> Option<&'p RunSpec> {
    plan.edge_names
        .iter()
        .find(|n| {
            let is_whole = matches!(&n.run, RunSpec::Edge { .. });
            // A name for a part of the edge that has the same name is no other edge.
            let is_own = matches!(&n.run, RunSpec::Part { edge: e, .. } if e.eq_ignore_ascii_case(edge));
            !is_whole && !is_own && n.run.piece().eq_ignore_ascii_case(piece) && n.name.eq_ignore_ascii_case(edge)
        })
        .map(|n| &n.run)
}

fn unknown_edge(plan: &SewingPlan, p: &Piece, edge: &str) -> Diagnostic {
    let mut known: Vec<&str> = p.edges.iter().filter_map(|e| e.name.as_deref()).collect();
    known.extend(plan.edge_names.iter().filter(|n| n.run.piece() == p.name).map(|n| n.name.as_str()));
    known.dedup();
    let numbers = format!("its edges are numbered 0 to {}", p.edges.len().saturating_sub(1));
    let hint = if known.is_empty() { numbers } else { format!("{}; {numbers}", nearest(edge, &known)) };
    Diagnostic::error(EDGE_UNKNOWN, format!("piece `{}` has no edge `{edge}`", p.name)).hint(hint)
}

fn scattered(p: &Piece, edge: &str) -> Diagnostic {
    Diagnostic::error(
        codes::EDGE_NAME_SCATTERED,
        format!("piece `{}`: the edges called `{edge}` do not follow one another", p.name),
    )
    .hint("name them apart, or give the run by two points")
}

/// One run over edges that follow one another, darts between them allowed.
fn join_edges(p: &Piece, shape: &PieceShape, edges: &[&toile_garment::outline::OutlineEdge]) -> Option<RawRun> {
    let ring = shape.rings.first()?;
    let position = |vertex: u32| -> Option<f64> {
        let vertex = vertex as usize;
        match ring.of_line.get(vertex)? {
            Some(i) => ring.arc.get(*i).copied(),
            // Swallowed by a marked mouth: the nearest point that is left.
            None => Some(ring.project(p.outline.points.get(vertex)?.at).0),
        }
    };
    let mut ends = Vec::new();
    for e in edges {
        ends.push((position(e.from)?, position(e.to)?));
    }
    // The first edge is the one that no other leads to.
    let leads = |a: &(f64, f64), b: &(f64, f64)| ring.sewn_ahead(a.1, b.0) < SAME;
    let first = (0..ends.len()).find(|i| !ends.iter().enumerate().any(|(k, e)| k != *i && leads(e, &ends[*i])));
    let mut at = first.unwrap_or(0);
    let (mut left, from) = (ends.len().checked_sub(1)?, ends.get(at)?.0);
    while left > 0 {
        at = (0..ends.len()).find(|k| *k != at && leads(&ends[at], &ends[*k]))?;
        left -= 1;
    }
    Some(RawRun { piece: p.id, ring: 0, from, to: ends[at].1, forward: true, stated: false })
}

/// A line inside a piece.
fn line_run(garment: &Garment, shapes: &Shapes, id: PieceId, line: &[Vec2]) -> Result<RawRun, Diagnostic> {
    let (p, shape) = (&garment.pieces[id.index()], &shapes[id.index()]);
    let number = garment.plan.seam_lines(&p.name).iter().position(|l| *l == line);
    let ring = number.map_or(shape.rings.len(), |k| shape.rings.len() - shape.seam_lines + k);
    let length = shape.rings.get(ring).map_or(0.0, |r| 0.5 * r.total());
    if length > SAME {
        return Ok(RawRun { piece: id, ring, from: 0.0, to: length, forward: true, stated: true });
    }
    let at = line.first().map_or_else(String::new, |p| format!(" at {}", mm(*p)));
    let message = format!("piece `{}`: the seam line{at} has no length", p.name);
    Err(Diagnostic::error(codes::RUN_WITHOUT_LENGTH, message).hint("give two different points inside the piece"))
}

/// A run by two points.
fn points_run(
    p: &Piece,
    shape: &PieceShape,
    from: Vec2,
    to: Vec2,
    way: RunWay,
    at: Option<&SourceRef>,
) -> Result<RawRun, Diagnostic> {
    let (ring, s0, s1) = locate_both(p, shape, from, to).map_err(|d| d.at(at.cloned()))?;
    let r = &shape.rings[ring];
    let closed = r.ahead(s0, s1) < SAME;
    if closed && matches!(way, RunWay::Short | RunWay::Long) {
        return Err(Diagnostic::error(
            codes::RUN_WITHOUT_LENGTH,
            format!("piece `{}`: the run starts and ends at {}", p.name, mm(from)),
        )
        .at(at.cloned())
        .hint("give two different points; for the whole outline add way = \"left\" or \"right\""));
    }
    let (left, right) = (r.sewn_ahead(s0, s1), r.sewn_ahead(s1, s0));
    let tie = (left - right).abs() < SAME_WAY * left.max(right);
    let forward = match way {
        RunWay::Left => true,
        RunWay::Right => false,
        RunWay::Short | RunWay::Long if tie => return Err(tied(p, from, to, left).at(at.cloned())),
        RunWay::Short => left < right,
        RunWay::Long => left > right,
    };
    Ok(RawRun { piece: p.id, ring, from: s0, to: s1, forward, stated: true })
}

fn tied(p: &Piece, from: Vec2, to: Vec2, length: f64) -> Diagnostic {
    let message =
        format!("piece `{}`: both ways from {} to {} are about {:.0} mm long", p.name, mm(from), mm(to), length * 1e3);
    Diagnostic::error(codes::RUN_WAY_AMBIGUOUS, message)
        .hint("add way = \"left\" (cloth on the left, counter-clockwise) or way = \"right\"")
}

fn locate_both(p: &Piece, shape: &PieceShape, from: Vec2, to: Vec2) -> Result<(usize, f64, f64), Diagnostic> {
    let mut wrong = None;
    for ring in 0..shape.rings.len() {
        match (locate(p, shape, ring, from), locate(p, shape, ring, to)) {
            (Ok(a), Ok(b)) => return Ok((ring, a, b)),
            (Err(d), _) | (_, Err(d)) => wrong = wrong.or(Some(d)),
        }
    }
    Err(wrong.unwrap_or_else(|| Diagnostic::error(OUTLINE_TOO_SMALL, format!("piece `{}` has no outline", p.name))))
}

/// The position of a point: the nearest corner, vertex, or place on the line within a millimetre.
pub fn locate(p: &Piece, shape: &PieceShape, ring: usize, point: Vec2) -> Result<f64, Diagnostic> {
    let r = &shape.rings[ring];
    let near = |i: &usize| (r.points[*i] - point).norm();
    let corner = |i: &usize| ring == 0 && is_corner(p, r, *i);
    let best = |list: Vec<usize>| list.into_iter().min_by(|a, b| near(a).total_cmp(&near(b)));
    let close: Vec<usize> = (0..r.points.len()).filter(|i| near(i) <= POINT_TOLERANCE).collect();
    let corners: Vec<usize> = close.iter().copied().filter(|i| corner(i)).collect();
    if let Some(i) = best(corners).or_else(|| best(close)) {
        return Ok(r.arc[i]);
    }
    let (s, distance) = r.project(point);
    if distance <= POINT_TOLERANCE {
        return Ok(s);
    }
    let nearest = best((0..r.points.len()).collect());
    let hint = nearest.map_or(String::new(), |i| format!("the nearest vertex is {}", mm(r.points[i])));
    Err(Diagnostic::error(
        codes::POINT_OFF_OUTLINE,
        format!("piece `{}`: the point {} lies {:.1} mm off the outline", p.name, mm(point), distance * 1e3),
    )
    .hint(hint))
}

/// Is a ring point a corner of the piece?
fn is_corner(p: &Piece, ring: &super::ring::Ring, i: usize) -> bool {
    let at_gap = ring.gaps.iter().any(|g| g.from == i || g.to == i || g.apex == Some(i));
    let vertices = ring.of_line.iter().enumerate().filter(|(_, k)| **k == Some(i)).map(|(v, _)| v);
    at_gap
        || vertices.into_iter().any(|v| {
            let edge_end = p.edges.iter().any(|e| e.from as usize == v || e.to as usize == v);
            edge_end || p.outline.points.get(v).is_some_and(|q| q.kind == PointKind::Turn)
        })
}
