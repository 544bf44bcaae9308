//! The cases, one file for each letter of the catalogue.

mod contact;
mod drawn;
mod effects;
pub mod elsewhere;
mod grain;
mod large;
mod layers;
mod materials;
mod meshes;
mod motion;
pub mod not_yet;
mod numbers;
mod scale;
mod seams;
mod starts;
mod symmetry;

use crate::case::Case;

/// All cases, in the order of the catalogue.
pub fn all() -> Vec<Case> {
    let mut list = Vec::new();
    list.extend(meshes::cases());
    list.extend(materials::cases());
    list.extend(numbers::cases());
    list.extend(seams::cases());
    list.extend(grain::cases());
    list.extend(starts::cases());
    list.extend(layers::cases());
    list.extend(contact::cases());
    list.extend(motion::cases());
    list.extend(drawn::cases());
    list.extend(large::cases());
    list.extend(scale::cases());
    list.extend(symmetry::cases());
    list.extend(effects::cases());
    list
}
