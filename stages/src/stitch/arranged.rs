//! Pieces that the sewing file does not place: they are arranged by their roles and seams.

use super::place::{Wrap, is_arranged, spec_of};
use super::{codes, plan_check};
use crate::arrange::{Arrangement, Given, Sheet, arrange};
use crate::body::with_segments;
use crate::roles::{Join, PiecePoint, joins_of_meshes, joins_of_plan, roles};
use crate::sewing::resolve::ResolvedSeam;
use crate::solve::Layout;
use crate::solve::layer_of;
use toile_garment::body::Body;
use toile_garment::sewing::{AttachSpec, AttachStrength, Placement};
use toile_garment::{Diagnostic, Garment, Piece, Report, Vec3};

/// Confidence of a place below which its piece is named in the finding.
const SURE: f64 = 0.5;

/// Where the pieces without a place of their own start; nothing where all have one.
#[derive(Clone, Debug, Default)]
pub struct Arranged {
    pub(super) sheets: Vec<Option<Sheet>>,
}

impl Arranged {
    /// The sheet of a piece.
    pub fn sheet(&self, piece: &Piece) -> Option<&Sheet> {
        self.sheets.get(piece.id.index())?.as_ref()
    }
}

/// Arranges the pieces without a place, and holds the edges that have to be held where the sewing file holds none. Both
/// are told.
///
/// # Errors
/// All pieces that cannot be placed, each with the reason.
pub fn arranged(garment: &mut Garment, report: &mut Report) -> Result<Arranged, Vec<Diagnostic>> {
    if !garment.pieces.iter().any(|p| is_arranged(garment, p)) {
        return Ok(Arranged::default());
    }
    if let Some(body) = &garment.body {
        let whole = with_segments(body);
        let found: Vec<&str> =
            whole.segments.keys().filter(|n| !body.segments.contains_key(*n)).map(String::as_str).collect();
        if !found.is_empty() {
            report.push(finding_of_segments(body, &whole, &found));
        }
        garment.body = Some(whole);
    }
    let arrangement = arrangement_of(garment, &joins_of_meshes(garment));
    let errors: Vec<Diagnostic> = faults(garment, &arrangement).collect();
    if !errors.is_empty() {
        return Err(errors);
    }
    report.push(finding(garment, &arrangement));
    if garment.plan.attachments.is_empty() && !arrangement.held.is_empty() {
        garment.plan.attachments = held(garment, &arrangement);
        report.push(finding_of_held(garment));
    }
    let sheets = arrangement.places.into_iter().map(|place| place.map(|p| p.sheet)).collect();
    Ok(Arranged { sheets })
}

/// Pieces that cannot be placed, and seams that are out of reach, as far as the sewing file tells.
pub fn foreseen(garment: &Garment) -> Vec<Diagnostic> {
    let Ok(shapes) = crate::sewing::shapes::shapes(garment) else { return Vec::new() };
    // Seams that cannot be found are told by the stage that sews.
    let Ok(seams) = crate::sewing::resolve::placed(crate::sewing::resolve::find(garment, &shapes)) else {
        return Vec::new();
    };
    let joins = joins_of_plan(&seams, &shapes);
    let mut found = out_of_reach(garment, &seams, &joins);
    if garment.pieces.iter().any(|p| is_arranged(garment, p)) {
        found.extend(faults(garment, &arrangement_of(garment, &joins)));
    }
    found
}

/// Seams between pieces that the sewing file places too far apart.
fn out_of_reach(garment: &Garment, seams: &[ResolvedSeam], joins: &[Join]) -> Vec<Diagnostic> {
    let sheets: Vec<Option<Sheet>> = garment.pieces.iter().map(|p| given(garment, p)).collect();
    let at = |p: &PiecePoint| Some(sheets.get(p.piece)?.as_ref()?.at(p.at));
    let beyond = |(seam, join): (&ResolvedSeam, &Join)| {
        let threads: Vec<f64> = join.pairs.iter().filter_map(|[a, b]| Some((at(a)? - at(b)?).norm())).collect();
        let pieces = seam.a.spans.iter().chain(&seam.b.spans).map(|span| span.piece);
        plan_check::beyond_reach(garment, &seam.name, pieces, &threads, seam.source.as_ref())
    };
    seams.iter().zip(joins).filter_map(beyond).collect()
}

fn arrangement_of(garment: &Garment, joins: &[Join]) -> Arrangement {
    let given = Given {
        sheets: garment.pieces.iter().map(|p| given(garment, p)).collect(),
        layers: garment.pieces.iter().map(|p| layer_of(garment, p)).collect(),
    };
    arrange(&garment.pieces, &roles(&garment.pieces, joins), joins, garment.body.as_ref(), given)
}

