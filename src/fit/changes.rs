//! Changes of a pattern in the words of the trade: widths at the heights of the body, seams, darts.

use toile_garment::body::Body;
use toile_garment::flat::{DartChange, FlatPiece, LengthChange};
use toile_garment::mesh::PieceMesh;
use toile_garment::seam::Seam;
use toile_garment::sewing::AttachSpec;
use toile_garment::{Garment, Vec2, Vec3};
use toile_stages::fit::{cut_in_plane, inside, level_height};
use toile_stages::flatten::features;
use toile_stages::transfer::LEVELS;

/// Changes below this are none, metres.
const NO_CHANGE: f64 = 5e-4;
/// The same for angles, radians.
const NO_TURN: f64 = 2e-3;

/// A free edge lies in this part of the height of its piece, from below or above, else it has no word.
const EDGE_PART: f64 = 0.25;
/// A piece lies on the middle of the body where it reaches farther than this to both sides, metres.
const BESIDE_MIDDLE: f64 = 0.02;

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
    let mut all: Vec<Change> = extents(garment, flat).into_iter().map(|(what, w)| change(what, w, None)).collect();
    let words = words_of_edges(garment, flat);
    let edge = |(e, word): (&LengthChange, &Option<String>)| {
        let word = word.as_ref().map_or_else(String::new, |word| format!(" ({word})"));
        change(format!("length of {}{word}", e.name), [e.original, e.flat], None)
    };
    all.extend(flat.edges.iter().zip(&words).map(edge));
    let dart = |d: &DartChange| change(format!("intake of {}", d.name), d.width, Some(d.angle));
    all.extend(flat.darts.iter().map(dart));
    let is_one = |c: &Change| {
        let turned = c.angle.is_some_and(|[a, b]| (b - a).abs() >= NO_TURN);
        turned || (c.length[1] - c.length[0]).abs() >= NO_CHANGE
    };
    all.into_iter().filter(is_one).collect()
}

/// Describes each edge of a piece by the name of its seam, by what it is attached to, or by where it lies.
fn words_of_edges(garment: &Garment, flat: &FlatPiece) -> Vec<Option<String>> {
    let piece = garment.pieces.get(flat.piece.index());
    let Some((piece, mesh)) = piece.and_then(|p| Some((p, p.mesh.as_ref()?))) else {
        return vec![None; flat.edges.len()];
    };
    let chains = features::of(garment, piece, mesh).edges;
    let word = |e: &LengthChange| {
        let chain = chains.iter().find(|c| c.name == e.name)?;
        let holds = |seam: &&Seam| {
            let mut runs = seam.a.runs.iter().chain(&seam.b.runs).filter(|r| r.piece == flat.piece);
            runs.any(|r| chain.vertices.windows(2).any(|pair| pair.iter().all(|v| r.vertices.contains(v))))
        };
        let is_here =
            |a: &&AttachSpec| a.piece == piece.name && e.name.strip_prefix("edge ").unwrap_or(&e.name) == a.edge;
        let seam = garment.seams.iter().find(holds).map(|s| s.name.clone());
        seam.or_else(|| garment.plan.attachments.iter().find(is_here).map(|a| format!("at the {}", a.to)))
            .or_else(|| free_edge(garment.drape.as_ref()?.positions.get(flat.piece.index())?, &chain.vertices))
    };
    flat.edges.iter().map(word).collect()
}

/// An edge that is sewn to nothing, by its place on the worn piece.
fn free_edge(worn: &[Vec3], edge: &[u32]) -> Option<String> {
    let [low, high] = range(worn.iter().map(|p| p.y));
    let mean = edge.iter().filter_map(|v| worn.get(*v as usize)).map(|p| p.y).sum::<f64>() / edge.len() as f64;
    let share = (mean - low) / (high - low);
    let word = match (share < EDGE_PART, share > 1.0 - EDGE_PART) {
        (true, _) => "lower edge",
        (_, true) => "upper edge",
        _ => return None,
    };
    Some(word.to_owned())
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

/// Width of the cloth of a piece at each height of the body, and its length at the middle of the body, before and after.
/// Intakes of darts do not count.
fn extents(garment: &Garment, flat: &FlatPiece) -> Vec<(String, [f64; 2])> {
    let at = flat.piece.index();
    let mesh = garment.pieces.get(at).and_then(|p| p.mesh.as_ref());
    let moved = garment.drape.as_ref().and_then(|s| s.positions.get(at));
    let (Some(mesh), Some(moved), Some(body)) = (mesh, moved, &garment.body) else { return Vec::new() };
    if !lies_on_trunk(moved, body) {
        return Vec::new();
    }
    let both = |worn: &[Vec3], height: f64| [&mesh.rest, &flat.positions].map(|p| across(mesh, worn, p, height));
    let heights = range(moved.iter().map(|p| p.y));
    let width = |name: &&str| {
        let height = level_height(name, body).and_then(|wanted| inside(wanted, heights))?;
        let lengths = both(moved, height);
        (lengths[0] > 0.0).then(|| (format!("width at the {}", name.replace('_', " ")), lengths))
    };
    let [right, left] = range(moved.iter().map(|p| p.x));
    let middle = (right < -BESIDE_MIDDLE && left > BESIDE_MIDDLE).then(|| {
        let lying: Vec<Vec3> = moved.iter().map(|p| Vec3::new(p.y, p.x, p.z)).collect();
        ("length at the middle".to_owned(), both(&lying, 0.0))
    });
    LEVELS.iter().filter_map(width).chain(middle).collect()
}

/// Does a piece lie between the shoulders? A sleeve does not, and its width at the bust says nothing.
pub(super) fn lies_on_trunk(worn: &[Vec3], body: &Body) -> bool {
    let aside = worn.iter().map(|p| p.x.abs()).sum::<f64>() / worn.len().max(1) as f64;
    body.landmarks.get("shoulder-left").is_none_or(|p| aside < p.x.abs())
}

/// Length in the plane of the line in which a height cuts a piece.
fn across(mesh: &PieceMesh, worn: &[Vec3], plane: &[Vec2], height: f64) -> f64 {
    let cut = |t: &[u32; 3]| cut_in_plane(t.map(|v| worn[v as usize]), t.map(|v| plane[v as usize]), height);
    mesh.triangles.iter().filter_map(cut).sum()
}
