//! The origin of a garment, written by the engine and read by reports. It holds no clock and no name of a machine.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One stage that ran.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageRecord {
    /// Stage name.
    pub stage: String,
    /// Id in the pipeline.
    pub id: String,
    /// Revision of the stage's code.
    pub revision: u32,
    /// Full parameters, defaults included.
    pub params: serde_json::Value,
}

/// An input file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct InputRecord {
    /// Path as the pipeline names it.
    pub path: String,
    /// blake3 of its bytes, hex.
    pub blake3: String,
}

/// The history of a garment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Provenance {
    /// Program version.
    pub toile: String,
    /// Product line and version of the pipeline.
    pub pipeline: String,
    /// Seed.
    pub seed: u64,
    /// Inputs read.
    pub inputs: Vec<InputRecord>,
    /// Stages run.
    pub stages: Vec<StageRecord>,
}
