//! How a garment fits: its surface, girths, strain and distance to the body.
//!
//! The garment with its seams closed is a [`Surface`]. Girths of all that a height cuts are [`along`] and [`tape`].
//! The parts of a cut, such as trunk and sleeves, are [`rings`]. Quantities per vertex, for colours, are [`maps`]. All
//! that a report tells is put together by [`measure`].

mod along;
mod balance;
mod bent;
mod edge_names;
mod folds;
mod girth;
mod maps;
mod measures;
pub(crate) mod nearest;
mod points;
mod rings;
mod surface;
mod tailor;

pub use bent::{PAD, bending, pressure, strain_beside_limit, tension};
pub use folds::folds;
pub use girth::{along, tape};
pub use maps::{ease, maps, strain};
pub use measures::{cut_in_plane, inside, level_height, measure};
pub use nearest::Nearest;
pub use points::{point, unknown_names};
pub use rings::{Ring, rings};
pub use surface::{Hem, Surface};
