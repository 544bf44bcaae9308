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
//! | `evidence.rs` | the table of evidence for and against, each row with its points |
//! | `decide.rs` | the decision by points: dart, undecided, or none |
//! | `insert.rs` | wedges into which another piece's point fits: godets |
//! | `declare.rs` | undecided darts, finding `dart-undecided`, with the lines of the sewing file |
//! | `drill.rs` | drill holes and notches without lines: candidates, finding `dart-candidate` |
//! | `pleat.rs` | pairs of fold lines: told and not made, finding `pleat-candidate` |
//! | `neckline.rs` | wedges in the middle of a whole piece that are V necklines |
//! | `legs_differ.rs` | legs of different length, finding `dart-legs-differ` |
//! | `dart.rs` | the dart as drawn, and what was denied |
//!
//! Shape alone makes no dart: the search gathers all that may be one, and evidence decides. For a dart speak an angle
//! that slits do not have, lines drawn as legs, notches, a drill hole, a cap, a word, legs of one length, a sibling and
//! another size. Unequal legs, the shape of a slit, the habit of the file, another word and an insert speak against it.
//!
//! A look-alike that is denied becomes the finding `wedge-not-a-dart` or stands in `not_darts` of `inspect`.

mod blunt;
pub(crate) mod codes;
mod dart;
mod decide;
mod declare;
mod drill;
mod evidence;
mod insert;
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

pub use dart::{Denied, DrawnDart, Evidence, Form};
pub(super) use decide::decide;
pub use declare::UndecidedDart;
pub use pleat::Pleat;
