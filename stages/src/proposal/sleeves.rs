//! Sleeves sewn as a whole: the edge of the cap around the edge of the armhole.
//!
//! The search sews stretches between marks to each other. Where a cap or an armhole lacks marks, that leaves parts of
//! both open. Here the trunk and the sleeves are sewn each for themselves, and both openings are known whole. The
//! heights along them tell how they meet: the underarm is the lowest place of both, the shoulder the highest.

use super::assignment::Assignment;
use super::atoms::{Layout, Panel};
use super::openings::{Closing, Sewn};
use super::propose::Names;
use super::tuning::{self, SleeveWeights};
use super::whole::{find, join};
use std::f64::consts::PI;
use toile_garment::Vec2;

/// Stations at which the heights of two openings are compared.
const STATIONS: usize = 64;

/// Cosine of the angle up to which a direction is nearly that of the grain.
const NEARLY_ALONG: f64 = 0.9;

/// An opening with its heights.
struct Opening {
    /// Its atoms, in order.
    atoms: Vec<usize>,
    /// Where each atom starts, as a share of the length.
    starts: Vec<f64>,
    /// Heights at shares of the length: points (share, height in metres).
    heights: Vec<[f64; 2]>,
    /// Length, metres.
    length: f64,
    /// For every atom: does a seam end at its start?
    is_seam: Vec<bool>,
    /// Groups of notches, in order.
    notches: Vec<Notches>,
}

/// Notches that stand close together count as one mark: a double notch, for example, tells the back.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Notches {
    /// Their middle, as a share of the length.
    at: f64,
    /// How many they are.
    count: usize,
}

/// Sleeves that are set into armholes.
#[derive(Clone, Debug, Default)]
pub struct SetIn {
    /// Their seams.
    pub seams: Vec<Closing>,
    /// Number of sleeves.
    pub count: usize,
}

/// How a sleeve meets an armhole.
struct Fit {
    sleeve: usize,
    armhole: usize,
    /// Numbers of the atoms at whose starts both begin.
    begin: [usize; 2],
    cost: f64,
}

/// Are all sleeves sewn to the trunk without a gap in the edge of the cap, and no stretch eased by more than `ease`: the
/// logarithm of the ratio of the lengths?
pub fn are_whole(sewn: Sewn<'_>, names: &dyn Names, ease: f64) -> bool {
    let atoms = || 0..sewn.layout.atoms.len();
    let is_between = |a: usize| {
        sewn.of.partner(a).is_some_and(|b| {
            let pieces = [sewn.piece(a), sewn.piece(b)];
            let ratio = libm::log(sewn.length(&[a]) / sewn.length(&[b])).abs();
            ratio < ease && (names.is_sleeve_of(pieces[0], pieces[1]) || names.is_sleeve_of(pieces[1], pieces[0]))
        })
    };
    let mut apart = sewn.of.clone();
    atoms().filter(|a| is_between(*a)).for_each(|a| apart = apart.without(a..a + 1));
    let openings = Sewn { of: &apart, ..sewn }.openings();
    let is_whole = |panel: &std::ops::Range<usize>| {
        let has = |o: &&Vec<usize>| o.iter().any(|a| panel.contains(a));
        openings.iter().filter(has).any(|o| o.iter().all(|a| is_between(*a)))
    };
    let is_sleeve = |p: usize| names.is_sleeve(sewn.layout.panels[p].piece);
    (0..sewn.layout.panels.len()).filter(|p| is_sleeve(*p)).all(|p| is_whole(&sewn.layout.panels[p].atoms))
}

