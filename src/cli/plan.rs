//! `toile plan`: what a run would do, without doing it.

use super::args::PlanArgs;
use super::console::Console;
use crate::engine::{Exit, Gate, Stop, planned_inputs};
use crate::load;
use crate::pipeline::{Pipeline, Step, word};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;
use toile_stage_api::Registry;

pub(super) fn run(args: &PlanArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let request = args.pipeline.request();
    let source = match load::open(&request) {
        Ok(source) => source,
        Err(findings) => {
            console.findings(&findings, None);
            return Exit::Usage;
        }
    };
    let loaded = load::check(&source, &request, stop, registry);
    console.findings(&loaded.report.findings, Some((source.file(), source.text())));
    let exit = Exit::of_findings(&loaded.report.findings);
    if let (Exit::Good, Some(pipeline), Some(gate)) = (exit, &loaded.pipeline, &loaded.gate) {
        let plan = plan(pipeline, gate);
        if args.json { console.json(&plan) } else { console.result(&text(pipeline, &plan)) }
    }
    exit
}

fn plan(pipeline: &Pipeline<'_>, gate: &Gate) -> Value {
    let inputs: Vec<Value> = planned_inputs(&pipeline.steps)
        .map(|input| {
            let size = gate.input(Path::new(&input.text)).ok().and_then(|real| Some(real.metadata().ok()?.len()));
            json!({ "path": Gate::shown(Path::new(&input.text)), "bytes": size })
        })
        .collect();
    let outputs: Vec<&str> =
        pipeline.steps.iter().flat_map(|s| &s.paths).filter(|p| p.is_output()).map(|p| p.text.as_str()).collect();
    json!({
        "pipeline": format!("{} v{}", pipeline.line, pipeline.version),
        "seed": pipeline.seed,
        "stages": pipeline.steps.iter().map(step).collect::<Vec<_>>(),
        "inputs": inputs,
        "outputs": outputs,
    })
}

fn step(step: &Step<'_>) -> Value {
    let info = step.ready.info();
    json!({
        "use": info.name,
        "id": step.id,
        "revision": info.revision,
        "needs": info.needs,
        "gives": info.gives,
        "params": step.ready.params(),
    })
}

fn text(pipeline: &Pipeline<'_>, plan: &Value) -> String {
    let mut text = format!("{} v{}\n", pipeline.line, pipeline.version);
    for (number, step) in pipeline.steps.iter().enumerate() {
        let info = step.ready.info();
        let gives = if info.gives.is_empty() {
            "leaves the garment as it is".to_owned()
        } else {
            format!("gives {}", info.gives.iter().map(|a| word(*a)).collect::<Vec<_>>().join(", "))
        };
        text.push_str(&format!("{:>3} {:<18} {gives}\n", number + 1, step.id));
    }
    for input in plan["inputs"].as_array().into_iter().flatten() {
        text.push_str(&format!("reads  {} ({} bytes)\n", input["path"].as_str().unwrap_or(""), input["bytes"]));
    }
    for output in plan["outputs"].as_array().into_iter().flatten() {
        text.push_str(&format!("writes {}\n", output.as_str().unwrap_or("")));
    }
    crate::render::safe(&text)
}
