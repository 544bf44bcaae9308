//! `run.json`: what ran, how long, with which result. The only output that may hold times and machine facts.

use super::exit::Exit;
use super::files::read_limited;
use crate::pipeline::ProgramContent;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;
use toile_garment::animation::MotionCertificate;
use toile_garment::garment::{Certificate, EffectRecord};
use toile_garment::provenance::InputRecord;
use toile_garment::{Diagnostic, Garment};

/// One stage that ran.
#[derive(Clone, Debug, Serialize)]
pub struct StageRun {
    /// Stage.
    #[serde(rename = "use")]
    pub name: String,
    /// Id.
    pub id: String,
    /// Revision of the stage's code.
    pub revision: u32,
    /// Full parameters.
    pub params: Value,
    /// Wall time.
    pub seconds: f64,
    /// Time of all threads, where the system tells.
    pub cpu_seconds: Option<f64>,
    /// Largest resident memory, MB, where the system tells.
    pub peak_mb: Option<f64>,
    /// Taken from the cache?
    pub cached: bool,
}

/// An output.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OutputRecord {
    /// Below the output folder, forward slashes.
    pub path: String,
    /// Hex digest.
    pub blake3: String,
}

/// Counts of the garment.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct GarmentCounts {
    /// Pieces.
    pub pieces: usize,
    /// Triangles of all pieces.
    pub triangles: usize,
    /// Vertices of all pieces, before welding.
    pub vertices: usize,
    /// Seams, darts and pleats not counted.
    pub seams: usize,
    /// Darts of all pieces.
    pub darts: usize,
}

/// The program and the content of a run.
#[derive(Clone, Debug, Serialize)]
pub struct RunIdentity {
    /// Program version.
    pub toile: String,
    /// The program: its version and a digest of its file.
    pub program: String,
    /// Key of the content that was foreseen: a run with the same key writes the same outputs. It is missing where the
    /// run read a file that nobody foresaw.
    pub key: Option<String>,
    /// Product line and version.
    pub pipeline: String,
}

/// The whole record.
#[derive(Clone, Debug, Serialize)]
pub struct RunRecord {
    /// The program and the content.
    #[serde(flatten)]
    pub identity: RunIdentity,
    /// Status in a word.
    pub status: &'static str,
    /// Exit code.
    pub exit_code: u8,
    /// Overrides of the command line.
    pub set: Vec<String>,
    /// Accuracy of the command line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<String>,
    /// Repeats of the command line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repeats: Option<u32>,
    /// Inputs.
    pub inputs: Vec<InputRecord>,
    /// Seed.
    pub seed: u64,
    /// Threads.
    pub threads: usize,
    /// Wall time of the whole run.
    pub seconds: f64,
    /// Programs of plugins.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub programs: Vec<ProgramContent>,
    /// Stages.
    pub stages: Vec<StageRun>,
    /// Effects of the drape.
    pub effects: Vec<EffectRecord>,
    /// Findings.
    pub findings: Vec<Diagnostic>,
    /// Certificate of the drape.
    pub certificate: Option<Certificate>,
    /// Certificate of the motion, if the garment was moved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionCertificate>,
    /// Counts.
    pub garment: GarmentCounts,
    /// Outputs.
    pub outputs: Vec<OutputRecord>,
}

impl RunRecord {
    /// The record as JSON text.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut text = toile_garment::text::json(&serde_json::to_string_pretty(self).unwrap_or_default());
        text.push('\n');
        text
    }

    /// Sets status and code.
    pub fn end(&mut self, exit: Exit) {
        self.status = exit.word();
        self.exit_code = exit.code();
    }
}

/// Largest record that is read, bytes.
const MAX_RECORD: u64 = 64 << 20;

/// Reads the record of a run.
///
/// # Errors
/// What is wrong with the file, in words.
pub fn read_record(path: &Path) -> Result<Value, String> {
    let bytes = read_limited(path, path, MAX_RECORD).map_err(|e| e.to_string())?;
    let record: Value = serde_json::from_slice(&bytes).map_err(|e| e.to_string())?;
    let is_record = record.get("toile").is_some() && record.get("stages").is_some();
    is_record.then_some(record).ok_or_else(|| "the file is no record of a run".to_owned())
}

impl GarmentCounts {
    /// Counts a garment.
    #[must_use]
    pub fn of(garment: &Garment) -> Self {
        let meshes = || garment.pieces.iter().filter_map(|p| p.mesh.as_ref());
        Self {
            pieces: garment.pieces.len(),
            triangles: meshes().map(|m| m.triangles.len()).sum(),
            vertices: meshes().map(|m| m.rest.len()).sum(),
            seams: garment.seams.iter().filter(|s| !is_dart(s)).count(),
            darts: garment.pieces.iter().map(|p| p.darts.len()).sum(),
        }
    }
}

fn is_dart(seam: &toile_garment::seam::Seam) -> bool {
    !matches!(seam.kind, toile_garment::seam::SeamKind::Seam)
}