/// Do the sleeves reach up to the neckline? Then an opening of sleeves and trunk has a left and a right sleeve, where
/// what is set on the trunk besides is taken off.
pub fn are_raglan(sewn: Sewn<'_>, names: &dyn Names) -> bool {
    let layout = sewn.layout;
    let pieces: Vec<usize> = layout.panels.iter().map(|p| p.piece).collect();
    let is_trunk = |p: usize| pieces.iter().any(|s| names.is_sleeve_of(*s, p));
    let stays = |p: usize| names.is_sleeve(p) || is_trunk(p);
    let taken_off = layout.panels.iter().filter(|p| !stays(p.piece)).flat_map(|p| p.atoms.clone());
    let mut bare = sewn.of.clone();
    taken_off.for_each(|a| bare = bare.without(a..a + 1));
    let sewn = Sewn { of: &bare, ..sewn };
    let is_neck = |opening: &Vec<usize>| {
        let own: Vec<usize> = opening.iter().map(|a| sewn.piece(*a)).filter(|p| names.is_sleeve(*p)).collect();
        own.iter().any(|p| *p != own[0]) && opening.iter().any(|a| is_trunk(sewn.piece(*a)))
    };
    sewn.openings().iter().any(is_neck)
}

/// The seams that close raglan sleeves to tubes where the search left both sides open, because one of them has a mark.
/// A side goes from the underarm up to the next corner.
pub fn raglan_sides(sewn: Sewn<'_>, names: &dyn Names) -> Vec<Closing> {
    let is_tube = |p: &&Panel| p.atoms.clone().any(|a| sewn.of.partner(a).is_some_and(|b| p.atoms.contains(&b)));
    let open = sewn.layout.panels.iter().filter(|p| names.is_sleeve(p.piece)).filter(|p| !is_tube(p));
    open.filter_map(|p| raglan_side(sewn, p)).collect()
}

fn raglan_side(sewn: Sewn<'_>, panel: &Panel) -> Option<Closing> {
    let atoms = &sewn.layout.atoms;
    let is_free = |a: &usize| sewn.of.partner(*a).is_none();
    let is_start = |a: &usize| is_free(a) && !is_free(&atoms[*a].before);
    let stretch = |first: usize| {
        let next = |a: &usize| Some(atoms[*a].next).filter(|b| *b != first);
        std::iter::successors(Some(first), next).take_while(is_free).collect::<Vec<usize>>()
    };
    // The neckline is the shorter stretch that is free.
    let length = |s: &Vec<usize>| sewn.length(s);
    let lower = panel.atoms.clone().filter(is_start).map(stretch).max_by(|s, t| length(s).total_cmp(&length(t)))?;
    let is_corner = |a: usize| (atoms[a].joint.angle - PI).abs() > tuning::CLEAR_CORNER;
    let corners: Vec<usize> = (1..lower.len()).filter(|k| is_corner(lower[*k])).collect();
    let (first, last) = (*corners.first()?, *corners.last()?);
    let (a, b) = (lower[..first].to_vec(), lower[last..].iter().rev().copied().collect::<Vec<usize>>());
    let weights = SleeveWeights::default();
    let ratio = libm::log(length(&a) / length(&b)).abs();
    let is_side = first < last && ratio < weights.sides && length(&a).min(length(&b)) > weights.side_least;
    is_side.then_some(Closing { a, b, lead: 0.0, confidence: weights.confidence })
}

