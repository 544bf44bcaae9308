//! The words of protocol 2, and those of protocol 1 among them.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toile_garment::{Aspect, Diagnostic};
use toile_stage_api::{Knob, MeshSize};

/// Newest version of the protocol.
pub const PROTOCOL: u32 = 2;
/// Oldest version that is still spoken. A program is answered in the version that its description names.
pub const OLDEST_PROTOCOL: u32 = 1;

/// Answer to `describe`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Description {
    /// Version the program speaks.
    pub protocol: u32,
    /// Its stages.
    pub stages: Vec<StageDescription>,
}

/// One stage of a program.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StageDescription {
    /// `plugin.stage`.
    pub name: String,
    /// One line.
    pub summary: String,
    /// Aspects it needs.
    pub needs: Vec<Aspect>,
    /// Aspects it gives.
    pub gives: Vec<Aspect>,
    /// Raised whenever its output changes for the same input.
    pub revision: u32,
    /// Schema of its parameters.
    pub params_schema: serde_json::Value,
    /// Parameters that an asked accuracy may set. Since protocol 2.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub knobs: Vec<Knob>,
    /// The program answers `forecast` for this stage. Since protocol 2.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub forecast: bool,
}

/// The request that `run` and `forecast` read from stdin.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Request {
    /// Version of the protocol.
    pub protocol: u32,
    /// Which stage.
    pub stage: String,
    /// Its parameters.
    pub params: serde_json::Value,
    /// Bundle folder to read.
    pub input: PathBuf,
    /// Bundle folder to write.
    pub output: PathBuf,
    /// Seed.
    pub seed: u64,
    /// Size of the mesh, for `forecast`, as far as an earlier stage could tell it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<MeshSize>,
}

/// One line on stdout of `run` and `forecast`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Line {
    /// How far it is.
    Progress {
        /// Steps done.
        #[serde(default)]
        done: u64,
        /// Steps in all, 0 if unknown.
        #[serde(default)]
        total: u64,
        /// A few words.
        #[serde(default)]
        words: String,
    },
    /// A finding.
    Diagnostic(Diagnostic),
    /// Time and memory that the stage will need. Only `forecast` answers with it. Of several lines the last counts.
    Forecast {
        /// CPU seconds of all threads; without them nothing is foreseen.
        #[serde(default)]
        seconds: Option<f64>,
        /// Memory of the work, MB.
        #[serde(default)]
        mb: f64,
        /// Size of the mesh that the stage makes; without it the mesh stays as it was.
        #[serde(default)]
        mesh: Option<MeshSize>,
    },
}
