//! A stage of another program, behind the same trait as the built-in ones.

use super::codes;
use super::forecast;
use super::process::{Ended, ProcessError, Program};
use super::protocol::{Description, Line, OLDEST_PROTOCOL, PROTOCOL, Request, StageDescription};
use crate::engine::{MAX_INPUT, Stop, read_limited};
use schemars::{Schema, SchemaGenerator};
use serde::Deserialize as _;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_garment::bundle::{FILE_NAME, from_text, to_text};
use toile_garment::{Aspect, Code, Diagnostic, Garment, Report, SourceRef};
use toile_stage_api::{AnyStage, Cost, Forecast, Knob, MeshSize, ReadyStage, StageContext, StageError, StageInfo};

/// Most stages of one program.
const MAX_STAGES: usize = 100;
/// Most findings that are taken from one stage.
const MAX_FINDINGS: usize = 1000;
/// Most letters of one text of a plugin.
const MAX_TEXT: usize = 2000;

/// A stage of another program.
pub struct ExternalStage {
    pub(super) program: Program,
    pub(super) protocol: u32,
    pub(super) info: StageInfo,
    schema: Value,
    knobs: Vec<Knob>,
    pub(super) forecasts: bool,
}

/// Asks a program for its stages.
pub(super) fn describe(program: &Program, plugin: &str) -> Result<Vec<ExternalStage>, String> {
    let (ended, answer) = program.describe().map_err(|e| e.to_string())?;
    if !ended.status.success() {
        return Err(format!("`describe` ended with {}: {}", ended.status, ended.stderr));
    }
    let description: Description =
        serde_json::from_slice(&answer).map_err(|e| format!("its description is wrong: {e}"))?;
    let protocol = description.protocol;
    if !(OLDEST_PROTOCOL..=PROTOCOL).contains(&protocol) {
        return Err(format!("it speaks protocol {protocol}, this program speaks {OLDEST_PROTOCOL} to {PROTOCOL}"));
    }
    if description.stages.len() > MAX_STAGES {
        return Err(format!("it declares more than {MAX_STAGES} stages"));
    }
    let stage = |stage| ExternalStage::new(program.clone(), protocol, stage, plugin);
    description.stages.into_iter().map(stage).collect()
}

impl ExternalStage {
    fn new(program: Program, protocol: u32, described: StageDescription, plugin: &str) -> Result<Self, String> {
        let short = described.name.strip_prefix(plugin).and_then(|s| s.strip_prefix('.'));
        let good =
            |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-');
        if !short.is_some_and(good) {
            return Err(format!("its stage `{}` must be called `{plugin}.name`", crate::render::safe(&described.name)));
        }
        if !described.params_schema.is_object() {
            return Err(format!("the schema of `{}` is no object", described.name));
        }
        let info = StageInfo {
            name: described.name.into(),
            summary: described.summary.into(),
            needs: described.needs.into(),
            gives: described.gives.into(),
            revision: described.revision,
            reads_outdated: false,
        };
        // Protocol 1 has no words for these.
        let knobs = if protocol >= 2 { described.knobs } else { Vec::new() };
        let forecasts = protocol >= 2 && described.forecast;
        Ok(Self { program, protocol, info, schema: described.params_schema, knobs, forecasts })
    }
}

impl AnyStage for ExternalStage {
    fn info(&self) -> StageInfo {
        self.info.clone()
    }

    fn knobs(&self) -> &[Knob] {
        &self.knobs
    }

    fn schema(&self, _: &mut SchemaGenerator) -> Schema {
        Schema::try_from(self.schema.clone()).unwrap_or_default()
    }

    fn configure<'a>(
        &'a self,
        params: toml::de::ValueDeserializer<'_>,
    ) -> Result<Box<dyn ReadyStage + 'a>, toml::de::Error> {
        let params = Value::deserialize(params)?;
        Ok(Box::new(Ready { stage: self, params }))
    }
}

pub(super) struct Ready<'a> {
    pub(super) stage: &'a ExternalStage,
    params: Value,
}

