//! The engine and command line of toile.

pub mod pipeline;
