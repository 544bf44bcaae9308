//! The words of protocol 1.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toile_garment::{Aspect, Diagnostic};

/// Version of the protocol.
pub const PROTOCOL: u32 = 1;

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
}

/// What `run` reads from stdin.
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
}

/// One line on stdout of `run`.
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
}