/// The seams of the sleeves of a garment whose trunk and sleeves are sewn each for themselves. `up` tells which way is
/// up on a piece of the trunk.
///
/// With `are_single`, every sleeve is a piece of its own, and the first fitting one is set in with its namesake. Other
/// sleeves are alternatives.
pub fn sleeves(sewn: Sewn<'_>, names: &dyn Names, up: &dyn Fn(usize) -> Vec2, are_single: bool) -> SetIn {
    let weights = SleeveWeights::default();
    let all = sewn.openings();
    let on = |o: &[usize], holds: &dyn Fn(usize) -> bool| o.iter().all(|a| holds(sewn.piece(*a)));
    let layout = sewn.layout;
    let is_under = |p: usize| layout.panels.iter().any(|s| names.is_sleeve_of(s.piece, p));
    let is_half = |p: usize| names.is_sleeve(p) && !are_single;
    let upright = |panel: usize, _: &[usize]| along(layout.panels[panel].warp, up(layout.panels[panel].piece));
    let armholes: Vec<Opening> =
        all.iter().filter(|o| on(o, &is_under)).map(|o| Opening::new(sewn, o, &upright)).collect();
    let parts = parts(sewn);
    let part = |atom: usize| parts[layout.atoms[atom].panel];
    let halves = all.iter().filter(|o| on(o, &is_half)).map(|o| Sleeve::sewn(sewn, o, part(o[0])));
    let singles = layout.panels.iter().filter(|p| names.is_sleeve(p.piece) && are_single);
    let singles = singles.flat_map(|p| Sleeve::shapes(sewn, p, part(p.atoms.start), &weights));
    let sleeves: Vec<Sleeve> = halves.chain(singles).collect();
    let fits = fits(sewn, names, &sleeves, &armholes, &weights);
    let piece = |s: &Sleeve| sewn.piece(s.cap.atoms[0]);
    let all_single: Vec<usize> = layout.panels.iter().map(|p| p.piece).filter(|p| names.is_sleeve(*p)).collect();
    let has_namesake = |p: usize| all_single.iter().any(|q| names.are_namesakes(p, *q));
    let is_other = |first: &Sleeve, second: &Sleeve| {
        let (p, q) = (piece(first), piece(second));
        names.are_namesakes(p, q) || !has_namesake(p) && !has_namesake(q)
    };
    let (mut out, mut taken): (SetIn, Vec<&Fit>) = (SetIn::default(), Vec::new());
    for fit in &fits {
        let sleeve = &sleeves[fit.sleeve];
        if are_single && taken.first().is_some_and(|t| !is_other(&sleeves[t.sleeve], sleeve)) {
            continue;
        }
        if taken.iter().any(|t| t.armhole == fit.armhole || sleeves[t.sleeve].part == sleeve.part) {
            continue;
        }
        let confidence = weights.confidence(fit.cost);
        out.seams.extend(sewn_on(&sleeve.cap, &armholes[fit.armhole], fit.begin, &weights, confidence));
        out.seams.extend(sleeve.closed(confidence));
        out.count += 1;
        taken.push(fit);
    }
    out
}

/// How sleeves meet armholes, the best fit first.
fn fits(
    sewn: Sewn<'_>,
    names: &dyn Names,
    sleeves: &[Sleeve],
    armholes: &[Opening],
    weights: &SleeveWeights,
) -> Vec<Fit> {
    let mut fits: Vec<Fit> = Vec::new();
    for (number, sleeve) in sleeves.iter().enumerate() {
        for (armhole, other) in armholes.iter().enumerate() {
            let fit = |(begin, cost): ([usize; 2], f64)| {
                let pieces =
                    other.pieces(sewn, begin[0], false).into_iter().zip(sleeve.cap.pieces(sewn, begin[1], true));
                let names: f64 = pieces.map(|(p, q)| names.seam(p, q, false, other.length)).sum();
                let cost = cost + sleeve.cost - weights.names * names / STATIONS as f64;
                Fit { sleeve: number, armhole, begin, cost }
            };
            fits.extend(best_fit(&sleeve.cap, other, weights).map(fit));
        }
    }
    fits.sort_by(|x, y| x.cost.total_cmp(&y.cost).then((x.sleeve, x.armhole).cmp(&(y.sleeve, y.armhole))));
    fits
}

/// A sleeve: its cap, and its sides where they are not sewn yet.
struct Sleeve {
    cap: Opening,
    /// The sides of a sleeve of one piece, each walked forward.
    sides: Option<[Vec<usize>; 2]>,
    /// Number of the part of the garment that it is.
    part: u32,
    /// Cost of its shape.
    cost: f64,
}

