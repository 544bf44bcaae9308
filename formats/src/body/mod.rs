//! The body: a closed OBJ mesh in metres, and beside it a TOML file with what the mesh cannot say.
//!
//! # The file beside the mesh (`<body>.toml`)
//!
//! ```toml
//! name = "woman 38"
//!
//! [measures]                                   # ISO 8559-1 names
//! waist_girth = "720 mm"
//!
//! [landmarks]                                  # x to the wearer's left, y up, z to the front
//! waist = ["0 mm", "1040 mm", "0 mm"]
//!
//! [segments.torso]                             # torso, arm-left, arm-right, leg-left, leg-right, neck
//! from = ["0 mm", "1400 mm", "0 mm"]
//! to = ["0 mm", "780 mm", "0 mm"]
//! half_width = "180 mm"
//! half_depth = "120 mm"
//! ```

pub(crate) mod codes;
mod handover;
mod mesh;
mod sidecar;
#[cfg(test)]
mod tests;

use crate::obj;
pub use sidecar::{Unread, schema};
use toile_garment::body::Body;
use toile_garment::garment::UpAxis;
use toile_garment::{Diagnostic, SourceRef};

/// A body and what was found while reading it.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadBody {
    /// The body.
    pub body: Body,
    /// Notes and warnings: what was merged, dropped, turned, left open.
    pub findings: Vec<Diagnostic>,
}

/// Reads a body from its OBJ and, where there is one, the text of the TOML file beside it.
///
/// Bit-equal vertices of an open mesh are merged, triangles without area and doubles dropped, parts that face inwards
/// turned; each is counted in a finding. `obj_name` is the file's name for messages and, without its ending, the body's
/// default name.
///
/// # Errors
/// All mistakes of both files. Triangles that face both ways in one part are refused.
pub fn read(obj_bytes: &[u8], obj_name: &str, sidecar_toml: Option<&str>) -> Result<ReadBody, Vec<Diagnostic>> {
    let files = handover::Files {
        digest: blake3::hash(obj_bytes).to_hex().to_string(),
        name: obj_name.to_owned(),
        side: sidecar_toml.map(str::to_owned),
    };
    if let Some(read) = handover::take(&files) {
        return Ok(read);
    }
    let sound = read_anew(obj_bytes, obj_name, sidecar_toml, &files.digest);
    if !sound.errors.is_empty() {
        return Err(sound.errors);
    }
    handover::keep(files, &sound.read);
    Ok(sound.read)
}

/// The parts of a body that can be read, and the mistakes of the others.
#[derive(Clone, Debug)]
pub struct SoundParts {
    /// The body; it has no triangle where its mesh cannot be used.
    pub read: ReadBody,
    /// The mistakes.
    pub errors: Vec<Diagnostic>,
    /// The names of the side file whose values cannot be read.
    pub unread: Unread,
}

/// Reads a body as [`read`] does, as far as it is sound. `None` stands for a mesh that is not there.
#[must_use]
pub fn read_sound_parts(obj_bytes: Option<&[u8]>, obj_name: &str, sidecar_toml: Option<&str>) -> SoundParts {
    let read = |bytes| read(bytes, obj_name, sidecar_toml).ok();
    if let Some(read) = obj_bytes.and_then(read) {
        return SoundParts { read, errors: Vec::new(), unread: Unread::default() };
    }
    read_anew(obj_bytes.unwrap_or_default(), obj_name, sidecar_toml, "")
}

fn read_anew(obj_bytes: &[u8], obj_name: &str, sidecar_toml: Option<&str>, digest: &str) -> SoundParts {
    let (said, unread, mut errors) =
        sidecar_toml.map(|text| sidecar::read(text, &sidecar_name(obj_name))).unwrap_or_default();
    let is_person = sidecar_toml.is_some();
    let mut findings = Vec::new();
    let before = errors.len();
    let mesh = sound_mesh(obj_bytes, obj_name, is_person, &mut findings, &mut errors);
    let (positions, triangles) = if errors.len() == before { mesh.unwrap_or_default() } else { Default::default() };
    let body = Body {
        name: if said.name.is_empty() { stem(obj_name) } else { said.name },
        positions,
        triangles,
        measures: said.measures,
        landmarks: said.landmarks,
        segments: said.segments,
        digest: digest.to_owned(),
    };
    SoundParts { read: ReadBody { body, findings }, errors, unread }
}

/// The mesh of a body, made sound; `is_person` where its measures are told.
fn sound_mesh(
    obj_bytes: &[u8],
    obj_name: &str,
    is_person: bool,
    findings: &mut Vec<Diagnostic>,
    errors: &mut Vec<Diagnostic>,
) -> Option<mesh::Mesh> {
    let raw = obj::read_geometry(obj_bytes, obj_name).map_err(|wrong| errors.extend(wrong)).ok()?;
    findings.extend(raw.findings.iter().cloned());
    let cleaned = mesh::clean(&raw, obj_name, findings).map_err(|wrong| errors.push(*wrong)).ok();
    if let Some(finding) = mesh::size(&raw, obj_name, is_person) {
        let list = if finding.severity == toile_garment::Severity::Error { errors } else { findings };
        list.push(finding);
    }
    cleaned
}

/// Turns a body that was read from a file with another vertical axis.
pub fn turn(body: &mut Body, up: UpAxis) {
    let points = body.positions.iter_mut().chain(body.landmarks.values_mut());
    points.for_each(|p| *p = up.from_file(*p));
    for segment in body.segments.values_mut() {
        segment.from = up.from_file(segment.from);
        segment.to = up.from_file(segment.to);
    }
}

/// The body as two texts, OBJ and TOML; the same body gives the same bytes. Reading them gives it back: the mesh
/// bit-equal, the lengths of the TOML within a rounding error.
#[must_use]
pub fn write(body: &Body) -> (String, String) {
    let mut mesh = obj::MeshText::default();
    mesh.comment("metres, +y up, +z front, +x the wearer's left, floor at y = 0");
    mesh.group(&body.name, &body.positions, None, &body.triangles);
    (mesh.finish(), sidecar::write(body))
}

/// Name of the file beside an OBJ: `body.obj` → `body.toml`.
#[must_use]
pub fn sidecar_name(obj_name: &str) -> String {
    let base = match obj_name.rfind('.') {
        Some(dot) if !obj_name[dot..].contains(['/', '\\']) => &obj_name[..dot],
        _ => obj_name,
    };
    format!("{base}.toml")
}

fn stem(name: &str) -> String {
    let file = name.rsplit(['/', '\\']).next().unwrap_or(name);
    file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_owned()
}

fn place(file: &str) -> SourceRef {
    SourceRef::file(file)
}
