//! The way to a garment: a search over all pieces, or one without the sleeves, which are set in afterwards.

use super::assignment::Assignment;
use super::atoms::{Layout, Panel};
use super::buttons::button_fronts;
use super::confidence::margins;
use super::hems::Hems;
use super::knowledge::{Knowledge, Sleeves};
use super::known::{Decisions, Known};
use super::legs::Legs;
use super::likely::{Likely, likely_sleeves};
use super::mirror::{Mirror, maps};
use super::onward::onward;
use super::openings::{Closing, Sewn};
use super::pairs::{Judge, Pairs};
use super::propose::Names;
use super::seams::{ProposedSeam, seams};
use super::search::{Found, best};
use super::sleeves::{are_raglan, are_whole, raglan_sides, sleeves};
use super::tuning::{self, PairWeights, SleeveWeights, WholeWeights};
use super::whole::{SLEEVES, Whole};
use crate::roles::Upright;
use crate::roles::outline::turned;
use crate::sewing::shapes::Shapes;
use rayon::prelude::*;
use toile_garment::{Garment, Vec2};

/// A garment to be sewn.
#[derive(Clone)]
pub struct Task<'a> {
    /// The garment.
    pub garment: &'a Garment,
    /// Its sewn outlines.
    pub shapes: &'a Shapes,
    /// Its outlines, cut.
    pub layout: &'a Layout,
    /// Names of the pieces.
    pub names: &'a dyn Names,
    /// Decisions of a person.
    pub known: &'a Known,
    /// Pieces that are sewn later.
    pub later: Vec<usize>,
}

/// A sewn garment.
pub struct Made {
    /// Partners of atoms.
    pub assignment: Assignment,
    /// Their seams.
    pub seams: Vec<ProposedSeam>,
    /// Stretches that are sewn beside those: seams that go on, and sleeves that are set in as a whole.
    pub closings: Vec<Closing>,
}

/// The result of one search, with the scores it was found by.
struct Search {
    how: Sleeves,
    weights: WholeWeights,
    /// Mirror images and scores of pairs.
    scores: (Mirror, Pairs),
    found: Found,
}

