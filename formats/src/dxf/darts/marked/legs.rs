//! Legs of marked darts: which belong together, where they meet, and whether they are those of a dart.

use crate::dxf::chain::Path;
use crate::dxf::darts::dart::{Denied, DrawnDart, Form};
use crate::dxf::darts::legs_test::wedge_test;
use crate::dxf::darts::thresholds::{
    ANGLE_OF_DART, BOW_OF_LEG, DEPTH_OF_MARKED_APEX, DISTANCE_OF_ALLOWANCE_CORNER, DISTANCE_OF_SAME_APEX,
    DISTANCE_OF_SAME_LEG, GAP_OF_LEGS, GAP_OF_SHORT_LEG, LENGTH_OF_CHORD, LENGTH_OF_TIP, TURN_OF_LEG_END,
    TURN_OF_TWIN_APEX, WIDTH_OF_BLUNT_APEX,
};
use crate::dxf::geom::{self, PointIndex};
use toile_garment::Vec2;

/// A line from the outline to a point inside.
pub(super) struct Leg<'a> {
    pub points: Vec<Vec2>,
    pub path: &'a Path,
}

impl Leg<'_> {
    fn apex(&self) -> Vec2 {
        self.points[self.points.len() - 1]
    }

    fn mouth(&self) -> Vec2 {
        self.points[0]
    }

    fn angle(&self) -> f64 {
        let v = self.mouth() - self.apex();
        libm::atan2(v.y, v.x).to_degrees()
    }
}

/// Two legs that meet.
pub(super) struct Pair {
    pub legs: [Vec<Vec2>; 2],
    pub line: u64,
    pub ids: Vec<u32>,
}

