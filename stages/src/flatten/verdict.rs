//! The verdict on every flattened piece: what a pattern maker checks before it is cut.

use super::features::{self, Features};
use super::held_lines::{bow, corner_angles, is_straight};
use super::params::FlattenTolerance;
use super::seam_stations::{Beside, beside};
use super::sewn::MeshEdges;
use super::source::{Source, sources};
use super::{overlaps, symmetry};
use toile_garment::flat::{Check, CheckKind, Flat, FlatMetric, FlatPiece, PieceVerdict};
use toile_garment::seam::SeamKind;
use toile_garment::{Garment, PieceId, Vec2};
use toile_stage_api::StageError;

/// Sewn edges, and notches beside their partner, that differ by less can be sewn without a change, metres.
const SEWABLE: f64 = 1e-3;
/// Legs of a dart whose difference changed by less can be sewn without a change, metres.
const LEGS: f64 = 0.5e-3;
/// Strain that no cloth is eased by. It was chosen: a hem that was folded up in 3D shows 200 %, a widened hip 2 %.
const STRAIN: f64 = 0.5;
/// A notch lies this near to the sewn line, metres. On a cut line it lies off it by the allowance.
const NOTCH_NEAR: f64 = 30e-3;
/// A station of a seam this near to a notch is the place of the notch, metres.
const NOTCH_STATION: f64 = 15e-3;

/// The tolerances. What shows whether the pieces can be sewn is judged always, and changes only where it is asked for.
fn limit(kind: CheckKind, t: &FlattenTolerance) -> Option<f64> {
    match kind {
        CheckKind::Area => t.area.map(|s| s.0),
        CheckKind::Edge => t.edge.map(|l| l.0),
        CheckKind::Seam => Some(t.seam.map_or(SEWABLE, |l| l.0)),
        CheckKind::DartIntake => t.dart_intake.map(|l| l.0),
        CheckKind::DartLegs => Some(t.dart_legs.map_or(LEGS, |l| l.0)),
        CheckKind::Notch => t.notch.map(|l| l.0),
        CheckKind::NotchPartner => Some(t.notch_partner.map_or(SEWABLE, |l| l.0)),
        CheckKind::Corner => t.corner.map(|a| a.0),
        CheckKind::Bow => t.bow.map(|l| l.0),
        CheckKind::Symmetry => t.symmetry.map(|l| l.0),
        CheckKind::Grain => t.grain.map(|a| a.0),
        CheckKind::Overlap => Some(0.0),
        CheckKind::Strain => Some(STRAIN),
    }
}

