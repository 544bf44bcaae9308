//! Between garment words and the solver's plain arrays: the one place where both are known.

mod fabric;
pub mod scene;
pub mod watch;

pub use scene::{Layout, scene};
pub use watch::{Follow, failure};
