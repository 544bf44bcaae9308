//! An asked accuracy is turned into settings of the stages of a chain.

use super::Request;
use super::codes;
use crate::codes::WRONG_VALUE;
use crate::engine::read_limited;
use crate::pipeline::{Document, Tuning, knob, turned_by};
use crate::study::Study;
use crate::study::choose::{Choice, Refusal, Wanted};
use std::path::{Path, PathBuf};
use toile_garment::{Diagnostic, Report, SourceRef};
use toile_stage_api::{AnyStage, Meaning, Registry};

/// Largest study that is read, bytes.
const MAX_STUDY: u64 = 16 << 20;

/// The settings for the accuracy of the request, else of the pipeline's head; no settings when neither asks.
pub(super) fn tuning(document: &Document<'_>, request: &Request, registry: &Registry, report: &mut Report) -> Tuning {
    let (text, place) = match (&request.accuracy, &document.accuracy) {
        (Some(text), _) => (text.as_str(), SourceRef::file(format!("--accuracy {text}"))),
        (None, Some(text)) => (text.get_ref().as_str(), document.source.place(&text.span())),
        (None, None) => return Tuning::default(),
    };
    let chosen = choose(text, document, request, registry, report);
    match chosen {
        Ok((choice, finding)) => {
            report.push(finding.at(place));
            choice.tuning()
        }
        Err(finding) => {
            report.push(finding.at(place));
            Tuning::default()
        }
    }
}

/// The study beside the pipeline, where an accuracy is asked for: what it holds decides the settings.
pub(super) fn looked_for(document: &Document<'_>, request: &Request) -> Vec<PathBuf> {
    let is_asked = request.accuracy.is_some() || document.accuracy.is_some();
    let study = request.file.with_extension("study.json");
    let name = study.file_name().filter(|_| is_asked && request.tuning.is_empty());
    name.map(PathBuf::from).into_iter().collect()
}

/// Name of the study that lies beside the pipeline, which a report shows. None where settings are tried out.
pub(super) fn study_beside(request: &Request) -> Option<String> {
    let file = request.file.with_extension("study.json");
    (request.tuning.is_empty() && file.is_file()).then(|| name_of(&file))
}

fn choose(
    text: &str,
    document: &Document<'_>,
    request: &Request,
    registry: &Registry,
    report: &mut Report,
) -> Result<(Choice, Diagnostic), Diagnostic> {
    let wanted = Wanted::read(text).map_err(|why| {
        Diagnostic::error(WRONG_VALUE, format!("accuracy: {why}")).hint("write e.g. accuracy = \"10 mm\"")
    })?;
    needs_knobs(document, registry)?;
    let file = request.file.with_extension("study.json");
    let study = stored(&file, document, report);
    let choice =
        wanted.choose(study.as_ref()).map_err(|Refusal::OutOfReach(least)| refusal(text, least, study.is_some()))?;
    let words = words(text, &choice, &file);
    Ok((choice, Diagnostic::info(codes::ACCURACY_CHOSEN, words)))
}

/// Refuses a chain in which no stage has a knob for the mesh, or none for the rest. A chain with an unknown stage passes.
fn needs_knobs(document: &Document<'_>, registry: &Registry) -> Result<(), Diagnostic> {
    let stages: Vec<Option<&dyn AnyStage>> = document.stages.iter().map(|s| registry.get(s.name.get_ref())).collect();
    if stages.iter().any(Option::is_none) {
        return Ok(());
    }
    for wanted in [Meaning::EdgeLength, Meaning::Tolerance] {
        if !stages.iter().flatten().any(|s| knob(s.knobs(), wanted).is_some()) {
            let (stage, _) = turned_by(registry, wanted);
            let message = format!("an accuracy is a choice of mesh and drape, but the chain has no `{stage}`");
            let (drape, key) = turned_by(registry, Meaning::Tolerance);
            let hint = format!("leave it out; `with.{key}` of `{drape}` alone says how near to rest a drape is led");
            return Err(Diagnostic::error(codes::ACCURACY_NO_STAGE, message).hint(hint));
        }
    }
    Ok(())
}

/// The study beside the pipeline. One that cannot be used is told of, not passed over in silence.
fn stored(file: &Path, document: &Document<'_>, report: &mut Report) -> Option<Study> {
    if !file.is_file() {
        return None;
    }
    let name = name_of(file);
    let unfit = |why: String| {
        let message = format!("`{name}` is not used: {why}; the accuracy comes from the presets");
        Diagnostic::warning(codes::STUDY_UNFIT, message).hint("make it anew with `toile study`")
    };
    let read = read_limited(file, file, MAX_STUDY).map_err(|e| unfit(e.to_string()));
    let study = read.and_then(|bytes| serde_json::from_slice::<Study>(&bytes).map_err(|e| unfit(e.to_string())));
    let wanted = format!("{} v{}", document.line, document.version);
    let fits = study.and_then(|s| match s {
        s if s.pipeline != wanted => Err(unfit(format!("it is of {}", s.pipeline))),
        s if s.finest >= s.rows.len() => Err(unfit("it is damaged".to_owned())),
        s => Ok(s),
    });
    fits.map_err(|finding| report.push(finding)).ok()
}

fn refusal(text: &str, least: f64, studied: bool) -> Diagnostic {
    let source = if studied { "the study of this pipeline" } else { "the presets" };
    let message = format!("accuracy {text} is out of reach: the least error known from {source} is {least:.1} mm");
    let hint = if studied {
        "ask for less, or study finer meshes: `toile study --edges`"
    } else {
        "ask for less, or let `toile study` find what this garment needs and put its study.json beside the pipeline as NAME.study.json"
    };
    Diagnostic::error(codes::ACCURACY_OUT_OF_REACH, message).hint(hint)
}

fn words(text: &str, choice: &Choice, file: &Path) -> String {
    let (error, name) = (choice.error, choice.setting.name());
    let preset = choice.preset.map_or_else(String::new, |p| format!(" (preset {p})"));
    if choice.studied {
        format!("accuracy {text}: `{name}`{preset}, estimated error {error:.1} mm, from `{}`", name_of(file))
    } else {
        format!("accuracy {text}: `{name}`{preset}, promised error {error} mm")
    }
}

fn name_of(file: &Path) -> String {
    file.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default()
}