/// Can the outline of a piece be parted into the edges of a sleeve, with a cap that is curved?
pub fn has_shape(layout: &Layout, panel: &Panel) -> bool {
    let weights = SleeveWeights::default();
    let of = Assignment::empty(layout.atoms.len());
    let shapes = Sleeve::shapes(Sewn { layout, of: &of, closed: &[] }, panel, 0, &weights);
    shapes.iter().any(|s| s.cap.is_curved(&weights))
}

impl Sleeve {
    /// A sleeve whose sides are sewn. The cap is one of its openings.
    fn sewn(sewn: Sewn<'_>, cap: &[usize], part: u32) -> Self {
        let up = |panel: usize, cap: &[usize]| to_cap(sewn.layout, panel, cap);
        Self { cap: Opening::new(sewn, cap, &up), sides: None, part, cost: 0.0 }
    }

    /// All likely ways to part the outline of one piece at four corners into cap, side, hem and side.
    fn shapes(sewn: Sewn<'_>, panel: &Panel, part: u32, weights: &SleeveWeights) -> Vec<Self> {
        let layout = sewn.layout;
        let atoms: Vec<usize> = panel.atoms.clone().collect();
        let n = atoms.len();
        let is_corner = |k: &usize| (layout.atoms[atoms[*k]].joint.angle - PI).abs() > tuning::CLEAR_CORNER;
        let corners: Vec<usize> = (0..n).filter(is_corner).collect();
        let run = |from: usize, to: usize| {
            let count = (to + n - from - 1) % n + 1;
            (0..count).map(|k| atoms[(from + k) % n]).collect::<Vec<usize>>()
        };
        let mut out = Vec::new();
        for four in fours(&corners) {
            let [cap, side, hem, other] = [0, 1, 2, 3].map(|k| run(four[k], four[(k + 1) % 4]));
            let uneven = libm::log(sewn.length(&side) / sewn.length(&other)).abs();
            if uneven > weights.sides || sewn.length(&side) < weights.side_least {
                continue;
            }
            let ends = [hem[0], hem[hem.len() - 1]].map(|a| &layout.atoms[a].points);
            let chord = (ends[1][ends[1].len() - 1] - ends[0][0]).norm();
            let bent = 1.0 - chord / sewn.length(&hem);
            let cost = weights.sides_uneven * uneven * uneven + weights.hem_bent * bent;
            let cap = Self::sewn(sewn, &cap, part).cap;
            out.push(Self { cap, sides: Some([side, other]), part, cost });
        }
        out
    }

    /// The seam of its sides.
    fn closed(&self, confidence: f64) -> Option<Closing> {
        let [a, b] = self.sides.clone()?;
        Some(Closing { a, b: b.into_iter().rev().collect(), lead: 0.0, confidence })
    }
}

/// All choices of four numbers out of a list, in its cyclic order, from each of them on.
fn fours(list: &[usize]) -> Vec<[usize; 4]> {
    let n = list.len();
    let mut out = Vec::new();
    for a in 0..n {
        for b in a + 1..n {
            for c in b + 1..n {
                for d in c + 1..n {
                    let four = [list[a], list[b], list[c], list[d]];
                    out.extend((0..4).map(|k| [four[k], four[(k + 1) % 4], four[(k + 2) % 4], four[(k + 3) % 4]]));
                }
            }
        }
    }
    out
}

/// For every panel the number of the part of the garment that it belongs to.
fn parts(sewn: Sewn<'_>) -> Vec<u32> {
    let panels = sewn.layout.panels.len() as u32;
    let mut parent: Vec<u32> = (0..panels).collect();
    for pair in sewn.of.pairs() {
        let [p, q] = [pair.a, pair.b].map(|a| sewn.layout.atoms[a].panel as u32);
        join(&mut parent, p, q);
    }
    (0..panels).map(|panel| find(&mut parent, panel)).collect()
}

/// A direction or its opposite, whichever runs along another one.
fn along(direction: Vec2, other: Vec2) -> Vec2 {
    if direction.dot(&other) < 0.0 { -direction } else { direction }
}

