//! Scores of whole garments: pairs, the corners that meet, and the surface that comes out.

use super::assignment::Assignment;
use super::atoms::{Atom, Layout, Mark};
use super::mirror::{ALONE, Mirror};
use super::pairs::Pairs;
use super::tuning::WholeWeights;

/// Sleeves of a garment.
pub const SLEEVES: usize = 2;

const NONE: u32 = u32::MAX;

/// The score of an assignment.
#[derive(Clone, Copy, Debug, Default)]
pub struct Score {
    /// Pairs, corners, sides.
    pub soft: f64,
    /// Parts, handles, openings.
    pub hard: f64,
}

impl Score {
    /// Both together, the surface counted by a share of its weight.
    pub fn with(self, share: f64) -> f64 {
        self.soft + share * self.hard
    }

    /// Both together.
    pub fn total(self) -> f64 {
        self.soft + self.hard
    }
}

/// The properties of an atom that the score of a garment reads. They lie close together in memory.
struct Stretch {
    next: u32,
    before: u32,
    panel: u32,
    /// The mark and the angle at its start.
    mark: Mark,
    angle: f64,
    /// Length, metres, and its logarithm.
    length: f64,
    log_length: f64,
}

/// Scores assignments of one garment.
pub struct Whole<'a> {
    layout: &'a Layout,
    /// For every atom.
    stretches: Vec<Stretch>,
    /// Mirror images.
    pub mirror: &'a Mirror,
    /// Scores of pairs.
    pub pairs: &'a Pairs,
    weights: &'a WholeWeights,
    /// Panels of sleeves that are apart from the trunk: two parts of their own.
    apart: Vec<bool>,
    /// For every atom the half of its panel on which it lies, and the half that mirrors it.
    half: Vec<[u32; 2]>,
}

/// Room for one evaluation, kept between evaluations.
#[derive(Default)]
pub struct Room {
    seen: Vec<bool>,
    across: Vec<u32>,
    parent: Vec<u32>,
    /// For every panel the number of the part that it belongs to.
    part: Vec<u32>,
    half_parent: Vec<u32>,
    chi: Vec<i32>,
    open: Vec<u32>,
    ratios: Vec<f64>,
}

/// One way round a place at which corners meet.
struct Fan {
    corners: usize,
    sum: f64,
    mark: Mark,
}

impl<'a> Whole<'a> {
    /// For one garment.
    pub fn new(layout: &'a Layout, mirror: &'a Mirror, pairs: &'a Pairs, weights: &'a WholeWeights) -> Self {
        let apart = vec![false; layout.panels.len()];
        let stretch = |a: &Atom| Stretch {
            next: a.next as u32,
            before: a.before as u32,
            panel: a.panel as u32,
            mark: a.joint.mark,
            angle: a.joint.angle,
            length: a.length,
            log_length: libm::log(a.length),
        };
        let stretches = layout.atoms.iter().map(stretch).collect();
        Self { layout, stretches, mirror, pairs, weights, apart, half: halves(layout, mirror) }
    }

    /// The same with some panels apart from the others, in two parts of their own.
    pub fn with_apart(self, apart: Vec<bool>) -> Self {
        Self { apart, ..self }
    }

    /// The score of an assignment: what may be traded, and the surface, which must be right in the end.
    pub fn score(&self, of: &Assignment, room: &mut Room) -> Score {
        let soft = self.soft(of, room);
        Score { soft, hard: self.surface(of, room) }
    }

    /// What may be traded. It notes in `room` what [`Self::surface`] reads.
    pub fn soft(&self, of: &Assignment, room: &mut Room) -> f64 {
        self.sewn(of, room) + self.vertices(of, room) + self.crossings(of, room) + self.middles(of)
    }

    /// Runs of edges beyond the first that sew a piece to its mirror image. A piece that is sewn to itself, such as a
    /// trouser leg in one piece, has a middle in front and one in the back.
    fn middles(&self, of: &Assignment) -> f64 {
        let is_image = |a: usize| of.partner(a).is_some_and(|b| self.mirror.of(a) == Some(b));
        let mut more = 0;
        for (p, panel) in self.layout.panels.iter().enumerate() {
            if self.mirror.panel[p] == ALONE {
                continue;
            }
            let goes_round = panel.atoms.clone().any(|a| of.partner(a).is_some_and(|b| panel.atoms.contains(&b)));
            let starts = panel.atoms.clone().filter(|a| is_image(*a) && !is_image(self.stretches[*a].before as usize));
            more += starts.count().saturating_sub(if goes_round || self.mirror.panel[p] == p { 2 } else { 1 });
        }
        self.weights.second_middle * more as f64
    }