/// The legs that meet at one apex, two by two. Of three the outer ones count: the third is the centre line.
pub(super) fn pairs(legs: &[Leg<'_>]) -> Vec<Pair> {
    let index = PointIndex::new(GAP_OF_LEGS, legs.iter().enumerate().map(|(i, l)| (l.apex(), i)));
    let mut used = vec![false; legs.len()];
    let mut out = Vec::new();
    for i in 0..legs.len() {
        if used[i] {
            continue;
        }
        let group = meeting(i, legs, &index, &used);
        group.iter().for_each(|j| used[*j] = true);
        for sector in sectors(&group, legs) {
            out.extend(sector_pairs(&sector, legs));
        }
    }
    out
}

/// The free legs that end where leg `i` does; without any, the nearest one that has no nearer partner itself.
fn meeting(i: usize, legs: &[Leg<'_>], index: &PointIndex, used: &[bool]) -> Vec<usize> {
    let near =
        |k: usize| index.near(legs[k].apex(), GAP_OF_LEGS).into_iter().filter(move |(_, j)| *j != k && !used[*j]);
    let mut group: Vec<usize> = near(i).filter(|(d, _)| *d <= DISTANCE_OF_SAME_APEX).map(|(_, j)| j).collect();
    if group.is_empty() {
        let mutual = |(d, j): &(f64, usize)| near(*j).next().is_some_and(|(nearest, _)| nearest >= *d - 1e-9);
        group.extend(near(i).find(mutual).map(|(_, j)| j));
    }
    group.push(i);
    group.sort_unstable();
    group
}

/// Legs of one apex in groups that lie within the widest angle of a dart, in order round the apex.
fn sectors(group: &[usize], legs: &[Leg<'_>]) -> Vec<Vec<usize>> {
    let mut order = group.to_vec();
    order.sort_by(|a, b| legs[*a].angle().total_cmp(&legs[*b].angle()).then(a.cmp(b)));
    let n = order.len();
    let gap = |k: usize| {
        let turn = legs[order[(k + 1) % n]].angle() - legs[order[k]].angle();
        if k + 1 < n { turn } else { turn + 360.0 }
    };
    let Some(widest) = (0..n).max_by(|a, b| gap(*a).total_cmp(&gap(*b))) else { return Vec::new() };
    let mut out = vec![Vec::new()];
    for k in 1..=n {
        let at = (widest + k) % n;
        if let Some(sector) = out.last_mut() {
            sector.push(order[at]);
        }
        if gap(at) > ANGLE_OF_DART && k < n {
            out.push(Vec::new());
        }
    }
    out
}

/// The darts of a sector: the outer legs, or two neighbours sharing the apex when there are four legs.
fn sector_pairs(sector: &[usize], legs: &[Leg<'_>]) -> Vec<Pair> {
    let mut distinct: Vec<Vec<usize>> = Vec::new();
    for i in sector {
        match distinct.last_mut() {
            Some(last) if (legs[last[0]].mouth() - legs[*i].mouth()).norm() <= DISTANCE_OF_SAME_LEG => last.push(*i),
            _ => distinct.push(vec![*i]),
        }
    }
    match distinct.as_slice() {
        [a, b, c, d] => vec![pair(a, b, legs), pair(c, d, legs)],
        [a, .., b] => vec![pair(a, b, legs)],
        _ => Vec::new(),
    }
}

fn pair(a: &[usize], b: &[usize], legs: &[Leg<'_>]) -> Pair {
    let mut all: Vec<usize> = a.iter().chain(b).copied().collect();
    all.sort_unstable();
    let [a, b] = [&legs[a[0].min(b[0])], &legs[a[0].max(b[0])]];
    let apex = meet(&a.points, &b.points);
    let to_apex = |leg: &Leg<'_>| {
        let mut points = leg.points.clone();
        if let Some(last) = points.last_mut() {
            *last = apex;
        }
        points
    };
    Pair {
        legs: [to_apex(a), to_apex(b)],
        line: a.path.line,
        ids: all.iter().flat_map(|i| legs[*i].path.ids.iter().copied()).collect(),
    }
}

/// Where two legs meet: at the end of the longer one when the other ends beside it, else in the middle.
fn meet(a: &[Vec2], b: &[Vec2]) -> Vec2 {
    let (p, q) = (a[a.len() - 1], b[b.len() - 1]);
    if (p - q).norm() <= GAP_OF_SHORT_LEG || geom::distance(q, a, false) <= GAP_OF_SHORT_LEG {
        p
    } else if geom::distance(p, b, false) <= GAP_OF_SHORT_LEG {
        q
    } else {
        (p + q) * 0.5
    }
}

/// One line: leg, apex, leg. The apex is its sharpest vertex, or two side by side.
pub(super) fn halves(mut points: Vec<Vec2>) -> Option<[Vec<Vec2>; 2]> {
    let turn = |p: &[Vec2], i: usize| geom::turn(p[i - 1], p[i], p[i + 1]);
    let sharpest = |p: &[Vec2]| (1..p.len() - 1).max_by(|a, b| turn(p, *a).abs().total_cmp(&turn(p, *b).abs()));
    let mut apex = sharpest(&points)?;
    let inner = 1..points.len() - 1;
    let twin = [apex.wrapping_sub(1), apex + 1].into_iter().filter(|k| inner.contains(k)).find(|k| {
        let [one, both] = [turn(&points, *k), turn(&points, *k) + turn(&points, apex)].map(|t| t.to_degrees().abs());
        (points[*k] - points[apex]).norm() <= WIDTH_OF_BLUNT_APEX && one > TURN_OF_LEG_END && both > TURN_OF_TWIN_APEX
    });
    if let Some(twin) = twin {
        let first = twin.min(apex);
        points[first] = (points[twin] + points[apex]) * 0.5;
        points.remove(first + 1);
        apex = first;
    }
    let second = points[apex..].iter().rev().copied().collect();
    points.truncate(apex + 1);
    Some([points, second])
}

/// Two legs, from the mouth to the apex they share, as a dart; or why they are none although they run as its legs do.
pub(super) fn dart(
    mut legs: [Vec<Vec2>; 2],
    line: u64,
    ids: Vec<u32>,
    outline: &[Vec2],
) -> Option<Result<DrawnDart, Denied>> {
    let apex = *legs[0].last()?;
    let (a, b) = (legs[0][0], legs[1][0]);
    wedge_test(apex, a, b).ok()?;
    let straight = legs.iter().all(|l| geom::length(l, false) <= BOW_OF_LEG * (l[0] - l[l.len() - 1]).norm());
    if !straight || !geom::inside(apex, outline) || geom::distance(apex, outline, true) < DEPTH_OF_MARKED_APEX {
        return None;
    }
    if let Some(why) = boxed(&legs) {
        return Some(Err(Denied { at: apex, why, form: Form::Marked }));
    }
    // The leg met first on the counter-clockwise outline: seen from the apex the mouth runs clockwise.
    if geom::cross(a - apex, b - apex) < 0.0 {
        legs.reverse();
    }
    let mouth = [legs[0][0], legs[1][0]];
    Some(Ok(DrawnDart {
        form: Form::Marked,
        apexes: vec![apex],
        mouth,
        work: legs.clone(),
        open_lens: false,
        legs,
        on: "internal",
        line,
        ids,
        evidence: Vec::new(),
    }))
}

/// Why the legs are the sides of a pointed or round box (a placket, a flap, a patch pocket) and not those of a dart.
fn boxed(legs: &[Vec<Vec2>; 2]) -> Option<&'static str> {
    let [a, b] = [tip(&legs[0]), tip(&legs[1])];
    let apex = legs[0][legs[0].len() - 1];
    let (u, v) = (a - apex, b - apex);
    let angle = geom::angle(u, v);
    if angle > ANGLE_OF_DART {
        return Some("its point is blunter than 60 degrees: a placket, flap or pocket");
    }
    legs.iter().any(|leg| has_corner(leg)).then_some("a side has a corner: a placket, flap or pocket")
}

/// The place on a leg that shows its direction at the apex.
fn tip(leg: &[Vec2]) -> Vec2 {
    let mut left = LENGTH_OF_TIP.min(0.5 * geom::length(leg, false));
    for k in (1..leg.len()).rev() {
        let step = (leg[k - 1] - leg[k]).norm();
        if step >= left {
            return leg[k] + (leg[k - 1] - leg[k]) * (left / step.max(1e-9));
        }
        left -= step;
    }
    leg[0]
}

/// Does a leg turn a corner on its way, apart from its mouth?
fn has_corner(leg: &[Vec2]) -> bool {
    let mut points: Vec<Vec2> = Vec::with_capacity(leg.len());
    for p in leg {
        if points.last().is_none_or(|last| (p - last).norm() >= LENGTH_OF_CHORD) {
            points.push(*p);
        }
    }
    let corner = |w: &[Vec2]| geom::turn(w[0], w[1], w[2]).to_degrees().abs() > TURN_OF_LEG_END;
    points.windows(3).any(|w| corner(w) && (w[1] - leg[0]).norm() > DISTANCE_OF_ALLOWANCE_CORNER)
}
