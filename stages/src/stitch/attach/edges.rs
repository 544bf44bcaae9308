//! The edges that attachments name, and the vertices along them.

use crate::sewing::ring::SAME;
use crate::stitch::codes;
use toile_formats::codes::EDGE_UNKNOWN;
use toile_garment::dart::DartKind;
use toile_garment::outline::OutlineEdge;
use toile_garment::sewing::{AttachSpec, AttachStrength, EdgeNameSpec, RunSpec};
use toile_garment::{Diagnostic, Garment, Piece, Vec2};

/// An outline edge by its number, and how it is held.
pub type HeldEdge = (usize, AttachStrength);

/// Outline edges of a piece that are attached, in outline order.
pub fn edges_of(garment: &Garment, piece: &Piece, specs: &[&AttachSpec]) -> Result<Vec<HeldEdge>, Diagnostic> {
    let mut edges = Vec::new();
    for spec in specs.iter().filter(|s| s.piece.eq_ignore_ascii_case(&piece.name)) {
        edges.extend(edges_of_spec(garment, piece, spec)?.into_iter().map(|edge| (edge, spec.strength)));
    }
    edges.sort_by_key(|(edge, _)| *edge);
    edges.dedup_by_key(|(edge, _)| *edge);
    Ok(edges)
}

/// Outline edges that one attachment names, as a seam would find them: by name, else by number. A leg of a dart cannot be
/// held, because it is sewn to the other leg.
pub fn edges_of_spec(garment: &Garment, piece: &Piece, spec: &AttachSpec) -> Result<Vec<usize>, Diagnostic> {
    let of = |is_it: &dyn Fn(&OutlineEdge) -> bool| piece.edges.iter().filter(|e| is_it(e)).collect::<Vec<_>>();
    let mut named = of(&|e| e.name.as_deref() == Some(spec.edge.as_str()));
    if named.is_empty() {
        named = of(&|e| e.name.as_ref().is_some_and(|n| n.eq_ignore_ascii_case(&spec.edge)));
    }
    if named.is_empty()
        && let Some(fault) = no_edge(garment, piece, spec)
    {
        return Err(fault);
    }
    if named.is_empty() {
        named = of(&|e| e.index.to_string() == spec.edge);
    }
    if named.is_empty() {
        let message = format!("piece `{}` has no edge `{}` to attach", piece.name, spec.edge);
        let hint = "`toile inspect --svg` draws the numbers of all edges";
        return Err(Diagnostic::error(EDGE_UNKNOWN, message).hint(hint));
    }
    if let Some(dart) = named.iter().find_map(|e| dart_of_leg(piece, e)) {
        let message =
            format!("edge `{}` of `{}` is a leg of the dart `{dart}`, which is sewn shut", spec.edge, piece.name);
        let hint = "attach the edges beside the dart's mouth";
        return Err(Diagnostic::error(codes::ATTACH_DART_LEG, message).hint(hint));
    }
    Ok(named.iter().map(|e| e.index as usize).collect())
}

/// The error on a name of the sewing file that is no edge: a part of one, or a line inside the piece.
fn no_edge(garment: &Garment, piece: &Piece, spec: &AttachSpec) -> Option<Diagnostic> {
    let named =
        |n: &&EdgeNameSpec| n.run.piece().eq_ignore_ascii_case(&piece.name) && n.name.eq_ignore_ascii_case(&spec.edge);
    let name = garment.plan.edge_names.iter().filter(named).find(|n| !matches!(n.run, RunSpec::Edge { .. }))?;
    let what = if matches!(name.run, RunSpec::Line { .. }) { "a line inside" } else { "a part of an edge of" };
    let message = format!("`{}` is {what} `{}`, and whole edges alone can be held on the body", spec.edge, piece.name);
    let hint = "attach the whole edge, by its name or number; `toile inspect --svg` draws the numbers";
    Some(Diagnostic::error(codes::ATTACH_NO_EDGE, message).hint(hint))
}

/// The dart whose point an edge ends in.
fn dart_of_leg<'a>(piece: &'a Piece, edge: &OutlineEdge) -> Option<&'a str> {
    let ends = [edge.from, edge.to].map(|v| piece.outline.points.get(v as usize).map(|p| p.at));
    let at_end = |apex: &Vec2| ends.iter().flatten().any(|end| (apex - end).norm() < SAME);
    let mut wedges = piece.darts.iter().filter(|d| d.kind == DartKind::Wedge);
    wedges.find(|d| d.apexes.iter().any(at_end)).map(|d| d.name.as_str())
}

/// Attached edges from the first after a gap, so that a run over the outline's start stays together.
pub fn in_outline_order(piece: &Piece, edges: &[HeldEdge]) -> Vec<HeldEdge> {
    let n = piece.edges.len();
    let held = |e: usize| edges.iter().any(|(edge, _)| *edge == e % n);
    // Two attached edges with only dart legs between them belong together: the longest pause is the real one.
    let mut best = (0, edges[0].0);
    for (e, _) in edges {
        let pause = (1..=n).take_while(|k| !held(e + n - k)).count();
        if pause > best.0 {
            best = (pause, *e);
        }
    }
    (0..n).filter_map(|k| edges.iter().find(|(e, _)| *e == (best.1 + k) % n)).copied().collect()
}

/// Mesh vertices along an outline edge, counter-clockwise.
pub fn edge_vertices(piece: &Piece, edge: usize) -> Vec<u32> {
    let Some(mesh) = &piece.mesh else { return Vec::new() };
    let Some(chain) = mesh.outline() else { return Vec::new() };
    let end = |i: u32| mesh.outline_vertex.get(i as usize).copied().flatten();
    let (Some(from), Some(to)) = (end(piece.edges[edge].from), end(piece.edges[edge].to)) else { return Vec::new() };
    let n = chain.vertices.len();
    let Some(start) = chain.vertices.iter().position(|v| *v == from) else { return Vec::new() };
    let mut out = vec![from];
    for k in 1..=n {
        let v = chain.vertices[(start + k) % n];
        out.push(v);
        if v == to {
            break;
        }
    }
    out
}