impl ReadyStage for Ready<'_> {
    fn info(&self) -> StageInfo {
        self.stage.info()
    }

    fn knobs(&self) -> &[Knob] {
        &self.stage.knobs
    }

    fn params(&self) -> Value {
        self.params.clone()
    }

    fn forecast(&self, forecast: &mut Forecast, cx: &mut StageContext<'_>) -> Result<Option<Cost>, StageError> {
        let asked = if self.stage.forecasts { forecast::ask(self, forecast, cx) } else { Ok(None) };
        if self.stage.info.gives.contains(&Aspect::Flat) {
            forecast.garment.flat.get_or_insert_default();
        }
        asked
    }

    fn check(&self, _: &Garment, _: &mut Report) {}

    fn run(&self, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let desk = Desk::lay(&garment, self.stage.program.stop())?;
        self.talk("run", &self.request(&desk, None, cx)?, &desk, cx, &mut |_| {})?;
        let mut back = self.read_back(&desk.output.join(FILE_NAME))?;
        // The engine alone writes the history.
        back.provenance = garment.provenance;
        self.check_gives(&back)?;
        Ok(back)
    }
}

/// The folders through which garments go to the program and back; they are gone with the last use.
pub(super) struct Desk {
    folder: tempfile::TempDir,
    stop: Arc<Stop>,
    input: PathBuf,
    pub(super) output: PathBuf,
}

impl Desk {
    /// Lays a garment into a fresh input folder.
    pub(super) fn lay(garment: &Garment, stop: &Arc<Stop>) -> Result<Self, StageError> {
        let folder = tempfile::Builder::new().prefix("toile-plugin-").tempdir().map_err(|e| system(&e.to_string()))?;
        stop.add_litter(folder.path());
        let stop = Arc::clone(stop);
        let (input, output) = (folder.path().join("in"), folder.path().join("out"));
        for dir in [&input, &output] {
            std::fs::create_dir(dir).map_err(|e| system(&e.to_string()))?;
        }
        let text = to_text(garment).map_err(|e| StageError::Internal(e.to_string()))?;
        std::fs::write(input.join(FILE_NAME), text).map_err(|e| system(&e.to_string()))?;
        Ok(Self { folder, stop, input, output })
    }
}

impl Drop for Desk {
    fn drop(&mut self) {
        self.stop.forget_litter(self.folder.path());
    }
}

