//! D17: a seam between two layers of a stack.

use crate::case::{Case, case};
use crate::lab::Lab;
use crate::scenes::{block, cotton, even, lying};
use crate::support::mesh::Mesh;
use crate::support::trial::Trial;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    vec![case("D17-seam-from-layer-3-to-1", skipped).quick()]
}

/// How far the second and the fourth layer are drawn, m.
const WAY: f64 = 0.03;

/// Four layers on a table. The lowest is held at its right edge; the third is sewn to it along the left edge, over the
/// second, which ends 20 mm before the seam. The second is drawn out to the right, the fourth forwards: both come along
/// as they are, the others stay.
fn skipped(lab: &mut Lab) -> Result<(), String> {
    let (side, pitch) = (0.2, 0.02);
    let mut cloth = Mesh::default();
    let mut first = Vec::new();
    for k in 0..4 {
        let z = 2e-3 + 3e-3 * f64::from(k);
        let width = if k == 1 { side - pitch } else { side };
        let sheet = lying(even(width, side, pitch), z);
        let shift = Vec3::x() * (0.5 * (side - width));
        first.push(cloth.join(&Mesh { at: sheet.at.iter().map(|p| p + shift).collect(), ..sheet }));
    }
    first.push(cloth.at.len());
    let layer = |k: usize| first[k]..first[k + 1];
    let start = cloth.at.clone();
    let edge = |k: usize, x: f64| layer(k).filter(|v| (start[*v].x - x).abs() < 1e-9).collect::<Vec<_>>();
    let front: Vec<usize> = layer(3).filter(|v| (start[*v].y + 0.5 * side).abs() < 1e-9).collect();
    let stitches = edge(2, -0.5 * side).into_iter().zip(edge(0, -0.5 * side)).map(|(a, b)| [a, b]).collect();
    let table = block(Vec3::new(-0.5, -0.5, -0.25), Vec3::new(0.5, 0.5, 0.0));
    let (still, right) = (edge(0, 0.5 * side), edge(1, 0.5 * side));
    let ways = [Vec3::zeros(), Vec3::x() * WAY, Vec3::zeros(), Vec3::y() * -WAY];
    let mut trial =
        Trial::new(cloth, cotton()).over(table).hold(still).lead(right, |p| p + ways[1]).lead(front, |p| p + ways[3]);
    trial.stitches = stitches;
    let d = lab.settles(&trial)?;
    let gap = trial.stitches.iter().map(|[a, b]| (d.at[*a] - d.at[*b]).norm()).fold(0.0, f64::max);
    lab.below("seam gap m", gap, 1e-4);
    for (k, way) in ways.iter().enumerate() {
        // The seam takes the third layer's edge down to the first; heights are not asked.
        let off = |v: usize| (d.at[v] - start[v] - way).xy().norm();
        let off = layer(k).map(off).fold(0.0, f64::max);
        lab.below(&format!("layer {} off its place m", k + 1), off, 2e-3);
    }
    let height = |k: usize| layer(k).map(|v| d.at[v].z).sum::<f64>() / layer(k).len() as f64;
    lab.expect((0..3).all(|k| height(k) < height(k + 1)), "the layers changed their order");
    Ok(())
}
