//! Places on a piece.

use super::params::{Change, EdgeSpot, Spot};
use super::{ALTER_DART, ALTER_PLACE};
use crate::fit::nearest::closest;
use crate::sewing::codes::RUN_WITHOUT_LENGTH;
use crate::sewing::lookup;
use crate::sewing::ring::{Gap, Ring, arcs, nearest_on};
use crate::sewing::shapes::{Shapes, mm};
use toile_formats::sewing::edge_place;
use toile_garment::dart::{Dart, DartKind};
use toile_garment::outline::OutlineEdge;
use toile_garment::sewing::{EdgePlace, EdgeWay, RunSpec};
use toile_garment::{Diagnostic, Garment, Piece, PieceId, Vec2, Vec3};

/// A place of a line's end this far from the outline lies on it, metres.
const ON_OUTLINE: f64 = 2e-3;
/// The end of a line that was drawn in space lies on the outline within this, metres: seams are hit by eye.
const SEEN_NEAR: f64 = 15e-3;

/// A dart of a piece by its name, with its number.
pub fn dart<'g>(garment: &'g Garment, id: PieceId, name: &str) -> Result<(usize, &'g Dart), Diagnostic> {
    let piece = &garment.pieces[id.index()];
    let found = piece.darts.iter().enumerate().find(|(_, d)| d.name.eq_ignore_ascii_case(name));
    found.ok_or_else(|| {
        let names: Vec<&str> = piece.darts.iter().map(|d| d.name.as_str()).collect();
        let message = format!("piece `{}` has no dart `{name}`", piece.name);
        Diagnostic::error(ALTER_DART, message).hint(lookup::nearest(name, &names))
    })
}

/// A wedge dart by its name: its number, itself, and its place on the outline.
pub fn wedge<'g>(
    garment: &'g Garment,
    shapes: &'g Shapes,
    id: PieceId,
    name: &str,
) -> Result<(usize, &'g Dart, &'g Gap), Diagnostic> {
    let (number, dart) = dart(garment, id, name)?;
    let gaps = &shapes[id.index()].rings[0].gaps;
    let is_wedge = matches!(dart.kind, DartKind::Wedge | DartKind::MarkedWedge);
    let gap = gaps.iter().find(|g| g.dart == number && is_wedge && g.apex.is_some());
    let piece = &garment.pieces[id.index()].name;
    let refused = || {
        let message = format!("dart `{}` of piece `{piece}` does not begin at the outline", dart.name);
        Diagnostic::error(ALTER_DART, message).hint("fish-eye darts and pleats stay where they are; take a wedge dart")
    };
    gap.map(|gap| (number, dart, gap)).ok_or_else(refused)
}

/// A change whose places in space are places on the pieces.
///
/// # Errors
/// Places in space of a piece that has no shape there.
pub fn flattened(garment: &Garment, change: &Change) -> Result<Change, Diagnostic> {
    let mut change = change.clone();
    let piece = change.piece().to_owned();
    let mut spots = change.spots();
    let last = spots.len() - 1;
    for (k, spot) in spots.iter_mut().enumerate() {
        if let Spot::Space(at) = spot {
            let id = lookup::piece(garment, &piece, None)?;
            let p = in_space(garment, id, Vec3::new(at[0], at[1], at[2]) * 1e-3)?;
            let p = if k == 0 || k == last { to_outline(&garment.pieces[id.index()], p) } else { p };
            **spot = Spot::Plane([1e3 * p.x, 1e3 * p.y]);
        }
    }
    Ok(change)
}

/// A place, or the place on the outline that it is near to.
fn to_outline(piece: &Piece, p: Vec2) -> Vec2 {
    let ring = Ring::from_line(&piece.outline.positions());
    let (s, distance) = ring.project(p);
    if distance < SEEN_NEAR { ring.at(s) } else { p }
}

/// Where a place lies in the plane of the piece, metres.
pub fn point(garment: &Garment, shapes: &Shapes, id: PieceId, spot: &Spot) -> Result<Vec2, Diagnostic> {
    match spot {
        Spot::Dart(name) => {
            let (_, dart) = dart(garment, id, name)?;
            let piece = &garment.pieces[id.index()].name;
            dart.apexes
                .first()
                .copied()
                .ok_or_else(|| Diagnostic::error(ALTER_DART, format!("dart `{name}` of piece `{piece}` has no point")))
        }
        Spot::Plane(at) => Ok(Vec2::new(at[0], at[1]) * 1e-3),
        Spot::Space(at) => in_space(garment, id, Vec3::new(at[0], at[1], at[2]) * 1e-3),
        Spot::Edge(at) => edge(garment, shapes, id, at),
    }
}

