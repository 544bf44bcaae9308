//! Values that an accuracy or `--repeats` chose, and that `--set` changed again.

use super::{Request, codes};
use crate::pipeline::{Pipeline, Tuning, knob};
use serde_json::Value;
use toile_garment::{Diagnostic, Report};
use toile_stage_api::Meaning;

/// Tells what was overruled. An accuracy whose mesh or tolerance is another one promises nothing: its word is taken back.
pub(super) fn tell(pipeline: &Pipeline<'_>, tuning: &Tuning, request: &Request, report: &mut Report) {
    let (repeats, chosen): (Vec<_>, Vec<_>) = tuning.iter().partition(|(meaning, _)| **meaning == Meaning::Repeats);
    let of = |all: Vec<(&Meaning, &String)>| -> Vec<String> {
        all.into_iter().flat_map(|(meaning, value)| changed(pipeline, *meaning, value)).collect()
    };
    let hint = "--set has the last word; leave out one of both";
    for held in of(repeats) {
        let message = format!("--repeats is overruled: {held}");
        report.push(Diagnostic::warning(codes::CHOICE_OVERRULED, message).hint(hint));
    }
    // Settings that a study gives are no promise, and the study itself looks at them.
    let held = if request.tuning.is_empty() { of(chosen) } else { Vec::new() };
    if let Some(promise) = report.findings.iter_mut().find(|f| f.code == codes::ACCURACY_CHOSEN)
        && !held.is_empty()
    {
        let message = format!("{}; it is not promised here: {}", promise.message, held.join(", "));
        let withdrawn = Diagnostic::warning(codes::CHOICE_OVERRULED, message).hint(hint);
        *promise = match promise.source.clone() {
            Some(place) => withdrawn.at(place),
            None => withdrawn,
        };
    }
}

/// Parameters of this meaning with another value than the one that was chosen, in words.
fn changed(pipeline: &Pipeline<'_>, meaning: Meaning, value: &str) -> Vec<String> {
    let of = |step: &crate::pipeline::Step<'_>| {
        let key = &knob(step.ready.knobs(), meaning)?.key;
        let params = step.ready.params();
        let found = match params.pointer(&format!("/{}", key.replace('.', "/"))) {
            // A count of 0 is not written down.
            None | Some(Value::Null) if value == "0" => return None,
            None | Some(Value::Null) => "not set".to_owned(),
            Some(Value::String(text)) => text.clone(),
            Some(other) => other.to_string(),
        };
        (found != value).then(|| format!("`{}.{key}` is {found}, not {value}", step.id))
    };
    pipeline.steps.iter().filter_map(of).collect()
}
