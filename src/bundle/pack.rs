//! Packs all that a run read.

use super::archive;
use super::check::{MAX_BUNDLE, MAX_FILES, is_plain};
use super::codes;
use super::manifest::{FORM, MANIFEST_NAME, Manifest, PackedFile, ROOT_MARK};
use crate::engine::{
    Content, Exit, Gate, MAX_INPUT, OutputRecord, RECORD_NAME, Stop, clean, read_limited, read_record,
};
use crate::halt::Halt;
use crate::load::{self, Request};
use crate::pipeline::Pipeline;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use toile_garment::provenance::InputRecord;
use toile_garment::{Code, Diagnostic, SourceRef};
use toile_stage_api::Registry;

/// Which run, and what its pipeline may do.
#[derive(Clone, Debug, Default)]
pub struct Order {
    /// Folder of the run, or its record.
    pub run: PathBuf,
    /// Pipeline file, if it is not where the record says.
    pub pipeline: Option<PathBuf>,
    /// Further folders that it may read.
    pub allow_read: Vec<PathBuf>,
    /// Plugins that it may run.
    pub allow_run: Vec<String>,
}

/// A bundle that is ready to be written.
pub struct Packed {
    /// Its list.
    pub manifest: Manifest,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// Real paths of the files in it.
    pub inputs: Vec<PathBuf>,
}

/// The parts of a record that a bundle needs.
struct Run {
    record: Value,
    pipeline: InputRecord,
    inputs: Vec<InputRecord>,
    outputs: Vec<OutputRecord>,
}

/// Packs a run.
///
/// # Errors
/// When it is no run, its pipeline cannot be opened, or a file has changed since.
pub fn pack(order: &Order, stop: &Arc<Stop>, registry: &mut Registry) -> Result<Packed, Halt> {
    let run = open_run(&order.run).map_err(|finding| Halt::new(vec![finding], Exit::Input))?;
    let request = request(order, &run);
    let loaded = load::load(&request, stop, registry);
    let exit = loaded.exit();
    let source = loaded.text().map(|(file, text)| (file.to_owned(), text.to_owned()));
    let (Exit::Good, Some(pipeline), Some(gate)) = (exit, &loaded.pipeline, &loaded.gate) else {
        let hint = "paths of a run start where it was started: work there, or name the pipeline with --pipeline";
        let findings = loaded.report.findings.into_iter();
        let hinted = findings.map(|f| if f.hint.is_none() { f.hint(hint) } else { f });
        return Err(Halt { findings: hinted.collect(), source, exit });
    };
    let content = Content::of(pipeline, gate, stop);
    let mut collected = Collected::new(gate, pipeline, &request.file);
    collected.pipeline(&run.pipeline, source.map(|(_, text)| text.into_bytes()).unwrap_or_default());
    collected.inputs(&run, &content);
    collected.programs();
    let (placed, wrong) = (collected.placed(), collected.wrong);
    if !wrong.is_empty() {
        let changed = wrong.iter().all(|f| f.code == codes::BUNDLE_INPUT_CHANGED);
        return Err(Halt::new(wrong, if changed { Exit::Input } else { Exit::Usage }));
    }
    build(&run, &request, pipeline, placed)
}

fn open_run(path: &Path) -> Result<Run, Diagnostic> {
    let wrong = |why: String| {
        let finding = Diagnostic::error(codes::BUNDLE_NO_RUN, format!("`{}` is no run: {why}", clean(path)));
        finding.at(SourceRef::file(clean(path))).hint("give the folder of a run, or its run.json")
    };
    let file = if path.is_dir() { path.join(RECORD_NAME) } else { path.to_path_buf() };
    let mut record = read_record(&file).map_err(wrong)?;
    let bad = |e: serde_json::Error| wrong(e.to_string());
    let mut inputs: Vec<InputRecord> = serde_json::from_value(record["inputs"].take()).map_err(bad)?;
    let outputs: Vec<OutputRecord> = serde_json::from_value(record["outputs"].take()).map_err(bad)?;
    if inputs.is_empty() {
        return Err(wrong("its record names no pipeline".to_owned()));
    }
    let pipeline = inputs.remove(0);
    Ok(Run { record, pipeline, inputs, outputs })
}