impl Ready<'_> {
    /// The request in the words of the program's own protocol.
    pub(super) fn request(
        &self,
        desk: &Desk,
        mesh: Option<MeshSize>,
        cx: &StageContext<'_>,
    ) -> Result<Vec<u8>, StageError> {
        let request = Request {
            protocol: self.stage.protocol,
            stage: self.stage.info.name.to_string(),
            params: self.params.clone(),
            input: desk.input.clone(),
            output: desk.output.clone(),
            seed: cx.seed,
            mesh,
        };
        serde_json::to_vec(&request).map_err(|e| StageError::Internal(e.to_string()))
    }

    /// Starts the program and listens to the end; `told` hears the lines that are neither progress nor findings.
    pub(super) fn talk(
        &self,
        verb: &str,
        request: &[u8],
        desk: &Desk,
        cx: &mut StageContext<'_>,
        told: &mut dyn FnMut(Line),
    ) -> Result<(), StageError> {
        let mut wrong: Option<String> = None;
        let mut rejections = Vec::new();
        let mut heard = 0;
        let ended =
            self.stage.program.ask(verb, request, desk.folder.path(), &mut |line| match serde_json::from_slice(line) {
                Ok(Line::Progress { done, total, words }) => {
                    cx.progress.update(done, total, &crate::render::safe(&shortened(words)));
                }
                Ok(Line::Diagnostic(finding)) => {
                    let finding = in_short(finding);
                    heard += 1;
                    if heard > MAX_FINDINGS {
                        // Only counted.
                    } else if finding.severity == toile_garment::Severity::Error {
                        rejections.push(finding);
                    } else {
                        cx.report.push(finding);
                    }
                }
                Ok(line) if self.stage.forecasts => told(line),
                Ok(_) => drop(wrong.get_or_insert("it tells a forecast, which it did not declare".to_owned())),
                Err(error) => {
                    let line = String::from_utf8_lossy(&line[..line.len().min(80)]).into_owned();
                    wrong.get_or_insert(format!(
                        "the line `{}` is not of protocol {}: {error}",
                        crate::render::safe(&line),
                        self.stage.protocol
                    ));
                }
            });
        let ended = ended.map_err(|e| self.process_error(&e))?;
        if heard > MAX_FINDINGS {
            let message = format!(
                "plugin stage `{}` told {heard} findings; those after the first {MAX_FINDINGS} were left out",
                self.stage.info.name
            );
            cx.report.push(Diagnostic::warning(codes::PLUGIN_FINDINGS_LEFT_OUT, message));
        }
        match wrong {
            Some(wrong) => Err(self.input(codes::PLUGIN_PROTOCOL, wrong)),
            None => self.judge(&ended, rejections),
        }
    }

    fn judge(&self, ended: &Ended, mut rejections: Vec<Diagnostic>) -> Result<(), StageError> {
        match ended.status.code() {
            Some(0) if rejections.is_empty() => Ok(()),
            Some(0 | 2) => {
                if rejections.is_empty() {
                    let message = format!("`{}` rejected the garment without saying why", self.stage.info.name);
                    rejections.push(Diagnostic::error(codes::PLUGIN_REJECTED, message));
                }
                Err(StageError::Input(rejections))
            }
            _ => {
                let said = if ended.stderr.is_empty() { String::new() } else { format!("; it said: {}", ended.stderr) };
                rejections
                    .push(Diagnostic::error(codes::PLUGIN_FAILED, format!("it ended with {}{said}", ended.status)));
                Err(StageError::Input(rejections))
            }
        }
    }

    fn process_error(&self, error: &ProcessError) -> StageError {
        match error {
            ProcessError::Stopped => StageError::Cancelled,
            other => self.input(codes::PLUGIN_FAILED, other.to_string()),
        }
    }

    pub(super) fn read_back(&self, path: &Path) -> Result<Garment, StageError> {
        let kind = |path: &Path| std::fs::symlink_metadata(path).map(|m| m.file_type()).ok();
        if !path.parent().and_then(kind).is_some_and(|k| k.is_dir()) {
            let reason = "its output folder is gone, or something else has taken its place; write into it as it is";
            return Err(self.input(codes::PLUGIN_PROTOCOL, reason.to_owned()));
        }
        if !kind(path).is_some_and(|k| k.is_file()) {
            return Err(self.input(codes::PLUGIN_PROTOCOL, format!("it wrote no {FILE_NAME} into its output folder")));
        }
        let bytes = read_limited(Path::new(FILE_NAME), path, MAX_INPUT)?;
        let text = String::from_utf8(bytes).map_err(|e| self.input(codes::PLUGIN_PROTOCOL, e.to_string()))?;
        from_text(&text).map_err(|e| self.input(codes::PLUGIN_PROTOCOL, e.to_string()))
    }

    fn check_gives(&self, garment: &Garment) -> Result<(), StageError> {
        let missing = self.stage.info.gives.iter().find(|a| !garment.has(**a));
        match missing {
            Some(aspect) => {
                Err(self.input(codes::PLUGIN_PROTOCOL, format!("it promised {aspect:?} and did not give it")))
            }
            None => Ok(()),
        }
    }

    pub(super) fn input(&self, code: Code, message: String) -> StageError {
        StageError::input(Diagnostic::error(code, format!("plugin stage `{}`: {message}", self.stage.info.name)))
    }
}

/// A text of a plugin, up to its longest.
fn shortened(mut text: String) -> String {
    let count = text.chars().count();
    if let Some((end, _)) = text.char_indices().nth(MAX_TEXT) {
        text.truncate(end);
        text.push_str(&format!("… ({} more letters of the plugin were left out)", count - MAX_TEXT));
    }
    text
}

/// A finding of a plugin with all its texts up to their longest.
fn in_short(mut finding: Diagnostic) -> Diagnostic {
    let place = |s: SourceRef| SourceRef {
        file: shortened(s.file),
        block: s.block.map(shortened),
        layer: s.layer.map(shortened),
        ..s
    };
    finding.code = shortened(finding.code);
    finding.message = shortened(finding.message);
    finding.hint = finding.hint.map(shortened);
    finding.source = finding.source.map(place);
    finding
}

fn system(message: &str) -> StageError {
    StageError::File(toile_stage_api::FileError::Write {
        path: "temporary folder".to_owned(),
        reason: message.to_owned(),
    })
}
