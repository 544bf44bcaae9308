//! A working folder made from a pattern: pipeline, sewing file with proposed seams, fabric, body, and the proposal.
//!
//! Nothing that lies in the folder already is changed.

mod alternatives;
mod buttons;
pub(crate) mod codes;
mod cut;
mod document;
mod dress;
mod earlier;
mod fits;
mod folder;
mod page;
mod pattern;
mod pipeline;
mod samples;
mod sewing;
mod stand;
mod stock;
mod unsewn;

pub(crate) use codes::{BODY_NOT_STANDING, FABRIC_CHOSEN, SIZE_TAKEN};
pub use earlier::Earlier;
pub use folder::{Folder, Made};
pub use pattern::{Source, Why, Wishes, read};
pub use samples::{SAMPLES, Sample};
pub(crate) use stand::{differing, told, upright};
pub(crate) use stock::no_size;
pub use stock::{Body, Fabric};

use stock::Opened;

use serde_json::Value;
use toile_formats::report::Language;
use toile_garment::{Diagnostic, Piece};
use toile_stages::proposal::{Known, Nameless, Names, Proposal, RoleNames, own_images, propose};
use toile_stages::roles::{Role, roles_of_names};

/// The remedy where a fabric was chosen that a person did not ask for.
pub(crate) const FABRIC_HINT: &str = "--fabric NAME or --fabric FILE takes another one";

/// The wishes of a person.
#[derive(Debug)]
pub struct Order<'a> {
    /// The pattern.
    pub source: &'a Source,
    /// The body.
    pub body: Body,
    /// Did a person ask for this body?
    pub is_body_asked: bool,
    /// Did a person ask for this size of the pattern?
    pub is_size_asked: bool,
    /// The fabric.
    pub fabric: Fabric,
    /// The fabric of a garment that is narrower than its body, where a person asked for none.
    pub knit: Option<Fabric>,
    /// The folder's earlier content.
    pub earlier: Option<&'a Earlier>,
    /// Are the names of the pieces left out of account?
    pub is_anonymous: bool,
    /// Language of the page.
    pub language: Language,
}

/// A folder that was put together, and what is open in it.
#[derive(Debug)]
pub struct New {
    /// The files.
    pub folder: Folder,
    /// The proposal, as `proposal.json` holds it.
    pub proposal: Value,
    /// Seams that are proposed and that no file has.
    pub seams: usize,
    /// Seams that are too unsure to be sewn.
    pub open: usize,
    /// Findings on the body.
    pub findings: Vec<Diagnostic>,
}

fn proposed(source: &Source, is_anonymous: bool, known: &Known) -> Result<Proposal, Vec<Diagnostic>> {
    let names: Box<dyn Names> =
        if is_anonymous { Box::new(Nameless) } else { Box::new(RoleNames::new(&source.garment)) };
    propose(&source.garment, names.as_ref(), known)
}

/// A pattern of whose collars and hoods one is sewn: the one that fits the neckline of the garment without them.
fn with_one_collar(order: &Order<'_>) -> Result<Source, Vec<Diagnostic>> {
    let source = order.source;
    let pieces = &source.garment.pieces;
    let (roles, own) = (roles_of_names(pieces), own_images(&source.garment));
    let is_sewn = |p: &&Piece| !source.garment.plan.leave_out.contains(&p.name);
    let known = |p| known(source, p, &roles, &own);
    let known: Vec<alternatives::Known<'_>> = pieces.iter().filter(is_sewn).map(known).collect();
    let necks = alternatives::of_neck(&known);
    if necks.is_empty() {
        return Ok(source.clone());
    }
    let names = |keep: Option<usize>| -> Vec<String> {
        let others = necks.iter().enumerate().filter(|(k, _)| Some(*k) != keep);
        others.map(|(_, k)| k.piece.name.clone()).collect()
    };
    let bare = proposed(&source.without(&names(None), Why::StandsFor), order.is_anonymous, &Known::default())?;
    let best = alternatives::best_at_neck(&necks, &bare);
    Ok(source.without(&names(Some(best)), Why::StandsFor))
}

/// A piece with what names and copies say of it.
fn known<'a>(source: &Source, piece: &'a Piece, roles: &'a [Role], own: &[bool]) -> alternatives::Known<'a> {
    let at = piece.id.index();
    let is_double = source.copies.iter().any(|c| c.piece == piece.name || c.name == piece.name);
    alternatives::Known { piece, role: &roles[at], is_double, is_own_image: own[at] }
}

/// A pattern on its body.
struct Worn {
    body: Body,
    fabric: Fabric,
    opened: Opened,
    dressed: dress::Dressed,
    findings: Vec<Diagnostic>,
}

