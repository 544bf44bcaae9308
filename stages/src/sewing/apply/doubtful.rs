//! The entries that a wrong table leaves in doubt: seams on a piece whose copy is wrong, on an edge whose name is, and
//! on a numbered edge of a piece whose dart is. The others are looked at all the same, so that all mistakes are told
//! at once.

use crate::sewing::lookup;
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::sewing::RunSpec;
use toile_garment::{Diagnostic, Garment, SourceRef};

/// A dart gives a piece at most so many edges more.
const EDGES_OF_DART: usize = 4;

/// Names in lower case that nothing can be said of.
#[derive(Default)]
pub struct Doubts {
    /// Pieces that may not be there.
    pieces: BTreeSet<String>,
    /// Names of edges.
    edges: BTreeSet<String>,
    /// Pieces whose edges may be others, with the number from which on they have none.
    darted: BTreeMap<String, usize>,
}

/// Takes all that is sewn to a piece or edge in doubt out of the plan.
pub fn set_aside(garment: &mut Garment, errors: &[Diagnostic]) -> Doubts {
    if errors.is_empty() {
        return Doubts::default();
    }
    let doubts = doubts(garment, errors);
    let plan = &mut garment.plan;
    plan.seams.retain(|seam| !seam.a.iter().chain(&seam.b).any(|run| doubts.has(run)));
    plan.elastics.retain(|band| !band.along.iter().any(|run| doubts.has(run)));
    plan.attachments.retain(|a| !doubts.has_edge(&a.piece, Some(&a.edge)));
    plan.edge_names.retain(|e| !doubts.has(&e.run) && !doubts.edges.contains(&e.name.to_lowercase()));
    plan.places.retain(|p| !doubts.has_edge(&p.piece, None));
    plan.layers.iter_mut().for_each(|l| l.pieces.retain(|p| !doubts.has_edge(p, None)));
    plan.interlinings.iter_mut().for_each(|i| i.pieces.retain(|p| !doubts.has_edge(p, None)));
    plan.wholes.iter_mut().for_each(|w| w.pieces.retain(|p| !doubts.has_edge(p, None)));
    plan.darts.retain(|d| !doubts.has_edge(&d.piece, None));
    plan.folds.retain(|f| !doubts.has_edge(&f.piece, None));
    doubts
}

fn doubts(garment: &Garment, errors: &[Diagnostic]) -> Doubts {
    let plan = &garment.plan;
    let is_wrong = |source: &Option<SourceRef>| errors.iter().any(|e| e.source.is_some() && e.source == *source);
    let mut doubts = Doubts::default();
    doubts.edges.extend(plan.edge_names.iter().filter(|e| is_wrong(&e.source)).map(|e| e.name.to_lowercase()));
    for copy in &plan.copies {
        if is_wrong(&copy.source) || doubts.pieces.contains(&copy.piece.to_lowercase()) {
            doubts.pieces.insert(copy.name.to_lowercase());
        }
    }
    for dart in plan.darts.iter().filter(|d| is_wrong(&d.source)) {
        // A name that no piece has is likely that of the nearest one.
        let near = lookup::near_piece(garment, &dart.piece);
        let copies = plan.copies.iter().filter(|c| near.is_some_and(|p| p.name.eq_ignore_ascii_case(&c.piece)));
        let edges = near.map_or(0, |p| p.edges.len());
        let names = near.map(|p| p.name.to_lowercase()).into_iter().chain(copies.map(|c| c.name.to_lowercase()));
        for name in names {
            *doubts.darted.entry(name).or_insert(edges) += EDGES_OF_DART;
        }
    }
    doubts
}

impl Doubts {
    /// Takes the seams out of the plan whose lengths a wrong dart changes.
    pub fn set_lengths_aside(&self, garment: &mut Garment) {
        let is_darted = |run: &RunSpec| self.darted.contains_key(&run.piece().to_lowercase());
        garment.plan.seams.retain(|seam| !seam.a.iter().chain(&seam.b).any(is_darted));
    }

    fn has_edge(&self, piece: &str, edge: Option<&str>) -> bool {
        let piece = piece.to_lowercase();
        let is_numbered = |edge: &str| {
            let number = edge.parse::<usize>().ok();
            number.zip(self.darted.get(&piece)).is_some_and(|(number, most)| number < *most)
        };
        self.pieces.contains(&piece) || edge.is_some_and(|e| self.edges.contains(&e.to_lowercase()) || is_numbered(e))
    }

    fn has(&self, run: &RunSpec) -> bool {
        let edge = match run {
            RunSpec::Edge { edge, .. } | RunSpec::Part { edge, .. } => Some(edge.as_str()),
            RunSpec::Points { .. } | RunSpec::Line { .. } => None,
        };
        self.has_edge(run.piece(), edge)
    }
}
