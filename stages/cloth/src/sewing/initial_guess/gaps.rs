//! The bends that bring pieces nearest to the places they are sewn to, whatever else may be in the way.

use crate::Vec3;
use crate::sewing::initial_guess::piece::{Bend, Piece};
use crate::sewing::tuning::{GUESS_BENDS, GUESS_ROUNDS};

/// Parts of the largest curvature by which each piece is bent more or less in a round.
const CURVATURE_STEPS: [f64; 10] = [-0.16, -0.08, -0.04, -0.016, -0.008, 0.008, 0.016, 0.04, 0.08, 0.16];

/// An end of a thread: on a piece, where it lies flat, or where it stays.
#[derive(Clone, Copy, Debug)]
pub(crate) enum End {
    On(usize, Vec3),
    Still(Vec3),
}

/// Pieces, how each is bent, and the threads between them.
#[derive(Debug)]
pub(crate) struct BentPieces {
    pub pieces: Vec<Piece>,
    pub bends: Vec<Bend>,
    threads: Vec<[End; 2]>,
}

/// The other end of a thread while only one piece bends.
enum Other {
    Same(Vec3),
    Still(Vec3),
}

impl BentPieces {
    /// All flat.
    pub fn new(pieces: Vec<Piece>, threads: Vec<[End; 2]>) -> Self {
        Self { bends: vec![Bend::default(); pieces.len()], pieces, threads }
    }

    /// Bends those for which that leaves less open, by the sum of the squares of the gaps.
    pub fn close(&mut self) {
        let bends = i32::try_from(GUESS_BENDS.get()).unwrap_or(i32::MAX);
        for k in 0..self.pieces.len() {
            self.bend(k, self.pieces[k].bends(bends));
        }
        for _ in 0..GUESS_ROUNDS.get() {
            for k in 0..self.pieces.len() {
                self.bend(k, self.pieces[k].variants(self.bends[k], &CURVATURE_STEPS));
            }
        }
    }

    fn place(&self, end: &End) -> Vec3 {
        match end {
            End::On(k, p) => self.pieces[*k].place(p, self.bends[*k]),
            End::Still(p) => *p,
        }
    }

    /// Bends one piece as leaves least open, if it is less than now.
    fn bend(&mut self, k: usize, tried: Vec<Bend>) {
        let (piece, pairs) = (&self.pieces[k], self.pairs(k));
        let gap = |(p, other): &(Vec3, Other), bend: Bend| {
            let to = match other {
                Other::Same(q) => piece.place(q, bend),
                Other::Still(q) => *q,
            };
            (piece.place(p, bend) - to).norm_squared()
        };
        let open = |bend: Bend| pairs.iter().map(|pair| gap(pair, bend)).sum::<f64>();
        let mut best = (open(self.bends[k]), self.bends[k]);
        for bend in tried {
            let left = open(bend);
            if left < best.0 {
                best = (left, bend);
            }
        }
        self.bends[k] = best.1;
    }

    /// Ends on a piece, and what they are sewn to.
    fn pairs(&self, k: usize) -> Vec<(Vec3, Other)> {
        let pair = |ends: &[End; 2]| match ends {
            [End::On(i, p), End::On(j, q)] if *i == k && *j == k => Some((*p, Other::Same(*q))),
            [End::On(i, p), other] | [other, End::On(i, p)] if *i == k => Some((*p, Other::Still(self.place(other)))),
            _ => None,
        };
        self.threads.iter().filter_map(pair).collect()
    }
}
