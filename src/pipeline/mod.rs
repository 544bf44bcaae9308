//! The pipeline file: TOML text → checked chain. Every value keeps its line and column, every mistake is collected.
//!
//! Two steps, because stages in other processes must be asked between them: [`parse`] reads the grammar, [`link`]
//! looks the stages up, parses all parameters and matches needs and gives.

mod chain;
pub(crate) mod codes;
mod document;
mod fill;
mod inputs;
mod nearest;
mod overrides;
mod params;
mod plugins;
mod schema_walk;
mod text;
mod tune;

pub use chain::{PathText, Pipeline, Step, link, word};
pub(crate) use codes::{BAD_NAME, MISSING_KEY};
pub use document::{Document, GRAMMAR, MAX_ERRORS, StageEntry, parse};
pub(crate) use document::{Reader, parse_toml};
pub use inputs::{Input, InputKind};
pub use nearest::{nearest, remedy, remedy_of_many};
pub use params::refused_value;
pub use plugins::{Plugin, ProgramContent};
pub use schema_walk::{FileRole, SchemaTree};
pub use text::{MAX_BYTES, SourceText};
pub use tune::{Tuning, cut_behind_drape, knob, offer, tune, turned_by};
