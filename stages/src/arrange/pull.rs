//! Seams pull flat pieces to where their threads are shortest, every piece in its plane.

use super::dresser::Dresser;
use nalgebra::{DMatrix, DVector};
use toile_garment::{Vec2, Vec3};

/// Distance at which pieces that lie beside one another are left, m.
pub const GAP: f64 = 0.01;
/// Weight of the pull to the middle of the body against a seam of 1 m.
const MIDDLE: f64 = 1e-4;
/// Weight of an anchor against a seam of the same length.
const ANCHOR: f64 = 100.0;

/// A point of a piece that belongs at a height.
#[derive(Clone, Copy, Debug)]
pub struct Anchor {
    /// Piece.
    pub piece: usize,
    /// Its point, m.
    pub at: Vec2,
    /// Height, m.
    pub height: f64,
    /// Length of edge that it stands for, m.
    pub share: f64,
}

/// Moves the flat pieces of a group in their planes. Pieces that are placed and not in the group hold still.
pub fn pull(d: &mut Dresser<'_>, group: &[usize], anchors: &[Anchor]) {
    let n = 2 * group.len();
    let mut system = System { matrix: DMatrix::zeros(n, n), right: DVector::zeros(n) };
    let number = |piece: usize| group.iter().position(|g| *g == piece);
    for (k, i) in group.iter().enumerate() {
        let Some(sheet) = d.sheets[*i].clone() else { continue };
        let axes = [sheet.right, sheet.up];
        for t in d.threads[*i].iter().filter(|t| t.other.piece != *i) {
            let Some(other) = &d.sheets[t.other.piece] else { continue };
            let fellow = number(t.other.piece);
            let gap = (sheet.direction(t.outwards) - other.direction(t.other_outwards)) * (0.5 * GAP);
            let off = sheet.at(t.at) + gap - other.at(t.other.at);
            // Every thread within the group is met twice, once from each end.
            let weight = if fellow.is_some() { 0.5 * t.share } else { t.share };
            for row in 0..3 {
                let mut terms = vec![(2 * k, axes[0][row]), (2 * k + 1, axes[1][row])];
                if let Some(f) = fellow {
                    terms.extend([(2 * f, -other.right[row]), (2 * f + 1, -other.up[row])]);
                }
                system.add(&terms, off[row], weight);
            }
        }
        let middle = sheet.at(d.outlines[*i].centroid());
        system.add(&[(2 * k, axes[0].x), (2 * k + 1, axes[1].x)], middle.x - d.form.torso.from.x, MIDDLE);
        // Whatever is not decided stays.
        (0..2).for_each(|a| system.add(&[(2 * k + a, 1.0)], 0.0, 0.01 * MIDDLE));
    }
    for a in anchors {
        let (Some(k), Some(sheet)) = (number(a.piece), &d.sheets[a.piece]) else { continue };
        let terms = [(2 * k, sheet.right.y), (2 * k + 1, sheet.up.y)];
        system.add(&terms, sheet.at(a.at).y - a.height, ANCHOR * a.share);
    }
    let Some(by) = system.matrix.cholesky().map(|c| c.solve(&system.right)) else { return };
    for (k, i) in group.iter().enumerate() {
        if let Some(sheet) = &mut d.sheets[*i] {
            let move_by: Vec3 = sheet.right * by[2 * k] + sheet.up * by[2 * k + 1];
            sheet.shift(move_by);
        }
    }
}

/// Normal equations of a least-squares problem.
struct System {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
}

impl System {
    /// Adds the square of `off` + Σ factor · unknown.
    fn add(&mut self, terms: &[(usize, f64)], off: f64, weight: f64) {
        for (i, a) in terms {
            for (j, b) in terms {
                self.matrix[(*i, *j)] += weight * a * b;
            }
            self.right[*i] -= weight * a * off;
        }
    }
}
