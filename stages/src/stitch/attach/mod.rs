//! Edges tied to the body: a waist edge is laid on the ring a tape makes around the body there.

mod edges;
mod lay;
mod ring;

use self::edges::{HeldEdge, edge_vertices, edges_of, edges_of_spec};
use self::lay::{Laid, Share, lay, share};
use self::ring::{Ring, section, target};
use super::{codes, part_of_ring};
use crate::body::Section;
use crate::sewing::sewn_points::SewnPoints;
use crate::solve::layer_of;
use std::collections::BTreeMap;
use toile_formats::codes::EDGE_UNKNOWN;
use toile_garment::dart::{DartKind, DartMesh};
use toile_garment::garment::{ElasticBand, Pin};
use toile_garment::mesh::PieceMesh;
use toile_garment::sewing::{AttachSpec, AttachStrength};
use toile_garment::{Diagnostic, Garment, Piece, PieceId, Vec3};

/// Extra distance between held edges and the body, beyond the contact's own, metres.
const SLACK: f64 = 3e-4;

/// Landmarks nearer in height than this lie on one ring, m.
const SAME_HEIGHT: f64 = 1e-3;

/// The attachments at one height, in the order of the file.
struct Height<'g> {
    height: f64,
    section: Section,
    specs: Vec<&'g AttachSpec>,
}

/// Pins and bands that hold the attached edges.
#[derive(Debug, Default)]
pub struct Holds {
    /// Held for good.
    pub lasting: Vec<Pin>,
    /// Held until the garment is sewn.
    pub while_sewing: Vec<Pin>,
    /// Elastic bands that hold the edges then.
    pub bands: Vec<ElasticBand>,
}

impl Holds {
    fn extend(&mut self, more: Self) {
        self.lasting.extend(more.lasting);
        self.while_sewing.extend(more.while_sewing);
        self.bands.extend(more.bands);
    }
}

/// Pins and bands of the attached edges, `gap` metres off the body. Cloth is `thickness` metres thick.
///
/// # Errors
/// All attachments that cannot be made, each with the reason.
pub fn holds(garment: &Garment, placed: &[Vec<Vec3>], gap: f64, thickness: f64) -> Result<Holds, Vec<Diagnostic>> {
    let (heights, mut errors) = heights(garment);
    let mut holds = Holds::default();
    for height in &heights {
        match ring_holds(garment, placed, [gap, thickness], height) {
            Ok(more) => holds.extend(more),
            Err(finding) => errors.push(finding.at(height.specs[0].source.clone())),
        }
    }
    if errors.is_empty() { Ok(holds) } else { Err(errors) }
}

