//! The flattening result as JSON, in millimetres and degrees.

use super::features::{self, Chain, ChainPair, Corner};
use serde_json::{Value, json};
use toile_garment::flat::{
    Check, CheckKind, DartChange, Flat, FlatPiece, LengthChange, PairChange, PieceVerdict, StrainMap,
};
use toile_garment::{Garment, Piece, Vec2, Vec3};

/// The result of [`super::flatten_garment`] for other programs.
#[must_use]
pub fn json(garment: &Garment, flat: &Flat) -> Value {
    let verdict = |f: &FlatPiece| flat.verdicts.iter().find(|v| v.piece == f.piece).map_or(Value::Null, verdict);
    let with_verdict = |f: &FlatPiece| {
        let mut told = piece(garment, f)?;
        told["verdict"] = verdict(f);
        Some(told)
    };
    let pieces: Vec<Value> = flat.pieces.iter().filter_map(with_verdict).collect();
    json!({
        "metric": flat.metric,
        "pieces": pieces,
        "pairs": flat.pairs.iter().map(pair).collect::<Vec<_>>(),
    })
}

fn piece(garment: &Garment, flat: &FlatPiece) -> Option<Value> {
    let piece = garment.pieces.get(flat.piece.index())?;
    let mesh = piece.mesh.as_ref()?;
    let surface = garment.drape.as_ref()?.positions.get(flat.piece.index())?;
    Some(json!({
        "name": piece.name,
        "flat_vertices_mm": flat.positions.iter().map(mm2).collect::<Vec<_>>(),
        "orig_vertices_mm": mesh.rest.iter().map(mm2).collect::<Vec<_>>(),
        "surface_vertices_mm": surface.iter().map(mm3).collect::<Vec<_>>(),
        "triangles": mesh.triangles,
        "features": named(garment, piece),
        "figures": figures(flat),
    }))
}

/// The verdict on a piece: every check in the unit that its key tells, and in words.
fn verdict(v: &PieceVerdict) -> Value {
    let check = |c: &Check| {
        let (key, unit) = match c.kind {
            CheckKind::Area | CheckKind::Strain => ("pct", 100.0),
            CheckKind::Corner | CheckKind::Grain => ("deg", 1f64.to_degrees()),
            CheckKind::Overlap => ("count", 1.0),
            _ => ("mm", 1e3),
        };
        let mut told = json!({ "kind": c.kind, "place": c.place, "passes": c.passes(), "words": c.words() });
        told[format!("change_{key}")] = json!(unit * c.value);
        told[format!("limit_{key}")] = json!(c.limit.map(|l| unit * l));
        told["along_mm"] = json!(c.along.map(|a| 1e3 * a));
        told
    };
    json!({ "passed": v.passes(), "fails": v.fails(), "checks": v.checks.iter().map(check).collect::<Vec<_>>() })
}

fn named(garment: &Garment, piece: &Piece) -> Value {
    let Some(mesh) = &piece.mesh else { return Value::Null };
    let f = features::of(garment, piece, mesh);
    let warp = piece.warp();
    let mut grain = json!({ "direction": [warp.x, warp.y] });
    if let Some(line) = f.grain {
        grain["line"] = json!(line);
    }
    let edge = |c: &Chain| json!({ "id": c.name, "chain": c.vertices });
    let pair = |p: &ChainPair| json!({ "id": p.name, "a": p.a, "b": p.b });
    let dart = |p: &ChainPair| json!({ "id": p.name, "leg_a": p.a, "leg_b": p.b });
    let corner = |c: &Corner| json!({ "id": c.name, "at": c.at });
    json!({
        "edges": f.edges.iter().map(edge).collect::<Vec<_>>(),
        "pairs": f.pairs.iter().map(pair).collect::<Vec<_>>(),
        "darts": f.darts.iter().map(dart).collect::<Vec<_>>(),
        "corners": f.corners.iter().map(corner).collect::<Vec<_>>(),
        "grain": grain,
    })
}

fn figures(flat: &FlatPiece) -> Value {
    let [original, new, surface] = flat.area.map(|a| 1e4 * a);
    json!({
        "area": { "original_cm2": original, "flat_cm2": new, "surface_cm2": surface,
                  "flat_vs_original_pct": percent(new, original), "flat_vs_surface_pct": percent(new, surface) },
        "edges": flat.edges.iter().map(edge).collect::<Vec<_>>(),
        "darts": flat.darts.iter().map(dart).collect::<Vec<_>>(),
        "grain_shift_deg": flat.grain_shift.to_degrees(),
        "drape_strain": strain(&flat.drape_strain),
        "flat_strain": strain(&flat.flat_strain),
        "curvature_deg": flat.curvature.to_degrees(),
        "forced_strain_pct": flat.forced_strain.map(|s| 100.0 * s),
        "rounds": flat.rounds,
        "last_motion_mm": 1e3 * flat.last_motion,
    })
}

fn edge(e: &LengthChange) -> Value {
    json!({ "id": e.name, "original_mm": 1e3 * e.original, "flat_mm": 1e3 * e.flat, "surface_mm": 1e3 * e.surface,
            "flat_vs_original_mm": 1e3 * (e.flat - e.original) })
}

fn dart(d: &DartChange) -> Value {
    let leg = d.legs.map(|l| 1e3 * l);
    json!({
        "id": d.name,
        "original": { "angle_deg": d.angle[0].to_degrees(), "width_mm": 1e3 * d.width[0], "leg_a_mm": leg[0], "leg_b_mm": leg[1] },
        "flat": { "angle_deg": d.angle[1].to_degrees(), "width_mm": 1e3 * d.width[1], "leg_a_mm": leg[2], "leg_b_mm": leg[3] },
    })
}

fn pair(p: &PairChange) -> Value {
    let (original, flat) = (p.a[0] - p.b[0], p.a[1] - p.b[1]);
    json!({
        "id": p.name,
        "a": { "original_mm": 1e3 * p.a[0], "flat_mm": 1e3 * p.a[1] },
        "b": { "original_mm": 1e3 * p.b[0], "flat_mm": 1e3 * p.b[1] },
        "ease_original_mm": 1e3 * original, "ease_flat_mm": 1e3 * flat, "ease_error_mm": 1e3 * (flat - original),
    })
}

fn strain(map: &StrainMap) -> Value {
    json!({ "warp": map.warp, "weft": map.weft, "shear_rad": map.shear })
}

fn percent(new: f64, old: f64) -> f64 {
    if old > 0.0 { 100.0 * (new / old - 1.0) } else { 0.0 }
}

fn mm2(p: &Vec2) -> [f64; 2] {
    [1e3 * p.x, 1e3 * p.y]
}

fn mm3(p: &Vec3) -> [f64; 3] {
    [1e3 * p.x, 1e3 * p.y, 1e3 * p.z]
}
