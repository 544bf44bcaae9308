//! The plan applied to freshly imported pieces.

mod claims;
mod contradictions;
pub mod copies;
pub mod darts;
mod doubtful;
pub mod folds;
mod names;
mod undecided;

use super::codes;
use super::resolve::{elastic_side, find, placed};
use super::shapes::{Shapes, shapes};
use crate::codes::{PIECE_UNKNOWN, SEAM_PROPOSED};
use toile_formats::codes::PIECES_LEFT_OUT;
use toile_formats::dxf::darts::UndecidedDart;
use toile_garment::sewing::{SeamSpec, SewingPlan};
use toile_garment::{Diagnostic, Garment, PieceId, Report};
use toile_stage_api::StageError;

/// Applies a plan to freshly imported pieces: leaves out and copies pieces, names edges, adds and removes darts, and
/// stores the plan in the garment.
///
/// # Errors
/// When the plan names a piece, edge or point that is not there.
pub fn apply(garment: &mut Garment, plan: SewingPlan, report: &mut Report) -> Result<(), StageError> {
    apply_deciding(garment, plan, Vec::new(), report)
}

/// [`apply`], and the wedges that the reader leaves undecided become darts where the plan closes them. The others are
/// told, unless the plan says what they are.
///
/// # Errors
/// As [`apply`].
pub fn apply_deciding(
    garment: &mut Garment,
    plan: SewingPlan,
    undecided: Vec<UndecidedDart>,
    report: &mut Report,
) -> Result<(), StageError> {
    let mut errors = Vec::new();
    report.findings.extend(plan.seams.iter().filter_map(proposed));
    report.findings.extend(names_that_repeat(&plan.seams));
    garment.plan = plan;
    leave_out(garment, report, &mut errors);
    // Drawn pieces first, so that copies inherit names and darts; then what is said of the copies themselves.
    let copies = garment.plan.copies.clone();
    let is_copy = |name: &str| copies.iter().any(|c| c.name.eq_ignore_ascii_case(name));
    names::edges(garment, |piece| !is_copy(piece), &mut errors);
    darts::declare(garment, |piece| !is_copy(piece), &undecided, report, &mut errors);
    folds::declare(garment, |piece| !is_copy(piece), &mut errors);
    undecided::decide(garment, undecided, report, &mut errors);
    copies::copy(garment, &mut errors);
    names::edges(garment, is_copy, &mut errors);
    darts::declare(garment, is_copy, &[], report, &mut errors);
    folds::declare(garment, is_copy, &mut errors);
    let doubts = doubtful::set_aside(garment, &errors);
    names::canonical(garment, &mut errors);
    errors.extend(contradictions::check(&garment.plan));
    for error in wrong_seams(garment, report) {
        if !errors.contains(&error) {
            errors.push(error);
        }
    }
    doubts.set_lengths_aside(garment);
    if errors.is_empty() { Ok(()) } else { Err(StageError::Parameter(errors)) }
}

/// The mistakes of what is sewn. A seam along a dart decides whether there is one.
fn wrong_seams(garment: &mut Garment, report: &mut Report) -> Vec<Diagnostic> {
    // Bad outlines are for the stage that needs them, with all their places.
    let Ok(rings) = shapes(garment) else { return Vec::new() };
    // A wedge that is no dart is part of the outline again.
    let rings = if claims::release(garment, &rings, report) { shapes(garment) } else { Ok(rings) };
    rings.map(|rings| check_seams(garment, &rings)).unwrap_or_default()
}

/// The note on a seam that nobody has confirmed yet.
fn proposed(seam: &SeamSpec) -> Option<Diagnostic> {
    let share = seam.proposed?;
    let message = format!("seam `{}` is proposed, {:.0} % sure", seam.name, 100.0 * share);
    let hint = "look at it, and remove `proposed` from it in the sewing file when it is right";
    Some(Diagnostic::info(SEAM_PROPOSED, message).at(seam.source.clone()).hint(hint))
}