impl Task<'_> {
    /// The best garment; `None` where nothing can be sewn. Sleeves that are one piece each, or whose caps are not sewn
    /// all round, are set in as a whole.
    pub fn made(&self, decisions: &Decisions) -> Option<Made> {
        let is_given = (0..self.layout.atoms.len()).any(|a| decisions.is_given(a));
        let sleeves = self.layout.panels.iter().filter(|p| self.names.is_sleeve(p.piece)).count();
        if is_given {
            return self.with_trunk();
        }
        if sleeves == 0 {
            return self.with_likely_sleeves();
        }
        let mut made = self.with_trunk()?;
        // Halves of sleeves may be gathered; marks of a sleeve that is one piece meet within its ease.
        let ease = if sleeves <= SLEEVES { SleeveWeights::default().whole_ease } else { f64::INFINITY };
        let are_closed = sleeves > SLEEVES || self.are_tubes(&made.assignment);
        if are_closed && are_whole(self.sewn(&made.assignment, &[]), self.names, ease) {
            return Some(made);
        }
        if sleeves <= SLEEVES && are_raglan(self.sewn(&made.assignment, &[]), self.names) {
            // A wrong assignment can look like a raglan. Then the caps fit the armholes of a trunk that is sewn alone.
            if let Some((set_in, _)) =
                self.set_in(Sleeves::Single).filter(|(_, likely)| *likely >= tuning::SURELY_SET_IN)
            {
                return Some(set_in);
            }
            let sides = raglan_sides(self.sewn(&made.assignment, &[]), self.names);
            let is_new = |c: &Closing| !c.a.iter().chain(&c.b).any(|a| made.closings.iter().any(|old| old.has(*a)));
            let sides: Vec<Closing> = sides.into_iter().filter(is_new).collect();
            made.closings.extend(sides);
            return Some(made);
        }
        if sleeves <= SLEEVES {
            return self.set_in(Sleeves::Single).map(|(set_in, _)| set_in).or(Some(made));
        }
        let set_in = self.set_in(Sleeves::Single).or_else(|| self.set_in(Sleeves::Halves));
        set_in.map(|(set_in, _)| set_in).or(Some(made))
    }

    /// A garment without a named sleeve. Where the shapes of two pieces allow that they are its sleeves, and they fit the
    /// armholes of the others, they are.
    fn with_likely_sleeves(&self) -> Option<Made> {
        let plain = self.with_trunk()?;
        let ease = SleeveWeights::default().whole_ease;
        for pair in likely_sleeves(self.layout, self.names) {
            let names = Likely::with_sleeves(self.names, pair);
            let task = Task { names: &names, ..self.clone() };
            if task.are_tubes(&plain.assignment) && are_whole(task.sewn(&plain.assignment, &[]), &names, ease) {
                return Some(plain);
            }
            if let Some((set_in, _)) =
                task.set_in(Sleeves::Single).filter(|(_, likely)| *likely >= tuning::SURELY_SET_IN)
            {
                return Some(set_in);
            }
        }
        Some(plain)
    }

    fn sewn<'b>(&'b self, of: &'b Assignment, closed: &'b [Closing]) -> Sewn<'b> {
        Sewn { layout: self.layout, of, closed }
    }

    /// Stretches by which the seams of an assignment go on.
    fn onward(&self, of: &Assignment) -> Vec<Closing> {
        let decisions = Decisions::new(self.layout, self.known);
        onward(self.sewn(of, &[]), |a| decisions.is_given(a))
    }

    /// Is every sleeve sewn to itself?
    fn are_tubes(&self, of: &Assignment) -> bool {
        let is_tube = |p: &Panel| p.atoms.clone().any(|a| of.partner(a).is_some_and(|b| p.atoms.contains(&b)));
        self.layout.panels.iter().filter(|p| self.names.is_sleeve(p.piece)).all(is_tube)
    }

    /// A garment whose sleeves are sewn like all other pieces.
    fn with_trunk(&self) -> Option<Made> {
        let search = self.search(WholeWeights::default(), Sleeves::WithTrunk, 1.0)?;
        let (assignment, seams) = self.seams(search);
        let closings = self.onward(&assignment);
        Some(Made { assignment, seams, closings })
    }

    /// A garment whose sleeves are set in as a whole, and how likely that of the less sure one is right; `None` where not
    /// both find an armhole.
    fn set_in(&self, how: Sleeves) -> Option<(Made, f64)> {
        let up = self.up();
        let set_in = |of: &Assignment| {
            let mut closings = self.onward(of);
            let set_in = sleeves(self.sewn(of, &closings), self.names, &up, how == Sleeves::Single);
            let likely = set_in.seams.iter().map(|c| c.confidence).fold(1.0, f64::min);
            closings.extend(set_in.seams);
            (set_in.count == SLEEVES).then_some((closings, likely))
        };
        // A search takes the square of the number of atoms.
        let is_large = self.layout.atoms.len() > tuning::MANY_ATOMS;
        let effort = if is_large { tuning::SHORT } else { 1.0 };
        let tries = [WholeWeights::default(), WholeWeights::open_marks()];
        for weights in tries.into_iter().take(if is_large { 1 } else { 2 }) {
            let search = self.search(weights, how, effort)?;
            if set_in(&search.found.assignment).is_none() {
                continue;
            }
            // How sure the seams are takes much longer to find. It may find better ones.
            let (assignment, seams) = self.seams(search);
            if let Some((closings, likely)) = set_in(&assignment) {
                return Some((Made { assignment, seams, closings }, likely));
            }
        }
        None
    }

    /// Tells which way is up on a piece, as a unit vector.
    fn up(&self) -> impl Fn(usize) -> Vec2 {
        let turns = Upright::of(&self.garment.pieces, &[]).turns;
        move |piece| turned(Vec2::y(), -turns[piece])
    }

    fn search(&self, weights: WholeWeights, how: Sleeves, effort: f64) -> Option<Search> {
        let (layout, names) = (self.layout, self.names);
        let decisions = Decisions::new(layout, self.known);
        let legs = Legs::new(layout, names, &self.up());
        let hems = Hems::new(layout, names, &self.later, &self.up());
        let hems = hems.with_buttons(layout, &button_fronts(self.garment));
        let sleeve = SleeveWeights::default();
        let knowledge = Knowledge { names, decisions, legs, hems, how, later: &self.later, sleeve };
        let mut scores = scores(layout, &knowledge);
        let wholes: Vec<Whole<'_>> = scores.iter().map(|scores| self.whole(scores, &weights, how)).collect();
        let (map, found) = search_all(layout, &wholes, effort)?;
        Some(Search { how, scores: scores.swap_remove(map), weights, found })
    }

    fn whole<'b>(&'b self, scores: &'b (Mirror, Pairs), weights: &'b WholeWeights, how: Sleeves) -> Whole<'b> {
        let is_apart = |p: &Panel| how == Sleeves::Halves && self.names.is_sleeve(p.piece);
        let apart = self.layout.panels.iter().map(is_apart).collect();
        Whole::new(self.layout, &scores.0, &scores.1, weights).with_apart(apart)
    }

    /// The seams of what was found, each with how sure it is.
    fn seams(&self, mut search: Search) -> (Assignment, Vec<ProposedSeam>) {
        let whole = self.whole(&search.scores, &search.weights, search.how);
        let mut margins = margins(self.layout, &whole, &mut search.found);
        let weights = PairWeights::default();
        let judge = Judge::new(self.layout, &search.scores.0, &weights);
        // The garment may need a seam that its two edges speak against. Then another one is missing.
        for m in &mut margins {
            let own = search.scores.1.score(m.pair.a, m.pair.b, m.pair.opposite);
            let is_unlikely = own < tuning::UNLIKELY_PAIR;
            m.most = if judge.is_level_pair(m.pair) {
                tuning::LEVEL_MOST
            } else if is_unlikely {
                tuning::UNLIKELY_MOST
            } else {
                1.0
            };
        }
        (search.found.assignment, seams(self.garment, self.shapes, self.layout, &margins))
    }
}

