//! Checks for statements of a file that cannot all be meant. Each looks at pieces that are read, and only reports.

pub(crate) mod codes;
mod cutouts;
mod marks;
mod nest;

use super::desk::Desk;
use super::piece::{DrawnPiece, RefusedPiece};

/// All checks of the pieces of a file.
pub(super) fn pieces(pieces: &[DrawnPiece], refused: &[RefusedPiece], sample: Option<&str>, desk: &mut Desk<'_>) {
    for piece in pieces {
        cutouts::check(piece, desk);
        marks::check(piece, desk);
    }
    nest::check(pieces, refused, sample, desk);
}