/// Up on a sleeve, a unit vector: from the middle of the panel to its part of the cap, along the grain where that is
/// nearly so.
fn to_cap(layout: &Layout, panel: usize, cap: &[usize]) -> Vec2 {
    let own = |a: &usize| layout.atoms[*a].panel == panel;
    let middle = |atoms: &[usize]| {
        let points: Vec<Vec2> = atoms.iter().flat_map(|a| layout.atoms[*a].points.iter().copied()).collect();
        points.iter().sum::<Vec2>() / points.len().max(1) as f64
    };
    let all: Vec<usize> = layout.panels[panel].atoms.clone().collect();
    let upper: Vec<usize> = cap.iter().copied().filter(own).collect();
    let up = (middle(&upper) - middle(&all)).try_normalize(1e-9).unwrap_or(layout.panels[panel].warp);
    let grain = along(layout.panels[panel].warp, up);
    if grain.dot(&up) > NEARLY_ALONG { grain } else { up }
}

impl Opening {
    /// Does it rise by enough of its length?
    fn is_curved(&self, weights: &SleeveWeights) -> bool {
        self.range()[1] - self.range()[0] > weights.least_height * self.length
    }

    /// Measures an opening. `up` gives the upward direction on a panel.
    fn new(sewn: Sewn<'_>, atoms: &[usize], up: &dyn Fn(usize, &[usize]) -> Vec2) -> Self {
        let length = sewn.length(atoms);
        let n = atoms.len();
        let (mut at, mut height) = (0.0, 0.0);
        let (mut starts, mut heights) = (Vec::new(), vec![[0.0, 0.0]]);
        for a in atoms {
            let atom = &sewn.layout.atoms[*a];
            let up = up(atom.panel, atoms);
            starts.push(at / length);
            for step in atom.steps() {
                at += step.norm();
                height += step.dot(&up);
                heights.push([at / length, height]);
            }
        }
        // The way round ends at the height where it began.
        heights.iter_mut().for_each(|[share, h]| *h -= *share * height);
        let is_seam = (0..n).map(|k| sewn.layout.atoms[atoms[(k + n - 1) % n]].next != atoms[k]).collect();
        let notched = (0..n).filter(|k| sewn.layout.atoms[atoms[*k]].joint.is_notched).map(|k| starts[k]);
        let notches = groups(&notched.collect::<Vec<f64>>(), tuning::NOTCH_GROUP / length);
        Self { atoms: atoms.to_vec(), starts, heights, length, is_seam, notches }
    }

    /// Its lowest and highest height, metres.
    fn range(&self) -> [f64; 2] {
        let far = [f64::INFINITY, f64::NEG_INFINITY];
        self.heights.iter().fold(far, |[low, high], [_, h]| [low.min(*h), high.max(*h)])
    }

    /// Even shares of the length from the start of an atom on, walked backward or forward.
    fn stations(&self, from: usize, is_backward: bool) -> impl Iterator<Item = f64> {
        let start = self.starts[from];
        (0..STATIONS).map(move |k| {
            let way = (k as f64 + 0.5) / STATIONS as f64;
            let share = start + if is_backward { 1.0 - way } else { way };
            share - share.floor()
        })
    }

    /// The pieces at the stations.
    fn pieces(&self, sewn: Sewn<'_>, from: usize, is_backward: bool) -> Vec<usize> {
        let at = |share: f64| self.starts.partition_point(|s| *s <= share).max(1) - 1;
        self.stations(from, is_backward).map(|share| sewn.piece(self.atoms[at(share)])).collect()
    }

    /// Heights over the range, 0 to 1, at the stations.
    fn course(&self, from: usize, is_backward: bool) -> Vec<f64> {
        let [low, high] = self.range();
        let at = |share: f64| {
            let after = self.heights.partition_point(|[s, _]| *s < share).clamp(1, self.heights.len() - 1);
            let ([s0, h0], [s1, h1]) = (self.heights[after - 1], self.heights[after]);
            let h = h0 + (h1 - h0) * (share - s0) / (s1 - s0).max(1e-12);
            (h - low) / (high - low).max(1e-9)
        };
        self.stations(from, is_backward).map(at).collect()
    }

