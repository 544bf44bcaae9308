//! Scores of sewing one atom to another, each pair looked at alone.

use super::atoms::{Atom, Joint, Layout, Mark};
use super::mirror::{ALONE, Mirror};
use super::profile::{apart, mirrored, reversed};
use super::tuning::{self, PairWeights};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Two atoms that may be sewn to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// One atom.
    pub a: usize,
    /// The other one.
    pub b: usize,
    /// Does the start of one meet the end of the other, the usual case? Else start meets start, and one piece lies
    /// turned over on the other.
    pub opposite: bool,
}

/// Knowledge of a pair beside its geometry.
pub trait Prior {
    /// Added to the score of sewing two panels' atoms; both panels, and whether the middle may lie between.
    fn score(&self, layout: &Layout, pair: Pair, images: bool) -> f64;
}

/// Scores of all pairs of one garment under one map of mirror images.
pub struct Pairs {
    count: usize,
    score: [Vec<f64>; 2],
    /// Pairs that are worth trying, with `a < b`.
    pub candidates: Vec<Pair>,
}

impl Pairs {
    /// Scores all pairs.
    pub fn new(layout: &Layout, mirror: &Mirror, prior: &dyn Prior, weights: &PairWeights) -> Self {
        let n = layout.atoms.len();
        let judge = Judge::new(layout, mirror, weights);
        let mut score = [vec![f64::NEG_INFINITY; n * n], vec![f64::NEG_INFINITY; n * n]];
        for a in 0..n {
            for b in a + 1..n {
                for opposite in [true, false] {
                    let pair = Pair { a, b, opposite };
                    let value = judge.score(pair) + prior.score(layout, pair, is_middle(layout, mirror, pair));
                    score[usize::from(opposite)][a * n + b] = value;
                    score[usize::from(opposite)][b * n + a] = value;
                }
            }
        }
        let mut pairs = Self { count: n, score, candidates: Vec::new() };
        pairs.candidates = pairs.best();
        pairs
    }

    /// The score of a pair.
    pub fn score(&self, a: usize, b: usize, opposite: bool) -> f64 {
        self.score[usize::from(opposite)][a * self.count + b]
    }

    /// The best pairs of every atom.
    fn best(&self) -> Vec<Pair> {
        let mut chosen = Vec::new();
        for a in 0..self.count {
            let mut list: Vec<(f64, Pair)> = (0..self.count)
                .filter(|b| *b != a)
                .flat_map(|b| [true, false].map(|opposite| Pair { a: a.min(b), b: a.max(b), opposite }))
                .map(|p| (self.score(p.a, p.b, p.opposite), p))
                .filter(|(s, _)| *s > tuning::CANDIDATE_LEAST)
                .collect();
            list.sort_by(|x, y| y.0.total_cmp(&x.0).then((x.1.a, x.1.b).cmp(&(y.1.a, y.1.b))));
            chosen.extend(list.into_iter().take(tuning::CANDIDATES_OF_ATOM).map(|(_, p)| p));
        }
        chosen.sort_by_key(|p| (p.a, p.b, p.opposite));
        chosen.dedup();
        chosen
    }
}

/// Judges pairs.
pub struct Judge<'a> {
    layout: &'a Layout,
    mirror: &'a Mirror,
    weights: &'a PairWeights,
    /// For every atom how many others, its mirror images left out, are as long.
    rivals: Vec<f64>,
}

impl<'a> Judge<'a> {
    /// For one garment.
    pub fn new(layout: &'a Layout, mirror: &'a Mirror, weights: &'a PairWeights) -> Self {
        let rivals = (0..layout.atoms.len()).map(|a| rivals(layout, mirror, a)).collect();
        Self { layout, mirror, weights, rivals }
    }

    /// The score: the sum of the weights of what holds.
    pub fn score(&self, pair: Pair) -> f64 {
        self.length(pair) + self.course(pair) + self.grain(pair) + self.ends(pair) + self.sides(pair)
    }

