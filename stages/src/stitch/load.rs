//! Body and fabrics from their files.

use super::{StitchParams, codes};
use crate::body::check_side_file;
use crate::codes::TEXT_NOT_UTF8;
use std::collections::BTreeSet;
use std::path::Path;
use toile_garment::body::Body;
use toile_garment::fabric::Fabric;
use toile_garment::{Diagnostic, Garment, Severity};
use toile_stage_api::{StageContext, StageError};

/// Reads all fabrics and the body of the parameters into the garment. What is wrong with both is told at once.
///
/// # Errors
/// When a file is missing or wrong.
pub fn inputs(params: &StitchParams, garment: &mut Garment, cx: &mut StageContext<'_>) -> Result<(), StageError> {
    let mut errors = fabrics(params, garment, cx);
    garment.body = match params.body.as_ref().map(|path| body(path, cx)) {
        Some(Ok(body)) => Some(body),
        // Nothing is measured on another body instead.
        Some(Err(error)) => {
            errors.push(error);
            None
        }
        None => garment.body.take(),
    };
    together(errors)
}

/// All files that are wrong; else the first that could not be read.
fn together(errors: Vec<StageError>) -> Result<(), StageError> {
    let (mut wrong, mut unread) = (Vec::new(), None);
    for error in errors {
        match error {
            StageError::Input(findings) => wrong.extend(findings),
            other => unread = unread.or(Some(other)),
        }
    }
    if wrong.is_empty() { unread.map_or(Ok(()), Err) } else { Err(StageError::Input(wrong)) }
}

/// Reads all fabrics of the parameters into the garment, and gives what is wrong with them.
///
/// A fabric for a material that no piece is of gets a warning, as soon as there are pieces.
fn fabrics(params: &StitchParams, garment: &mut Garment, cx: &mut StageContext<'_>) -> Vec<StageError> {
    let base = std::iter::once((String::new(), &params.fabric));
    let mut errors = Vec::new();
    for (material, path) in base.chain(params.fabrics.iter().map(|(material, path)| (material.clone(), path))) {
        match fabric(path, cx) {
            Ok(read) => {
                garment.fabrics.insert(material, read);
            }
            Err(error) => errors.push(error),
        }
    }
    let materials: BTreeSet<&str> = garment.pieces.iter().filter_map(|p| p.material.as_deref()).collect();
    let is_known = |key: &str| materials.contains(key) || garment.pieces.iter().any(|p| p.name == key);
    let unused = params.fabrics.keys().filter(|key| !garment.pieces.is_empty() && !is_known(key));
    let names: Vec<&str> = garment.pieces.iter().map(|p| p.name.as_str()).collect();
    cx.report.findings.extend(unused.map(|key| no_such_material(key, &materials, &names)));
    errors
}

fn no_such_material(key: &str, materials: &BTreeSet<&str>, pieces: &[&str]) -> Diagnostic {
    let message = format!("with.fabrics names `{key}`, which is neither a material nor a piece of the pattern");
    let materials = materials.iter().map(|m| format!("`{m}`")).collect::<Vec<_>>().join(", ");
    let near = crate::sewing::lookup::nearest(key, pieces);
    let hint = if materials.is_empty() {
        format!("no piece names a material; {near}")
    } else {
        format!("the materials are {materials}; {near}")
    };
    Diagnostic::warning(codes::FABRIC_UNUSED, message).hint(hint)
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
    // A file that ends in `.toml` is no side file of itself.
    let beside = if side_path == path { None } else { cx.files.read_optional(&side_path)? };
    let side = beside.map(|b| text(&side_path, &b)).transpose()?;
    let read =
        toile_formats::body::read(&bytes, &path.display().to_string(), side.as_deref()).map_err(StageError::Input)?;
    for finding in read.findings {
        if finding.severity != Severity::Info {
            cx.report.push(finding);
        }
    }
    let said = if side.is_some() { check_side_file(&read.body, &side_path.display().to_string()) } else { Vec::new() };
    let (wrong, doubtful): (Vec<_>, Vec<_>) = said.into_iter().partition(|f| f.severity == Severity::Error);
    cx.report.findings.extend(doubtful);
    if wrong.is_empty() { Ok(read.body) } else { Err(StageError::Input(wrong)) }
}

fn text(path: &Path, bytes: &[u8]) -> Result<String, StageError> {
    String::from_utf8(bytes.to_vec()).map_err(|_| {
        StageError::input(Diagnostic::error(TEXT_NOT_UTF8, format!("{} is not UTF-8 text", path.display())))
    })
}
