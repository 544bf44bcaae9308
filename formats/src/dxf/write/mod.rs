//! The DXF writer: a drawing in millimetres becomes the narrow subset of DXF that the widest set of pattern systems
//! reads: R12 tags, an empty HEADER, one BLOCK per piece and size, one INSERT each, CRLF, 7-bit ASCII.
//!
//! The meaning lives in numeric layers (1 boundary, 2 turn points, 3 curve points, 4 and 80 to 83 notches, 5 and 7
//! grain, 6 fold, 8 internal lines, 11 cutouts, 13 drill holes, 14 sew line, 84 and 87 dense copies of 1 and 14) and
//! in `Key: value` texts.

mod block;
pub(crate) mod codes;
mod fold;
mod from_piece;
mod growth;
mod model;
mod names;
mod size_run;
mod style;
mod tags;
#[cfg(test)]
mod tests;
mod thin;

pub(crate) use names::escaped;

pub use from_piece::{PieceOptions, piece_drawing};
pub use model::{
    Dialect, DrawDrill, DrawLine, DrawNotch, DrawPoint, DrawRule, Drawing, LayerText, PieceDrawing, StyleText,
};

pub use size_run::{SizeRun, Sizes};

use names::Names;
use tags::Tags;
use toile_garment::Diagnostic;

/// A DXF file as bytes, and what had to be changed for the format's sake.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// The file: CRLF, 7-bit ASCII.
    pub bytes: Vec<u8>,
    /// Names shortened, texts folded to ASCII, notch shapes the dialect does not have.
    pub findings: Vec<Diagnostic>,
}

/// Writes a drawing. The same drawing gives the same bytes: no date, no machine.
///
/// # Errors
/// One finding per piece that holds a number that is not finite, or a boundary of fewer than three points.
pub fn write(drawing: &Drawing, dialect: Dialect) -> Result<Written, Vec<Diagnostic>> {
    let faults: Vec<_> = drawing.pieces.iter().filter_map(model::fault).collect();
    if !faults.is_empty() {
        return Err(faults);
    }
    let mut findings = Vec::new();
    let names = Names::of(drawing, dialect, &mut findings);
    let height = (dialect == Dialect::Gerber).then_some(0.25);
    let mut tags = Tags::default();
    tags.height = height;
    style::header(&mut tags, dialect);
    tags.section("BLOCKS");
    for (piece, name) in drawing.pieces.iter().zip(&names.pieces) {
        block::block(&mut tags, piece, name, dialect, &mut findings);
    }
    tags.end_section();
    tags.section("ENTITIES");
    for name in &names.pieces {
        style::insert(&mut tags, &name.block);
    }
    style::texts(&mut tags, &drawing.style, dialect, &mut findings);
    tags.end_section();
    tags.pair(0, "EOF");
    Ok(Written { bytes: tags.into_bytes(), findings })
}