/// For every vertex of a garment, whether its piece is sewn on when all others are sewn.
pub fn sewn_last(garment: &Garment, layout: &Layout) -> Vec<bool> {
    let joins = joins_of_meshes(garment);
    let last = crate::arrange::sewn_last(&garment.pieces, &roles(&garment.pieces, &joins), &joins);
    let vertices = garment.pieces.iter().map(|p| p.mesh.as_ref().map_or(0, |m| m.rest.len())).enumerate();
    let each: Vec<Vec<bool>> = vertices.map(|(piece, count)| vec![last.contains(&piece); count]).collect();
    layout.join(&each)
}

/// The sheet of a piece that the sewing file places.
fn given(garment: &Garment, piece: &Piece) -> Option<Sheet> {
    match &spec_of(garment, piece)?.placement {
        Placement::Moved { .. } => None,
        Placement::Explicit { rotation, translation } => {
            let column = |k: usize| Vec3::new(rotation[0][k], rotation[1][k], rotation[2][k]);
            Some(Sheet { origin: *translation, ..Sheet::facing(column(2), column(1), 0.0) })
        }
        // What is wrong with it is told where it is placed.
        Placement::Around(place) => Wrap::new(garment, piece, place, 0.02).ok()?.sheet(garment),
    }
}

fn faults<'a>(garment: &'a Garment, arrangement: &'a Arrangement) -> impl Iterator<Item = Diagnostic> + 'a {
    arrangement.unplaced.iter().map(|(i, why)| {
        let piece = &garment.pieces[*i];
        let message = format!("nothing says where piece `{}` starts in 3D: {why}", piece.name);
        let hint = format!(
            "sew it to another piece, leave it out (leave_out = [\"{0}\"]), or add to the sewing file: [[place]] piece = \
             \"{0}\" around = \"torso\" side = \"front\" height = \"1050 mm\", or a rotation and a translation",
            piece.name
        );
        Diagnostic::error(codes::PIECE_NOT_PLACED, message).at(piece.source.clone()).hint(hint)
    })
}

fn finding(garment: &Garment, arrangement: &Arrangement) -> Diagnostic {
    let own = |p: &&Piece| is_arranged(garment, p);
    let count = garment.pieces.iter().filter(own).count();
    let place = |p: &Piece| arrangement.places[p.id.index()].as_ref();
    let doubtful: Vec<String> = garment
        .pieces
        .iter()
        .filter(own)
        .filter(|p| place(p).is_some_and(|place| place.confidence < SURE))
        .map(|p| format!("`{}`", p.name))
        .collect();
    let unsure = if doubtful.is_empty() { String::new() } else { format!("; least sure: {}", doubtful.join(", ")) };
    let message = format!(
        "{count} of {} pieces were arranged by their roles and seams; threads are {:.0} mm long on average and {:.0} mm at \
         most{unsure}",
        garment.pieces.len(),
        arrangement.mean_thread * 1e3,
        arrangement.longest_thread * 1e3
    );
    Diagnostic::info(codes::ARRANGED, message)
        .hint("a [[place]] in the sewing file moves a piece, or puts it elsewhere")
}

fn finding_of_segments(body: &Body, whole: &Body, found: &[&str]) -> Diagnostic {
    let waist = whole.landmarks.get("waist").filter(|_| !body.landmarks.contains_key("waist"));
    let waist = waist.map_or(String::new(), |p| format!("; its waist lies at {:.0} mm", p.y * 1e3));
    let message = format!("body `{}` names no {}: found on its mesh{waist}", body.name, found.join(", "));
    let hint = "a side file with [segments] and [landmarks] beside the OBJ says otherwise";
    Diagnostic::info(codes::BODY_SEGMENTS_FOUND, message).hint(hint)
}

fn held(garment: &Garment, arrangement: &Arrangement) -> Vec<AttachSpec> {
    let spec = |h: &crate::arrange::Held| AttachSpec {
        piece: garment.pieces[h.piece].name.clone(),
        edge: h.edge.to_string(),
        to: "waist".to_owned(),
        strength: AttachStrength::Hold,
        source: None,
    };
    arrangement.held.iter().map(spec).collect()
}

fn finding_of_held(garment: &Garment) -> Diagnostic {
    let edges: Vec<String> = garment.plan.attachments.iter().map(|a| format!("{}.{}", a.piece, a.edge)).collect();
    let message = format!("nothing held the garment up: the edges {} are held at the waist", edges.join(", "));
    Diagnostic::info(codes::HELD_AT_WAIST, message).hint("an [[attach]] in the sewing file says otherwise")
}
