//! The state of an arrangement while it is made.

use super::Given;
use super::form::Form;
use super::sheet::Sheet;
use crate::roles::outline::{Polygon, turned};
use crate::roles::{Facing, Join, Lateral, Part, PiecePoint, Role};
use std::f64::consts::{FRAC_PI_2, PI};
use toile_garment::body::BodySegment;
use toile_garment::{Vec2, Vec3};

/// A pair of a seam, seen from one of its pieces.
#[derive(Clone, Copy, Debug)]
pub struct Thread {
    /// Own point, in piece coordinates, m.
    pub at: Vec2,
    /// Outward normal of the own outline there; zero inside the piece.
    pub outwards: Vec2,
    /// The other end.
    pub other: PiecePoint,
    /// Outward normal of the other outline there; zero inside that piece.
    pub other_outwards: Vec2,
    /// Length of the seam that it stands for, m.
    pub share: f64,
    /// Index of the seam.
    pub join: usize,
}

/// A part of the body that pieces lie on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Segment {
    /// The trunk above the legs, and all that hangs from it.
    Torso,
    /// Left (0) or right (1) arm.
    Arm(usize),
    /// Left (0) or right (1) leg.
    Leg(usize),
    /// Neck and head.
    Neck,
}

impl Segment {
    /// The name of the segment of a body.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Torso => "torso",
            Self::Arm(0) => "arm-left",
            Self::Arm(_) => "arm-right",
            Self::Leg(0) => "leg-left",
            Self::Leg(_) => "leg-right",
            Self::Neck => "neck",
        }
    }
}

/// The garment and what was decided so far.
pub struct Dresser<'a> {
    /// Roles.
    pub roles: &'a [Role],
    /// Seams.
    pub joins: &'a [Join],
    /// Body.
    pub form: Form,
    /// Outlines.
    pub outlines: Vec<Polygon>,
    /// Threads of every piece.
    pub threads: Vec<Vec<Thread>>,
    /// Segments, as they are decided.
    pub segments: Vec<Segment>,
    /// Sheets, as they are placed.
    pub sheets: Vec<Option<Sheet>>,
    /// Pieces that a person placed.
    pub is_given: Vec<bool>,
    /// Layers; a lower one lies inside. A lining of which nothing is said lies inside.
    pub layers: Vec<i32>,
}

impl<'a> Dresser<'a> {
    /// A garment of which something is said.
    pub fn new(outlines: Vec<Polygon>, roles: &'a [Role], joins: &'a [Join], form: Form, given: Given) -> Self {
        let threads = threads(&outlines, joins);
        let Given { sheets, layers } = given;
        let is_given = sheets.iter().map(Option::is_some).collect();
        let inside = |(role, layer): (&Role, i32)| layer - i32::from(layer == 0 && role.part == Some(Part::Lining));
        let layers = roles.iter().zip(layers).map(inside).collect();
        let segments = vec![Segment::Torso; roles.len()];
        Self { roles, joins, form, outlines, threads, segments, sheets, is_given, layers }
    }

    /// Part of a piece.
    pub fn part(&self, i: usize) -> Option<Part> {
        self.roles[i].part
    }

    /// The segment of the body that a piece lies on.
    pub fn segment(&self, i: usize) -> &BodySegment {
        match self.segments[i] {
            Segment::Torso => &self.form.torso,
            Segment::Arm(k) => &self.form.arms[k],
            Segment::Leg(k) => &self.form.legs[k],
            Segment::Neck => &self.form.neck,
        }
    }