    /// Scores of the pairs, and of gathers that occur once.
    fn sewn(&self, of: &Assignment, room: &mut Room) -> f64 {
        let mut sum = 0.0;
        room.ratios.clear();
        for p in of.pairs() {
            sum += self.pairs.score(p.a, p.b, p.opposite);
            let ratio = (self.stretches[p.a].log_length - self.stretches[p.b].log_length).abs();
            if ratio > self.weights.gather_from {
                room.ratios.push(ratio);
            }
        }
        room.ratios.sort_by(f64::total_cmp);
        let r = &room.ratios;
        let is_single = |k: usize| {
            let near = |j: usize| (r[j] - r[k]).abs() < 0.02;
            !(k > 0 && near(k - 1) || k + 1 < r.len() && near(k + 1))
        };
        sum + self.weights.single_gather * (0..r.len()).filter(|k| is_single(*k)).count() as f64
    }

    /// The end that is reached across the seam from an end of an atom. Ends are numbered 2·atom + (0 start, 1 end).
    fn across_seam(&self, of: &Assignment, end: u32) -> Option<u32> {
        let (atom, side) = ((end / 2) as usize, end % 2);
        let partner = of.partner(atom)? as u32;
        Some(2 * partner + if of.is_opposite(atom) { 1 - side } else { side })
    }

    /// The end on the other side of the corner at an end of an atom.
    fn across_corner(&self, end: u32) -> (u32, usize) {
        let atom = (end / 2) as usize;
        if end.is_multiple_of(2) {
            (2 * self.stretches[atom].before + 1, atom)
        } else {
            let next = self.stretches[atom].next;
            (2 * next, next as usize)
        }
    }

    /// Walks from an end round its corners to the free end on the other side, or back.
    fn walk(&self, of: &Assignment, start: u32, room: &mut Room) -> (Fan, Option<u32>) {
        let mut fan = Fan { corners: 0, sum: 0.0, mark: Mark::Corner };
        let mut end = start;
        loop {
            let (other, joint) = self.across_corner(end);
            room.seen[joint] = true;
            fan.corners += 1;
            fan.sum += self.stretches[joint].angle;
            fan.mark = self.stretches[joint].mark;
            match self.across_seam(of, other) {
                None => return (fan, Some(other)),
                Some(next) if next == start || fan.corners > self.stretches.len() => return (fan, None),
                Some(next) => end = next,
            }
        }
    }

    /// Scores all places at which corners meet; notes them for the surface.
    fn vertices(&self, of: &Assignment, room: &mut Room) -> f64 {
        let n = self.stretches.len();
        room.seen.clear();
        room.seen.resize(n, false);
        room.across.clear();
        room.across.resize(2 * n, NONE);
        self.components(of, room);
        let mut sum = 0.0;
        for end in 0..2 * n as u32 {
            let is_start = of.partner((end / 2) as usize).is_none() && room.across[end as usize] == NONE;
            if !is_start {
                continue;
            }
            let (fan, other) = self.walk(of, end, room);
            if let Some(other) = other {
                (room.across[end as usize], room.across[other as usize]) = (other, end);
            }
            sum += self.weights.open_fan(fan.corners, fan.sum, fan.mark);
            self.count_vertex(end, room);
        }
        for joint in 0..n {
            if !room.seen[joint] {
                let (fan, _) = self.walk(of, 2 * joint as u32, room);
                sum += self.weights.closed_fan(fan.corners, fan.sum);
                self.count_vertex(2 * joint as u32, room);
            }
        }
        sum
    }

    fn count_vertex(&self, end: u32, room: &mut Room) {
        let panel = self.stretches[(end / 2) as usize].panel;
        room.chi[room.part[panel as usize] as usize] += 1;
    }

    /// Joins panels that are sewn, and begins to count vertices − edges + faces.
    fn components(&self, of: &Assignment, room: &mut Room) {
        let panels = self.layout.panels.len() as u32;
        room.parent.clear();
        room.parent.extend(0..panels);
        for p in of.pairs() {
            join(&mut room.parent, self.stretches[p.a].panel, self.stretches[p.b].panel);
        }
        room.part.clear();
        room.part.extend((0..panels).map(|panel| find(&mut room.parent, panel)));
        room.chi.clear();
        room.chi.resize(panels as usize, 0);
        room.part.iter().for_each(|part| room.chi[*part as usize] += 1);
        for (a, stretch) in self.stretches.iter().enumerate() {
            if of.partner(a).is_none_or(|b| a < b) {
                room.chi[room.part[stretch.panel as usize] as usize] -= 1;
            }
        }
    }

