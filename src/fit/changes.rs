//! Changes of a pattern in the words of the trade: widths at the heights of the body, seams, darts.

use toile_garment::body::Body;
use toile_garment::flat::{DartChange, FlatPiece, LengthChange};
use toile_garment::mesh::PieceMesh;
use toile_garment::seam::Seam;
use toile_garment::{Garment, Vec2, Vec3};
use toile_stages::fit::{cut_in_plane, inside, level_height};
use toile_stages::flatten::features;
use toile_stages::transfer::LEVELS;

/// Changes below this are none, metres.
const NO_CHANGE: f64 = 5e-4;
/// The same for angles, radians.
const NO_TURN: f64 = 2e-3;

/// One change of a piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Name of the piece.
    pub piece: String,
    /// The thing that changed, such as `width at the hip` or `intake of dart-1`.
    pub what: String,
    /// Length before and after, metres.
    pub length: [f64; 2],
    /// Angle before and after, radians; of a dart only.
    pub angle: Option<[f64; 2]>,
}

impl Change {
    /// The change in words, millimetres and degrees.
    #[must_use]
    pub fn words(&self) -> String {
        let [before, after] = self.length.map(|l| 1e3 * l);
        let angle = self.angle.map(|a| a.map(f64::to_degrees));
        let turned = angle.map_or_else(String::new, |[a, b]| format!(", {a:.1}° → {b:.1}°"));
        format!("{before:.1} → {after:.1} mm ({:+.1} mm){turned}", after - before)
    }
}

/// All changes of a garment that was moved and laid flat.
#[must_use]
pub fn changes(garment: &Garment) -> Vec<Change> {
    let Some(flat) = &garment.flat else { return Vec::new() };
    flat.pieces.iter().flat_map(|f| of_piece(garment, f)).collect()
}

fn of_piece(garment: &Garment, flat: &FlatPiece) -> Vec<Change> {
    let Some(piece) = garment.pieces.get(flat.piece.index()) else { return Vec::new() };
    let change = |what: String, length: [f64; 2], angle| Change { piece: piece.name.clone(), what, length, angle };
    let mut all: Vec<Change> = widths(garment, flat).into_iter().map(|(what, w)| change(what, w, None)).collect();
    let seams = seams_of_edges(garment, flat);
    let edge = |(e, seam): (&LengthChange, &Option<String>)| {
        let sewn = seam.as_ref().map_or_else(String::new, |name| format!(" ({name})"));
        change(format!("length of {}{sewn}", e.name), [e.original, e.flat], None)
    };
    all.extend(flat.edges.iter().zip(&seams).map(edge));
    let dart = |d: &DartChange| change(format!("intake of {}", d.name), d.width, Some(d.angle));
    all.extend(flat.darts.iter().map(dart));
    let is_one = |c: &Change| {
        let turned = c.angle.is_some_and(|[a, b]| (b - a).abs() >= NO_TURN);
        turned || (c.length[1] - c.length[0]).abs() >= NO_CHANGE
    };
    all.into_iter().filter(is_one).collect()
}

/// Name of the seam or dart on each edge of a piece.
fn seams_of_edges(garment: &Garment, flat: &FlatPiece) -> Vec<Option<String>> {
    let Some(piece) = garment.pieces.get(flat.piece.index()) else { return vec![None; flat.edges.len()] };
    let Some(mesh) = &piece.mesh else { return vec![None; flat.edges.len()] };
    let chains = features::of(garment, piece, mesh).edges;
    let holds = |seam: &Seam, vertices: &[u32]| {
        let mut runs = seam.a.runs.iter().chain(&seam.b.runs).filter(|r| r.piece == flat.piece);
        runs.any(|r| vertices.windows(2).any(|pair| pair.iter().all(|v| r.vertices.contains(v))))
    };
    let named = |name: &str| {
        let chain = chains.iter().find(|c| c.name == name)?;
        garment.seams.iter().find(|s| holds(s, &chain.vertices)).map(|s| s.name.clone())
    };
    flat.edges.iter().map(|e| named(&e.name)).collect()
}

/// Width of the cloth of a piece at each height of the body, before and after. Intakes of darts do not count.
fn widths(garment: &Garment, flat: &FlatPiece) -> Vec<(String, [f64; 2])> {
    let at = flat.piece.index();
    let mesh = garment.pieces.get(at).and_then(|p| p.mesh.as_ref());
    let moved = garment.drape.as_ref().and_then(|s| s.positions.get(at));
    let (Some(mesh), Some(moved), Some(body)) = (mesh, moved, &garment.body) else { return Vec::new() };
    if !lies_on_trunk(moved, body) {
        return Vec::new();
    }
    let heights = moved.iter().map(|p| p.y);
    let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)]);
    let width = |name: &&str| {
        let height = level_height(name, body).and_then(|wanted| inside(wanted, [low, high]))?;
        let lengths = [&mesh.rest, &flat.positions].map(|p| across(mesh, moved, p, height));
        (lengths[0] > 0.0).then(|| (format!("width at the {}", name.replace('_', " ")), lengths))
    };
    LEVELS.iter().filter_map(width).collect()
}

/// Does a piece lie between the shoulders? A sleeve does not, and its width at the bust says nothing.
fn lies_on_trunk(worn: &[Vec3], body: &Body) -> bool {
    let aside = worn.iter().map(|p| p.x.abs()).sum::<f64>() / worn.len().max(1) as f64;
    body.landmarks.get("shoulder-left").is_none_or(|p| aside < p.x.abs())
}

/// Length in the plane of the line in which a height cuts a piece.
fn across(mesh: &PieceMesh, worn: &[Vec3], plane: &[Vec2], height: f64) -> f64 {
    let cut = |t: &[u32; 3]| cut_in_plane(t.map(|v| worn[v as usize]), t.map(|v| plane[v as usize]), height);
    mesh.triangles.iter().filter_map(cut).sum()
}
