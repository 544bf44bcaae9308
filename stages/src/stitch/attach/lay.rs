//! Attached edges laid side by side around a ring.

use super::edges::{HeldEdge, edge_vertices, in_outline_order};
use super::ring::{Ring, bearing};
use toile_garment::garment::Pin;
use toile_garment::sewing::AttachStrength;
use toile_garment::{MeshVertex, Piece, PieceId, Vec3};

/// A vertex laid on a ring.
pub struct Laid {
    /// Its place on the ring.
    pub pin: Pin,
    /// Its arc position there, m.
    pub arc: f64,
    /// How its edge is held.
    pub held: AttachStrength,
}

/// One piece's share of a ring.
pub struct Share {
    piece: usize,
    /// Vertices along the attached edges with their distance from the first, darts closed, metres.
    stations: Vec<(u32, f64)>,
    /// How the edge of each station is held.
    held: Vec<AttachStrength>,
    /// Length of the attached edges, metres.
    pub length: f64,
    /// Arc position of its middle on the ring at the start.
    middle: f64,
    /// Does it run against the ring?
    is_turned: bool,
}

/// Vertices along the attached edges. Where the next attached edge starts at another vertex (a dart lies between),
/// the distance goes on from the same value: the dart is closed when sewn. So is the intake of a pleat, which hangs free.
pub fn share(piece: &Piece, placed: &[Vec3], edges: &[HeldEdge], intake: &[u32], ring: &Ring) -> Share {
    let (mut stations, mut held): (Vec<(u32, f64)>, Vec<AttachStrength>) = (Vec::new(), Vec::new());
    let mut length = 0.0;
    for (e, strength) in in_outline_order(piece, edges) {
        let chain = edge_vertices(piece, e);
        let rest = piece.mesh.as_ref().map_or(&[][..], |m| &m.rest);
        for (k, v) in chain.iter().enumerate() {
            if intake.contains(v) {
                continue;
            }
            if k > 0 && !intake.contains(&chain[k - 1]) {
                length += (rest[*v as usize] - rest[chain[k - 1] as usize]).norm();
            }
            stations.push((*v, length));
            held.push(strength);
        }
    }
    let turn = turn(&stations, placed);
    if turn < 0.0 {
        // The ring runs to the wearer's left; a top edge walked counter-clockwise runs to the right.
        stations.iter_mut().for_each(|(_, along)| *along = length - *along);
    }
    // The mean of an edge that goes more than half round lies near the axis, and tells no direction.
    let is_half_round = turn.abs() > std::f64::consts::PI;
    let shown = if is_half_round { &stations[stations.len() / 2..=stations.len() / 2] } else { &stations[..] };
    let sum: Vec3 = shown.iter().map(|(v, _)| placed[*v as usize]).sum();
    let middle = ring.arc_towards(sum / (shown.len().max(1) as f64));
    Share { piece: piece.id.index(), stations, held, length, middle, is_turned: turn < 0.0 }
}

/// The turn about the body's axis along stations, rad, to the wearer's left. An edge of a whole ring turns by a full circle.
pub fn turn(stations: &[(u32, f64)], placed: &[Vec3]) -> f64 {
    let at = |s: &(u32, f64)| bearing(placed[s.0 as usize]);
    let wrapped = |x: f64| (x + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
    stations.windows(2).map(|w| wrapped(at(&w[1]) - at(&w[0]))).sum()
}

/// Lays the shares side by side around the ring, turned so that their middles move least. Also tells how far the
/// straight line between neighbouring pins lies inside the ring at most, metres.
pub fn lay(shares: &[Share], ring: &Ring) -> (Vec<Laid>, f64) {
    let mut shares: Vec<&Share> = shares.iter().collect();
    shares.sort_by(|a, b| a.middle.total_cmp(&b.middle));
    let girth = ring.girth();
    let total: f64 = shares.iter().map(|s| s.length).sum();
    let scale = girth / total.max(1e-9);
    let mut start = 0.0;
    let mut starts = Vec::new();
    let mut offset = 0.0;
    for s in &shares {
        starts.push(start);
        let away = s.middle - (start + 0.5 * s.length * scale);
        let first = shares[0].middle - 0.5 * shares[0].length * scale;
        offset += first + (away - first + 0.5 * girth).rem_euclid(girth) - 0.5 * girth;
        start += s.length * scale;
    }
    offset /= shares.len().max(1) as f64;
    let mut laid: Vec<Laid> = Vec::new();
    let mut cut = 0.0_f64;
    for (s, from) in shares.iter().zip(&starts) {
        let arc = |along: f64| from + along * scale + offset;
        let first = laid.len();
        for ((v, along), held) in s.stations.iter().zip(&s.held) {
            let vertex = MeshVertex { piece: PieceId::from(s.piece), vertex: *v };
            laid.push(Laid { pin: Pin { vertex, at: ring.at(arc(*along)) }, arc: arc(*along), held: *held });
        }
        // A corner belongs to both edges that meet there; each of both is to stand beside its own edge.
        if s.is_turned {
            laid[first..].reverse();
        }
        for w in s.stations.windows(2) {
            let (a, b) = (arc(w[0].1), arc(w[1].1));
            let chord = (ring.at(a) + ring.at(b)) * 0.5;
            cut = cut.max((ring.at(0.5 * (a + b)) - chord).norm());
        }
    }
    laid.sort_by(|a, b| a.arc.total_cmp(&b.arc).then(a.pin.vertex.cmp(&b.pin.vertex)));
    (laid, cut)
}