    fn length(&self, p: Pair) -> f64 {
        let (w, a, b) = (self.weights, &self.layout.atoms[p.a], &self.layout.atoms[p.b]);
        let n = libm::log(a.length / b.length).abs();
        let mut sum = w.lengths.bias + w.lengths.ratio * n.min(1.2);
        sum += if n < 0.1 { w.lengths.within_tenth } else { 0.0 };
        sum += if n < 0.01 { w.lengths.within_hundredth } else { 0.0 };
        sum += if n < 0.003 { w.lengths.within_thousandth } else { 0.0 };
        let is_short = n > 0.1 && a.length.max(b.length) < tuning::GATHERED_LEAST;
        sum += if is_short || n > tuning::GATHER_MOST { tuning::TOO_GATHERED } else { 0.0 };
        let rivals = f64::max(self.rivals[p.a], self.rivals[p.b]).max(1.0);
        sum += if n < 0.01 { w.lengths.rare / rivals } else { 0.0 };
        if p.opposite { sum } else { sum + w.lengths.fold_over }
    }

    fn course(&self, p: Pair) -> f64 {
        let (w, a, b) = (self.weights, &self.layout.atoms[p.a], &self.layout.atoms[p.b]);
        let other = if p.opposite { reversed(&b.profile) } else { b.profile };
        let fit = apart(&a.profile, &other);
        let alike = apart(&a.profile, &mirrored(&b.profile));
        let unit = |off: f64| (off.to_degrees() / 20.0).min(2.0);
        let sum = w.courses.course_fit * unit(fit) + w.courses.course_alike * unit(fit.min(alike));
        sum + if a.straight != b.straight { w.courses.straight_to_curved } else { 0.0 }
    }

    fn grain(&self, p: Pair) -> f64 {
        let (w, a, b) = (self.weights, &self.layout.atoms[p.a], &self.layout.atoms[p.b]);
        let mut sum = 0.0;
        if a.is_along() && b.is_along() {
            let same = (a.along[0] > 0.0) == (b.along[0] > 0.0);
            sum += if same == p.opposite { w.courses.same_way } else { 0.0 };
        }
        sum += if a.is_low() && b.is_low() { w.courses.low_to_low } else { 0.0 };
        sum += if p.opposite && self.is_level_pair(p) { w.courses.level_to_level } else { 0.0 };
        let crossed = a.is_along() && b.is_across() || a.is_across() && b.is_along();
        sum + if crossed { w.courses.along_to_across } else { 0.0 }
    }

    /// Do both edges run over the middle of their pieces, nearer to the weft than to the warp, and both below or both
    /// above? Hems, necklines and waists do: a body has to pass between them.
    pub fn is_level_pair(&self, p: Pair) -> bool {
        let (a, b) = (&self.layout.atoms[p.a], &self.layout.atoms[p.b]);
        let is_level = |x: usize| self.on_axis(x) && self.layout.atoms[x].along[0].abs() < FRAC_1_SQRT_2;
        is_level(p.a) && is_level(p.b) && a.panel != b.panel && (a.along[1] < 0.0) == (b.along[1] < 0.0)
    }

    /// The joints that meet at both ends.
    fn meetings(&self, p: Pair) -> [[Joint; 2]; 2] {
        let (s, e) = (|a: usize| self.layout.atoms[a].joint, |a: usize| self.layout.end_joint(a));
        if p.opposite { [[s(p.a), e(p.b)], [e(p.a), s(p.b)]] } else { [[s(p.a), s(p.b)], [e(p.a), e(p.b)]] }
    }

