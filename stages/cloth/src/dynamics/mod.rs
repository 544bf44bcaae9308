//! Motion in time for animation (docs/dynamics.md): implicit steps, each a descent of the same energy and contact as
//! the drape with inertia added, and a body that moves; for comparison also explicit ones.

mod air;
mod carry;
pub(crate) mod explicit;
mod figures;
mod impact;
mod motion;
mod run;
mod scheme;
mod stage;

pub use motion::{Dynamics, Frame, Motion, Trip};
pub(crate) use run::film;
