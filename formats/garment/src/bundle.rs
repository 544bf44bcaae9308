//! The garment as text: a versioned envelope around the document.
//!
//! The same envelope stands in a bundle folder on disk (`garment.json`) and, without what the GLB already
//! carries, in `extras.toile` of a GLB.

use crate::garment::Garment;
use serde::{Deserialize, Serialize};

/// `kind` of the envelope.
pub const KIND: &str = "toile-garment";
/// Version of the document's form. Raise it when an old reader would read wrongly.
pub const VERSION: u32 = 1;
/// Name of the document inside a bundle folder.
pub const FILE_NAME: &str = "garment.json";

/// Why a bundle was refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BundleError {
    /// Not JSON of this form.
    #[error("this is no garment document: {0}")]
    Form(#[from] serde_json::Error),
    /// Another kind of document.
    #[error("the document is of kind `{0}`, expected `{KIND}`")]
    Kind(String),
    /// Written by a newer program.
    #[error("the garment document has version {0}, this program reads up to {VERSION}; use a newer toile")]
    Version(u32),
    /// Indices or numbers that cannot be.
    #[error("the garment document is damaged: {0}")]
    Damaged(String),
}

#[derive(Serialize)]
struct EnvelopeRef<'a> {
    kind: &'static str,
    version: u32,
    garment: &'a Garment,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<Certified>,
}

/// The shape that a certificate was given for, so that a document whose positions were edited is known by itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Certified {
    certificate: String,
    shape: String,
}

impl Certified {
    fn of(garment: &Garment) -> Option<Self> {
        let (certificate, drape) = (garment.certificate.as_ref()?, garment.drape.as_ref()?);
        let coordinates = drape.positions.iter().flatten().flat_map(|p| [p.x, p.y, p.z]);
        let shape = digest(coordinates.flat_map(|x| x.to_bits().to_le_bytes()));
        let certificate = digest(serde_json::to_string(certificate).ok()?.bytes());
        Some(Self { certificate, shape })
    }

    /// The certificate is the same, and the shape is not.
    fn is_stale(&self, garment: &Garment) -> bool {
        Self::of(garment).is_some_and(|now| now.certificate == self.certificate && now.shape != self.shape)
    }
}

/// FNV-1a of 64 bits, in hexadecimal digits. It tells changes by chance and by editors, and is no signature.
fn digest(bytes: impl Iterator<Item = u8>) -> String {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    format!("{:016x}", bytes.fold(0xcbf2_9ce4_8422_2325, step))
}

#[derive(Deserialize)]
struct Head {
    kind: String,
    version: u32,
}

#[derive(Deserialize)]
struct Envelope {
    garment: Garment,
    #[serde(default)]
    certified: Option<Certified>,
}

/// The envelope as a JSON value.
///
/// # Errors
/// Never for a garment made by this program; a number that is not finite becomes `null` and is found on reading.
pub fn to_value(garment: &Garment) -> Result<serde_json::Value, BundleError> {
    Ok(serde_json::to_value(EnvelopeRef { kind: KIND, version: VERSION, garment, certified: None })?)
}

/// The envelope as text, the same bytes for the same garment. It tells the shape that the certificate was given for.
///
/// # Errors
/// As [`to_value`].
pub fn to_text(garment: &Garment) -> Result<String, BundleError> {
    let certified = Certified::of(garment);
    Ok(serde_json::to_string(&EnvelopeRef { kind: KIND, version: VERSION, garment, certified })?)
}

/// Reads an envelope and checks kind, version and every index. A certificate of another shape is left out.
///
/// # Errors
/// See [`BundleError`].
pub fn from_text(text: &str) -> Result<Garment, BundleError> {
    Ok(read(text)?.garment)
}

/// A garment as it was read.
pub struct Read {
    /// The garment.
    pub garment: Garment,
    /// Its positions were edited after its certificate was given, so it has none now.
    pub is_edited: bool,
}