fn request(order: &Order, run: &Run) -> Request {
    let set = run.record["set"].as_array().into_iter().flatten().filter_map(Value::as_str);
    Request {
        file: order.pipeline.clone().unwrap_or_else(|| PathBuf::from(&run.pipeline.path)),
        set: set.map(str::to_owned).collect(),
        accuracy: run.record["accuracy"].as_str().map(str::to_owned),
        repeats: run.record["repeats"].as_u64().and_then(|n| u32::try_from(n).ok()),
        allow_read: order.allow_read.clone(),
        allow_run: order.allow_run.iter().cloned().collect(),
        ..Request::default()
    }
}

/// Where a file stands.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    /// On the machine; it keeps its way to the others.
    There(PathBuf),
    /// Below the folder that `--set` gave this name.
    Given(String, PathBuf),
}

/// A file with its bytes.
#[derive(Default)]
struct Taken {
    bytes: Vec<u8>,
    is_program: bool,
    real: Option<PathBuf>,
}

/// The files by their paths in the bundle.
struct Placed {
    files: BTreeMap<String, Taken>,
    pipeline: String,
}

/// The files of a run.
struct Collected<'a> {
    gate: &'a Gate,
    programs: &'a [PathBuf],
    file: PathBuf,
    taken: Vec<(Place, Taken)>,
    wrong: Vec<Diagnostic>,
}

impl<'a> Collected<'a> {
    fn new(gate: &'a Gate, pipeline: &'a Pipeline<'_>, file: &Path) -> Self {
        let file = gate.base().join(file.file_name().unwrap_or_default());
        Self { gate, programs: &pipeline.programs, file, taken: Vec::new(), wrong: Vec::new() }
    }

    fn refuse(&mut self, code: Code, path: &str, why: &str) {
        let finding = Diagnostic::error(code, format!("`{path}` {why}"));
        let hint = if finding.code == codes::BUNDLE_INPUT_CHANGED {
            "run the pipeline again, and pack that run"
        } else {
            "let the pipeline take the file as an input of kind path"
        };
        self.wrong.push(finding.hint(hint));
    }

    fn pipeline(&mut self, record: &InputRecord, bytes: Vec<u8>) {
        if blake3::hash(&bytes).to_hex().as_str() != record.blake3 {
            self.refuse(codes::BUNDLE_INPUT_CHANGED, &record.path, "has changed since the run");
        }
        let taken = Taken { bytes, is_program: false, real: Some(self.file.clone()) };
        self.taken.push((Place::There(self.file.clone()), taken));
    }

    /// Files that the run read, and those that it would have read if it had come so far.
    fn inputs(&mut self, run: &Run, content: &Content) {
        let recorded: BTreeMap<&str, &str> = run.inputs.iter().map(|i| (i.path.as_str(), i.blake3.as_str())).collect();
        let mut paths: Vec<PathBuf> = content.reads.iter().map(|r| r.path.clone()).collect();
        let is_foreseen = |i: &&InputRecord| content.reads.iter().any(|r| Gate::shown(&r.path) == i.path);
        paths.extend(run.inputs.iter().filter(|i| !is_foreseen(i)).map(|i| PathBuf::from(&i.path)));
        for path in paths {
            let name = Gate::shown(&path);
            let real = self.gate.optional_input(&path).ok().flatten();
            let bytes = real.as_ref().and_then(|real| read_limited(&path, real, MAX_INPUT).ok());
            let wanted = recorded.get(name.as_str()).copied();
            match (bytes, wanted) {
                (None, None) => {}
                (None, Some(_)) => self.refuse(codes::BUNDLE_INPUT_CHANGED, &name, "is gone since the run"),
                (Some(bytes), Some(wanted)) if blake3::hash(&bytes).to_hex().as_str() != wanted => {
                    self.refuse(codes::BUNDLE_INPUT_CHANGED, &name, "has changed since the run");
                }
                (Some(bytes), _) => self.take(&path, Taken { bytes, is_program: false, real }),
            }
        }
    }

    /// Files of plugins that stand beside the pipeline.
    fn programs(&mut self) {
        for word in self.programs.iter().filter(|w| w.is_relative()) {
            let path = self.gate.base().join(word);
            if let Ok(bytes) = read_limited(word, &path, MAX_INPUT) {
                self.take(word, Taken { bytes, is_program: true, real: Some(path) });
            }
        }
    }

    fn take(&mut self, path: &Path, taken: Taken) {
        match self.place(path) {
            Some(place) => self.taken.push((place, taken)),
            None => {
                self.refuse(codes::BUNDLE_PATH, &clean(path), "is an absolute path, or leads out of a given folder")
            }
        }
    }

