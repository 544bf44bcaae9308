//! A result: a folder of a run, its record, or a GLB.

use super::codes;
use crate::engine::{RECORD_NAME, clean, output_below, read_limited, read_record};
use serde_json::Value;
use std::path::{Path, PathBuf};
use toile_formats::gltf;
use toile_garment::{Diagnostic, Garment, SourceRef};

/// Largest file that is read, bytes.
const MAX_FILE: u64 = 1 << 30;

/// One result.
pub struct Side {
    /// Name for reports.
    pub name: String,
    /// `run.json`, if there is one.
    pub record: Option<Value>,
    /// The garment, if there is a GLB.
    pub garment: Option<Garment>,
}

/// Opens a result.
///
/// # Errors
/// When the path is no result, or a file is damaged.
pub fn open(path: &Path) -> Result<Side, Diagnostic> {
    let wrong = |why: String| {
        let finding = Diagnostic::error(codes::DIFF_NO_RESULT, format!("`{}` is no result: {why}", clean(path)));
        finding.at(SourceRef::file(clean(path))).hint("give the folder of a run, its run.json, or a GLB")
    };
    let mut side = Side { name: clean(path), record: None, garment: None };
    let (folder, file) = if path.is_dir() { (path, None) } else { (path.parent().unwrap_or(path), Some(path)) };
    match file.filter(|f| f.extension().is_some_and(|e| e.eq_ignore_ascii_case("glb"))) {
        Some(glb) => side.garment = Some(garment(glb).map_err(wrong)?),
        None => {
            let path = file.map_or_else(|| folder.join(RECORD_NAME), Path::to_path_buf);
            let record = read_record(&path).map_err(wrong)?;
            side.garment = glb_of(folder, &record).map(|glb| garment(&glb)).transpose().map_err(wrong)?;
            side.record = Some(record);
        }
    }
    Ok(side)
}

/// The first garment among the outputs.
pub(crate) fn glb_of(folder: &Path, record: &Value) -> Option<PathBuf> {
    let mut outputs = record["outputs"].as_array()?.iter().filter_map(|o| o["path"].as_str());
    Some(folder.join(output_below(Path::new(outputs.find(|p| p.ends_with(".glb"))?)).ok()?))
}

fn garment(path: &Path) -> Result<Garment, String> {
    let bytes = read_limited(path, path, MAX_FILE).map_err(|e| e.to_string())?;
    gltf::read_garment(&bytes).map_err(|e| e.to_string())
}