/// Seams that have the name of an earlier one.
fn names_that_repeat(seams: &[SeamSpec]) -> impl Iterator<Item = Diagnostic> {
    let repeats = |(k, seam): (usize, &SeamSpec)| {
        let first = seams[..k].iter().find(|s| s.name == seam.name)?;
        let line =
            first.source.as_ref().and_then(|s| s.line).map_or_else(String::new, |line| format!(" in line {line}"));
        let message = format!("a seam{line} is called `{}`, too: reports cannot tell the two apart", seam.name);
        let hint = "give every seam a name of its own";
        Some(Diagnostic::warning(codes::SEAM_NAME_REPEATS, message).at(seam.source.clone()).hint(hint))
    };
    seams.iter().enumerate().filter_map(repeats)
}

/// Checks that all seams, attachments, elastic bands and interlinings are where they say.
fn check_seams(garment: &Garment, rings: &Shapes) -> Vec<Diagnostic> {
    let mut errors = placed(find(garment, rings)).err().unwrap_or_default();
    for attach in &garment.plan.attachments {
        let run = toile_garment::sewing::RunSpec::Edge { piece: attach.piece.clone(), edge: attach.edge.clone() };
        errors.extend(super::lookup::run(garment, rings, &run, attach.source.as_ref()).err());
    }
    let stiffened = garment.plan.interlinings.iter().map(|i| (&i.pieces, &i.source));
    let cut = garment.plan.wholes.iter().map(|w| (&w.pieces, &w.source));
    for (pieces, source) in stiffened.chain(cut) {
        let found = pieces.iter().map(|name| super::lookup::piece(garment, name, source.as_ref()));
        errors.extend(found.filter_map(Result::err));
    }
    errors.extend(garment.plan.elastics.iter().filter_map(|e| elastic_side(garment, rings, e).err()));
    errors
}

fn leave_out(garment: &mut Garment, report: &mut Report, errors: &mut Vec<Diagnostic>) {
    let names = |garment: &Garment| garment.pieces.iter().map(|p| p.name.clone()).collect::<Vec<_>>();
    let before = names(garment);
    remove(garment, errors);
    let left = names(garment);
    let out: Vec<String> = before.into_iter().filter(|name| !left.contains(name)).map(|n| format!("`{n}`")).collect();
    if !out.is_empty() {
        let message = format!("left out of the garment: {}", out.join(", "));
        let remedy = "to have one sewn, take it out of `leave_out` in the sewing file, and write its seams";
        report.push(Diagnostic::info(PIECES_LEFT_OUT, message).hint(remedy));
    }
}

/// Removes the pieces that the list names.
fn remove(garment: &mut Garment, errors: &mut Vec<Diagnostic>) {
    for word in &garment.plan.leave_out {
        let is = |text: &Option<String>| text.as_deref().is_some_and(|t| t.eq_ignore_ascii_case(word));
        let before = garment.pieces.len();
        if garment.pieces.iter().any(|p| p.name.eq_ignore_ascii_case(word)) {
            garment.pieces.retain(|p| !p.name.eq_ignore_ascii_case(word));
        } else {
            garment.pieces.retain(|p| !is(&p.material) && !is(&p.category));
        }
        if garment.pieces.len() == before {
            let names: Vec<_> = garment.pieces.iter().map(|p| p.name.as_str()).collect();
            let message = format!("leave_out: no piece, material or category is called `{word}`");
            let found = Diagnostic::error(PIECE_UNKNOWN, message).at(garment.plan.leave_out_source.clone());
            errors.push(found.hint(super::lookup::nearest(word, &names)));
        }
    }
    number(garment);
}

/// Ids follow the order of the list.
fn number(garment: &mut Garment) {
    for (i, piece) in garment.pieces.iter_mut().enumerate() {
        piece.id = PieceId::from(i);
    }
}

#[cfg(test)]
mod tests;
