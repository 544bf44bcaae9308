//! The places at which outlines are cut into atoms.

use super::profile::turn;
use super::tuning;
use crate::sewing::marks::on_rings;
use crate::sewing::ring::{Gap, Ring};
use crate::sewing::shapes::PieceShape;
use std::f64::consts::PI;
use toile_garment::dart::DartKind;
use toile_garment::{Piece, Vec2};

/// The mark between two atoms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A corner of the outline.
    Corner,
    /// A notch.
    Notch,
    /// The mouth of a dart.
    Dart,
}

/// A place at which the outline is cut: one atom ends, the next starts, and a dart may lie between.
#[derive(Clone, Debug)]
pub struct Cut {
    /// Where the atom before it ends, metres of arc.
    pub end: f64,
    /// Where the atom after it starts.
    pub start: f64,
    /// Kind.
    pub mark: Mark,
    gap: Option<Gap>,
    /// Does a notch stand there?
    pub is_notched: bool,
}

impl Cut {
    /// Angle of the cloth there, radians.
    pub fn angle(&self, ring: &Ring) -> f64 {
        let d = tuning::CORNER_REACH.min(0.1 * ring.total());
        let into = |s: f64| ring.at(s) - ring.at(s - d);
        let out = |s: f64| ring.at(s + d) - ring.at(s);
        match &self.gap {
            Some(g) if g.apex.is_some() => {
                2.0 * PI - turn(into(self.end), out(self.end)) - turn(into(self.start), out(self.start))
            }
            _ => PI - turn(into(self.end), out(self.start)),
        }
    }

    /// True for a corner that hardly turns. It marks a place on an edge, like a notch.
    pub fn is_flat_corner(&self, ring: &Ring) -> bool {
        self.mark == Mark::Corner && (self.angle(ring) - PI).abs() < tuning::FLAT_CORNER
    }
}

/// The outline of a piece with its cuts.
pub struct Outline<'a> {
    /// Index of the piece in the garment.
    pub index: usize,
    /// The piece.
    pub piece: &'a Piece,
    /// Its outline.
    pub ring: &'a Ring,
    /// Unit warp direction, upwards where it is not level.
    pub warp: Vec2,
    /// Its cuts in walking order.
    pub cuts: Vec<Cut>,
}

impl<'a> Outline<'a> {
    /// The outline of a piece, cut at its corners, notches and darts.
    pub fn new(index: usize, piece: &'a Piece, shape: &'a PieceShape, up: Vec2) -> Self {
        let warp = piece.warp();
        let warp = if warp.dot(&up) < -tuning::UPRIGHT { -warp } else { warp };
        Self { index, piece, ring: &shape.rings[0], warp, cuts: cuts(piece, shape) }
    }

    /// Marks a place that another piece asks for.
    pub fn mark(&mut self, at: f64) {
        self.cuts.push(Cut { end: at, start: at, mark: Mark::Notch, gap: None, is_notched: false });
        self.cuts.sort_by(|a, b| a.end.total_cmp(&b.end));
    }

    /// Lengths of the stretches that begin at the cuts, metres.
    fn lengths(&self) -> Vec<f64> {
        let n = self.cuts.len();
        let ahead = |k: usize| self.ring.sewn_ahead(self.cuts[k].start, self.cuts[(k + 1) % n].end);
        (0..n).map(|k| if n == 1 { self.ring.total() } else { ahead(k) }).collect()
    }

    /// Runs of stretches that only corners part which hardly turn, each by the numbers of its stretches.
    fn smooth_runs(&self) -> Vec<Vec<usize>> {
        let n = self.cuts.len();
        let goes_on = |k: &usize| !self.cuts[*k].is_notched && self.cuts[*k].is_flat_corner(self.ring);
        let run = |first: usize| {
            let more = (first + 1..first + n).map(|k| k % n).take_while(goes_on);
            std::iter::once(first).chain(more).collect::<Vec<usize>>()
        };
        (0..n).filter(|k| !goes_on(k)).map(run).filter(|run| run.len() > 1).collect()
    }
}

