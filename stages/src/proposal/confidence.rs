//! How sure a seam is: it is forbidden, the garment is searched again, and the loss of score is the margin.

use super::assignment::Assignment;
use super::atoms::Layout;
use super::pairs::Pair;
use super::random::Random;
use super::search::{Found, Schedule, Search};
use super::tuning;
use super::whole::Whole;
use rayon::prelude::*;

/// A sewn pair and what speaks for it against the next best garment.
#[derive(Clone, Debug)]
pub struct Margin {
    /// The pair.
    pub pair: Pair,
    /// Score that is lost without it.
    pub margin: f64,
    /// The next best partners of both atoms.
    pub instead: [Option<usize>; 2],
    /// Likelihood that the pair itself allows at most, whatever the rest of the garment asks for.
    pub most: f64,
}

/// Margins of all pairs. Where a garment without a pair turns out to be better, it is taken, and all begins again.
pub fn margins(layout: &Layout, whole: &Whole<'_>, found: &mut Found) -> Vec<Margin> {
    let steps = (tuning::AGAIN_LEAST + tuning::AGAIN_PER_ATOM * layout.atoms.len() as f64) as usize;
    let schedule = Schedule { steps, hottest: tuning::HOTTEST_AGAIN };
    for _ in 0..tuning::ROUNDS {
        match one_round(layout, whole, found, schedule) {
            Ok(margins) => return margins,
            Err(better) => *found = better,
        }
    }
    one_round(layout, whole, found, Schedule { steps: 0, ..schedule }).unwrap_or_default()
}

/// Seams that are looked at side by side, before a better garment ends the round.
const AT_ONCE: usize = 8;

fn one_round(layout: &Layout, whole: &Whole<'_>, found: &Found, schedule: Schedule) -> Result<Vec<Margin>, Found> {
    let image = |pair: Pair| super::assignment::image(pair, whole.mirror);
    let mut asked: Vec<Pair> = Vec::new();
    for pair in found.assignment.pairs() {
        if !image(pair).is_some_and(|i| asked.iter().any(|known| is_same(*known, i))) {
            asked.push(pair);
        }
    }
    let without = |pair: &Pair| {
        let mut search = Search::new(layout, whole);
        search.forbidden = std::iter::once(*pair).chain(image(*pair)).collect();
        let mut assignment = found.assignment.clone();
        assignment.remove(pair.a, whole.mirror);
        let start = Found { score: search.score(&assignment), assignment };
        search.anneal(start, schedule, &mut Random::new(tuning::SEED))
    };
    let mut known: Vec<Margin> = Vec::new();
    for pairs in asked.chunks(AT_ONCE) {
        let others: Vec<Found> = pairs.par_iter().map(without).collect();
        for (pair, other) in pairs.iter().zip(others) {
            let margin = found.score.total() - other.score.total();
            if margin < -1e-6 {
                return Err(other);
            }
            known.push(Margin { pair: *pair, margin, instead: partners(&other.assignment, *pair), most: 1.0 });
        }
    }
    let of = |pair: Pair| {
        let own = known.iter().find(|m| m.pair == pair).cloned();
        own.or_else(|| mirrored(known.iter().find(|m| image(pair).is_some_and(|i| is_same(m.pair, i)))?, pair, whole))
    };
    Ok(found.assignment.pairs().filter_map(of).collect())
}

/// The margin of a pair from that of its mirror image.
fn mirrored(known: &Margin, pair: Pair, whole: &Whole<'_>) -> Option<Margin> {
    let atom = |a: Option<usize>| a.map(|a| whole.mirror.of(a).unwrap_or(a));
    let swapped = whole.mirror.of(known.pair.a) != Some(pair.a);
    let [x, y] = known.instead.map(atom);
    let instead = if swapped { [y, x] } else { [x, y] };
    Some(Margin { pair, instead, ..known.clone() })
}

fn is_same(x: Pair, y: Pair) -> bool {
    (x.a.min(x.b), x.a.max(x.b)) == (y.a.min(y.b), y.a.max(y.b))
}

fn partners(of: &Assignment, pair: Pair) -> [Option<usize>; 2] {
    [of.partner(pair.a), of.partner(pair.b)]
}
