//! A garment document on disk.

use super::{Inspected, Source};
use crate::engine::{GarmentCounts, clean};
use serde_json::{Value, json};
use std::fmt::Write as _;
use toile_formats::codes::GARMENT_FILE;
use toile_formats::{garment_file, svg};
use toile_garment::{Diagnostic, Garment, SourceRef};

pub(super) fn is_json(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"{")
}

pub(super) fn document(source: &Source<'_>) -> Result<Inspected, Vec<Diagnostic>> {
    let place = SourceRef::file(clean(source.path));
    let wrong = |message| vec![Diagnostic::error(GARMENT_FILE, message).at(place)];
    let garment = garment_file::document(source.bytes).map_err(wrong)?.garment;
    let json = json!({
        "style": garment.style,
        "size": garment.size,
        "counts": GarmentCounts::of(&garment),
        "pieces": pieces(&garment),
        "certificate": garment.certificate,
    });
    let svg = source.draw.then(|| svg::pattern(&garment.pieces, &garment.style));
    Ok(Inspected { json, text: table(&garment), svg, findings: Vec::new(), is_usable: true })
}

fn pieces(garment: &Garment) -> Vec<Value> {
    let size = |p: &toile_garment::Piece| p.mesh.as_ref().map_or((0, 0), |m| (m.rest.len(), m.triangles.len()));
    let facts = garment.pieces.iter().map(|p| {
        let (vertices, triangles) = size(p);
        json!({ "name": p.name, "darts": p.darts.len(), "vertices": vertices, "triangles": triangles })
    });
    facts.collect()
}

/// The garment for people.
pub(super) fn table(garment: &Garment) -> String {
    let counts = GarmentCounts::of(garment);
    let mut text = format!(
        "garment `{}`: {} pieces, {} seams, {} darts, {} triangles\n",
        garment.style, counts.pieces, counts.seams, counts.darts, counts.triangles
    );
    for piece in &garment.pieces {
        let triangles = piece.mesh.as_ref().map_or(0, |m| m.triangles.len());
        let _ = writeln!(text, "  {:<20} {} darts, {triangles} triangles", piece.name, piece.darts.len());
    }
    text
}
