//! How sure a seam is: it is forbidden, the garment is searched again, and the loss of score is the margin.

use super::assignment::Assignment;
use super::atoms::Layout;
use super::pairs::Pair;
use super::random::Random;
use super::search::{Found, Schedule, Search};
use super::tuning;
use super::whole::Whole;

/// A sewn pair and what speaks for it against the next best garment.
#[derive(Clone, Debug)]
pub struct Margin {
    /// The pair.
    pub pair: Pair,
    /// Score that is lost without it.
    pub margin: f64,
    /// The next best partners of both atoms.
    pub instead: [Option<usize>; 2],
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

fn one_round(layout: &Layout, whole: &Whole<'_>, found: &Found, schedule: Schedule) -> Result<Vec<Margin>, Found> {
    let mut search = Search::new(layout, whole);
    let mut out: Vec<Margin> = Vec::new();
    for pair in found.assignment.pairs() {
        let image = super::assignment::image(pair, whole.mirror);
        let known = image.and_then(|i| out.iter().find(|m| is_same(m.pair, i)).cloned());
        if let Some(known) = known {
            let atom = |a: Option<usize>| a.map(|a| whole.mirror.of(a).unwrap_or(a));
            let swapped = whole.mirror.of(known.pair.a) != Some(pair.a);
            let [x, y] = known.instead.map(atom);
            out.push(Margin { pair, margin: known.margin, instead: if swapped { [y, x] } else { [x, y] } });
            continue;
        }
        search.forbidden = std::iter::once(pair).chain(image).collect();
        let mut assignment = found.assignment.clone();
        assignment.remove(pair.a, whole.mirror);
        let start = Found { score: search.score(&assignment), assignment };
        let other = search.anneal(start, schedule, &mut Random::new(tuning::SEED));
        let margin = found.score.total() - other.score.total();
        if margin < -1e-6 {
            return Err(other);
        }
        out.push(Margin { pair, margin, instead: partners(&other.assignment, pair) });
    }
    Ok(out)
}

fn is_same(x: Pair, y: Pair) -> bool {
    (x.a.min(x.b), x.a.max(x.b)) == (y.a.min(y.b), y.a.max(y.b))
}

fn partners(of: &Assignment, pair: Pair) -> [Option<usize>; 2] {
    [of.partner(pair.a), of.partner(pair.b)]
}