/// All attachments by their heights, and what is wrong with those that the body has no ring for.
fn heights(garment: &Garment) -> (Vec<Height<'_>>, Vec<Diagnostic>) {
    let (mut heights, mut errors): (Vec<Height<'_>>, Vec<Diagnostic>) = (Vec::new(), Vec::new());
    let specs = &garment.plan.attachments;
    for (k, spec) in specs.iter().enumerate() {
        match section(garment, &spec.to) {
            Ok((height, section)) => match heights.iter_mut().find(|h| (h.height - height).abs() < SAME_HEIGHT) {
                Some(known) => known.specs.push(spec),
                None => heights.push(Height { height, section, specs: vec![spec] }),
            },
            Err(found) if specs[..k].iter().all(|b| b.to != spec.to) => errors.push(found.at(spec.source.clone())),
            Err(_) => {}
        }
    }
    (heights, errors)
}

/// Attachments to names that the body does not have, each name once.
pub fn unknown_targets(garment: &Garment) -> Vec<Diagnostic> {
    let specs = &garment.plan.attachments;
    let first = specs.iter().enumerate().filter(|(k, spec)| specs[..*k].iter().all(|before| before.to != spec.to));
    let unknown = |spec: &AttachSpec| Some(target(garment, &spec.to).err()?.at(spec.source.clone()));
    first.filter_map(|(_, spec)| unknown(spec)).collect()
}

/// Attachments that cannot be made, whatever the mesh: on this body, or of these edges.
pub fn faults(garment: &Garment) -> Vec<Diagnostic> {
    let specs = &garment.plan.attachments;
    let (heights, mut found) = heights(garment);
    let mut known: Vec<(PieceId, usize, &AttachSpec)> = Vec::new();
    let mut are_known = true;
    for spec in specs {
        let Some(piece) = garment.pieces.iter().find(|p| spec.piece.eq_ignore_ascii_case(&p.name)) else { continue };
        match edges_of_spec(garment, piece, spec) {
            Ok(edges) => {
                let first = known.iter().find(|(id, edge, _)| *id == piece.id && edges.contains(edge));
                found.extend(first.map(|(_, _, first)| attached_twice(piece, spec, first)));
                known.extend(edges.into_iter().map(|edge| (piece.id, edge, spec)));
            }
            // An edge that is not there is told where the sewing file is read.
            Err(fault) if fault.code == EDGE_UNKNOWN => are_known = false,
            Err(fault) => found.push(fault.at(spec.source.clone())),
        }
    }
    if found.is_empty() && are_known {
        found.extend(heights.iter().filter_map(|h| part_of_ring(garment, h)));
    }
    found
}

fn attached_twice(piece: &Piece, spec: &AttachSpec, first: &AttachSpec) -> Diagnostic {
    let line = first.source.as_ref().and_then(|s| s.line).map_or_else(String::new, |line| format!(" in line {line}"));
    let message = format!(
        "edge `{}` of `{}` is attached to `{}`, and{line} to `{}` already: it can be held once",
        spec.edge, piece.name, spec.to, first.to
    );
    Diagnostic::error(codes::ATTACHED_TWICE, message)
        .at(spec.source.clone())
        .hint("remove one of both [[attach]] tables")
}

/// The error on edges that go only part of the way round at one height.
fn part_of_ring(garment: &Garment, height: &Height<'_>) -> Option<Diagnostic> {
    let attached = |piece: &Piece| edges_of(garment, piece, &height.specs).unwrap_or_default();
    let edges = garment.pieces.iter().flat_map(|p| attached(p).into_iter().map(|(edge, _)| (p.id, edge))).collect();
    let first = height.specs.first()?;
    Some(part_of_ring::fault(garment, edges, &first.to)?.at(first.source.clone()))
}

/// Holds at one landmark. Each layer of the garment has a ring of its own, outside that of the layer below.
fn ring_holds(
    garment: &Garment,
    placed: &[Vec<Vec3>],
    [gap, thickness]: [f64; 2],
    Height { section, specs, .. }: &Height<'_>,
) -> Result<Holds, Diagnostic> {
    let mut layers: BTreeMap<i32, Vec<(&Piece, Vec<HeldEdge>)>> = BTreeMap::new();
    for piece in &garment.pieces {
        let edges = edges_of(garment, piece, specs)?;
        if !edges.is_empty() {
            layers.entry(layer_of(garment, piece)).or_default().push((piece, edges));
        }
    }
    let mut holds = Holds::default();
    let mut gap = gap;
    for pieces in layers.values() {
        let ring = Ring::around(section, gap);
        let mut pleated = false;
        let shares: Vec<Share> = pieces
            .iter()
            .map(|(piece, edges)| {
                let intake = pleat_intakes(piece);
                pleated |= edges.iter().flat_map(|e| edge_vertices(piece, e.0)).any(|v| intake.contains(&v));
                share(piece, &placed[piece.id.index()], edges, &intake, &ring)
            })
            .collect();
        // Under a pleat lie two more layers. Straight mesh edges cut the corner of the ring: it moves out until their
        // middles keep the gap as well.
        let under = if pleated { 2.0 * thickness } else { 0.0 };
        let out = gap + under + lay(&shares, &ring).1 + SLACK;
        let laid = lay(&shares, &Ring::around(section, out)).0;
        let to = specs.first().map_or("", |s| s.to.as_str());
        holds.extend(holds_of(garment, to, &laid, section.girth()));
        gap = out + thickness;
    }
    Ok(holds)
}

/// A band that grows along the ring.
struct Growing {
    band: ElasticBand,
    held: AttachStrength,
    /// Arc position of its last vertex.
    before: f64,
}

/// Pins and bands of laid stations, which stand in order around the ring.
fn holds_of(garment: &Garment, to: &str, laid: &[Laid], girth: f64) -> Holds {
    let mut holds = Holds::default();
    let mut points = SewnPoints::new(garment, &garment.seams);
    let arcs = || laid.iter().map(|l| l.arc);
    let around = arcs().fold(f64::NEG_INFINITY, f64::max) - arcs().fold(f64::INFINITY, f64::min);
    let mut growing: Option<Growing> = None;
    for l in laid {
        if growing.as_ref().is_some_and(|g| g.held != l.held) {
            holds.bands.extend(growing.take().map(|g| g.band).filter(|b| b.vertices.len() > 1));
        }
        let AttachStrength::Elastic(share) = l.held else {
            let list = if l.held == AttachStrength::Hold { &mut holds.lasting } else { &mut holds.while_sewing };
            list.push(l.pin);
            continue;
        };
        holds.while_sewing.push(l.pin);
        // The ring lies a little off the body; the file speaks of the body.
        let scale = share * girth / around.max(1e-9);
        let start = || Growing { band: ElasticBand::named(to), held: l.held, before: l.arc };
        let Growing { band, before, .. } = growing.get_or_insert_with(start);
        if band.vertices.last().is_some_and(|last| points.are_one(*last, l.pin.vertex)) {
            continue;
        }
        if !band.vertices.is_empty() {
            band.rest.push(((l.arc - *before) * scale).max(SLACK));
        }
        band.vertices.push(l.pin.vertex);
        *before = l.arc;
    }
    if let Some(Growing { mut band, .. }) = growing {
        if laid.iter().all(|l| laid[0].held == l.held) {
            close(&mut band, &mut points);
        }
        holds.bands.push(band);
    }
    for pins in [&mut holds.lasting, &mut holds.while_sewing] {
        pins.sort_by_key(|p| p.vertex);
        pins.dedup_by_key(|p| p.vertex);
    }
    // Where edges meet, what is held for good stays held.
    let lasting = &holds.lasting;
    holds.while_sewing.retain(|p| lasting.binary_search_by_key(&p.vertex, |l| l.vertex).is_err());
    holds
}

/// Joins the ends of a band that goes all the way round.
fn close(band: &mut ElasticBand, points: &mut SewnPoints) {
    let ends = [band.vertices.first().copied(), band.vertices.last().copied()];
    let [Some(first), Some(last)] = ends else { return };
    if points.are_one(first, last) {
        band.vertices.pop();
    } else {
        band.rest.push(SLACK);
    }
}

/// Vertices of the outline between the mouth points of pleats, which are folded away.
fn pleat_intakes(piece: &Piece) -> Vec<u32> {
    let Some(chain) = piece.mesh.as_ref().and_then(PieceMesh::outline) else { return Vec::new() };
    let n = chain.vertices.len();
    let at = |v: u32| chain.vertices.iter().position(|c| *c == v);
    let pleats = piece.darts.iter().filter(|d| d.kind == DartKind::Pleat).filter_map(|d| d.mesh.as_ref());
    let between = |m: &DartMesh| {
        let (i, k) = (at(*m.legs[0].first()?)?, at(*m.legs[1].first()?)?);
        let (ahead, back) = ((k + n - i) % n, (i + n - k) % n);
        let (from, steps) = if ahead <= back { (i, ahead) } else { (k, back) };
        Some((1..steps).map(move |s| chain.vertices[(from + s) % n]))
    };
    pleats.filter_map(between).flatten().collect()
}

#[cfg(test)]
mod tests;