    /// Shares of its length from the start of an atom to the starts of the others in walking order.
    fn marks(&self, from: usize, is_backward: bool) -> Vec<f64> {
        let n = self.atoms.len();
        let share = |k: usize| {
            let to = if is_backward { (from + n - k) % n } else { (from + k) % n };
            let way = self.starts[to] - self.starts[from];
            let way = if is_backward { -way } else { way };
            way - way.floor()
        };
        (1..n).map(share).collect()
    }
}

/// Notches at shares of a length that rise, in groups whose members stand no further apart than `reach`.
fn groups(shares: &[f64], reach: f64) -> Vec<Notches> {
    let middle = |group: &[f64]| Notches { at: (group[0] + group[group.len() - 1]) / 2.0, count: group.len() };
    shares.chunk_by(|a, b| b - a < reach).map(middle).collect()
}

/// The share of the notches of both sides that meet none of the other side, if the sides begin at these atoms. Notches
/// meet where they are as many. A single notch may also meet the end of a seam, such as a shoulder.
fn unmet_notches(cap: &Opening, armhole: &Opening, begin: [usize; 2], reach: f64) -> f64 {
    let [i, j] = begin;
    let on_armhole = |share: f64| (share - armhole.starts[i]).rem_euclid(1.0);
    let on_cap = |share: f64| (cap.starts[j] - share).rem_euclid(1.0);
    let marks = |o: &Opening, way: &dyn Fn(f64) -> f64| -> Vec<Notches> {
        let seams = o.is_seam.iter().zip(&o.starts).filter(|(is_seam, _)| **is_seam);
        let seams = seams.map(|(_, start)| Notches { at: way(*start), count: 0 });
        o.notches.iter().map(|m| Notches { at: way(m.at), ..*m }).chain(seams).collect()
    };
    let sides = [marks(armhole, &on_armhole), marks(cap, &on_cap)];
    let is_met = |m: &Notches, others: &[Notches]| {
        others.iter().any(|o| {
            let apart = (m.at - o.at).abs();
            let is_alike = m.count == o.count || m.count == 1 && o.count == 0;
            is_alike && apart.min(1.0 - apart) * armhole.length < reach
        })
    };
    let unmet = |own: &[Notches], others: &[Notches]| -> [usize; 2] {
        let notches = own.iter().filter(|m| m.count > 0);
        [notches.clone().filter(|m| !is_met(m, others)).count(), notches.count()]
    };
    let [a, b] = [unmet(&sides[0], &sides[1]), unmet(&sides[1], &sides[0])];
    (a[0] + b[0]) as f64 / (a[1] + b[1]).max(1) as f64
}

/// The beginning at which a cap fits an armhole best, and its cost.
fn best_fit(cap: &Opening, armhole: &Opening, weights: &SleeveWeights) -> Option<([usize; 2], f64)> {
    let ratio = cap.length / armhole.length;
    if !weights.ratio.contains(&ratio) || !cap.is_curved(weights) || !armhole.is_curved(weights) {
        return None;
    }
    let ease = weights.ease * libm::log(ratio) * libm::log(ratio);
    let starts = |o: &Opening| 0..o.atoms.len();
    let caps: Vec<Vec<f64>> = starts(cap).map(|j| cap.course(j, true)).collect();
    let mut best: Option<([usize; 2], f64)> = None;
    for i in starts(armhole) {
        let course = armhole.course(i, false);
        for (j, other) in caps.iter().enumerate() {
            let square: f64 = course.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum();
            let beside = [armhole.is_seam[i], cap.is_seam[j]].iter().filter(|is_seam| !**is_seam).count() as f64;
            let shape = square / STATIONS as f64 + weights.start_beside_seam * beside + ease;
            let unmet = unmet_notches(cap, armhole, [i, j], weights.marks_meet);
            let cost = shape + weights.notches_unmet * unmet;
            if shape < weights.most && best.is_none_or(|(_, b)| cost < b) {
                best = Some(([i, j], cost));
            }
        }
    }
    best
}

