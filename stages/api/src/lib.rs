//! The interface of a stage: trait, context, registry. All that an outside stage depends on.
//!
//! A stage is a type that implements [`Stage`]; it is registered with one line in a [`Registry`]. The engine stores
//! it as [`AnyStage`], parses all parameters and checks the needs/gives chain before the first stage runs.

mod any;
mod context;
mod error;
mod forecast;
mod knob;
mod registry;
mod stage;

pub use any::{AnyStage, ReadyStage};
pub use context::{FileError, Files, Progress, StageContext};
pub use error::{Errors, StageError};
pub use forecast::{Cost, EdgeLengths, Forecast, MeshSize};
pub use knob::{Knob, Meaning};
pub use registry::{Registry, RegistryError};
pub use stage::{Stage, StageInfo};
pub use toile_garment as garment;
