//! Body and fabrics from their files.

use super::{StitchParams, codes};
use crate::body::check_side_file;
use crate::text::utf8;
use std::collections::BTreeSet;
use std::path::Path;
use toile_formats::body::{ReadBody, Unread, read_sound_parts};
use toile_garment::body::Body;
use toile_garment::fabric::Fabric;
use toile_garment::{Diagnostic, Garment, Severity};
use toile_stage_api::{Errors, StageContext, StageError};

/// Reads all fabrics and the body of the parameters into the garment, as far as they can be read. What is wrong with them
/// is told at once. It gives the names of the body that cannot be read.
pub fn inputs(params: &StitchParams, garment: &mut Garment, errors: &mut Errors, cx: &mut StageContext<'_>) -> Unread {
    fabrics(params, garment, errors, cx);
    let Some(path) = &params.body else { return Unread::default() };
    // Nothing is measured on another body instead.
    let (body, unread) = sound_body(path, errors, cx);
    garment.body = Some(body);
    unread
}

/// Reads all fabrics of the parameters into the garment.
///
/// A fabric for a material that no piece is of gets a warning, as soon as there are pieces.
fn fabrics(params: &StitchParams, garment: &mut Garment, errors: &mut Errors, cx: &mut StageContext<'_>) {
    let base = std::iter::once((String::new(), &params.fabric));
    for (material, path) in base.chain(params.fabrics.iter().map(|(material, path)| (material.clone(), path))) {
        if let Some(read) = errors.keep(fabric(path, cx)) {
            garment.fabrics.insert(material, read);
        }
    }
    let materials: BTreeSet<&str> = garment.pieces.iter().filter_map(|p| p.material.as_deref()).collect();
    let is_known = |key: &str| materials.contains(key) || garment.pieces.iter().any(|p| p.name == key);
    let unused = params.fabrics.keys().filter(|key| !garment.pieces.is_empty() && !is_known(key));
    let names: Vec<&str> = garment.pieces.iter().map(|p| p.name.as_str()).collect();
    cx.report.findings.extend(unused.map(|key| unused_fabric(key, &materials, &names)));
}

fn unused_fabric(key: &str, materials: &BTreeSet<&str>, pieces: &[&str]) -> Diagnostic {
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
    let text = utf8(path, &cx.files.read(path)?)?;
    toile_formats::fabric::read(&text, &name).map_err(StageError::Input)
}

/// Reads a body and its side file.
///
/// # Errors
/// When a file is missing or wrong.
pub fn body(path: &Path, cx: &mut StageContext<'_>) -> Result<Body, StageError> {
    let mut errors = Errors::default();
    let (body, _) = sound_body(path, &mut errors, cx);
    errors.finish().map(|()| body)
}

/// The readable part of a body and its side file, and the names that cannot be read. A mesh that is not there or wrong
/// has no triangle.
fn sound_body(path: &Path, errors: &mut Errors, cx: &mut StageContext<'_>) -> (Body, Unread) {
    let bytes = errors.keep(cx.files.read(path));
    let side_path = path.with_extension("toml");
    // A file that ends in `.toml` is no side file of itself.
    let beside = if side_path == path { Ok(None) } else { cx.files.read_optional(&side_path) };
    let beside = errors.keep(beside).flatten();
    let side = beside.as_ref().and_then(|bytes| errors.keep(utf8(&side_path, bytes)));
    let parts = read_sound_parts(bytes.as_deref(), &path.display().to_string(), side.as_deref());
    let unread = Unread { all: parts.unread.all || beside.is_some() && side.is_none(), ..parts.unread };
    // What is wrong with a mesh that is not there is told already.
    errors.inputs(if bytes.is_some() { parts.errors } else { Vec::new() });
    let ReadBody { body, findings } = parts.read;
    cx.report.findings.extend(findings.into_iter().filter(|f| f.severity != Severity::Info));
    let is_told = side.is_some() && !body.triangles.is_empty();
    let said = if is_told { check_side_file(&body, &side_path.display().to_string()) } else { Vec::new() };
    let (wrong, doubtful): (Vec<_>, Vec<_>) = said.into_iter().partition(|f| f.severity == Severity::Error);
    cx.report.findings.extend(doubtful);
    errors.inputs(wrong);
    (body, unread)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{cloth, one, rectangle};

    #[test]
    fn a_fabric_by_the_name_of_a_piece_wins_over_its_material() {
        let mut garment = one(rectangle(0, "YOKE", 100.0, 50.0));
        let mut give = |key: &str, mass: f64| {
            garment.fabrics.insert(key.to_owned(), cloth(mass, 500.0, 50.0, [1e-5; 2]));
            let mut piece = garment.pieces[0].clone();
            piece.material = Some("lining".to_owned());
            garment.fabric_of(&piece).map(|f| f.areal_mass)
        };
        assert_eq!([give("", 0.1), give("lining", 0.2), give("YOKE", 0.3)], [Some(0.1), Some(0.2), Some(0.3)]);
        let told = unused_fabric("YOK", &BTreeSet::new(), &["YOKE"]);
        assert!(told.hint.as_deref().is_some_and(|h| h.contains("YOKE")), "{told:?}");
    }
}
