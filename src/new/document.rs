//! `proposal.json`: the proposal for programs.

use super::dress::Dressed;
use super::pattern::Source;
use serde_json::{Value, json};
use toile_garment::Vec2;
use toile_stages::proposal::{Proposal, ProposedSeam, Run};

/// The document. Lengths are millimetres in the coordinates of the DXF block.
#[must_use]
pub fn document(source: &Source, proposal: &Proposal, dressed: &Dressed, is_anonymous: bool) -> Value {
    let garment = &source.garment;
    let pieces: Vec<Value> = garment
        .pieces
        .iter()
        .enumerate()
        .filter(|(_, p)| !is_copy(source, &p.name))
        .map(|(i, p)| {
            let name = if is_anonymous { format!("P{}", i + 1) } else { p.name.clone() };
            let copies = 1 + source.copies.iter().filter(|c| c.piece == p.name).count();
            let role = Some(dressed.roles[i].words()).filter(|w| !w.is_empty());
            json!({ "block": p.block, "name": name, "role": role, "copies": copies, "mirrored_of": null })
        })
        .collect();
    let mut seams: Vec<Value> = proposal.seams.iter().map(|s| seam(source, s)).collect();
    seams.extend(garment.pieces.iter().flat_map(|p| p.darts.iter().map(|d| dart(source, p, d))));
    seams.sort_by_key(|s| s["name"].as_str().unwrap_or_default().to_owned());
    let mut unresolved: Vec<Value> = proposal
        .bare
        .iter()
        .map(|b| {
            let block = &garment.pieces[b.piece].block;
            let reason = "no partner fits; a hem or an opening";
            json!({ "piece": block, "edge": b.edge, "length_mm": mm(b.length), "reason": reason })
        })
        .collect();
    unresolved.sort_by_key(|u| (u["piece"].as_str().unwrap_or_default().to_owned(), u["edge"].as_u64()));
    json!({
        "toile": env!("CARGO_PKG_VERSION"),
        "pattern": source.file_name(),
        "pieces": pieces,
        "seams": seams,
        "places": places(source, dressed),
        "unresolved": unresolved,
    })
}

/// Where the pieces lie: rotation, and translation in millimetres.
fn places(source: &Source, dressed: &Dressed) -> Vec<Value> {
    let place = |(piece, place): (usize, &Option<toile_stages::arrange::Place>)| {
        let place = place.as_ref()?;
        // A copy has its own coordinates, those of the block with x turned round, as the form of the file wants it.
        let (block, instance, _) = origin(source, piece);
        let (rotation, t) = (place.rotation(), place.translation());
        let role = Some(dressed.roles[piece].words()).filter(|w| !w.is_empty());
        Some(json!({
            "piece": block,
            "instance": instance,
            "rotation": rotation,
            "translation_mm": [mm(t.x), mm(t.y), mm(t.z)],
            "role": role,
            "confidence": (place.confidence * 1e3).round() / 1e3,
        }))
    };
    let mut out: Vec<Value> = dressed.arrangement.places.iter().enumerate().filter_map(place).collect();
    out.sort_by_key(|p| (p["piece"].as_str().unwrap_or_default().to_owned(), p["instance"].as_u64()));
    out
}

fn is_copy(source: &Source, name: &str) -> bool {
    source.copies.iter().any(|c| c.name == name)
}

fn seam(source: &Source, seam: &ProposedSeam) -> Value {
    let pieces = |runs: &[Run]| runs.iter().map(|r| r.piece).collect::<Vec<_>>();
    let is_self = pieces(&seam.a).iter().any(|p| pieces(&seam.b).contains(p));
    let side = |runs: &[Run]| json!({ "runs": runs.iter().map(|r| run(source, r)).collect::<Vec<_>>() });
    json!({
        "name": seam.name,
        "kind": if is_self { "self" } else { "seam" },
        "a": side(&seam.a),
        "b": side(&seam.b),
        "confidence": (seam.confidence * 1e3).round() / 1e3,
        "evidence": evidence(seam),
        "ease_mm": mm(seam.ease()),
    })
}

/// Evidence for a seam, in words.
pub fn evidence(seam: &ProposedSeam) -> Vec<String> {
    let mut out = Vec::new();
    let (long, short) = (seam.length_a.max(seam.length_b), seam.length_a.min(seam.length_b));
    out.push(if long - short < 1e-3 {
        "the sides are equally long".to_owned()
    } else if long / short < 1.1 {
        format!("the sides differ by {:.1} mm", (long - short) * 1e3)
    } else {
        format!("one side is {:.2} times as long as the other", long / short)
    });
    match seam.atoms.len().saturating_sub(1) {
        0 => {}
        1 => out.push("a mark along the seam fits".to_owned()),
        marks => out.push(format!("{marks} marks along the seam fit")),
    }
    if seam.fold_over {
        out.push("one piece lies turned over on the other".to_owned());
    }
    out
}

/// Block and instance of a piece of the garment. Copies are drawn as the piece they are cut from.
fn origin(source: &Source, piece: usize) -> (&str, usize, bool) {
    let piece = &source.garment.pieces[piece];
    match source.copies.iter().find(|c| c.name == piece.name) {
        Some(copy) => (&piece.block, 1, copy.mirror),
        None => (&piece.block, 0, false),
    }
}

fn run(source: &Source, run: &Run) -> Value {
    let (block, instance, turned) = origin(source, run.piece);
    let points: Vec<Value> = run.points.iter().map(|p| point(*p, turned)).collect();
    json!({ "piece": block, "instance": instance, "points_mm": points })
}

fn dart(source: &Source, piece: &toile_garment::Piece, dart: &toile_garment::dart::Dart) -> Value {
    let (block, instance, turned) = origin(source, piece.id.index());
    let side = |leg: &[Vec2]| {
        let points: Vec<Value> = leg.iter().map(|p| point(*p, turned)).collect();
        json!({ "runs": [{ "piece": block, "instance": instance, "points_mm": points }] })
    };
    json!({
        "name": format!("{} {}", piece.name, dart.name),
        "kind": "dart",
        "a": side(&dart.legs[0]),
        "b": side(&dart.legs[1]),
        "confidence": 0.97,
        "evidence": ["found in the outline and its marks"],
        "ease_mm": mm(dart.leg_length(0) - dart.leg_length(1)),
    })
}

fn point(p: Vec2, turned: bool) -> Value {
    json!([mm(if turned { -p.x } else { p.x }), mm(p.y)])
}

/// Millimetres, to 0.1 µm.
fn mm(length: f64) -> f64 {
    (length * 1e7).round() / 1e4
}
