//! DXF pattern files: AAMA-292 and ASTM D6673 with one reader.
//!
//! [`read`] gives the pieces as drawn (millimetres, block coordinates) with a ledger of every entity;
//! [`Pattern::to_garment`] chooses or grades a size and gives the garment document (metres); [`inspect`] tells what is
//! in a file.
//! The way of the data: bytes → [`tags`] → [`model`] (faithful) → sheet by layers → pieces → garment.

#![allow(clippy::result_large_err, reason = "a failure ends the reading and carries its place and remedy")]

mod binary;
pub mod chain;
pub(crate) mod checks;
pub(crate) mod codes;
mod contact;
pub mod curve;
pub mod cut_notches;
pub mod darts;
mod desk;
mod entity;
mod findings;
pub mod garment;
pub mod geom;
pub mod grade;
mod groups;
mod header;
mod inspect;
pub mod layers;
pub mod ledger;
mod library;
pub mod limits;
pub mod model;
mod mtext;
pub mod notches;
pub mod outline;
mod parse;
pub(crate) mod pattern;
pub mod piece;
mod rule_doubts;
mod sheet;
mod sizes;
pub mod tags;
mod texts;
mod tolerances;
mod unfold;
mod units;
mod vendor;
pub mod write;

pub use findings::Findings;
pub use inspect::{Inspection, inspect, inspect_with};
pub use library::Census;
pub use pattern::{InsertRule, Pattern, ReadOptions, read};
pub use piece::RefusedPiece;
pub use texts::unit;
pub use tolerances::Tolerances;
pub use units::Units;
pub use vendor::{Profile, Vendor};
#[cfg(test)]
mod tests;
