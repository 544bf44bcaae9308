//! The data for the viewer of the page: the model as a GLB, and names, seams and maps as JSON.

use super::fit::Fit;
use super::viewer::{Line, Scene, Stretch};
use super::words::Language;
use crate::gltf::{self, ViewPiece};
use crate::picture::{Field, Openness, lay, openness};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Map, Value, json};
use toile_garment::seam::{Seam, SeamKind, SeamRun};
use toile_garment::{Garment, Vec2};

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

/// Names, lines and quantities of a garment for the view.
#[must_use]
pub fn scene(garment: &Garment, fit: &Fit, language: Language) -> Scene {
    let stretch = |r: &SeamRun| Stretch::Vertices(r.piece.index(), r.vertices.clone());
    let line = |seam: &Seam| Line {
        stretches: [&seam.a, &seam.b].iter().flat_map(|s| &s.runs).map(stretch).collect(),
        colour: None,
    };
    let field = |f: &Field| json!({ "key": f.key, "name": language.say(f.name), "unit": f.unit, "ends": f.ends(), "stops": f.stops() });
    Scene {
        pieces: garment.pieces.len(),
        names: names(garment, language),
        lines: garment.seams.iter().map(line).collect(),
        fields: fit.maps.iter().map(field).collect(),
        threads: Vec::new(),
    }
}

/// PNG as the source of an image.
#[must_use]
pub fn image(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}
