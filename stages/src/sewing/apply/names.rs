//! Names of edges, and every name of the plan in the pieces' own spelling.

use crate::sewing::lookup;
use crate::sewing::ring::{Ring, SAME};
use crate::sewing::shapes::shape;
use toile_garment::sewing::{EdgeNameSpec, RunSpec};
use toile_garment::{Diagnostic, Garment, SourceRef};

/// Names the edges that `[[edge]]` tables of these pieces cover. A run that covers no whole edges keeps its name in the
/// plan and is found there.
pub fn edges(garment: &mut Garment, wanted: impl Fn(&str) -> bool, errors: &mut Vec<Diagnostic>) {
    let specs: Vec<EdgeNameSpec> = garment.plan.edge_names.iter().filter(|s| wanted(s.run.piece())).cloned().collect();
    for spec in specs {
        if let Err(e) = name(garment, &spec) {
            errors.push(e);
        }
    }
}

fn name(garment: &mut Garment, spec: &EdgeNameSpec) -> Result<(), Diagnostic> {
    let id = lookup::piece(garment, spec.run.piece(), spec.source.as_ref())?;
    let mut shape_errors = Vec::new();
    let mut shapes = vec![Default::default(); garment.pieces.len()];
    shapes[id.index()] = shape(&garment.pieces[id.index()], &garment.plan, &mut shape_errors);
    if !shape_errors.is_empty() {
        // The outline is bad: told with all its places when it is meshed.
        return Ok(());
    }
    let run = lookup::run(garment, &shapes, &spec.run, spec.source.as_ref())?;
    if run.ring != 0 {
        return Ok(());
    }
    let ring = &shapes[id.index()].rings[0];
    let (from, to) = run.span();
    let piece = &mut garment.pieces[id.index()];
    for edge in &mut piece.edges {
        let at = |v: u32| ring.of_line.get(v as usize).copied().flatten().map(|i| ring.arc[i]);
        if let (Some(start), Some(end)) = (at(edge.from), at(edge.to))
            && covers(ring, (from, to), (start, end))
            && !is_leg(ring, start, end)
        {
            edge.name = Some(spec.name.clone());
        }
    }
    Ok(())
}

fn covers(ring: &Ring, run: (f64, f64), edge: (f64, f64)) -> bool {
    let length = match ring.ahead(run.0, run.1) {
        d if d < SAME => ring.total(),
        d => d,
    };
    let start = ring.ahead(run.0, edge.0);
    start + ring.ahead(edge.0, edge.1) <= length + SAME
}

/// Does the edge lie on the legs of a dart?
fn is_leg(ring: &Ring, start: f64, end: f64) -> bool {
    let length = ring.ahead(start, end);
    ring.gaps.iter().any(|g| {
        let (from, to) = (ring.arc[g.from], ring.arc[g.to]);
        ring.ahead(from, start) + length <= ring.ahead(from, to) + SAME
    })
}

/// Writes every piece name of the plan as the piece spells it, so that later stages find it by equality.
pub fn canonical(garment: &mut Garment, errors: &mut Vec<Diagnostic>) {
    let mut plan = std::mem::take(&mut garment.plan);
    // A piece that is missing may be one of these.
    garment.plan.leave_out.clone_from(&plan.leave_out);
    let mut fix = |name: &mut String, at: Option<&SourceRef>| match lookup::piece(garment, name, at) {
        Ok(id) => name.clone_from(&garment.pieces[id.index()].name),
        Err(e) => errors.push(e),
    };
    for seam in &mut plan.seams {
        for run in seam.a.iter_mut().chain(&mut seam.b) {
            fix(RunSpec::piece_mut(run), seam.source.as_ref());
        }
    }
    for dart in &mut plan.darts {
        fix(&mut dart.piece, dart.source.as_ref());
    }
    for place in &mut plan.places {
        fix(&mut place.piece, place.source.as_ref());
    }
    for layer in &mut plan.layers {
        for piece in &mut layer.pieces {
            fix(piece, layer.source.as_ref());
        }
    }
    for attach in &mut plan.attachments {
        fix(&mut attach.piece, attach.source.as_ref());
    }
    for edge in &mut plan.edge_names {
        fix(edge.run.piece_mut(), edge.source.as_ref());
    }
    garment.plan = plan;
}
