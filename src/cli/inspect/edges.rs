//! The edges of a pattern as a table: what a sewing file names, how long it is, and what is as long.

use serde_json::{Value, json};
use std::fmt::Write as _;
use toile_garment::{Diagnostic, Garment, Piece};
use toile_stages::sewing::edges::{Edge, as_long, edges};
use toile_stages::sewing::shapes::{shape, shapes};

/// Edges whose lengths differ by no more than this share may be sewn to each other.
const AS_LONG: f64 = 0.01;
/// Most edges that are named as fitting.
const NAMED: usize = 3;

/// The table and its values for programs, of all pieces that can be sewn; `None` where there are none.
pub(super) fn table(garment: &Garment) -> Option<(String, Value)> {
    let garment = &with_shape(garment);
    let all = edges(garment, &shapes(garment).ok()?);
    if all.is_empty() {
        return None;
    }
    let width = all.iter().map(|e| e.name.chars().count()).max().unwrap_or(0).max(4);
    let size = garment.size.as_deref().map_or_else(String::new, |s| format!(" of size {s}"));
    let mut text = format!("edges{size} as they are sewn; a sewing file names them so\n");
    let _ = writeln!(text, "{:<width$} {:>9}  {:<28} as long", "edge", "mm", "notches, mm from its start");
    for edge in &all {
        let notches = edge.labels.iter().zip(&edge.notches);
        let notches: Vec<String> = notches.map(|(label, way)| format!("{label} {:.1}", way * 1e3)).collect();
        let fits: Vec<&str> = fits(&all, edge).map(|e| e.name.as_str()).collect();
        let row =
            format!("{:<width$} {:>9.1}  {:<28} {}", edge.name, edge.length * 1e3, notches.join(", "), fits.join(" "));
        let _ = writeln!(text, "{}", row.trim_end());
    }
    Some((text, all.iter().map(|e| value(&all, e)).collect()))
}

/// Why pieces cannot be sewn: their outlines, and the mouths of their darts.
pub(super) fn faults(garment: &Garment) -> Vec<Diagnostic> {
    garment.pieces.iter().flat_map(|piece| faults_of(piece, garment)).collect()
}

fn faults_of(piece: &Piece, garment: &Garment) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    shape(piece, &garment.plan, &mut errors);
    errors
}

/// The garment without pieces whose outline cannot be sewn.
fn with_shape(garment: &Garment) -> Garment {
    let sound = garment.pieces.iter().filter(|piece| faults_of(piece, garment).is_empty());
    Garment { pieces: sound.cloned().collect(), ..garment.clone() }
}

fn fits<'e>(all: &'e [Edge], edge: &Edge) -> impl Iterator<Item = &'e Edge> {
    as_long(all, edge, AS_LONG).into_iter().take(NAMED)
}

fn value(all: &[Edge], edge: &Edge) -> Value {
    let mm = |length: f64| (length * 1e6).round() / 1e3;
    json!({
        "edge": edge.name,
        "number": edge.number,
        "length_mm": mm(edge.length),
        "notches": edge.labels,
        "notches_mm": edge.notches.iter().map(|n| mm(*n)).collect::<Vec<_>>(),
        "as_long": fits(all, edge).map(|e| e.name.as_str()).collect::<Vec<_>>(),
    })
}
