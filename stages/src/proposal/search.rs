//! The search for the best assignment: simulated annealing with a fixed seed and a bounded number of steps.

use super::assignment::{Assignment, image};
use super::atoms::Layout;
use super::pairs::Pair;
use super::random::Random;
use super::tuning;
use super::whole::{Room, Score, Whole};
use rayon::prelude::*;

/// A garment and its score.
#[derive(Clone, Debug)]
pub struct Found {
    /// The partners.
    pub assignment: Assignment,
    /// Its score.
    pub score: Score,
}

/// How long and how hot.
#[derive(Clone, Copy, Debug)]
pub struct Schedule {
    /// Steps.
    pub steps: usize,
    /// Temperature at the start; the end is [`tuning::COLDEST`].
    pub hottest: f64,
}

/// The score that a change has to reach, with the share of the surface in it; lower ones are taken by chance.
#[derive(Clone, Copy)]
struct Least {
    score: f64,
    share: f64,
    temperature: f64,
}

/// The pairs that are tried, the likely ones more often.
struct Candidates {
    pairs: Vec<Pair>,
    /// Sums of their weights.
    sums: Vec<f64>,
    /// Those of every panel.
    of_panel: Vec<Vec<Scored>>,
}

/// A pair with its score, and the number from 0 to 1 above which noise makes the score positive.
#[derive(Clone, Copy)]
struct Scored {
    pair: Pair,
    score: f64,
    positive_from: f64,
}

impl Scored {
    fn new(pair: Pair, score: f64) -> Self {
        Self { pair, score, positive_from: libm::exp(-libm::exp(score / tuning::ANEW_NOISE)) }
    }

    /// The score with noise, where it is positive.
    fn with_noise(&self, random: &mut Random) -> Option<f64> {
        let unit = random.unit();
        (unit > self.positive_from).then(|| self.score + tuning::ANEW_NOISE * gumbel(unit))
    }
}

impl Candidates {
    fn new(layout: &Layout, whole: &Whole<'_>, is_allowed: impl Fn(Pair) -> bool) -> Self {
        let pairs: Vec<Pair> = whole.pairs.candidates.iter().copied().filter(|p| is_allowed(*p)).collect();
        let mut sum = 0.0;
        let mut weight = |p: &Pair| {
            sum += libm::exp((whole.pairs.score(p.a, p.b, p.opposite) / tuning::TRIAL_SPREAD).min(4.0));
            sum
        };
        let sums = pairs.iter().map(&mut weight).collect();
        let mut of_panel = vec![Vec::new(); layout.panels.len()];
        for p in &pairs {
            let scored = Scored::new(*p, whole.pairs.score(p.a, p.b, p.opposite));
            let (x, y) = (layout.atoms[p.a].panel, layout.atoms[p.b].panel);
            of_panel[x].push(scored);
            if x != y {
                of_panel[y].push(scored);
            }
        }
        Self { pairs, sums, of_panel }
    }

    fn draw(&self, random: &mut Random) -> Pair {
        let at = random.unit() * self.sums.last().copied().unwrap_or(0.0);
        self.pairs[self.sums.partition_point(|s| *s <= at).min(self.pairs.len() - 1)]
    }
}

/// The search on one garment.
pub struct Search<'a> {
    layout: &'a Layout,
    whole: &'a Whole<'a>,
    /// Pairs that may not be sewn; their mirror images neither.
    pub forbidden: Vec<Pair>,
    room: Room,
}

impl<'a> Search<'a> {
    /// A search.
    pub fn new(layout: &'a Layout, whole: &'a Whole<'a>) -> Self {
        Self { layout, whole, forbidden: Vec::new(), room: Room::default() }
    }

    /// The score of an assignment.
    pub fn score(&mut self, assignment: &Assignment) -> Score {
        self.whole.score(assignment, &mut self.room)
    }

    fn is_allowed(&self, pair: Pair) -> bool {
        let is = |f: &Pair| (f.a.min(f.b), f.a.max(f.b)) == (pair.a.min(pair.b), pair.a.max(pair.b));
        !self.forbidden.iter().any(|f| is(f) && f.opposite == pair.opposite)
    }

