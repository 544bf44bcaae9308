//! The DXF writer. A drawing in millimetres becomes the narrow subset of DXF that the widest set of pattern systems
//! reads. Its tags are those of R12, and its HEADER is empty. It holds one BLOCK per piece and size, and one INSERT
//! each. Lines end in CRLF, and texts are 7-bit ASCII unless a code page is asked for.
//!
//! The meaning lives in `Key: value` texts and in numeric layers. The boundary is on 1 and the sew line on 14, with
//! dense copies on 84 and 87. Turn points are on 2, curve points on 3, notches on 4 and 80 to 83. The grain is on 5 and
//! 7, the fold on 6. Internal lines are on 8, cutouts on 11, drill holes on 13.

mod block;
pub(crate) mod codes;
mod fold;
mod from_piece;
mod growth;
mod model;
mod names;
mod size_run;
pub(crate) mod sparse;
mod style;
mod tags;
#[cfg(test)]
mod tests;

pub(crate) use growth::begun_like;
pub(crate) use names::escaped;
pub(crate) use style::PRODUCT;
pub(crate) use tags::decimals;

pub use from_piece::{PieceOptions, drawn_vertices, piece_drawing};
pub use model::{
    CutNotes, Dialect, DrawDrill, DrawLine, DrawNotch, DrawPoint, DrawRule, Drawing, LayerText, NotchLine,
    PieceDrawing, StyleText,
};

pub use size_run::{Changed, SizeRun, Sizes};
pub use tags::WriteOptions;

use names::Names;
use tags::Tags;
use toile_garment::Diagnostic;

/// A DXF file as bytes, and what had to be changed for the format's sake.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// The file: CRLF, 7-bit ASCII but for texts in a code page that was asked for.
    pub bytes: Vec<u8>,
    /// Names shortened, texts folded to ASCII, notch shapes the dialect does not have.
    pub findings: Vec<Diagnostic>,
}

/// Writes a drawing in millimetres and ASCII. The same drawing gives the same bytes: no clock, no machine.
///
/// # Errors
/// One finding per piece that holds a number that is not finite, or a boundary of fewer than three points.
pub fn write(drawing: &Drawing, dialect: Dialect) -> Result<Written, Vec<Diagnostic>> {
    write_with(drawing, dialect, WriteOptions::default())
}

/// Writes a drawing as [`write()`] does, in the unit and code page of the options.
///
/// # Errors
/// As [`write()`].
pub fn write_with(drawing: &Drawing, dialect: Dialect, options: WriteOptions) -> Result<Written, Vec<Diagnostic>> {
    let faults: Vec<_> = drawing.pieces.iter().filter_map(model::fault).collect();
    if !faults.is_empty() {
        return Err(faults);
    }
    let mut findings = Vec::new();
    let names = Names::of(drawing, dialect, &mut findings);
    let height = (dialect == Dialect::Gerber).then_some(0.25);
    let mut tags = Tags::new(height, options);
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
