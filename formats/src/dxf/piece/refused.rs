//! A piece that is drawn so wrongly that no garment can have it: its texts and lines are kept, to be looked at.

use crate::dxf::chain::{self, Path};
use crate::dxf::geom;
use crate::dxf::sheet::Sheet;
use toile_garment::{Diagnostic, Vec2};

/// A piece of a file that cannot be sewn or cut as it is drawn, and why.
#[derive(Clone, Debug)]
pub struct RefusedPiece {
    /// Block name.
    pub block: String,
    /// Line of the block.
    pub line: u64,
    /// Text `Piece Name`, if any.
    pub name: Option<String>,
    /// Text `Size`, if any.
    pub size: Option<String>,
    /// Are there points of layers 2 or 3 in the block, by which other sizes find their corners?
    pub marked: bool,
    /// Lines of layer 1, chained, the longest first.
    pub lines: Vec<Path>,
    /// The reasons, each an error with its place.
    pub faults: Vec<Diagnostic>,
}

/// Facts of sound pieces and of refused ones, each with the line of its block, in the order of the file.
pub(crate) fn in_file_order<T>(
    sound: impl IntoIterator<Item = (u64, T)>,
    refused: impl IntoIterator<Item = (u64, T)>,
) -> Vec<T> {
    let mut all: Vec<(u64, T)> = sound.into_iter().chain(refused).collect();
    all.sort_by_key(|fact| fact.0);
    all.into_iter().map(|fact| fact.1).collect()
}

impl RefusedPiece {
    /// The piece of a sheet, with the texts that were read from it.
    pub(crate) fn new(block: &str, line: u64, sheet: Sheet, [name, size]: [Option<String>; 2]) -> Self {
        let marked = !(sheet.turn.is_empty() && sheet.curve.is_empty());
        let chained = chain::chain(sheet.boundary, 0.0);
        let mut lines: Vec<Path> = chained.closed.into_iter().chain(chained.open).collect();
        let length = |p: &Path| geom::length(&p.positions(), p.closed);
        lines.sort_by(|a, b| length(b).total_cmp(&length(a)));
        Self { block: block.to_owned(), line, name, size, marked, lines, faults: Vec::new() }
    }

    /// Piece name, or the block's.
    #[must_use]
    pub fn label(&self) -> &str {
        self.name.as_deref().filter(|n| !n.is_empty()).unwrap_or(&self.block)
    }

    /// Vertices of its longest line.
    #[must_use]
    pub fn positions(&self) -> Vec<Vec2> {
        self.lines.first().map(Path::positions).unwrap_or_default()
    }
}