    /// Threads of a piece to other pieces that are placed: own point, place of the other end, share.
    pub fn hung(&self, i: usize) -> impl Iterator<Item = (&Thread, Vec3)> + '_ {
        self.threads[i].iter().filter(move |t| t.other.piece != i).filter_map(|t| {
            let sheet = self.sheets[t.other.piece].as_ref()?;
            Some((t, sheet.at(t.other.at)))
        })
    }

    /// Azimuth that a name tells, from the front to the wearer's left, rad.
    pub fn named_azimuth(&self, i: usize) -> Option<f64> {
        let side = |lateral| match lateral {
            Some(Lateral::Left) => Some(FRAC_PI_2),
            Some(Lateral::Right) => Some(-FRAC_PI_2),
            _ => None,
        };
        match self.roles[i].facing? {
            Facing::Front => Some(0.0),
            Facing::Back => Some(PI),
            Facing::Side => side(self.roles[i].lateral),
            Facing::Upper | Facing::Under => None,
        }
    }

    /// Returns `true` if a piece is sewn to itself so that it becomes a tube.
    pub fn is_tube(&self, i: usize) -> bool {
        self.joins.iter().any(|j| {
            j.is_own()
                && j.pairs.first().is_some_and(|[a, _]| a.piece == i)
                && across(j) > 0.25 * self.outlines[i].size().x
        })
    }

    /// Returns `true` if a piece is the whole of a trouser leg. Left and right lie around the trunk, half of it each.
    pub fn is_whole_leg(&self, i: usize) -> bool {
        self.part(i) == Some(Part::Leg) && self.segments[i] == Segment::Torso && self.is_tube(i)
    }

    /// Returns `true` if one of two pieces is sewn to a line inside the other, as a pocket is.
    pub fn are_sewn_flat(&self, i: usize, k: usize) -> bool {
        let ends_inside =
            |from: usize, to: usize| self.threads[from].iter().any(|t| t.other.piece == to && t.other.is_inside);
        ends_inside(i, k) || ends_inside(k, i)
    }

    /// Returns `true` if a piece lies turned over on another: where they are sewn, both outlines go the same way round.
    pub fn folds_over(&self, i: usize, on: usize) -> bool {
        let own: Vec<&Thread> = self.threads[i].iter().filter(|t| t.other.piece == on).collect();
        let pairs = own.windows(2).filter(|w| w[0].join == w[1].join);
        let sense = |w: &[&Thread]| {
            let own = side(w[1].at - w[0].at, w[0].outwards);
            own * side(w[1].other.at - w[0].other.at, w[0].other_outwards) * w[0].share
        };
        pairs.map(sense).sum::<f64>() > 0.0
    }

    /// Has the garment a skirt or legs? A waistband of a garment without them is a band at the hem.
    pub fn has_below(&self) -> bool {
        (0..self.roles.len()).any(|k| matches!(self.part(k), Some(Part::Skirt | Part::Leg)))
    }

    /// The stands over which a collar is turned down; none for another piece.
    pub fn stands_under(&self, i: usize) -> impl Iterator<Item = usize> + '_ {
        let is_collar = self.part(i) == Some(Part::Collar);
        let is_stand = move |k: &usize| is_collar && self.part(*k) == Some(Part::Stand) && self.folds_over(i, *k);
        (0..self.sheets.len()).filter(is_stand)
    }

    /// Middle of a piece after a turn, m.
    pub fn middle(&self, i: usize, turn: f64) -> Vec2 {
        let [low, high] = self.outlines[i].map(|p| turned(p, turn)).bounds();
        (low + high) * 0.5
    }

    /// Mean of the points where a piece is sewn to others that `holds` names; `None` where it is not.
    pub fn seam_middle(&self, i: usize, holds: impl Fn(usize) -> bool) -> Option<Vec2> {
        let on = self.threads[i].iter().filter(|t| t.other.piece != i && holds(t.other.piece));
        let (sum, weight) = on.fold((Vec2::zeros(), 0.0), |(s, w), t| (s + t.at * t.share, w + t.share));
        (weight > 0.0).then(|| sum / weight)
    }
}

/// On which side of a way a direction points: 1 to its left, −1 to its right, 0 for none.
fn side(way: Vec2, direction: Vec2) -> f64 {
    let across = way.perp(&direction);
    if across == 0.0 { 0.0 } else { across.signum() }
}

/// Mean distance of the points that a seam of a piece with itself joins, m.
fn across(join: &Join) -> f64 {
    let sum: f64 = join.pairs.iter().map(|[a, b]| (a.at - b.at).norm()).sum();
    sum / join.pairs.len().max(1) as f64
}

fn threads(outlines: &[Polygon], joins: &[Join]) -> Vec<Vec<Thread>> {
    let mut threads = vec![Vec::new(); outlines.len()];
    let outwards = |p: &PiecePoint| if p.is_inside { Vec2::zeros() } else { outlines[p.piece].outwards(p.at).0 };
    for (join, j) in joins.iter().enumerate() {
        for [a, b] in &j.pairs {
            let (na, nb) = (outwards(a), outwards(b));
            let share = j.share();
            threads[a.piece].push(Thread { at: a.at, outwards: na, other: *b, other_outwards: nb, share, join });
            threads[b.piece].push(Thread { at: b.at, outwards: nb, other: *a, other_outwards: na, share, join });
        }
    }
    threads
}

/// Unit vectors across a segment: to its front, and to the left around it.
#[must_use]
pub fn across_segment(segment: &BodySegment) -> [Vec3; 2] {
    let down = (segment.to - segment.from).try_normalize(1e-9).unwrap_or_else(|| -Vec3::y());
    let front = (Vec3::z() - down * down.z).try_normalize(1e-6).unwrap_or_else(Vec3::y);
    [front, (-down).cross(&front)]
}