    fn ends(&self, p: Pair) -> f64 {
        let w = self.weights;
        self.meetings(p)
            .iter()
            .map(|[x, y]| {
                let marks = match (x.mark, y.mark) {
                    (Mark::Dart, Mark::Dart) => w.ends.dart_dart,
                    (Mark::Dart, Mark::Notch) | (Mark::Notch, Mark::Dart) => w.ends.dart_notch,
                    (Mark::Dart, Mark::Corner) | (Mark::Corner, Mark::Dart) => w.ends.dart_corner,
                    (Mark::Corner, Mark::Corner) => w.ends.corner_corner,
                    (Mark::Notch, Mark::Notch) => w.ends.notch_notch,
                    _ => w.ends.corner_notch,
                };
                let near = |angle: f64| (x.angle + y.angle - angle).abs() < tuning::CORNER_SUM;
                let sum = if x.angle + y.angle > tuning::CORNER_SUM_MOST {
                    w.ends.sum_more
                } else if near(PI) {
                    w.ends.sum_180
                } else if near(1.5 * PI) {
                    w.ends.sum_270
                } else if near(2.0 * PI) {
                    w.ends.sum_360
                } else {
                    0.0
                };
                marks + sum
            })
            .sum()
    }

    /// Does an end of the atom lie on the axis of its piece?
    fn on_axis(&self, a: usize) -> bool {
        self.mirror.of(a).is_some_and(|m| {
            let atoms = &self.layout.atoms;
            m == a || atoms[a].next == m || atoms[a].before == m
        }) && self.mirror.panel[self.layout.atoms[a].panel] == self.layout.atoms[a].panel
    }

    /// Would two edges of one piece make a ring around nothing? They are short, lie apart, and the piece is no band.
    fn is_short_tube(&self, p: Pair) -> bool {
        let (a, b) = (&self.layout.atoms[p.a], &self.layout.atoms[p.b]);
        let panel = &self.layout.panels[a.panel];
        let is_short = a.length.max(b.length) < tuning::ACROSS_LEAST * panel.perimeter;
        is_short && panel.slenderness > tuning::BAND && a.next != p.b && a.before != p.b
    }

    fn sides(&self, p: Pair) -> f64 {
        let (w, a, b) = (self.weights, &self.layout.atoms[p.a], &self.layout.atoms[p.b]);
        let images = self.mirror.of(p.a) == Some(p.b);
        let other = self.mirror.panel[a.panel];
        let mut sum = 0.0;
        if a.panel == b.panel {
            sum += if images || is_tube(a, b) { w.mirrors.tube } else { w.mirrors.itself };
            sum += if self.is_short_tube(p) { w.mirrors.short_tube } else { 0.0 };
        } else if other == b.panel && other != ALONE && !images {
            sum += w.mirrors.left_to_right;
        }
        if images && a.panel != b.panel {
            sum += w.mirrors.images;
        }
        if images && !a.straight {
            sum += w.mirrors.images_curved;
        }
        if images && a.is_across() {
            sum += w.mirrors.images_across;
        }
        let (x, y) = (self.on_axis(p.a), self.on_axis(p.b));
        sum + match (x, y) {
            (true, true) => w.mirrors.axis_to_axis,
            (true, false) | (false, true) => w.mirrors.axis_to_none,
            (false, false) => 0.0,
        }
    }
}

/// Do two edges of one piece close it to a tube: as long as each other, along the warp, and running opposite ways?
fn is_tube(a: &Atom, b: &Atom) -> bool {
    let is_equal = libm::log(a.length / b.length).abs() < 0.01;
    is_equal && a.is_along() && b.is_along() && a.along[0] * b.along[0] < 0.0
}

/// May the middle of the garment lie between two atoms? They are mirror images, or neither piece has an image at all.
fn is_middle(layout: &Layout, mirror: &Mirror, pair: Pair) -> bool {
    let alone = |a: usize| mirror.panel[layout.atoms[a].panel] == ALONE;
    mirror.of(pair.a) == Some(pair.b) || (alone(pair.a) && alone(pair.b))
}

/// How many others are as long as an atom; mirror images count once.
fn rivals(layout: &Layout, mirror: &Mirror, a: usize) -> f64 {
    let length = layout.atoms[a].length;
    let is_own = |b: usize| b == a || mirror.of(a) == Some(b);
    let is_second = |b: usize| mirror.of(b).is_some_and(|m| m < b && !is_own(m));
    let close = |b: usize| libm::log(layout.atoms[b].length / length).abs() < 0.01;
    (0..layout.atoms.len()).filter(|b| !is_own(*b) && !is_second(*b) && close(*b)).count() as f64
}
