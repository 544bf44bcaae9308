//! Edits that are symmetric in space, and the symmetry of the written pieces.

use super::edit::{Change, Edit};
use super::garments::Draped;
use super::support::bench::Bench;
use toile_formats::dxf::{self, ReadOptions};
use toile_garment::outline::PointKind;
use toile_garment::{Piece, Vec2, Vec3};
use toile_stages::flatten::mirror::Reflection;

/// The most by which two sides of a written pattern may differ, metres.
const APART: f64 = 1e-5;
/// How far a piece may be turned against its middle, radians: 0.01 mm on a metre.
const TURNED: f64 = 1e-5;
/// Stored points that are images of each other within this are the same place, metres.
const SAME_PLACE: f64 = 2e-5;
/// Corners of a piece and of its image mirror each other in space within this in the mean, metres.
const SAME_IN_SPACE: f64 = 0.06;

/// Wider, wider at one end, with a bump on both sides, and longer.
pub fn edits(garment: &Draped) -> Vec<Edit> {
    let [low, high] = garment.heights();
    let middle = 0.5 * (low + high);
    let front = garment.front(middle);
    let bumps = [-1.0, 1.0].map(|side| Change::Bump { at: [side * 0.08, middle, front], height: 0.012, radius: 0.06 });
    vec![
        Edit::of("wider", vec![Change::Scale([1.04, 1.0, 1.04])]),
        Edit::of("flare", vec![Change::Flare { from: middle, to: low, share: 0.08 }]),
        Edit::of("bumps", bumps.into()),
        Edit::of("longer", vec![Change::Scale([1.0, 1.03, 1.0])]),
    ]
}

/// Lays all edits of the garments flat and judges what was written.
pub fn judge(garments: &[Draped]) {
    let mut failed = Vec::new();
    for garment in garments {
        for edit in edits(garment) {
            let bench = Bench::new();
            let said = super::flattened(&bench, garment, &edit);
            assert_eq!(said.code, 0, "{}: {}: {said:?}", garment.name, edit.words);
            let bytes = std::fs::read(bench.out().join("new.dxf")).expect("DXF");
            let pattern = dxf::read(&bytes, "new.dxf", &ReadOptions::default()).expect("pattern");
            let (written, _) = pattern.to_garment(None, None).expect("garment");
            let [count, apart, turned] = asymmetry(garment, &written.pieces);
            println!(
                "{}: {}: {count} pairs, {:.5} mm apart, turned by {turned:.1e}",
                garment.name,
                edit.words,
                1e3 * apart
            );
            if count == 0.0 || apart > APART || turned > TURNED {
                failed.push(format!("{}: {}: {:.4} mm, {turned:.1e}", garment.name, edit.words, 1e3 * apart));
            }
        }
    }
    assert_eq!(failed, Vec::<String>::new());
}

/// Number of pieces with an image, the largest distance from it, and the largest turn of one on the middle.
fn asymmetry(garment: &Draped, written: &[Piece]) -> [f64; 3] {
    let stored = &garment.garment.pieces;
    let mut out = [0.0f64; 3];
    for (p, q) in (0..stored.len()).flat_map(|p| (p..stored.len()).map(move |q| (p, q))) {
        let Some(partner) = images(&corners(&stored[p]), &corners(&stored[q])) else { continue };
        if !garment.mirror_in_space(p, q, &partner) {
            continue;
        }
        let of = |k: usize| written.iter().find(|w| w.name == stored[k].name).expect("the piece was written");
        let found = |a: &Piece, b: &Piece| {
            let onto = corners(b);
            Reflection::best(&corners(a), &partner.iter().map(|k| onto[*k]).collect::<Vec<_>>())
        };
        let (now, was) = (found(of(p), of(q)), found(&stored[p], &stored[q]));
        let turn = (now.turned(Vec2::x()) - was.turned(Vec2::x())).norm();
        // The sew line, and the cut line where there is one.
        for line in [|w: &Piece| Some(w.outline.positions()), |w: &Piece| Some(w.cut_line.as_ref()?.positions())] {
            let (Some(a), Some(b)) = (line(of(p)), line(of(q))) else { continue };
            let apart = a.iter().map(|a| distance(now.of(*a), &b)).fold(0.0, f64::max);
            out[1] = out[1].max(apart);
        }
        out = [out[0] + 1.0, out[1], out[2].max(if p == q { turn } else { 0.0 })];
    }
    out
}

fn corners(piece: &Piece) -> Vec<Vec2> {
    piece.outline.points.iter().filter(|p| p.kind == PointKind::Turn).map(|p| p.at).collect()
}

/// The corners of an outline that those of another are carried to by a reflection, walked backwards.
fn images(from: &[Vec2], onto: &[Vec2]) -> Option<Vec<usize>> {
    let n = from.len();
    if n != onto.len() || n < 3 {
        return None;
    }
    (0..n).find_map(|k| {
        let partner: Vec<usize> = (0..n).map(|i| (k + n - i) % n).collect();
        let there: Vec<Vec2> = partner.iter().map(|j| onto[*j]).collect();
        let reflection = Reflection::best(from, &there);
        let fits = from.iter().zip(&there).all(|(a, b)| (reflection.of(*a) - b).norm() <= SAME_PLACE);
        fits.then_some(partner)
    })
}

/// Distance of a point from a closed line.
fn distance(p: Vec2, line: &[Vec2]) -> f64 {
    let sides = line.iter().zip(line.iter().cycle().skip(1));
    let off = sides.map(|(a, b)| {
        let d = b - a;
        let t = ((p - a).dot(&d) / d.norm_squared().max(1e-24)).clamp(0.0, 1.0);
        (a + d * t - p).norm()
    });
    off.fold(f64::INFINITY, f64::min)
}

impl Draped {
    /// Do the corners of a piece mirror those of another one, or its own, in space?
    fn mirror_in_space(&self, p: usize, q: usize, partner: &[usize]) -> bool {
        let positions = &self.garment.drape.as_ref().expect("drape").positions;
        let places = |k: usize| -> Vec<Option<Vec3>> {
            let piece = &self.garment.pieces[k];
            let vertices = piece.mesh.iter().flat_map(|m| &m.outline_vertex);
            let corner = piece.outline.points.iter().zip(vertices).filter(|(at, _)| at.kind == PointKind::Turn);
            corner.map(|(_, v)| v.map(|v| positions[k][v as usize])).collect()
        };
        let (a, b) = (places(p), places(q));
        let off: Vec<f64> = a
            .iter()
            .zip(partner)
            .filter_map(|(a, k)| a.zip(*b.get(*k)?))
            .map(|(a, b)| Vec3::new(a.x + b.x, a.y - b.y, a.z - b.z).norm())
            .collect();
        !off.is_empty() && off.iter().sum::<f64>() / (off.len() as f64) < SAME_IN_SPACE
    }

    /// How far in front the cloth lies at a height.
    fn front(&self, height: f64) -> f64 {
        let positions = self.garment.drape.iter().flat_map(|d| d.positions.iter().flatten());
        positions.filter(|p| (p.y - height).abs() < 0.03).map(|p| p.z).fold(0.0, f64::max)
    }
}
