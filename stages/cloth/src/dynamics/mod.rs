//! Motion in time for animation (docs/dynamics.md): implicit steps, each a descent of the same energy and contact as
//! the drape with inertia added, and a body that moves; for comparison also explicit ones.

pub(crate) mod attachments;
pub(crate) mod drag;
pub(crate) mod figures;
pub(crate) mod impact;
pub(crate) mod motion;
pub(crate) mod run;
pub(crate) mod settle;
pub(crate) mod step;
pub(crate) mod tr_bdf2;
pub(crate) mod tuning;

pub use motion::{Dynamics, Frame, Motion, Trip};
pub(crate) use run::film;
pub(crate) use settle::settle;
