//! How two sewn sides changed beside each other, from the start of a seam to every station of it.

use super::sewn::{MeshEdges, stations};
use toile_garment::seam::Seam;
use toile_garment::{MeshVertex, Vec2};

/// A place of a seam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beside {
    /// The vertices that are sewn to each other.
    pub at: [MeshVertex; 2],
    /// Way from the start of the seam in the stored pieces, metres: on side a, on side b.
    pub along: [f64; 2],
    /// How much more the way on side a grew than that on side b, metres.
    pub off: f64,
}

/// The stations of a seam in its order.
pub fn beside(seam: &Seam, edges: &MeshEdges, rest: &[&[Vec2]], flat: &[&[Vec2]]) -> Vec<Beside> {
    let place = |x: &[&[Vec2]], v: MeshVertex| x.get(v.piece.index()).and_then(|p| p.get(v.vertex as usize)).copied();
    let length =
        |x: &[&[Vec2]], [p, q]: [MeshVertex; 2]| place(x, p).zip(place(x, q)).map_or(0.0, |(p, q)| (q - p).norm());
    let (mut along, mut off) = ([0.0; 2], 0.0);
    let step = |s: super::sewn::Station| {
        let [before, after] = [rest, flat].map(|x| [length(x, s.a), length(x, s.b)]);
        off += match seam.gather {
            // A gather is sewn by its ratio, and the shorter side is what is felt.
            Some(_) if before.iter().all(|l| *l > 0.0) => {
                (after[0] / before[0] - after[1] / before[1]) * before[0].min(before[1])
            }
            _ => (after[0] - after[1]) - (before[0] - before[1]),
        };
        along = [along[0] + before[0], along[1] + before[1]];
        Beside { at: [s.a[1], s.b[1]], along, off }
    };
    stations(seam, edges).into_iter().map(step).collect()
}
