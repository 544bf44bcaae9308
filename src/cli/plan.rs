//! `toile plan`: what a run would do and need, without doing it.

use super::args::PlanArgs;
use super::console::Console;
use crate::engine::{Allow, Exit, Foresight, Gate, Stop, foresee, planned_inputs};
use crate::load;
use crate::pipeline::{Pipeline, Step, word};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;
use toile_stage_api::{Cost, Registry};

pub(super) fn run(args: &PlanArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let loaded = load::load(&args.accuracy.request(&args.pipeline), stop, registry);
    console.findings(&loaded.report.findings, loaded.text());
    let exit = loaded.exit();
    let (Exit::Good, Some(pipeline), Some(gate)) = (exit, &loaded.pipeline, &loaded.gate) else { return exit };
    let seen = foresee(pipeline, gate, stop);
    console.findings(&seen.findings, loaded.text());
    if seen.exit == Exit::Good {
        let plan = plan(pipeline, gate, &seen);
        if args.json {
            console.json(&plan)
        } else {
            console.result(&text(pipeline, &plan, &seen))
        }
        if let Some(refusal) = args.limits.limits().refuse(&seen, Allow::Options) {
            console.findings(&[refusal], None);
            return Exit::System;
        }
    }
    seen.exit
}

fn plan(pipeline: &Pipeline<'_>, gate: &Gate, seen: &Foresight) -> Value {
    let inputs: Vec<Value> = planned_inputs(&pipeline.steps)
        .map(|input| {
            let size = gate.input(Path::new(&input.text)).ok().and_then(|real| Some(real.metadata().ok()?.len()));
            json!({ "path": Gate::shown(Path::new(&input.text)), "bytes": size })
        })
        .collect();
    let outputs: Vec<&str> =
        pipeline.steps.iter().flat_map(|s| &s.paths).filter(|p| p.is_output()).map(|p| p.text.as_str()).collect();
    let mesh = seen.forecast.mesh;
    let steps = pipeline.steps.iter().zip(&seen.stages);
    let effects = seen.forecast.effects.iter();
    json!({
        "pipeline": format!("{} v{}", pipeline.line, pipeline.version),
        "seed": pipeline.seed,
        "stages": steps.map(|(s, expected)| step(s, expected.as_ref())).collect::<Vec<_>>(),
        "effects": effects
            .map(|e| json!({ "name": e.name, "on": e.on, "rule": e.rule, "evidence": e.evidence }))
            .collect::<Vec<_>>(),
        "expected": {
            "seconds": rounded(seen.seconds()),
            "mb": rounded(seen.mb()),
            "triangles": mesh.map(|m| m.triangles.round()),
            "edge_mm": mesh.map(|m| rounded(m.edge * 1e3)),
            "stages_not_foreseen": seen.stages.iter().filter(|e| e.is_none()).count(),
        },
        "advice": seen.forecast.advice,
        "programs": pipeline.contents,
        "inputs": inputs,
        "outputs": outputs,
    })
}

fn step(step: &Step<'_>, expected: Option<&Cost>) -> Value {
    let info = step.ready.info();
    json!({
        "use": info.name,
        "id": step.id,
        "revision": info.revision,
        "needs": info.needs,
        "gives": info.gives,
        "params": step.ready.params(),
        "expected_seconds": expected.map(|e| rounded(e.seconds)),
        "expected_mb": expected.map(|e| rounded(e.mb)),
    })
}

/// An expectation has no more digits than this.
fn rounded(x: f64) -> f64 {
    (x * 1e3).round() / 1e3
}

fn text(pipeline: &Pipeline<'_>, plan: &Value, seen: &Foresight) -> String {
    // Writing to a String cannot fail.
    let mut text = format!("{} v{}\n", pipeline.line, pipeline.version);
    for (number, (step, expected)) in pipeline.steps.iter().zip(&seen.stages).enumerate() {
        let info = step.ready.info();
        let gives = if info.gives.is_empty() {
            "leaves the garment as it is".to_owned()
        } else {
            format!("gives {}", info.gives.iter().map(|a| word(*a)).collect::<Vec<_>>().join(", "))
        };
        let needs = expected.map_or_else(|| "not foreseen".to_owned(), |e| about(e.seconds, e.mb));
        let _ = writeln!(text, "{:>3} {:<18} {gives:<42} {needs}", number + 1, step.id);
    }
    for e in &seen.forecast.effects {
        let state = if e.on { "on" } else { "off" };
        let _ = writeln!(text, "effect {:<14} {state:<4} {} ({})", e.name, e.rule, e.evidence);
    }
    for advice in &seen.forecast.advice {
        let _ = writeln!(text, "advice {advice}");
    }
    for program in &pipeline.contents {
        let stated = if program.is_stated { "stated" } else { "not stated" };
        let _ = writeln!(text, "plugin {:<14} content {} ({stated})", program.plugin, program.content);
    }
    for input in plan["inputs"].as_array().into_iter().flatten() {
        let _ = writeln!(text, "reads  {} ({} bytes)", input["path"].as_str().unwrap_or(""), input["bytes"]);
    }
    for output in plan["outputs"].as_array().into_iter().flatten() {
        let _ = writeln!(text, "writes {}", output.as_str().unwrap_or(""));
    }
    if seen.stages.iter().any(Option::is_some) {
        let size = seen.forecast.mesh.map_or_else(String::new, |m| {
            format!(" for about {:.0} triangles with edges of about {:.1} mm", m.triangles, m.edge * 1e3)
        });
        let _ = writeln!(
            text,
            "in all {}{size}; cloth that slides until something holds it may take five times as long",
            about(seen.seconds(), seen.mb())
        );
    }
    crate::render::safe(&text)
}

fn about(seconds: f64, mb: f64) -> String {
    let seconds = if seconds < 0.1 { "under 0.1 s".to_owned() } else { format!("about {seconds:.1} s") };
    format!("{seconds}, {mb:.0} MB")
}
