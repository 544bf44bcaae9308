//! The files by the systems whose habits they show.

mod chinese;
mod drawing;
mod european;
pub mod facts;
mod open_source;
mod optitex;
pub mod writer;

use facts::Case;

/// All files.
pub fn all() -> Vec<Case> {
    [optitex::cases(), european::cases(), open_source::cases(), chinese::cases(), drawing::cases()].concat()
}
