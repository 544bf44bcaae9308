//! `toile flatten GARMENT`: 3D → 2D from the garment's file alone, by the same stages a pipeline uses.

use super::args::FlattenArgs;
use super::console::Console;
use crate::engine::{Exit, MAX_INPUT, Stop, clean, of_file_error, of_stage_error, read_limited, write_whole};
use crate::progress::Teller;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_garment::{Diagnostic, Garment, Report};
use toile_stage_api::{FileError, Files, Registry, StageContext, StageError};
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

type ReadGarment = fn(&[u8]) -> Result<Garment, String>;

/// Forms a garment can be read from: how they begin, and what reads them.
const READERS: &[(&[u8], ReadGarment)] = &[(b"{", garment_from_bundle)];
/// The stage that flattens, and the taps that write its result to the parameter `file`.
const FLATTEN: &str = "flatten";
const DXF_TAP: &str = "export-dxf";
const JSON_TAP: &str = "export-report";

pub(super) fn run(args: &FlattenArgs, registry: &Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let garment = match read(&args.garment) {
        Ok(garment) => garment,
        Err(findings) => {
            console.findings(&findings, None);
            return Exit::Input;
        }
    };
    let mut report = Report::default();
    let written = flatten(args, registry, stop, garment, &mut report);
    match written {
        Ok(files) => {
            console.findings(&report.findings, None);
            let all = files.iter().map(|(path, bytes)| write_result(path, bytes, args.force, console));
            all.fold(Exit::Good, |worst, exit| if worst == Exit::Good { exit } else { worst })
        }
        Err(error) => {
            let (findings, exit) = of_stage_error(error);
            report.findings.extend(findings);
            console.findings(&report.findings, None);
            exit
        }
    }
}

fn read(path: &Path) -> Result<Garment, Vec<Diagnostic>> {
    let bytes = read_limited(path, path, MAX_INPUT).map_err(|e| of_file_error(&e).0)?;
    let body = bytes.trim_ascii_start();
    let reader = READERS.iter().find(|(begin, _)| body.starts_with(begin));
    let name = clean(path);
    let no_reader = || vec![Diagnostic::error("no-reader", format!("`{name}` is no garment file"))];
    let (_, reader) = reader.ok_or_else(no_reader)?;
    reader(&bytes).map_err(|message| vec![Diagnostic::error("garment-file", format!("`{name}`: {message}"))])
}

/// Reads a garment document.
pub(super) fn garment_from_bundle(bytes: &[u8]) -> Result<Garment, String> {
    let text = std::str::from_utf8(bytes).map_err(|e| format!("no UTF-8 text: {e}"))?;
    toile_garment::bundle::from_text(text).map_err(|e| e.to_string())
}

fn flatten(
    args: &FlattenArgs,
    registry: &Registry,
    stop: &Arc<Stop>,
    garment: Garment,
    report: &mut Report,
) -> Result<Vec<(PathBuf, Vec<u8>)>, StageError> {
    let mut files = Memory::default();
    let mut garment = run_stage(registry, FLATTEN, None, garment, stop, report, &mut files)?;
    let mut results = Vec::new();
    for (tap, path) in [(DXF_TAP, &args.dxf), (JSON_TAP, &args.json)] {
        let Some(path) = path else { continue };
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let file = format!("{{out}}/{name}");
        garment = run_stage(registry, tap, Some(&file), garment, stop, report, &mut files)?;
        let bytes = files.written.remove(Path::new(&file));
        let bytes = bytes.ok_or_else(|| StageError::Internal(format!("`{tap}` did not write `{file}`")))?;
        results.push((path.clone(), bytes));
    }
    Ok(results)
}

fn run_stage(
    registry: &Registry,
    name: &str,
    file: Option<&str>,
    garment: Garment,
    stop: &Arc<Stop>,
    report: &mut Report,
    files: &mut Memory,
) -> Result<Garment, StageError> {
    let stage = registry.get(name).ok_or_else(|| StageError::Unsupported(format!("there is no stage `{name}`")))?;
    let mut table = DeTable::new();
    if let Some(file) = file {
        table.insert(Spanned::new(0..0, "file".into()), Spanned::new(0..0, DeValue::String(file.into())));
    }
    let params = ValueDeserializer::from(Spanned::new(0..0, DeValue::Table(table)));
    let ready = stage.configure(params).map_err(|e| StageError::Internal(e.message().to_owned()))?;
    if let Some(need) = ready.info().needs.iter().find(|n| !garment.has(**n)) {
        let message = format!("the garment holds no {}, which `{name}` needs", crate::pipeline::word(*need));
        return Err(StageError::input(Diagnostic::error("needs-not-given", message)));
    }
    let mut cx = StageContext {
        report,
        progress: &mut Teller::silent(),
        files,
        cancel: stop.flag(),
        seed: garment.provenance.seed,
        threads: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
    };
    ready.run(garment, &mut cx)
}

/// Writes one result whole, never over a file without `--force`.
pub(super) fn write_result(path: &Path, bytes: &[u8], force: bool, console: &mut Console<'_>) -> Exit {
    let name = clean(path);
    if path.exists() && !force {
        console.say(&format!("error[path-refused] `{name}` is there already; replace it with --force\n"));
        return Exit::Usage;
    }
    if let Err(error) = write_whole(path, bytes) {
        console.say(&format!("error[write-failed] cannot write `{name}`: {error}\n"));
        return Exit::System;
    }
    console.result(&format!("{name}\n"));
    Exit::Good
}

/// Keeps what a tap writes; lets it read nothing.
#[derive(Default)]
struct Memory {
    written: BTreeMap<PathBuf, Vec<u8>>,
}

impl Files for Memory {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        let reason = "flattening works from the garment's file alone".to_owned();
        Err(FileError::Refused { path: clean(path), reason })
    }

    fn read_optional(&mut self, _: &Path) -> Result<Option<Vec<u8>>, FileError> {
        Ok(None)
    }

    fn write(&mut self, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
        self.written.insert(path.to_path_buf(), bytes.to_vec());
        Ok(())
    }
}