    fn place(&self, path: &Path) -> Option<Place> {
        if let Some((name, rest)) = path.to_str()?.strip_prefix('{').and_then(|t| t.split_once("}/")) {
            let stays = Path::new(rest).components().all(|c| matches!(c, Component::Normal(_)));
            return stays.then(|| Place::Given(name.to_owned(), PathBuf::from(rest)));
        }
        path.is_relative().then(|| self.gate.place(path).ok().map(Place::There)).flatten()
    }

    /// The nearest folder that holds all files is the root of the bundle.
    fn placed(&mut self) -> Placed {
        let mut root = self.gate.base().to_path_buf();
        for (place, _) in &self.taken {
            if let Place::There(path) = place {
                while !path.starts_with(&root) {
                    root.pop();
                }
            }
        }
        let text = |path: &Path| path.strip_prefix(&root).unwrap_or(path).to_string_lossy().replace('\\', "/");
        let mut placed = Placed { files: BTreeMap::new(), pipeline: text(&self.file) };
        for (place, taken) in std::mem::take(&mut self.taken) {
            let path = match &place {
                Place::There(path) => text(path),
                Place::Given(name, rest) => format!("{GIVEN}/{name}/{}", rest.to_string_lossy()),
            };
            let is_mixed = matches!(place, Place::There(_)) && Path::new(&path).starts_with(GIVEN);
            if is_plain(&path) && !is_mixed && path != MANIFEST_NAME && path != ROOT_MARK {
                placed.files.entry(path).or_insert(taken);
            } else {
                self.refuse(codes::BUNDLE_PATH, &path, "has a name that cannot stand in a bundle");
            }
        }
        placed
    }
}

/// Folder of the files that were named by `--set`.
const GIVEN: &str = "given";

fn build(run: &Run, request: &Request, pipeline: &Pipeline<'_>, placed: Placed) -> Result<Packed, Halt> {
    let inputs = placed.files.values().filter_map(|t| t.real.clone()).collect();
    let mut files: BTreeMap<String, Taken> = placed.files;
    files.insert(ROOT_MARK.to_owned(), Taken::default());
    let packed = |(path, taken): (&String, &Taken)| PackedFile {
        path: path.clone(),
        bytes: taken.bytes.len() as u64,
        blake3: blake3::hash(&taken.bytes).to_hex().to_string(),
        program: taken.is_program,
    };
    let manifest = Manifest {
        toile_bundle: FORM,
        program: run.record["program"].as_str().unwrap_or_default().to_owned(),
        key: run.record["key"].as_str().map(str::to_owned),
        pipeline: placed.pipeline,
        set: request.set.iter().map(|set| given(set, pipeline)).collect(),
        accuracy: request.accuracy.clone(),
        repeats: request.repeats,
        files: files.iter().map(packed).collect(),
        exit_code: run.record["exit_code"].as_u64().and_then(|c| u8::try_from(c).ok()).unwrap_or(Exit::System.code()),
        outputs: run.outputs.clone(),
    };
    let refused = |why: String, exit| Halt::new(vec![Diagnostic::error(codes::BUNDLE_PATH, why)], exit);
    let sum: u64 = manifest.files.iter().map(|f| f.bytes).sum();
    if files.len() > MAX_FILES || sum > MAX_BUNDLE {
        return Err(refused(format!("a bundle holds {MAX_FILES} files and 1 GiB at most"), Exit::Input));
    }
    let text = manifest.to_text();
    let list = std::iter::once((MANIFEST_NAME, text.as_bytes()));
    let bytes = archive::write(list.chain(files.iter().map(|(path, taken)| (path.as_str(), taken.bytes.as_slice()))))
        .map_err(|e| refused(format!("a path is too long for a bundle: {e}"), Exit::Usage))?;
    Ok(Packed { manifest, bytes, inputs })
}

/// An override as it is in the bundle: a path leads to the copy of its file.
fn given(set: &str, pipeline: &Pipeline<'_>) -> String {
    let parts = set.split_once('=').map(|(key, value)| (key.trim(), Path::new(value).file_name()));
    match parts {
        Some((key, Some(file))) if pipeline.mounts.contains_key(key) => {
            format!("{key}={GIVEN}/{key}/{}", file.to_string_lossy())
        }
        _ => set.to_owned(),
    }
}