    /// Scores components, openings and handles of the surface: no more than 0. `room` is that of [`Self::soft`].
    pub fn surface(&self, of: &Assignment, room: &mut Room) -> f64 {
        let w = self.weights;
        let n = self.stretches.len();
        let panels = self.layout.panels.len();
        room.open.clear();
        room.open.resize(panels, 0);
        room.seen.clear();
        room.seen.resize(n, false);
        let mut sum = 0.0;
        for first in 0..n {
            if room.seen[first] || of.partner(first).is_some() {
                continue;
            }
            let (mut length, mut end) = (0.0, 2 * first as u32 + 1);
            // From the end of a free atom round the corners to the next free atom, until the first comes again.
            for _ in 0..=n {
                let atom = (end / 2) as usize;
                if room.seen[atom] {
                    break;
                }
                room.seen[atom] = true;
                length += self.stretches[atom].length;
                let across = room.across[end as usize];
                if across == NONE {
                    break;
                }
                end = across ^ 1;
            }
            sum += w.opening(length);
            room.open[room.part[self.stretches[first].panel as usize] as usize] += 1;
        }
        let (mut parts, mut parts_apart) = (0, 0);
        for panel in 0..panels {
            if room.part[panel] as usize != panel {
                continue;
            }
            let count = if self.apart[panel] { &mut parts_apart } else { &mut parts };
            *count += 1;
            let (chi, open) = (room.chi[panel], room.open[panel] as i32);
            let handles = f64::from(2 - chi - open) / 2.0;
            sum += w.handle * handles.max(0.0) + if open == 0 { w.closed } else { 0.0 };
            // Cap and hem.
            sum += if self.apart[panel] { w.not_a_tube * f64::from((open - 2).max(0)) } else { 0.0 };
        }
        let expected = if self.apart.contains(&true) { SLEEVES as i32 } else { 0 };
        sum + w.part * f64::from((parts - 1).max(0) + i32::abs(parts_apart - expected)) + self.turned_over(of, room)
    }

    /// Counts panels that lie turned over, and seams that make the surface one-sided.
    fn turned_over(&self, of: &Assignment, room: &mut Room) -> f64 {
        if of.pairs().all(|p| p.opposite) {
            return 0.0;
        }
        // Two sides of every panel: sewn opposite, right sides go together.
        let panels = self.layout.panels.len() as u32;
        room.half_parent.clear();
        room.half_parent.extend(0..2 * panels);
        for p in of.pairs() {
            let (x, y) = (self.stretches[p.a].panel, self.stretches[p.b].panel);
            let shift = if p.opposite { 0 } else { panels };
            join(&mut room.half_parent, x, y + shift);
            join(&mut room.half_parent, x + panels, y + panels - shift);
        }
        let one_sided =
            (0..panels).filter(|p| find(&mut room.half_parent, *p) == find(&mut room.half_parent, p + panels)).count();
        self.weights.one_sided * one_sided as f64
    }

    /// Counts panels whose left half is joined to their right half otherwise than on the middle.
    fn crossings(&self, of: &Assignment, room: &mut Room) -> f64 {
        let halves = 2 * self.layout.panels.len() as u32;
        room.half_parent.clear();
        room.half_parent.extend(0..halves);
        for p in of.pairs() {
            let ([x, _], [y, _]) = (self.half[p.a], self.half[p.b]);
            if x != NONE && y != NONE && self.mirror.of(p.a) != Some(p.b) {
                join(&mut room.half_parent, x, y);
            }
        }
        let mut crossed = 0;
        let mut last = NONE;
        for [x, y] in self.half.iter().filter(|[x, y]| *x != NONE && x < y) {
            if *x != last && find(&mut room.half_parent, *x) == find(&mut room.half_parent, *y) {
                crossed += 1;
            }
            last = *x;
        }
        self.weights.crossed * f64::from(crossed)
    }
}

/// The root of an element in a forest of parents.
pub fn find(parent: &mut [u32], mut x: u32) -> u32 {
    while parent[x as usize] != x {
        parent[x as usize] = parent[parent[x as usize] as usize];
        x = parent[x as usize];
    }
    x
}

/// Joins the trees of two elements.
pub fn join(parent: &mut [u32], x: u32, y: u32) {
    let (x, y) = (find(parent, x), find(parent, y));
    if x != y {
        parent[x.max(y) as usize] = x.min(y);
    }
}

/// For every atom the half of a panel on which it lies, and the half that mirrors that one.
fn halves(layout: &Layout, mirror: &Mirror) -> Vec<[u32; 2]> {
    let mut out = vec![[NONE; 2]; layout.atoms.len()];
    for (p, panel) in layout.panels.iter().enumerate() {
        let q = mirror.panel[p];
        if q == ALONE {
            continue;
        }
        if q != p {
            panel.atoms.clone().for_each(|a| out[a] = [2 * p as u32, 2 * q as u32]);
            continue;
        }
        // From the axis on, as far as the other side.
        let is_first = |a: &usize| {
            let before = layout.atoms[*a].before;
            mirror.atom[*a] != *a && (mirror.atom[*a] == before || mirror.atom[before] == before)
        };
        let Some(first) = panel.atoms.clone().find(is_first) else { continue };
        let mut a = first;
        for _ in 0..panel.atoms.len() {
            let m = mirror.atom[a];
            if m == a || m == ALONE || out[m][0] != NONE || out[a][0] != NONE {
                break;
            }
            out[a] = [2 * p as u32, 2 * p as u32 + 1];
            out[m] = [2 * p as u32 + 1, 2 * p as u32];
            a = layout.atoms[a].next;
        }
    }
    out
}