/// The seams of a cap on an armhole, parted where marks of both meet.
fn sewn_on(
    cap: &Opening,
    armhole: &Opening,
    begin: [usize; 2],
    weights: &SleeveWeights,
    confidence: f64,
) -> Vec<Closing> {
    let [i, j] = begin;
    let (n, m) = (armhole.atoms.len(), cap.atoms.len());
    let around: Vec<usize> = (0..n).map(|k| armhole.atoms[(i + k) % n]).collect();
    let back: Vec<usize> = (0..m).map(|k| cap.atoms[(j + m - 1 - k) % m]).collect();
    let (of_armhole, of_cap) = (armhole.marks(i, false), cap.marks(j, true));
    let nearest =
        |s: f64, list: &[f64]| (0..list.len()).min_by(|x, y| (list[*x] - s).abs().total_cmp(&(list[*y] - s).abs()));
    let meets = |k: usize| {
        let other = nearest(of_armhole[k], &of_cap)?;
        let is_near = (of_armhole[k] - of_cap[other]).abs() * armhole.length < weights.marks_meet;
        (is_near && nearest(of_cap[other], &of_armhole) == Some(k)).then_some([k + 1, other + 1])
    };
    // Stretches between marks are no shorter than allowed.
    let mut cuts: Vec<[usize; 2]> = vec![[0, 0]];
    let way = |k: usize| if k == 0 { 0.0 } else { of_armhole[k - 1] * armhole.length };
    for cut in (0..of_armhole.len()).filter_map(meets) {
        let last = cuts.last().map_or(0, |c| c[0]);
        if way(cut[0]) - way(last) > weights.stretch_least && armhole.length - way(cut[0]) > weights.stretch_least {
            cuts.push(cut);
        }
    }
    cuts.push([n, m]);
    let closing = |w: &[[usize; 2]]| {
        let (a, b) = (around[w[0][0]..w[1][0]].to_vec(), back[w[0][1]..w[1][1]].to_vec());
        Closing { a, b, lead: 0.0, confidence }
    };
    cuts.windows(2).map(closing).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An opening of 0.5 m in one stretch, with notches at shares of it.
    fn opening(notches: &[(f64, usize)]) -> Opening {
        let notches = notches.iter().map(|(at, count)| Notches { at: *at, count: *count }).collect();
        Opening { atoms: vec![0], starts: vec![0.0], heights: Vec::new(), length: 0.5, is_seam: vec![true], notches }
    }

    #[test]
    fn double_notches_tell_front_from_back() {
        // A cap is walked backward: what lies at 0.8 of it comes after a fifth of the way.
        let armhole = opening(&[(0.2, 2), (0.7, 1)]);
        let (right, exchanged) = (opening(&[(0.3, 1), (0.8, 2)]), opening(&[(0.3, 2), (0.8, 1)]));
        let unmet = |cap: &Opening| unmet_notches(cap, &armhole, [0, 0], 8e-3);
        assert!(unmet(&right) == 0.0 && unmet(&exchanged) == 1.0);
        // Where one side has no notches, nothing speaks for a beginning.
        assert!(unmet(&opening(&[])) == 1.0 && unmet_notches(&opening(&[]), &opening(&[]), [0, 0], 8e-3) == 0.0);
    }

    #[test]
    fn notches_in_a_row_are_one_group() {
        let found = groups(&[0.1, 0.12, 0.5, 0.9, 0.91, 0.92], 0.03);
        assert_eq!(found.iter().map(|g| g.count).collect::<Vec<_>>(), [2, 1, 3]);
        assert!((found[0].at - 0.11).abs() < 1e-12 && (found[2].at - 0.91).abs() < 1e-12);
    }
}
