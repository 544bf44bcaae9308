//! Body and fabrics from their files.

use super::StitchParams;
use crate::codes::TEXT_NOT_UTF8;
use std::path::Path;
use toile_garment::body::Body;
use toile_garment::fabric::Fabric;
use toile_garment::{Diagnostic, Garment, Severity};
use toile_stage_api::{StageContext, StageError};

/// Reads all fabrics of the parameters into the garment.
///
/// # Errors
/// When a file is missing or wrong.
pub fn fabrics(params: &StitchParams, garment: &mut Garment, cx: &mut StageContext<'_>) -> Result<(), StageError> {
    garment.fabrics.insert(String::new(), fabric(&params.fabric, cx)?);
    for (material, path) in &params.fabrics {
        let read = fabric(path, cx)?;
        garment.fabrics.insert(material.clone(), read);
    }
    Ok(())
}

fn fabric(path: &Path, cx: &mut StageContext<'_>) -> Result<Fabric, StageError> {
    let name = path.display().to_string();
    let text = text(path, &cx.files.read(path)?)?;
    toile_formats::fabric::read(&text, &name).map_err(StageError::Input)
}

/// Reads a body and its side file.
///
/// # Errors
/// When a file is missing or wrong.
pub fn body(path: &Path, cx: &mut StageContext<'_>) -> Result<Body, StageError> {
    let bytes = cx.files.read(path)?;
    let side_path = path.with_extension("toml");
    let side = cx.files.read_optional(&side_path)?.map(|b| text(&side_path, &b)).transpose()?;
    let read =
        toile_formats::body::read(&bytes, &path.display().to_string(), side.as_deref()).map_err(StageError::Input)?;
    for finding in read.findings {
        if finding.severity != Severity::Info {
            cx.report.push(finding);
        }
    }
    Ok(read.body)
}

fn text(path: &Path, bytes: &[u8]) -> Result<String, StageError> {
    String::from_utf8(bytes.to_vec()).map_err(|_| {
        StageError::input(Diagnostic::error(TEXT_NOT_UTF8, format!("{} is not UTF-8 text", path.display())))
    })
}
