//! `toile deps`: the files that a pipeline reads and writes, for programs that decide what must be made anew.

use super::args::DepsArgs;
use super::console::Console;
use crate::engine::{Content, Exit, FileRead, Gate, Stop};
use crate::load;
use serde_json::{Value, json};
use std::sync::Arc;
use toile_stage_api::Registry;

pub(super) fn run(args: &DepsArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let loaded = load::load(&args.accuracy.request(&args.pipeline), stop, registry);
    console.findings(&loaded.report.findings, loaded.text());
    let exit = loaded.exit();
    let (Exit::Good, Some(pipeline), Some(gate)) = (exit, &loaded.pipeline, &loaded.gate) else { return exit };
    let content = Content::of(pipeline, gate, stop);
    console.findings(&content.foresight.findings, loaded.text());
    if content.foresight.exit != Exit::Good {
        return content.foresight.exit;
    }
    let outputs = pipeline.steps.iter().flat_map(|s| &s.paths).filter(|p| p.is_output());
    let outputs: Vec<String> = outputs.map(|p| p.text.replacen("{out}/", "", 1)).collect();
    if args.json {
        let reads: Vec<Value> = content.reads.iter().map(|read| input(read, gate)).collect();
        console.json(&json!({
            "pipeline": args.pipeline.pipeline.to_string_lossy(),
            "key": content.key(pipeline),
            "inputs": reads,
            "outputs": outputs,
        }));
        return Exit::Good;
    }
    let mut text = format!("reads  {}\n", args.pipeline.pipeline.to_string_lossy());
    for read in &content.reads {
        let absent = if read.blake3.is_none() { " (not there)" } else { "" };
        text.push_str(&format!("reads  {}{absent}\n", real(read, gate)));
    }
    outputs.iter().for_each(|name| text.push_str(&format!("writes {name}\n")));
    text.push_str(&format!("key    {}\n", content.key(pipeline)));
    console.result(&crate::render::safe(&text));
    Exit::Good
}

fn input(read: &FileRead, gate: &Gate) -> Value {
    json!({ "path": Gate::shown(&read.path), "file": real(read, gate), "blake3": read.blake3 })
}

/// The file on this machine; where there is none, the name that the pipeline gives it.
fn real(read: &FileRead, gate: &Gate) -> String {
    let found = gate.optional_input(&read.path).ok().flatten();
    found.map_or_else(|| Gate::shown(&read.path), |path| path.to_string_lossy().into_owned())
}