/// Takes away grade points: corners that hardly turn and that one side of a seam alone has. No other piece has a
/// stretch as long as one of those that they part, but some other stretch has the whole length. It may be one of the same
/// piece, because a leg in one piece is sewn to itself. The other side may have grade points of its own, elsewhere.
pub fn without_unpaired(outlines: &mut [Outline<'_>]) {
    let lengths: Vec<Vec<f64>> = outlines.iter().map(Outline::lengths).collect();
    let totals: Vec<f64> = outlines.iter().map(|o| o.ring.total()).collect();
    let runs: Vec<Vec<Vec<usize>>> = outlines.iter().map(Outline::smooth_runs).collect();
    let is = |length: f64, other: f64| libm::log(other / length).abs() < tuning::AS_LONG;
    let whole = |piece: usize, run: &[usize]| run.iter().map(|k| lengths[piece][*k]).sum::<f64>();
    // Where the parts of a run begin, from its start on.
    let places = |piece: usize, run: &[usize]| -> Vec<f64> {
        let sum = |at: &mut f64, k: &usize| {
            *at += lengths[piece][*k];
            Some(*at)
        };
        run[..run.len() - 1].iter().scan(0.0, sum).collect()
    };
    let unpaired = |own: usize| -> Vec<usize> {
        // A piece and its mirror image have the same marks.
        let is_other = |k: &usize| (totals[*k] / totals[own] - 1.0).abs() > tuning::SAME_PIECE;
        let others: Vec<f64> = (0..totals.len()).filter(is_other).flat_map(|k| lengths[k].iter().copied()).collect();
        let is_unpaired = |run: &Vec<usize>| {
            let has = |length: f64| others.iter().any(|l| is(length, *l));
            let whole = whole(own, run);
            let of_own = |k: usize| !run.contains(&k) && is(whole, lengths[own][k]);
            !run.iter().any(|k| has(lengths[own][*k])) && (has(whole) || (0..lengths[own].len()).any(of_own))
        };
        let of_run = |run: &Vec<usize>| -> Vec<usize> {
            if is_unpaired(run) {
                return run[1..].to_vec();
            }
            let length = whole(own, run);
            let mates = (0..totals.len()).filter(is_other).flat_map(|k| runs[k].iter().map(move |r| (k, r)));
            let mates: Vec<(usize, &Vec<usize>)> =
                mates.filter(|(k, r)| length > tuning::GRADED_RUN && is(length, whole(*k, r))).collect();
            // The other side is walked the other way.
            let of_mates: Vec<f64> = mates.iter().flat_map(|(k, r)| places(*k, r)).map(|at| length - at).collect();
            let is_met = |at: f64| of_mates.iter().any(|m| (m - at).abs() < tuning::SAME_PLACE);
            let parts = run[1..].iter().zip(places(own, run));
            parts.filter(|(_, at)| !mates.is_empty() && !is_met(*at)).map(|(k, _)| *k).collect()
        };
        runs[own].iter().flat_map(of_run).collect()
    };
    let unpaired: Vec<Vec<usize>> = (0..totals.len()).map(unpaired).collect();
    for (outline, unpaired) in outlines.iter_mut().zip(unpaired) {
        let mut number = 0..;
        outline.cuts.retain(|_| number.next().is_none_or(|k| !unpaired.contains(&k)));
    }
}

/// Takes away notches that the other side lacks: no stretch of another piece is as long as one of those that they part,
/// but some other one has both together. An edge that fits as a whole needs no gather in its parts.
pub fn without_alone(outlines: &mut [Outline<'_>]) {
    let lengths: Vec<Vec<f64>> = outlines.iter().map(Outline::lengths).collect();
    let totals: Vec<f64> = outlines.iter().map(|o| o.ring.total()).collect();
    let is = |length: f64, other: f64, off: f64| libm::log(other / length).abs() < off;
    let alone = |own: usize| -> Vec<usize> {
        let is_other = |k: &usize| (totals[*k] / totals[own] - 1.0).abs() > tuning::SAME_PIECE;
        let others: Vec<f64> = (0..totals.len()).filter(is_other).flat_map(|k| lengths[k].iter().copied()).collect();
        let has = |length: f64, off: f64| others.iter().any(|l| is(length, *l, off));
        let n = outlines[own].cuts.len();
        let is_alone = |k: &usize| {
            let cut = &outlines[own].cuts[*k];
            let [before, after] = [lengths[own][(*k + n - 1) % n], lengths[own][*k]];
            let is_mark = cut.mark == Mark::Notch && n > 1;
            is_mark && ![before, after].iter().any(|l| has(*l, tuning::AS_LONG)) && has(before + after, tuning::EXACTLY)
        };
        (0..n).filter(is_alone).collect()
    };
    let alone: Vec<Vec<usize>> = (0..totals.len()).map(alone).collect();
    for (outline, alone) in outlines.iter_mut().zip(alone) {
        let mut number = 0..;
        outline.cuts.retain(|_| number.next().is_none_or(|k| !alone.contains(&k)));
    }
}

/// The cuts of an outline in walking order, each once.
fn cuts(piece: &Piece, shape: &PieceShape) -> Vec<Cut> {
    let ring = &shape.rings[0];
    // A pleat is no mark: the edge goes on over it.
    let mut cuts: Vec<Cut> = ring
        .gaps
        .iter()
        .filter(|g| g.kind != DartKind::Pleat)
        .map(|g| Cut {
            end: ring.arc[g.from],
            start: ring.arc[g.to],
            mark: Mark::Dart,
            gap: Some(g.clone()),
            is_notched: false,
        })
        .collect();
    let ends = piece.edges.iter().filter_map(|e| ring.of_line.get(e.from as usize).copied().flatten());
    let corners = ends.map(|i| (ring.arc[i], Mark::Corner));
    let notches = on_rings(piece, shape).into_iter().filter(|(r, _)| *r == 0).map(|(_, s)| (s, Mark::Notch));
    for (s, mark) in corners.chain(notches) {
        let near = |t: f64| f64::min(ring.ahead(s, t), ring.ahead(t, s)) < tuning::SAME_MARK;
        let is_notched = mark == Mark::Notch;
        if let Some(known) = cuts.iter_mut().find(|c| near(c.end) || near(c.start)) {
            known.is_notched |= is_notched;
        } else if ring.gap_around(s).is_none() {
            cuts.push(Cut { end: s, start: s, mark, gap: None, is_notched });
        }
    }
    if cuts.is_empty() {
        cuts.push(Cut { end: 0.0, start: 0.0, mark: Mark::Corner, gap: None, is_notched: false });
    }
    cuts.sort_by(|a, b| a.end.total_cmp(&b.end));
    cuts
}