/// The verdicts on all pieces; none where the stored pieces came back.
///
/// # Errors
/// When the garment has no mesh or drape, or their vertices differ.
pub fn verdicts(garment: &Garment, flat: &Flat, t: &FlattenTolerance) -> Result<Vec<PieceVerdict>, StageError> {
    if flat.metric == FlatMetric::Unedited {
        return Ok(Vec::new());
    }
    let sources = sources(garment)?;
    let features: Vec<Features> = sources.iter().map(|s| features::of(garment, s.piece, s.mesh)).collect();
    let flats: Vec<Vec<Vec2>> = flat.pieces.iter().map(|p| p.positions.clone()).collect();
    let apart = symmetry::apart(&sources, &features, &flats);
    let seams = seams(garment, flat);
    let of_piece = |((source, features), flat): ((&Source<'_>, &Features), &FlatPiece)| {
        let mut all = own(source, features, flat);
        all.extend(beside_partner(source, &seams));
        all.extend(apart.iter().filter_map(|(p, q, value)| {
            let other = [(p, q), (q, p)].into_iter().find(|(k, _)| sources[**k].piece.id == source.piece.id)?.1;
            let own = sources[*other].piece.id == source.piece.id;
            let place = if own { String::new() } else { sources[*other].piece.name.clone() };
            Some(Check { place, ..check(CheckKind::Symmetry, "", *value) })
        }));
        PieceVerdict { piece: source.piece.id, checks: worst(all, t) }
    };
    Ok(sources.iter().zip(&features).zip(&flat.pieces).map(of_piece).collect())
}

fn check(kind: CheckKind, place: &str, value: f64) -> Check {
    Check { kind, place: place.to_owned(), notch: String::new(), along: None, value, limit: None }
}

/// The largest of every kind, with what is allowed, in the order of the kinds.
fn worst(all: Vec<Check>, t: &FlattenTolerance) -> Vec<Check> {
    let mut out: Vec<Check> = Vec::new();
    for mut check in all {
        check.limit = limit(check.kind, t);
        match out.iter_mut().find(|c| c.kind == check.kind) {
            Some(other) if check.value.abs() > other.value.abs() => *other = check,
            Some(_) => {}
            None => out.push(check),
        }
    }
    out
}

/// The figures of the piece by itself.
fn own(source: &Source<'_>, features: &Features, flat: &FlatPiece) -> Vec<Check> {
    let (rest, new) = (&source.mesh.rest, &flat.positions);
    let share = if flat.area[0] > 0.0 { flat.area[1] / flat.area[0] - 1.0 } else { 0.0 };
    let mut out = vec![check(CheckKind::Area, "", share)];
    out.extend(flat.edges.iter().map(|e| check(CheckKind::Edge, &e.name, e.flat - e.original)));
    for dart in &flat.darts {
        let [a, b, new_a, new_b] = dart.legs;
        out.push(check(CheckKind::DartIntake, &dart.name, dart.width[1] - dart.width[0]));
        out.push(check(CheckKind::DartLegs, &dart.name, (new_a - new_b) - (a - b)));
    }
    let notches = source.piece.notches.iter().zip(labels(source));
    out.extend(notches.filter_map(|(n, label)| Some(Check { notch: label, ..notch(features, rest, new, n.at)? })));
    let straight = features.edges.iter().filter(|e| e.vertices.len() > 2 && is_straight(rest, &e.vertices));
    out.extend(straight.map(|e| check(CheckKind::Bow, &e.name, bow(new, &e.vertices))));
    let corners = corner_angles(rest, features, [rest, new]).into_iter();
    out.extend(corners.map(|(name, [before, after])| check(CheckKind::Corner, &name, after - before)));
    out.push(check(CheckKind::Grain, "", flat.grain_shift));
    out.push(check(CheckKind::Strain, "", flat.forced_strain[1]));
    let crossings = overlaps::find(source.mesh, new).len();
    out.extend((crossings > 0).then(|| check(CheckKind::Overlap, "", crossings as f64)));
    out
}

/// The labels of the notches, with the piece.
fn labels(source: &Source<'_>) -> impl Iterator<Item = String> {
    source.piece.notch_labels().into_iter().map(|label| format!("{}.{label}", source.piece.name))
}

/// How far a notch moved along its edge.
fn notch(features: &Features, rest: &[Vec2], flat: &[Vec2], at: Vec2) -> Option<Check> {
    let on_edge = |edge: &features::Chain| {
        let mut along = [0.0; 2];
        let mut best: Option<(f64, [f64; 2])> = None;
        for w in edge.vertices.windows(2) {
            let [a, b] = [w[0], w[1]].map(|v| rest[v as usize]);
            let t = ((at - a).dot(&(b - a)) / (b - a).norm_squared().max(1e-24)).clamp(0.0, 1.0);
            let off = (a + (b - a) * t - at).norm();
            let lengths = [rest, flat].map(|x| (x[w[1] as usize] - x[w[0] as usize]).norm());
            if best.is_none_or(|(least, _)| off < least) {
                best = Some((off, [along[0] + t * lengths[0], along[1] + t * lengths[1]]));
            }
            along = [along[0] + lengths[0], along[1] + lengths[1]];
        }
        best.map(|(off, ways)| (off, edge.name.clone(), ways))
    };
    let nearest = features.edges.iter().filter_map(on_edge).min_by(|a, b| a.0.total_cmp(&b.0))?;
    let (off, place, [before, after]) = nearest;
    let moved = Check { along: Some(before), ..check(CheckKind::Notch, &place, after - before) };
    (off < NOTCH_NEAR).then_some(moved)
}

/// The seams with their stations.
fn seams(garment: &Garment, flat: &Flat) -> Vec<(String, Vec<Beside>)> {
    let edges = MeshEdges::of(garment);
    let rest: Vec<&[Vec2]> =
        garment.pieces.iter().map(|p| p.mesh.as_ref().map_or(&[][..], |m| m.rest.as_slice())).collect();
    let new: Vec<&[Vec2]> = flat.pieces.iter().map(|p| p.positions.as_slice()).collect();
    let declared = garment.seams.iter().filter(|s| s.kind == SeamKind::Seam);
    declared.map(|s| (s.name.clone(), beside(s, &edges, &rest, &new))).collect()
}

/// The figures of the seams of a piece: its edges and its notches beside those of its partners.
fn beside_partner(source: &Source<'_>, seams: &[(String, Vec<Beside>)]) -> Vec<Check> {
    let (mut out, labels) = (Vec::new(), labels(source).collect::<Vec<_>>());
    for (name, stations) in seams {
        let own: Vec<(usize, &Beside)> =
            stations.iter().filter_map(|s| Some((side_of(s, source.piece.id)?, s))).collect();
        let told = |kind: CheckKind, (side, s): &(usize, &Beside)| Check {
            along: Some(s.along[*side]),
            ..check(kind, name, s.off)
        };
        let worst = own.iter().max_by(|a, b| a.1.off.abs().total_cmp(&b.1.off.abs()));
        out.extend(worst.map(|s| told(CheckKind::Seam, s)));
        for (notch, label) in source.piece.notches.iter().zip(&labels) {
            let far = |(side, s): &(usize, &Beside)| (source.mesh.rest[s.at[*side].vertex as usize] - notch.at).norm();
            let nearest = own.iter().min_by(|a, b| far(a).total_cmp(&far(b))).filter(|s| far(s) < NOTCH_STATION);
            out.extend(nearest.map(|s| Check { notch: label.clone(), ..told(CheckKind::NotchPartner, s) }));
        }
    }
    out
}

/// The side of a station that lies on a piece.
fn side_of(station: &Beside, piece: PieceId) -> Option<usize> {
    station.at.iter().position(|v| v.piece == piece)
}