/// Reads an envelope as [`from_text`] does, and tells whether its shape was edited.
///
/// # Errors
/// See [`BundleError`].
pub fn read(text: &str) -> Result<Read, BundleError> {
    let head: Head = serde_json::from_str(text)?;
    check_head(&head)?;
    let Envelope { mut garment, certified } = serde_json::from_str(text)?;
    check_indices(&garment)?;
    check_places(&garment)?;
    let is_edited = certified.is_some_and(|c| c.is_stale(&garment));
    if is_edited {
        garment.certificate = None;
    }
    Ok(Read { garment, is_edited })
}

/// Reads an envelope from a JSON value.
///
/// # Errors
/// See [`BundleError`].
pub fn from_value(value: serde_json::Value) -> Result<Garment, BundleError> {
    let head = Head::deserialize(&value)?;
    check_head(&head)?;
    let garment = serde_json::from_value::<Envelope>(value)?.garment;
    check_indices(&garment)?;
    check_places(&garment)?;
    Ok(garment)
}

fn check_head(head: &Head) -> Result<(), BundleError> {
    if head.kind != KIND {
        return Err(BundleError::Kind(head.kind.clone()));
    }
    if head.version > VERSION {
        return Err(BundleError::Version(head.version));
    }
    Ok(())
}

fn check_indices(garment: &Garment) -> Result<(), BundleError> {
    let damaged = |what: String| Err(BundleError::Damaged(what));
    for (i, piece) in garment.pieces.iter().enumerate() {
        if piece.id.index() != i {
            return damaged(format!("piece {i} carries the id {}", piece.id.0));
        }
        let Some(mesh) = &piece.mesh else { continue };
        let n = mesh.rest.len();
        let inside = |v: &u32| (*v as usize) < n;
        let ids_hold = mesh.triangles.iter().flatten().all(inside)
            && mesh.chains.iter().flat_map(|c| &c.vertices).all(inside)
            && mesh.outline_vertex.iter().flatten().all(inside)
            && mesh.rest_corners.as_ref().is_none_or(|c| c.len() == mesh.triangles.len())
            && piece.darts.iter().filter_map(|d| d.mesh.as_ref()).flat_map(|m| m.legs.iter().flatten()).all(inside);
        if !ids_hold {
            return damaged(format!("piece `{}` names a vertex beyond its {n}", piece.name));
        }
    }
    let vertex_count = |piece: crate::ids::PieceId| {
        garment.pieces.get(piece.index()).and_then(|p| p.mesh.as_ref()).map_or(0, |m| m.rest.len())
    };
    for seam in &garment.seams {
        for stitch in &seam.stitches {
            for end in [stitch.a, stitch.b] {
                if end.vertex as usize >= vertex_count(end.piece) {
                    return damaged(format!("seam `{}` names a vertex that is not there", seam.name));
                }
            }
        }
    }
    let shapes = [&garment.stitched, &garment.drape, &garment.drape_before_edit].into_iter().flatten();
    let frames = garment.animation.iter().flat_map(|a| &a.frames);
    for positions in shapes.map(|s| &s.positions).chain(frames) {
        let fits = positions.len() == garment.pieces.len()
            && garment
                .pieces
                .iter()
                .zip(positions)
                .all(|(p, x)| p.mesh.as_ref().is_some_and(|m| m.rest.len() == x.len()));
        if !fits {
            return damaged("positions and vertices differ in number".to_owned());
        }
    }
    Ok(())
}

/// No place of a garment is as far from the origin as this, metres.
const FARTHEST: f64 = 1e4;

