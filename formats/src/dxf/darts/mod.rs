//! Darts: how they are found in a drawing, weighed, and denied. One file per rule, every number in [`thresholds`].
//!
//! | file | rule |
//! |---|---|
//! | `blunt.rs` | two vertices side by side are one apex; done before anything else, finding `dart-apex-blunt` |
//! | `search.rs` | the order of the search in one piece, and the look-alikes that are told |
//! | `legs_test.rs` | the test of two legs: lengths, ratio, angle, mouth |
//! | `wedge.rs` | wedges in the outline, and lenses cut open to the edge |
//! | `marked/` | legs drawn as internal lines; boxes (plackets, flaps, pockets) are denied |
//! | `lens.rs` | fish-eye darts: closed lenses, also in strokes; pocket openings are denied |
//! | `on_fold.rs` | darts of a half piece that the fold cuts in two; necklines on the fold are denied |
//! | `zigzag.rs` | teeth of a zigzag edge are denied |
//! | `evidence.rs` | confidence and evidence of a dart that was found |
//! | `drill.rs` | drill holes and notches without lines: candidates, finding `dart-candidate` |
//! | `pleat.rs` | pairs of fold lines: told and not made, finding `pleat-candidate` |
//! | `neckline.rs` | wedges in the middle of a whole piece that are V necklines |
//! | `deny.rs` | wedges that other pieces or the file's habit deny: godets, slits, vents |
//! | `legs_differ.rs` | legs of different length, finding `dart-legs-differ` |
//! | `dart.rs` | the dart as drawn, and what was denied |
//!
//! A look-alike that is denied becomes the finding `wedge-not-a-dart` or stands in `not_darts` of `inspect`.

mod blunt;
pub(crate) mod codes;
mod dart;
mod deny;
mod drill;
mod evidence;
mod legs_differ;
mod legs_test;
mod lens;
mod marked;
mod neckline;
mod on_fold;
mod pleat;
mod search;
pub mod thresholds;
mod wedge;
mod zigzag;

pub use dart::{Denied, DrawnDart, Form};
pub(super) use deny::deny_inserts_and_unmarked;
pub use pleat::Pleat;
