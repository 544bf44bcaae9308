//! The contents of a GLB, for `toile inspect`.

use super::ReadError;
use super::document;
use super::geometry::{open, placed};
use super::read::{ReadGarment, document_text, read_garment_with_findings};
use serde_json::{Value, json};
use toile_garment::{Garment, Vec3, bundle};

/// Facts about a GLB: counts, size in metres, names, materials, and whether it holds a garment document.
///
/// # Errors
/// When it is no sound GLB.
pub fn inspect(bytes: &[u8]) -> Result<Value, ReadError> {
    let sound = open(bytes)?;
    let placed = placed(&sound)?;
    let root = sound.document.as_json();
    let mut all = placed.iter().flat_map(|p| &p.positions);
    let size = all.next().map(|first| all.fold([*first, *first], |[lo, hi]: [Vec3; 2], p| [lo.inf(p), hi.sup(p)]));
    let meshes: Vec<Value> = placed
        .iter()
        .map(|p| {
            json!({ "node": p.node, "mesh": p.mesh, "vertices": p.positions.len(), "triangles": p.triangles.len(),
                    "piece": p.piece, "texcoord_0": p.uv.is_some() })
        })
        .collect();
    let toile = document_text(&sound.document).map(|text| match document::read(text.get()) {
        Ok(g) => stored(&g, read_garment_with_findings(bytes).ok().as_ref()),
        Err(e) => json!({ "error": e }),
    });
    Ok(json!({
        "format": "glb",
        "bytes": bytes.len(),
        "generator": root.asset.generator,
        "nodes": root.nodes.len(),
        "meshes": meshes,
        "vertices": placed.iter().map(|p| p.positions.len()).sum::<usize>(),
        "triangles": placed.iter().map(|p| p.triangles.len()).sum::<usize>(),
        "bbox_m": size.map(|s| s.map(|p| [p.x, p.y, p.z])),
        "size_m": size.map(|[lo, hi]| [hi.x - lo.x, hi.y - lo.y, hi.z - lo.z]),
        "materials": root.materials.iter().map(|m| &m.name).collect::<Vec<_>>(),
        "images": root.images.len(),
        "extensions_used": root.extensions_used,
        "toile": toile,
    }))
}

/// Facts about the stored garment. `shown` is the garment with the shape of the file: a certificate holds for the shape
/// alone that was certified.
fn stored(g: &Garment, shown: Option<&ReadGarment>) -> Value {
    let certificate = shown.and_then(|r| r.garment.certificate.as_ref());
    json!({ "version": bundle::VERSION, "style": g.style, "size": g.size,
            "pieces": g.pieces.iter().map(|p| &p.name).collect::<Vec<_>>(),
            "darts": g.pieces.iter().map(|p| p.darts.len()).sum::<usize>(),
            "seams": g.seams.len(), "draped": g.drape.is_some(), "edited": shown.map(|r| r.edited),
            "certificate_passed": certificate.map(|c| c.passed) })
}
