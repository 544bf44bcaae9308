//! Seams proposed from the pieces alone: one assignment over the whole garment.
//!
//! The outlines are cut into [atoms] at corners, notches and darts. Every pair of atoms has a score: length,
//! course, grain, marks, sides. A garment has one too: how corners meet, whether all pieces hang together, which
//! openings stay. A search looks for the garment of the highest score.

pub mod assignment;
pub mod atoms;
mod bands;
mod buttons;
pub(crate) mod confidence;
mod cuts;
mod edge_parts;
mod hems;
mod knowledge;
mod known;
mod layout;
mod legs;
mod likely;
pub mod mirror;
mod missing;
mod names;
mod onward;
mod openings;
pub mod pairs;
mod pleats;
mod profile;
mod propose;
mod random;
mod seams;
pub mod search;
mod sleeves;
mod task;
pub mod tuning;
pub mod whole;
mod written;

pub use buttons::{ButtonFront, button_fronts};
pub use edge_parts::EdgePart;
pub use known::Known;
pub use names::RoleNames;
pub use pleats::pleats;
pub use propose::{Bare, Nameless, Names, Proposal, own_images, propose};
pub use seams::{ProposedSeam, Run};
pub use written::written;

#[cfg(test)]
mod construction_tests;
#[cfg(test)]
mod tests;
