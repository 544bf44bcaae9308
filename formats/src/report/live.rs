//! The data for the viewer of the page: the model as a GLB, and names, seams and maps as JSON.

use super::fit::Fit;
use super::places::{Place, finding_name, middle_of_edge};
use super::verdict::verdict;
use super::viewer::{Line, Mark, Scene, Stretch, Tag};
use super::words::Language;
use super::{motion, notches};
use crate::gltf::{self, ViewPiece};
use crate::picture::{Field, Openness, lay, openness};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Map, Value, json};
use toile_garment::seam::{Seam, SeamKind, SeamRun};
use toile_garment::{Diagnostic, Garment, Piece, Vec2};

/// The model in base64. `None` without positions in 3D or with a mesh that cannot be written.
#[must_use]
pub fn model(garment: &Garment, fit: &Fit) -> Option<String> {
    model_in_light(garment, fit, &openness(garment)?)
}

/// The model in base64, where the light around it is known. `None` with a mesh that cannot be written.
pub(super) fn model_in_light(garment: &Garment, fit: &Fit, light: &Openness) -> Option<String> {
    let places = lay(garment);
    let mut pieces = Vec::new();
    for (k, open) in light.iter().enumerate() {
        let [right, wrong] = open.clone();
        let mut view = ViewPiece { values: vec![("open".into(), right), ("shut".into(), wrong)], flat: Vec::new() };
        if let Some(mesh) = garment.pieces.get(k).and_then(|p| p.mesh.as_ref()) {
            let by = places.get(k).copied().unwrap_or_else(Vec2::zeros);
            view.flat = mesh.rest.iter().map(|p| [p.x + by.x, p.y + by.y]).collect();
            let of_map = |f: &Field| Some((f.key.to_owned(), f.values.get(k)?.clone()));
            view.values.extend(fit.maps.iter().filter_map(of_map));
        }
        pieces.push(view);
    }
    gltf::write_view(garment, &pieces).ok().map(|glb| STANDARD.encode(glb))
}

/// Names for people by the names that pick: `piece:NUMBER` and `seam:NUMBER`.
fn names(garment: &Garment, language: Language) -> Map<String, Value> {
    let mut out = Map::new();
    for (k, piece) in garment.pieces.iter().enumerate() {
        out.insert(format!("piece:{k}"), json!(format!("{} {}", language.say("piece"), piece.name)));
    }
    for (k, seam) in garment.seams.iter().enumerate() {
        out.insert(format!("seam:{k}"), json!(label(seam, language)));
    }
    out
}

fn label(seam: &Seam, language: Language) -> String {
    let mm = |x: f64| crate::svg::canvas::fixed(1e3 * x, 1);
    let kind = if matches!(seam.kind, SeamKind::Dart { .. }) { "dart" } else { "seam" };
    let values = [language.say(kind).to_owned(), seam.name.clone(), mm(seam.a.length), mm(seam.b.length)];
    language.fill("{0} {1}: {2} mm on {3} mm", &values)
}

/// Names, lines, quantities and marked places of a garment for the view.
#[must_use]
pub fn scene(garment: &Garment, findings: &[Diagnostic], places: &[Place], fit: &Fit, language: Language) -> Scene {
    let stretch = |r: &SeamRun| Stretch::Vertices(r.piece.index(), r.vertices.clone());
    let line = |seam: &Seam| Line {
        stretches: [&seam.a, &seam.b].iter().flat_map(|s| &s.runs).map(stretch).collect(),
        colour: None,
    };
    let field = |f: &Field| json!({ "key": f.key, "name": language.say(f.name), "unit": f.unit, "ends": f.ends(), "stops": f.stops() });
    let mut names = names(garment, language);
    for (k, finding) in findings.iter().enumerate() {
        if places.iter().any(|p| p.pick == finding_name(k)) {
            let told = language.finding(&finding.code).map_or(finding.message.as_str(), |[what, _]| what);
            names.insert(finding_name(k), json!(told));
        }
    }
    let notched = notches::rows(garment);
    names.extend(notched.iter().map(|n| (notches::pick_name(n.at), json!(notches::words(n, language)))));
    let of_notches: Vec<Place> = notched.iter().map(|n| notches::place(garment, n)).collect();
    let lay = lay(garment);
    // A run that failed shows first where it did.
    let is_bad = verdict(garment, findings, language).passed == Some(false);
    let shown = places.iter().find(|p| is_bad && !p.number.is_empty()).map(|p| p.pick.clone());
    Scene {
        pieces: garment.pieces.len(),
        names,
        lines: garment.seams.iter().map(line).collect(),
        fields: fit.maps.iter().map(field).collect(),
        warps: garment.pieces.iter().map(warp).collect(),
        marks: places.iter().chain(&of_notches).map(|p| mark(p, garment, &lay)).collect(),
        tags: tags(garment, &notched, &lay),
        shown,
        colourways: garment.textures.iter().flat_map(|t| &t.colourways).map(|c| c.colors.clone()).collect(),
        motion: motion::motion(garment),
        ..Scene::default()
    }
}

/// The warp of a piece in its flat lay. A rest shape with cuts is none that lies flat.
fn warp(piece: &Piece) -> Option<[f64; 2]> {
    let is_flat = piece.mesh.as_ref().is_some_and(|m| m.rest_corners.is_none());
    is_flat.then(|| piece.warp().into())
}

/// The labels of edges and notches, which the view shows on a piece that is picked.
fn tags(garment: &Garment, notched: &[notches::Row], lay: &[Vec2]) -> Vec<Tag> {
    let edges = garment.pieces.iter().enumerate().flat_map(|(p, piece)| {
        piece.edges.iter().enumerate().filter_map(move |(k, edge)| {
            let text = edge.name.as_ref().map_or_else(|| edge.index.to_string(), |n| format!("{} {n}", edge.index));
            let at = at_of(&middle_of_edge(garment, p, k)?, garment, lay)?;
            Some(Tag { text, is_notch: false, at })
        })
    });
    let notches = notched.iter().filter_map(|row| {
        let text = row.name.rsplit_once('.')?.1.to_owned();
        Some(Tag { text, is_notch: true, at: at_of(&notches::place(garment, row), garment, lay)? })
    });
    edges.chain(notches).collect()
}

/// A place as the view marks it; `lay` tells where the pieces lie side by side.
fn mark(place: &Place, garment: &Garment, lay: &[Vec2]) -> Mark {
    let at = at_of(place, garment, lay);
    Mark { pick: place.pick.clone(), number: place.number.clone(), target: place.target.clone(), at }
}

/// The piece of a place, and its point in space and in the flat lay, metres.
fn at_of(place: &Place, garment: &Garment, lay: &[Vec2]) -> Option<(usize, [f64; 5])> {
    let (piece, worn, flat) = place.in_view(garment)?;
    let flat = flat + lay.get(piece).copied().unwrap_or_else(Vec2::zeros);
    Some((piece, [worn.x, worn.y, worn.z, flat.x, flat.y]))
}

/// PNG as the source of an image.
#[must_use]
pub fn image(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}