    /// Anneals from an assignment and gives the best that was met.
    pub fn anneal(&mut self, start: Found, schedule: Schedule, random: &mut Random) -> Found {
        let candidates = Candidates::new(self.layout, self.whole, |p| self.is_allowed(p));
        let mut best = start.clone();
        let mut here = start;
        if candidates.pairs.is_empty() {
            return best;
        }
        let cooling = libm::log(tuning::COLDEST / schedule.hottest) / schedule.steps.max(1) as f64;
        let mut trial = here.assignment.clone();
        for step in 0..schedule.steps {
            let temperature = schedule.hottest * libm::exp(cooling * step as f64);
            trial.clone_from(&here.assignment);
            if !self.change(&mut trial, &candidates, random) || trial == here.assignment {
                continue;
            }
            let share = tuning::surface_share(step as f64 / schedule.steps as f64);
            let least = Least { score: here.score.with(share), share, temperature };
            if let Some(score) = self.accepted(&trial, least, random) {
                std::mem::swap(&mut here.assignment, &mut trial);
                here.score = score;
                if score.total() > best.score.total() + 1e-9 {
                    best = here.clone();
                }
            }
        }
        best
    }

    /// The score of a change, if it is taken (Metropolis' rule). The surface only takes from a score: a change that is
    /// refused without it needs no look at the surface.
    fn accepted(&mut self, trial: &Assignment, least: Least, random: &mut Random) -> Option<Score> {
        let soft = self.whole.soft(trial, &mut self.room);
        let is_worse = soft < least.score;
        let chance = if is_worse { random.unit() } else { 0.0 };
        let is_refused = |gain: f64, chance: f64| gain < 0.0 && chance >= libm::exp(gain / least.temperature);
        if is_refused(soft - least.score, chance) {
            return None;
        }
        let score = Score { soft, hard: self.whole.surface(trial, &mut self.room) };
        let gain = score.with(least.share) - least.score;
        let chance = if !is_worse && gain < 0.0 { random.unit() } else { chance };
        (!is_refused(gain, chance)).then_some(score)
    }

    /// Makes one change. False if it cannot be made.
    fn change(&self, of: &mut Assignment, candidates: &Candidates, random: &mut Random) -> bool {
        let choice = random.unit();
        let [run, free, swap] = tuning::CHANGES;
        if choice < run {
            return self.run(of, candidates.draw(random), random);
        }
        let sewn: Vec<Pair> = of.pairs().collect();
        if sewn.is_empty() {
            return false;
        }
        let pair = sewn[random.below(sewn.len())];
        if choice < free {
            of.remove(pair.a, self.whole.mirror);
            return true;
        }
        if choice < swap { self.swap(of, pair, &sewn, random) } else { self.anew(of, candidates, random) }
    }

    /// Sews a pair, and what follows it on both sides as long as it fits.
    fn run(&self, of: &mut Assignment, pair: Pair, random: &mut Random) -> bool {
        let is_sewn = of.partner(pair.a) == Some(pair.b) && of.is_opposite(pair.a) == pair.opposite;
        if !is_sewn && !of.sew(pair, self.whole.mirror) {
            return false;
        }
        for forward in [true, false] {
            let mut here = pair;
            for _ in 0..self.layout.atoms.len() {
                let next = self.beside(here, forward);
                let fits = next.a != next.b
                    && self.whole.pairs.score(next.a, next.b, next.opposite) > tuning::GO_ON_LEAST
                    && self.is_allowed(next);
                let is_free = of.partner(next.a).is_none() && of.partner(next.b).is_none();
                let likely = if is_free { tuning::GO_ON } else { tuning::GO_ON_OVER };
                if random.unit() > likely || !fits {
                    break;
                }
                let is_sewn = of.partner(next.a) == Some(next.b);
                if !is_sewn && !of.sew(next, self.whole.mirror) {
                    break;
                }
                here = next;
            }
        }
        true
    }

    /// The pair that continues a pair past one of its ends.
    fn beside(&self, pair: Pair, forward: bool) -> Pair {
        let atoms = &self.layout.atoms;
        let a = if forward { atoms[pair.a].next } else { atoms[pair.a].before };
        let b = if forward == pair.opposite { atoms[pair.b].before } else { atoms[pair.b].next };
        Pair { a, b, opposite: pair.opposite }
    }

