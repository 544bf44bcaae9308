//! Pieces that the sewing file does not place: they are arranged by their roles and seams.

use super::place::{Wrap, is_arranged, spec_of};
use super::{codes, plan_check};
use crate::arrange::{Arranged, Arrangement, Given, Laid, Sheet, Whole, arrange_wholes};
use crate::body::with_segments;
use crate::roles::{Join, PiecePoint, joins_of_meshes, joins_of_plan, roles};
use crate::sewing::resolve::ResolvedSeam;
use crate::solve::Layout;
use crate::solve::layer_of;
use toile_garment::body::Body;
use toile_garment::sewing::{AttachSpec, AttachStrength, Placement, WholeSpec};
use toile_garment::{Diagnostic, Garment, Piece, PieceId, Report, Vec2, Vec3};

/// Confidence of a place below which its piece is named in the finding.
const SURE: f64 = 0.5;

/// Where the pieces without a place of their own start; nothing where all have one.
#[derive(Clone, Debug, Default)]
pub struct Starts {
    pub(super) by_piece: Vec<Option<(Sheet, Laid)>>,
}

impl Starts {
    /// Where the points of a piece start.
    pub fn start(&self, piece: &Piece) -> Option<impl Fn(Vec2) -> Vec3> {
        let (sheet, laid) = self.by_piece.get(piece.id.index())?.as_ref()?;
        Some(|p| sheet.at(laid.at(p)))
    }
}

/// Arranges the pieces without a place, and holds the edges that have to be held where the sewing file holds none. Both
/// are told.
///
/// # Errors
/// All pieces that cannot be placed, each with the reason.
pub fn arranged(garment: &mut Garment, report: &mut Report) -> Result<Starts, Vec<Diagnostic>> {
    report.findings.extend(placed_parts(garment));
    if !garment.pieces.iter().any(|p| is_arranged(garment, p)) {
        return Ok(Starts::default());
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
    let Arranged { arrangement, starts, apart } = arrangement_of(garment, &joins_of_meshes(garment));
    report
        .findings
        .extend(apart.iter().map(|name| unused_whole(garment, name, "are not sewn to one another side by side")));
    let errors: Vec<Diagnostic> = faults(garment, &arrangement).collect();
    if !errors.is_empty() {
        return Err(errors);
    }
    report.push(finding(garment, &arrangement));
    if garment.plan.attachments.is_empty() && !arrangement.held.is_empty() {
        garment.plan.attachments = held(garment, &arrangement);
        report.push(finding_of_held(garment));
    }
    let starts = arrangement.places.into_iter().zip(starts).map(|(place, laid)| Some((place?.sheet, laid)));
    Ok(Starts { by_piece: starts.collect() })
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
        found.extend(faults(garment, &arrangement_of(garment, &joins).arrangement));
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

fn arrangement_of(garment: &Garment, joins: &[Join]) -> Arranged {
    let given = Given {
        sheets: garment.pieces.iter().map(|p| given(garment, p)).collect(),
        layers: garment.pieces.iter().map(|p| layer_of(garment, p)).collect(),
    };
    arrange_wholes(&garment.pieces, joins, &wholes(garment), garment.body.as_ref(), given)
}

/// The pieces that were cut apart, but for those of which a person places a part.
fn wholes(garment: &Garment) -> Vec<Whole> {
    let whole = |spec: &WholeSpec| {
        let part = |name: &String| crate::sewing::lookup::piece(garment, name, None).ok().map(PieceId::index);
        let parts = spec.pieces.iter().map(part).collect::<Option<Vec<usize>>>()?;
        placed_part(garment, spec).is_none().then(|| Whole { name: spec.name.clone(), parts })
    };
    garment.plan.wholes.iter().filter_map(whole).collect()
}

/// A part that a person places.
fn placed_part<'g>(garment: &'g Garment, spec: &WholeSpec) -> Option<&'g Piece> {
    let is_part = |p: &&Piece| spec.pieces.iter().any(|name| name.eq_ignore_ascii_case(&p.name));
    garment.pieces.iter().filter(is_part).find(|p| !is_arranged(garment, p))
}

/// Whole pieces of which a person places a part.
fn placed_parts(garment: &Garment) -> Vec<Diagnostic> {
    let placed = |spec: &WholeSpec| {
        let part = placed_part(garment, spec)?;
        Some(unused_whole(garment, &spec.name, &format!("start one by one, for `{}` has a [[place]]", part.name)))
    };
    garment.plan.wholes.iter().filter_map(placed).collect()
}

fn unused_whole(garment: &Garment, name: &str, why: &str) -> Diagnostic {
    let source = garment.plan.wholes.iter().find(|w| w.name == name).and_then(|w| w.source.clone());
    Diagnostic::warning(codes::WHOLE_UNUSED, format!("the parts of `{name}` {why}"))
        .at(source)
        .hint("take the [[whole]] out of the sewing file, or the [[place]] of its part")
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
