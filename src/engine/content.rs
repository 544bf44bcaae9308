//! The content of a run before it runs: what it reads, and the key that says whether two runs give the same.

use super::files::{FileRead, TracedFiles};
use super::foresight::{Foresight, look_ahead};
use super::gate::Gate;
use super::preflight::planned_inputs;
use super::stop::Stop;
use crate::pipeline::Pipeline;
use serde_json::{Value, json};
use std::path::Path;
use std::sync::OnceLock;
use toile_garment::provenance::InputRecord;
use toile_stage_api::Files as _;

/// The program: its version, and a digest of its own file where that can be read. Two builds of one version differ.
#[must_use]
pub fn program() -> &'static str {
    static PROGRAM: OnceLock<String> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        let own = std::env::current_exe().and_then(std::fs::File::open);
        // Piece by piece: the whole file would be 30 MB of memory.
        let digest = own.and_then(|file| Ok(blake3::Hasher::new().update_reader(file)?.finalize().to_hex()));
        digest
            .map(|digest| digest[..16].to_owned())
            .map_or_else(|_| VERSION.to_owned(), |digest| format!("{VERSION}+{digest}"))
    })
}

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Everything that is known of a run before it runs.
pub struct Content {
    /// Cost, mesh, effects, and mistakes in the files.
    pub foresight: Foresight,
    /// Files that it reads or looks for, in the order of the chain.
    pub reads: Vec<FileRead>,
}

impl Content {
    /// Looks ahead along a chain. Files that no stage has asked for yet are read because the parameters name them.
    #[must_use]
    pub fn of(pipeline: &Pipeline<'_>, gate: &Gate, stop: &Stop) -> Self {
        let mut files = TracedFiles::new(gate);
        let foresight = look_ahead(pipeline, &mut files, stop);
        for input in planned_inputs(&pipeline.steps) {
            // A missing one is a finding already.
            drop(files.read(Path::new(&input.text)));
        }
        for path in &pipeline.beside {
            drop(files.read_optional(path));
        }
        Self { foresight, reads: files.into_seen() }
    }

    /// Key and files for the record. The pieces, the mesh and the body that were foreseen are given up.
    #[must_use]
    pub fn into_foreseen(self, pipeline: &Pipeline<'_>) -> (String, Vec<FileRead>) {
        (self.key(pipeline), self.reads)
    }

    /// Key of the outputs: two runs with one key write the same bytes.
    #[must_use]
    pub fn key(&self, pipeline: &Pipeline<'_>) -> String {
        let reads: Vec<Value> = self.reads.iter().map(|r| json!([Gate::shown(&r.path), r.blake3])).collect();
        digest(&json!([program(), chain(pipeline), reads]))
    }
}

/// The parts of a chain that decide its outputs, apart from files: names, revisions and full parameters of the stages,
/// and the contents of programs.
#[must_use]
pub fn chain(pipeline: &Pipeline<'_>) -> Value {
    let step = |s: &crate::pipeline::Step<'_>| {
        let info = s.ready.info();
        json!({ "use": info.name, "id": s.id, "revision": info.revision, "params": s.ready.params() })
    };
    let steps: Vec<Value> = pipeline.steps.iter().map(step).collect();
    let programs: Vec<[&String; 2]> = pipeline.contents.iter().map(|c| [&c.plugin, &c.content]).collect();
    json!([format!("{} v{}", pipeline.line, pipeline.version), pipeline.seed, steps, programs])
}

/// Digest of a JSON value, hex.
#[must_use]
pub fn digest(value: &Value) -> String {
    blake3::hash(value.to_string().as_bytes()).to_hex().to_string()
}

/// Does a file still have the content that a run has read?
#[must_use]
pub fn is_unchanged(input: &InputRecord, gate: &Gate) -> bool {
    let bytes = TracedFiles::new(gate).read_optional(Path::new(&input.path)).ok().flatten();
    bytes.is_some_and(|bytes| blake3::hash(&bytes).to_hex().as_str() == input.blake3)
}
