//! GarmentCode pattern specifications (JSON): panels with curved edges, their places around the body, and stitches.
//!
//! A panel whose edge loop runs clockwise shows its wrong side: it is mirrored, so that the right side of every piece
//! faces the reader and its outline runs counter-clockwise. A stitch between two neighbouring edges of one panel that
//! meet in a reflex vertex is a dart; all others are seams.
//! Curves: quadratic and cubic Bézier with control points relative to the edge, and arcs of a circle with radius in
//! file units. Rotations are Euler angles in degrees, applied about x, then y, then z.

pub(crate) mod codes;
mod edges;
mod panel;
mod spec;
mod stitches;
#[cfg(test)]
mod tests;

use crate::codes::FILE_TOO_LARGE;
use toile_garment::sewing::{PlaceSpec, Placement, SewingPlan};
use toile_garment::{Diagnostic, Garment, PieceId, SourceRef, Vec3};

/// Largest file, bytes.
const BYTES: usize = 64 << 20;
/// Most panels.
const PANELS: usize = 500;
/// Most edges of a panel.
const EDGES: usize = 5_000;
/// Most stitches.
const STITCHES: usize = 20_000;

/// A garment and the plan of its sewing.
#[derive(Clone, Debug)]
pub struct Read {
    /// Pieces with darts; the plan is not yet applied.
    pub garment: Garment,
    /// Seams and places.
    pub plan: SewingPlan,
    /// Findings; none is an error.
    pub findings: Vec<Diagnostic>,
}

/// Reads a specification. `file` is its name for messages, `flatness` how near chords keep to curves, metres.
///
/// # Errors
/// All mistakes, each with its panel, edge or stitch.
pub fn read(bytes: &[u8], file: &str, flatness: f64) -> Result<Read, Vec<Diagnostic>> {
    let place = || SourceRef::file(file);
    if bytes.len() > BYTES {
        let text = format!("a specification of {} bytes; {BYTES} can be read", bytes.len());
        return Err(vec![Diagnostic::error(FILE_TOO_LARGE, text).at(place())]);
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let spec = spec::parse(bytes).map_err(|list| at(list, file))?;
    let mut garment = Garment { style: stem(file), ..Garment::default() };
    let mut plan = SewingPlan::default();
    let mut errors = Vec::new();
    let mut panels = Vec::new();
    for (i, panel) in spec.panels.iter().enumerate() {
        match panel::piece(panel, &spec, flatness) {
            Ok(mut built) => {
                built.piece.id = PieceId::from(i);
                built.piece.source = Some(place());
                plan.places.push(PlaceSpec {
                    piece: panel.name.clone(),
                    placement: explicit(&built, &spec),
                    ignores: None,
                    source: Some(place()),
                });
                garment.pieces.push(built.piece.clone());
                panels.push(built);
            }
            Err(error) => errors.push(error),
        }
    }
    if !errors.is_empty() {
        return Err(at(errors, file));
    }
    let mut findings = Vec::new();
    let sewn = stitches::seams(&spec, &panels, &mut findings).map_err(|list| at(list, file))?;
    for (i, dart) in sewn.darts {
        let darts = &mut garment.pieces[i].darts;
        let name = format!("dart-{}", darts.len() + 1);
        darts.push(toile_garment::dart::Dart { name, ..dart });
    }
    plan.seams = sewn.seams;
    plan.seams.iter_mut().for_each(|s| s.source = Some(place()));
    Ok(Read { garment, plan, findings: at(findings, file) })
}

/// An entry that cannot be right.
fn wrong(what: String) -> Diagnostic {
    let remedy = "mend this entry of the specification, or make it anew in GarmentCode";
    Diagnostic::error(codes::GARMENTCODE_WRONG, what).hint(remedy)
}

fn at(list: Vec<Diagnostic>, file: &str) -> Vec<Diagnostic> {
    list.into_iter().map(|d| d.at(SourceRef::file(file))).collect()
}

/// `skirt` of `path/skirt_specification.json`.
fn stem(file: &str) -> String {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let name = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    name.trim_end_matches("_specification").to_owned()
}

/// The placement of a panel; of a mirrored one its x and z axes point the other way.
fn explicit(panel: &panel::Built, spec: &spec::Spec) -> Placement {
    let mut rotation = rotation(panel.rotation);
    if panel.mirrored {
        for row in &mut rotation {
            row[0] = -row[0];
            row[2] = -row[2];
        }
    }
    let [x, y, z] = panel.translation.map(|v| v * spec.unit);
    Placement::Explicit { rotation, translation: Vec3::new(x, y, z) }
}

/// Rows of Rz · Ry · Rx.
fn rotation(degrees: [f64; 3]) -> [[f64; 3]; 3] {
    let [(sx, cx), (sy, cy), (sz, cz)] = degrees.map(|d| libm::sincos(d.to_radians()));
    [
        [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
        [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
        [-sy, cy * sx, cy * cx],
    ]
}
