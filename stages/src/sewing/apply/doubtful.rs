//! What a wrong table leaves in doubt: seams on a piece whose dart or copy is wrong, and on an edge whose name is. The
//! others are looked at all the same, so that all mistakes are told at once.

use crate::sewing::lookup;
use std::collections::BTreeSet;
use toile_garment::sewing::RunSpec;
use toile_garment::{Diagnostic, Garment, SourceRef};

/// Names in lower case that nothing can be said of.
#[derive(Default)]
struct Doubts {
    pieces: BTreeSet<String>,
    edges: BTreeSet<String>,
}

/// Takes all that is sewn to a piece or edge in doubt out of the plan.
pub fn set_aside(garment: &mut Garment, errors: &[Diagnostic]) {
    if errors.is_empty() {
        return;
    }
    let doubts = doubts(garment, errors);
    let plan = &mut garment.plan;
    plan.seams.retain(|seam| !seam.a.iter().chain(&seam.b).any(|run| doubts.has(run)));
    plan.elastics.retain(|band| !band.along.iter().any(|run| doubts.has(run)));
    plan.attachments.retain(|a| !doubts.has_piece(&a.piece) && !doubts.edges.contains(&a.edge.to_lowercase()));
    plan.edge_names.retain(|e| !doubts.has(&e.run) && !doubts.edges.contains(&e.name.to_lowercase()));
    plan.places.retain(|p| !doubts.has_piece(&p.piece));
    plan.layers.iter_mut().for_each(|l| l.pieces.retain(|p| !doubts.has_piece(p)));
    plan.interlinings.iter_mut().for_each(|i| i.pieces.retain(|p| !doubts.has_piece(p)));
    plan.darts.retain(|d| !doubts.has_piece(&d.piece));
    plan.folds.retain(|f| !doubts.has_piece(&f.piece));
}

fn doubts(garment: &Garment, errors: &[Diagnostic]) -> Doubts {
    let plan = &garment.plan;
    let is_wrong = |source: &Option<SourceRef>| errors.iter().any(|e| e.source.is_some() && e.source == *source);
    let darts = plan.darts.iter().filter(|d| is_wrong(&d.source)).map(|d| &d.piece);
    let folds = plan.folds.iter().filter(|f| is_wrong(&f.source)).map(|f| &f.piece);
    let copies = plan.copies.iter().filter(|c| is_wrong(&c.source)).map(|c| &c.name);
    let names = plan.edge_names.iter().filter(|e| is_wrong(&e.source)).map(|e| e.name.to_lowercase());
    let mut doubts = Doubts { pieces: BTreeSet::new(), edges: names.collect() };
    for name in darts.chain(folds).chain(copies) {
        // A name that no piece has is likely that of the nearest one.
        doubts.pieces.insert(name.to_lowercase());
        doubts.pieces.extend(lookup::near_piece(garment, name).map(|p| p.name.to_lowercase()));
    }
    for copy in &plan.copies {
        if doubts.has_piece(&copy.piece) {
            doubts.pieces.insert(copy.name.to_lowercase());
        }
    }
    doubts
}

impl Doubts {
    fn has_piece(&self, name: &str) -> bool {
        self.pieces.contains(&name.to_lowercase())
    }

    fn has(&self, run: &RunSpec) -> bool {
        let edge = match run {
            RunSpec::Edge { edge, .. } | RunSpec::Part { edge, .. } => Some(edge),
            RunSpec::Points { .. } | RunSpec::Line { .. } => None,
        };
        self.has_piece(run.piece()) || edge.is_some_and(|edge| self.edges.contains(&edge.to_lowercase()))
    }
}