/// Lays a pattern on the body that was asked for, or on the one of its own size, and questions the body.
fn worn(order: &Order<'_>, source: &Source, proposal: &Proposal) -> Result<Worn, Vec<Diagnostic>> {
    let lay = |body: &Body| -> Result<(Opened, dress::Dressed), Vec<Diagnostic>> {
        let opened = body.open()?;
        let dressed = dress::dress(source, proposal, opened.model.as_ref(), order.is_anonymous);
        Ok((opened, dressed))
    };
    let mut body = order.body.clone();
    let (mut opened, mut dressed) = lay(&body)?;
    let mut findings = std::mem::take(&mut opened.findings);
    if !order.is_body_asked
        && let Some((other, finding)) =
            opened.model.as_ref().and_then(|b| fits::better(source, &dressed, b, order.is_size_asked))
    {
        (opened, dressed) = lay(&other)?;
        body = other;
        findings.push(finding);
    }
    let narrow = || opened.model.as_ref().and_then(|b| fits::narrow(&source.garment, &dressed, b));
    // A body that a person asked for may be too large.
    let knit = order.knit.as_ref().filter(|_| !order.is_body_asked).and_then(|knit| Some((knit, narrow()?)));
    if let Some((knit, girths)) = knit {
        let message = format!("the garment has {girths}, so it is a knit: {} was chosen", knit.name());
        findings.push(Diagnostic::info(FABRIC_CHOSEN, message).hint(FABRIC_HINT));
        return Ok(Worn { fabric: knit.clone(), body, opened, dressed, findings });
    }
    findings.extend(opened.model.as_ref().and_then(|b| fits::question(source, &dressed, &body, b)));
    Ok(Worn { fabric: order.fabric.clone(), body, opened, dressed, findings })
}

/// Puts a folder together from a pattern. Pieces without a sure seam are left out, and said.
///
/// # Errors
/// The pattern cannot be sewn, or the body or fabric is not there.
pub fn from_pattern(order: &Order<'_>) -> Result<New, Vec<Diagnostic>> {
    let known = order.earlier.map(|e| e.decisions(order.source)).transpose()?.unwrap_or_default();
    let mut source =
        if order.earlier.is_none() && !order.is_anonymous { with_one_collar(order)? } else { order.source.clone() };
    let mut proposal = proposed(&source, order.is_anonymous, &known)?;
    while order.earlier.is_none() && !proposal.seams.is_empty() {
        let [alone, doubtful] = unsewn::unsewn(&source, &proposal, order.is_anonymous);
        source = source.without(&[&alone[..], &doubtful[..]].concat(), Why::NoSureSeam);
        if doubtful.is_empty() {
            break;
        }
        // Others may be sewn to the edges that the doubtful pieces had. They may be doubtful in their turn.
        proposal = proposed(&source, order.is_anonymous, &known)?;
    }
    let source = &source;
    let Worn { body: own, fabric, opened: body, dressed, findings } = worn(order, source, &proposal)?;
    let new =
        proposal.seams.iter_mut().zip(&proposal.given).zip(&dressed.seam_names).filter(|((_, given), _)| !**given);
    for ((seam, _), name) in new {
        seam.name = name.clone().unwrap_or_else(|| seam.name.clone());
    }
    let document = document::document(source, &proposal, &dressed, order.is_anonymous);
    let open = sewing::missing(&proposal).filter(|s| s.confidence < sewing::LEAST_SURE).count();
    let mut folder = Folder::default();
    folder.add(&source.file_name(), source.bytes.clone());
    if let Some((name, bytes)) = &source.rules {
        folder.add(name, bytes.clone());
    }
    for (name, bytes) in body.files.into_iter().chain(fabric.files()?) {
        folder.add(&name, bytes);
    }
    // Seams are in the person's file before `proposal.json` says that they were proposed.
    if let Some(earlier) = order.earlier {
        let text = sewing::filled(source, &proposal, &earlier.text);
        if text != earlier.text {
            folder.replace("sewing.toml", text.into_bytes());
        } else {
            folder.add("sewing.toml", text.into_bytes());
        }
    }
    folder.add("pipeline.toml", pipeline::text(source, &own, &fabric).into_bytes());
    let json = serde_json::to_string_pretty(&document).unwrap_or_default();
    folder.replace("proposal.json", format!("{}\n", toile_garment::text::json(&json)).into_bytes());
    folder.replace(
        "start.html",
        page::page(source, &proposal, &dressed, body.model.as_ref(), order.language).into_bytes(),
    );
    // A first sewing file comes last: where it lies, the folder is complete, and what it says are decisions.
    if order.earlier.is_none() {
        folder.add("sewing.toml", sewing::text(source, &proposal).into_bytes());
    }
    Ok(New { folder, proposal: document, seams: sewing::missing(&proposal).count(), open, findings })
}