    /// Two pairs exchange partners.
    fn swap(&self, of: &mut Assignment, pair: Pair, sewn: &[Pair], random: &mut Random) -> bool {
        let other = sewn[random.below(sewn.len())];
        let (c, d) = if random.unit() < 0.5 { (other.a, other.b) } else { (other.b, other.a) };
        if [c, d].contains(&pair.a) {
            return false;
        }
        let two = [(pair.a, c), (pair.b, d)].map(|(a, b)| Pair { a: a.min(b), b: a.max(b), opposite: pair.opposite });
        two.iter().all(|p| self.is_allowed(*p) && image(*p, self.whole.mirror).is_some())
            && two.iter().all(|p| of.sew(*p, self.whole.mirror))
    }

    /// Takes a panel apart and sews its atoms anew to what is free, the best pairs first.
    fn anew(&self, of: &mut Assignment, candidates: &Candidates, random: &mut Random) -> bool {
        let panel = random.below(self.layout.panels.len());
        for a in self.layout.panels[panel].atoms.clone() {
            of.remove(a, self.whole.mirror);
        }
        let noisy = |scored: &Scored| Some((scored.with_noise(random)?, scored.pair));
        let mut list: Vec<(f64, Pair)> = candidates.of_panel[panel].iter().filter_map(noisy).collect();
        list.sort_by(|x, y| y.0.total_cmp(&x.0));
        for (_, pair) in list {
            if of.partner(pair.a).is_none() && of.partner(pair.b).is_none() {
                of.sew(pair, self.whole.mirror);
            }
        }
        true
    }
}

/// The number that is the largest of many by chance, of an even one from 0 to 1; its mean is 0.58 (Gumbel).
fn gumbel(unit: f64) -> f64 {
    -libm::log((-libm::log(unit.max(1e-12))).max(1e-12))
}

/// The best garment of several searches.
pub fn best(layout: &Layout, whole: &Whole<'_>, effort: f64) -> Found {
    let atoms = layout.atoms.len();
    let empty = Assignment::empty(atoms);
    let start = Found { score: Search::new(layout, whole).score(&empty), assignment: empty };
    let steps = (effort * (tuning::STEPS_LEAST + tuning::STEPS_PER_ATOM * atoms as f64)) as usize;
    let schedule = Schedule { steps, hottest: tuning::HOTTEST };
    let anneal = |seed: u64| Search::new(layout, whole).anneal(start.clone(), schedule, &mut Random::new(seed));
    let mut best: Option<Found> = None;
    let mut agreed = 0;
    for restarts in at_once() {
        let seeds: Vec<u64> = restarts.map(|restart| tuning::SEED + restart).collect();
        let all: Vec<Found> = seeds.into_par_iter().map(anneal).collect();
        // They are judged in their order, so that the result is that of one after the other.
        for found in all {
            match &best {
                Some(b) if found.score.total() <= b.score.total() + 1e-6 => {
                    agreed += u32::from(found.score.total() > b.score.total() - 1e-6);
                }
                _ => {
                    best = Some(found);
                    agreed = 0;
                }
            }
            if agreed >= tuning::AGREED {
                return best.unwrap_or(start);
            }
        }
    }
    best.unwrap_or(start)
}

/// The restarts that run side by side: first as many as may agree, then two by two.
fn at_once() -> impl Iterator<Item = std::ops::Range<u64>> {
    let first = u64::from(tuning::AGREED) + 1;
    let rest = (first..tuning::RESTARTS).step_by(2).map(|from| from..(from + 2).min(tuning::RESTARTS));
    std::iter::once(0..first).chain(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_left_out_only_where_the_score_stays_below_zero() {
        for score in [-6.0, -2.0, -0.3, 0.0, 1.5, 4.0] {
            let scored = Scored::new(Pair { a: 0, b: 1, opposite: true }, score);
            let (mut random, mut again) = (Random::new(7), Random::new(7));
            for _ in 0..20_000 {
                let direct = score + tuning::ANEW_NOISE * gumbel(again.unit());
                let told = scored.with_noise(&mut random);
                assert_eq!(told, (direct > 0.0).then_some(direct), "{score}");
            }
        }
    }

    #[test]
    fn every_restart_runs_once_and_in_order() {
        assert_eq!(at_once().flatten().collect::<Vec<_>>(), (0..tuning::RESTARTS).collect::<Vec<_>>());
    }
}
