//! Does the run of a bundle again, in a folder of its own, and compares.

use super::check::Bundle;
use super::codes;
use super::manifest::ROOT_MARK;
use crate::codes::WRITE_FAILED;
use crate::engine::{Exit, OutputRecord, Stop, output_below, program};
use crate::load::{self, Request};
use crate::rerun::{Ended, Means, rerun};
use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;
use toile_garment::{Diagnostic, Severity};
use toile_stage_api::Registry;

/// Unpacks a bundle below a folder and runs it. No findings: it ended as the list says, with the same bytes.
///
/// # Errors
/// When the run cannot begin, with the exit code for it.
pub fn replay(
    bundle: &Bundle,
    folder: &Path,
    allow_run: &[String],
    means: &Means,
    stop: &Arc<Stop>,
    registry: &mut Registry,
) -> Result<Vec<Diagnostic>, (Vec<Diagnostic>, Exit)> {
    let root = folder.join("bundle");
    unpack(bundle, &root).map_err(|e| {
        let message = format!("the bundle cannot be unpacked: {e}");
        (vec![Diagnostic::error(WRITE_FAILED, message)], Exit::System)
    })?;
    let request = Request {
        file: root.join(&bundle.manifest.pipeline),
        set: bundle.manifest.set.clone(),
        base: root,
        accuracy: bundle.manifest.accuracy.clone(),
        repeats: bundle.manifest.repeats,
        allow_run: allow_run.iter().cloned().collect(),
        ..Request::default()
    };
    refuse_outside(&request, stop, registry)?;
    let ended = rerun(&request, folder.join("out"), means, stop, registry);
    if ended.exit == Exit::Stopped || ended.record.is_none() {
        return Err((ended.findings, if ended.exit == Exit::Good { Exit::System } else { ended.exit }));
    }
    Ok(differences(bundle, &ended))
}

/// The overrides of a bundle are the words of somebody else: no path among them may lead out of it.
fn refuse_outside(request: &Request, stop: &Arc<Stop>, registry: &mut Registry) -> Result<(), (Vec<Diagnostic>, Exit)> {
    let loaded = load::load(request, stop, registry);
    let mounts = loaded.pipeline.iter().flat_map(|p| &p.mounts);
    let outside = mounts.filter(|(_, folder)| folder.as_path() != Path::new(".") && output_below(folder).is_err());
    let refuse = |(name, _): (&String, _)| {
        let message = format!("the override of `{name}` leads out of the bundle");
        Diagnostic::error(codes::BUNDLE_REFUSED, message).hint("do not trust this file")
    };
    let refused: Vec<Diagnostic> = outside.map(refuse).collect();
    if refused.is_empty() { Ok(()) } else { Err((refused, Exit::Input)) }
}

fn unpack(bundle: &Bundle, root: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(root)?;
    // Without a mark of its own, the project would be a folder above.
    std::fs::write(root.join(ROOT_MARK), "")?;
    for file in bundle.manifest.files.iter().filter(|f| f.path != ROOT_MARK) {
        let path = root.join(&file.path);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        let mut new = std::fs::File::options().write(true).create_new(true).open(&path)?;
        new.write_all(bundle.files.get(&file.path).map_or(&[], Vec::as_slice))?;
        drop(new);
        if file.program {
            allow_execution(&path)?;
        }
    }
    Ok(())
}

#[cfg(unix)]
fn allow_execution(path: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt as _;
    std::fs::set_permissions(path, std::fs::Permissions::from_mode(0o700))
}

#[cfg(not(unix))]
fn allow_execution(_: &Path) -> std::io::Result<()> {
    Ok(())
}

fn differences(bundle: &Bundle, ended: &Ended) -> Vec<Diagnostic> {
    let manifest = &bundle.manifest;
    let mut words = Vec::new();
    if ended.exit.code() != manifest.exit_code {
        let first = ended.findings.iter().find(|f| f.severity == Severity::Error);
        let why = first.map(|f| format!(": {}", f.message)).unwrap_or_default();
        words.push(format!("the exit code is {}, it was {}{why}", ended.exit.code(), manifest.exit_code));
    }
    let outputs = ended.record.as_ref().map(|r| r["outputs"].clone()).unwrap_or_default();
    let outputs: Vec<OutputRecord> = serde_json::from_value(outputs).unwrap_or_default();
    let by_path = |all: &[OutputRecord]| -> BTreeMap<String, String> {
        all.iter().map(|o| (o.path.clone(), o.blake3.clone())).collect()
    };
    let (before, after) = (by_path(&manifest.outputs), by_path(&outputs));
    for (path, digest) in &before {
        match after.get(path) {
            None => words.push(format!("`{path}` was not written")),
            Some(other) if other != digest => {
                words.push(format!("`{path}` has other bytes than in the run of the bundle"))
            }
            _ => {}
        }
    }
    words.extend(after.keys().filter(|p| !before.contains_key(*p)).map(|p| format!("`{p}` is new")));
    let hint = if manifest.program == program() {
        "the program is the same: please report it".to_owned()
    } else {
        format!("the bundle was made by toile {}, this is {}", manifest.program, program())
    };
    words.into_iter().map(|w| Diagnostic::error(codes::BUNDLE_DIFFERS, w).hint(hint.clone())).collect()
}