/// The maps of mirror images, and the scores of pairs under each.
fn scores(layout: &Layout, knowledge: &Knowledge<'_>) -> Vec<(Mirror, Pairs)> {
    let piece = |panel: usize| layout.panels[panel].piece;
    let maps = maps(layout, &|p, q| knowledge.names.are_namesakes(piece(p), piece(q)));
    let weights = PairWeights::default();
    let scored = |mirror: Mirror| {
        let pairs = Pairs::new(layout, &mirror, knowledge, &weights);
        (mirror, pairs)
    };
    maps.into_iter().map(scored).collect()
}

/// A short search on every map, a long one on the best: the number of the map, and what was found on it.
fn search_all(layout: &Layout, wholes: &[Whole<'_>], effort: f64) -> Option<(usize, Found)> {
    let first = if wholes.len() > 1 { tuning::SHORT * effort } else { effort };
    let short = |whole| best(layout, whole, first);
    let mut tried: Vec<(usize, Found)> = wholes.par_iter().map(short).enumerate().collect();
    tried.sort_by(|a, b| b.1.score.total().total_cmp(&a.1.score.total()));
    tried.truncate(tuning::LONG_TRIES);
    let mut chosen: Option<(usize, Found)> = None;
    let long = |(map, short): (usize, Found)| (map, short, best(layout, &wholes[map], effort));
    let tried: Vec<(usize, Found, Found)> = tried.into_par_iter().map(long).collect();
    for (map, short, long) in tried {
        let found = if long.score.total() >= short.score.total() { long } else { short };
        if chosen.as_ref().is_none_or(|(_, c)| found.score.total() > c.score.total()) {
            chosen = Some((map, found));
        }
    }
    chosen
}