/// Lines, marks and vertices are where a garment can be.
fn check_places(garment: &Garment) -> Result<(), BundleError> {
    // A number that is not finite is too far as well.
    let is_far = |x: &f64| x.is_nan() || x.abs() > FARTHEST;
    let damaged = |name: &str, what: &str, x: f64| {
        let reason = format!("{what} of piece `{name}` is at {x:e} m, and no garment reaches as far as {FARTHEST:e} m");
        Err(BundleError::Damaged(reason))
    };
    for piece in &garment.pieces {
        let inner = piece.internal_lines.iter().chain(&piece.cutouts).chain(&piece.match_lines);
        let lines = std::iter::once(&piece.outline).chain(&piece.cut_line).chain(inner);
        let drawn = piece.drawn.iter().flat_map(|d| d.outline.iter().chain(&d.cut_line));
        let on_lines = lines.flat_map(|l| &l.points).chain(drawn).map(|p| p.at);
        let marks = piece.notches.iter().map(|n| n.at).chain(piece.drill_holes.iter().map(|d| d.at));
        let axes = piece.grain.iter().chain(&piece.fold).flatten().copied().chain(piece.texts.iter().map(|t| t.at));
        let darts = piece.darts.iter().flat_map(|d| d.apexes.iter().chain(&d.mouth).chain(d.legs.iter().flatten()));
        let mesh = piece.mesh.iter().flat_map(|m| &m.rest);
        let mut flat =
            on_lines.chain(marks).chain(axes).chain(darts.copied()).chain(mesh.copied()).flat_map(|p| [p.x, p.y]);
        if let Some(x) = flat.find(is_far) {
            return damaged(&piece.name, "a point", x);
        }
    }
    let shapes = [&garment.stitched, &garment.drape, &garment.drape_before_edit].into_iter().flatten();
    let frames = garment.animation.iter().flat_map(|a| &a.frames);
    for positions in shapes.map(|s| &s.positions).chain(frames) {
        for (piece, positions) in garment.pieces.iter().zip(positions) {
            if let Some(x) = positions.iter().flat_map(|p| [p.x, p.y, p.z]).find(is_far) {
                return damaged(&piece.name, "a vertex", x);
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::{LinePoint, PieceLine, PointKind};
    use crate::{Piece, Vec2};

    #[test]
    fn a_document_whose_positions_were_edited_has_no_certificate() {
        use crate::garment::{Certificate, Shape};
        use crate::mesh::PieceMesh;
        let mesh = PieceMesh { rest: vec![Vec2::new(0.1, 0.2)], ..PieceMesh::default() };
        let piece = Piece { name: "front".into(), mesh: Some(mesh), ..Piece::default() };
        let drape = Shape { positions: vec![vec![crate::Vec3::new(0.1, 1.25, 0.3)]], ..Shape::default() };
        let certificate = Some(Certificate { passed: true, ..Certificate::default() });
        let garment = Garment { pieces: vec![piece], drape: Some(drape), certificate, ..Garment::default() };
        let text = to_text(&garment).expect("text");
        let same = read(&text).expect("read");
        assert!(same.garment == garment && !same.is_edited);
        let edited = text.replace("1.25", "1.26");
        let read_back = read(&edited).expect("read");
        assert!(read_back.is_edited && read_back.garment.certificate.is_none());
        // A program that settles the shape and certifies it anew is believed.
        let renewed = read(&edited.replace("\"passed\":true", "\"passed\":false")).expect("read");
        assert!(!renewed.is_edited && renewed.garment.certificate.is_some());
    }

    #[test]
    fn a_place_where_no_garment_can_be_is_refused() {
        for (x, good) in [(9e3, true), (1.1e4, false), (-1e308, false)] {
            let mut piece = Piece { name: "front".into(), ..Piece::default() };
            let point = LinePoint { at: Vec2::new(0.0, x), kind: PointKind::Turn };
            piece.internal_lines.push(PieceLine { points: vec![point], ..PieceLine::default() });
            let garment = Garment { pieces: vec![piece], ..Garment::default() };
            let read = from_text(&to_text(&garment).expect("text"));
            assert_eq!(read.is_ok(), good, "{x}");
            let said = read.err().map(|e| e.to_string()).unwrap_or_default();
            assert!(good || said.contains("a point of piece `front`"), "{said}");
        }
    }

    #[test]
    fn round_trip_keeps_the_document() {
        let garment = Garment { style: "s".into(), ..Garment::default() };
        let text = to_text(&garment).expect("text");
        assert_eq!(from_text(&text).expect("read"), garment);
    }

    #[test]
    fn refuses_other_kinds_and_newer_versions() {
        assert!(matches!(from_text(r#"{"kind":"x","version":1,"garment":{}}"#), Err(BundleError::Kind(_))));
        assert!(matches!(from_text(r#"{"kind":"toile-garment","version":99}"#), Err(BundleError::Version(99))));
    }
}
