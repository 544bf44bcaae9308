//! The pipeline of a fitted garment: that of the style, with the new pattern, the new body, and copies of its files.

use super::codes::{FIT_NO_DRAPE, FIT_NO_MESH_STAGE};
use super::{PATTERN_NAME, SEWING_NAME};
use crate::engine::{Exit, Gate, MAX_INPUT, of_file_error, read_limited};
use crate::halt::Halt;
use crate::load::{self, Request};
use crate::pipeline::{FileRole, Pipeline, SchemaTree, Step};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use toile_garment::{Aspect, Diagnostic};
use toile_stage_api::{AnyStage, Registry};
use toml::de::ValueDeserializer;

/// The key of the stage that reads the body.
const BODY_KEY: &str = "body";
/// The stage that reads the written pattern.
pub const IMPORT: &str = "import-dxf";

/// The text of the pipeline, and the files that it reads beside pattern and body.
pub struct Copied {
    /// The text.
    pub text: String,
    /// Names and contents.
    pub files: Vec<(String, Vec<u8>)>,
}

/// Copies a pipeline for a working folder. All values stand in it as they were run, without inputs and overrides.
///
/// # Errors
/// When the pipeline is wrong, has nothing to mesh or to drape, or a file cannot be read. Stages of other programs must be
/// connected.
pub fn copied(request: &Request, body: &str, registry: &Registry) -> Result<Copied, Halt> {
    let loaded = load::reload(request, registry);
    if loaded.report.has_errors() {
        return Err(Halt::of(loaded));
    }
    let (Some(pipeline), Some(gate)) = (&loaded.pipeline, &loaded.gate) else { return Err(Halt::of(loaded)) };
    let from = first_kept(pipeline).map_err(Halt::usage)?;
    let mut files = Vec::new();
    let mut stages = vec![json!({ "use": IMPORT, "with": { "file": PATTERN_NAME, "sewing": SEWING_NAME } })];
    for step in &pipeline.steps[from..] {
        let name = step.ready.info().name;
        // The chain was read by the stages of this registry, so each is there.
        if let Some(stage) = registry.get(&name) {
            stages.push(copied_step(step, stage, gate, body, &mut files)?);
        }
    }
    let head = json!({ "line": pipeline.line, "version": pipeline.version, "seed": pipeline.seed });
    let document = json!({ "toile": 1, "pipeline": head, "stage": stages });
    let text = toml::to_string(&document).map_err(|e| {
        let finding = Diagnostic::error(crate::codes::WRITE_FAILED, format!("the pipeline cannot be written: {e}"));
        Halt::new(vec![finding], Exit::System)
    })?;
    Ok(Copied { text, files })
}

/// The first stage that the written pattern does not replace: the one that meshes it.
fn first_kept(pipeline: &Pipeline<'_>) -> Result<usize, Diagnostic> {
    let gives = |aspect: Aspect| pipeline.steps.iter().position(|s| s.ready.info().gives.contains(&aspect));
    if gives(Aspect::Drape).is_none() {
        let message = format!("`{}` drapes nothing, so there is no garment to be fitted", pipeline.line);
        return Err(Diagnostic::error(FIT_NO_DRAPE, message).hint("add `use = \"drape\"` to the chain"));
    }
    let meshes = pipeline.steps.iter().position(|s| {
        let info = s.ready.info();
        info.gives.contains(&Aspect::Mesh) && info.needs.contains(&Aspect::Pieces)
    });
    meshes.ok_or_else(|| {
        let message =
            format!("`{}` meshes no pieces, so no other pattern can take the place of its own", pipeline.line);
        Diagnostic::error(FIT_NO_MESH_STAGE, message).hint("begin the chain with `import-dxf` and `triangulate`")
    })
}

fn copied_step(
    step: &Step<'_>,
    stage: &dyn AnyStage,
    gate: &Gate,
    body: &str,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Result<Value, Halt> {
    let mut params = without_defaults(stage, step.ready.params());
    for file in SchemaTree::of(stage).files(&params) {
        if file.role == FileRole::Output {
            continue;
        }
        let name = if file.keys == [BODY_KEY] { body.to_owned() } else { copied_file(&file.text, gate, files)? };
        if let Some(at) = params.pointer_mut(&format!("/{}", file.keys.join("/"))) {
            *at = Value::String(name);
        }
    }
    let name = step.ready.info().name.into_owned();
    let mut table = json!({ "use": name });
    if step.id != name {
        table["id"] = Value::String(step.id.clone());
    }
    if params.as_object().is_some_and(|p| !p.is_empty()) {
        table["with"] = params;
    }
    Ok(table)
}

/// A file that the pipeline reads: its full path, and its content.
///
/// # Errors
/// When the gate or the disk refuses it.
pub fn input_of(path: &Path, gate: &Gate) -> Result<(PathBuf, Vec<u8>), Halt> {
    let refused = |error| {
        let (findings, exit) = of_file_error(&error);
        Halt::new(findings.into_iter().collect(), exit)
    };
    let real = gate.input(path).map_err(refused)?;
    let bytes = read_limited(path, &real, MAX_INPUT).map_err(refused)?;
    Ok((real, bytes))
}

/// Puts a file beside the pipeline; two of one name get numbers.
fn copied_file(text: &str, gate: &Gate, files: &mut Vec<(String, Vec<u8>)>) -> Result<String, Halt> {
    let (real, bytes) = input_of(Path::new(text), gate)?;
    let own = real.file_name().map_or_else(|| "file".to_owned(), |n| n.to_string_lossy().into_owned());
    let free = (1..).map(|k| if k == 1 { own.clone() } else { format!("{k}-{own}") });
    for name in free {
        match files.iter().find(|(taken, _)| *taken == name) {
            Some((_, content)) if *content == bytes => return Ok(name),
            Some(_) => {}
            None => {
                files.push((name.clone(), bytes));
                return Ok(name);
            }
        }
    }
    Ok(own)
}

/// The parameters that differ from what the stage takes without them.
fn without_defaults(stage: &dyn AnyStage, params: Value) -> Value {
    let Value::Object(all) = without_nulls(params) else { return Value::Object(Map::new()) };
    let wanted = read(stage, &all);
    let mut kept = all.clone();
    for key in all.keys() {
        let mut less = kept.clone();
        less.remove(key);
        if wanted.is_some() && read(stage, &less) == wanted {
            kept = less;
        }
    }
    Value::Object(kept)
}

fn read(stage: &dyn AnyStage, params: &Map<String, Value>) -> Option<Value> {
    let table = toml::Value::try_from(params).ok()?;
    let text = table.to_string();
    Some(stage.configure(ValueDeserializer::parse(&text).ok()?).ok()?.params())
}

fn without_nulls(value: Value) -> Value {
    match value {
        Value::Object(map) => {
            let kept = map.into_iter().filter(|(_, v)| !v.is_null());
            Value::Object(kept.map(|(k, v)| (k, without_nulls(v))).collect())
        }
        Value::Array(items) => Value::Array(items.into_iter().map(without_nulls).collect()),
        other => other,
    }
}