fn edge(garment: &Garment, shapes: &Shapes, id: PieceId, spot: &EdgeSpot) -> Result<Vec2, Diagnostic> {
    let place = edge_place(&spot.at).ok_or_else(|| {
        let message = format!("`{}` is no place on an edge", spot.at);
        Diagnostic::error(ALTER_PLACE, message)
            .hint("write `40 mm`, `40 mm from end`, `30 %`, `notch 1`, `start`, `middle` or `end`")
    })?;
    let (piece, edge) = (garment.pieces[id.index()].name.clone(), spot.edge.text());
    let whole = lookup::run(garment, shapes, &RunSpec::Edge { piece: piece.clone(), edge: edge.clone() }, None)?;
    let end = EdgePlace { way: EdgeWay::Share(0.0), from_end: true };
    let shape = &shapes[id.index()];
    let ring = &shape.rings[whole.ring];
    let (start, length) = (whole.span().0, whole.walk(shape));
    if ring.gap_around((start + length / 2.0).rem_euclid(ring.total())).is_some() {
        let message = format!("edge `{}` is the leg of a dart", spot.edge.text());
        return Err(Diagnostic::error(ALTER_PLACE, message).hint("give a place on an edge of the cloth"));
    }
    // Any place begins a part that runs to the end of the edge. A part without length is the end.
    match lookup::run(garment, shapes, &RunSpec::Part { piece, edge, from: place, to: end }, None) {
        Ok(part) => Ok(shape.rings[part.ring].at(part.span().0)),
        Err(fault) if fault.code == RUN_WITHOUT_LENGTH => Ok(shape.rings[whole.ring].at(whole.span().1)),
        Err(fault) => Err(fault),
    }
}

/// The place of the piece that is nearest to a point in space.
fn in_space(garment: &Garment, id: PieceId, at: Vec3) -> Result<Vec2, Diagnostic> {
    let piece = &garment.pieces[id.index()];
    let shape = garment.drape.as_ref().or(garment.stitched.as_ref());
    let places = shape.and_then(|s| s.positions.get(id.index()));
    let (Some(mesh), Some(places)) = (&piece.mesh, places) else {
        let message = format!("piece `{}` has no shape in space yet", piece.name);
        return Err(Diagnostic::error(ALTER_PLACE, message)
            .hint("put `alter` after `drape` or `import-garment`, or give the place as [x, y] on the piece"));
    };
    let at = garment.file_up.from_file(at);
    let mut best: Option<(f64, Vec2)> = None;
    for t in &mesh.triangles {
        let corners = t.map(|v| places[v as usize]);
        let near = closest(&at, corners);
        let d = (near - at).norm();
        if best.is_none_or(|(least, _)| d < least) {
            let [s, u] = shares(near, corners);
            let [a, b, c] = t.map(|v| mesh.rest[v as usize]);
            best = Some((d, a + (b - a) * s + (c - a) * u));
        }
    }
    best.map(|(_, p)| p).ok_or_else(|| Diagnostic::error(ALTER_PLACE, format!("piece `{}` has no mesh", piece.name)))
}

/// A point of a triangle as shares of its first two sides.
fn shares(p: Vec3, [a, b, c]: [Vec3; 3]) -> [f64; 2] {
    let (u, v, d) = (b - a, c - a, p - a);
    let (uu, uv, vv, du, dv) = (u.dot(&u), u.dot(&v), v.dot(&v), d.dot(&u), d.dot(&v));
    let det = (uu * vv - uv * uv).max(f64::MIN_POSITIVE);
    [(vv * du - uv * dv) / det, (uu * dv - uv * du) / det]
}

/// The edge of a piece that a place lies on, in words.
pub fn edge_label(piece: &Piece, at: Vec2) -> String {
    let away = |e: &&OutlineEdge| {
        let line = piece.outline.edge_points(e);
        nearest_on(&line, &arcs(&line, false), false, at).1
    };
    let edge = piece.edges.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
    let label = edge.map_or_else(String::new, |e| e.name.clone().unwrap_or_else(|| e.index.to_string()));
    format!("edge `{}.{label}`", piece.name)
}

/// The arc position of a place on the outline.
pub fn on_outline(garment: &Garment, shapes: &Shapes, id: PieceId, spot: &Spot) -> Result<f64, Diagnostic> {
    let p = point(garment, shapes, id, spot)?;
    let (s, distance) = shapes[id.index()].rings[0].project(p);
    if distance <= ON_OUTLINE {
        return Ok(s);
    }
    let piece = &garment.pieces[id.index()].name;
    let message = format!("the place {} of piece `{piece}` lies {:.1} mm off the outline", mm(p), 1e3 * distance);
    Err(Diagnostic::error(ALTER_PLACE, message).hint("give a place on an edge, or the point of a wedge dart"))
}
