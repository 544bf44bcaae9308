//! A line drawn across darts. On the garment they are sewn shut, so it is drawn on the closed darts.

use super::legs::Open;
use crate::alter::motion::Motion;
use crate::alter::{ALTER_LINE_LEAVES_PIECE, ALTER_PLACE};
use crate::sewing::ring::{Ring, SAME};
use crate::sewing::shapes::mm;
use toile_formats::dxf::{curve, geom};
use toile_garment::{Diagnostic, Piece, Vec2};

/// Chords keep this near a smooth line, metres.
const CHORD: f64 = 0.1e-3;
/// A line keeps this far from the point and the mouth of a dart, metres.
const CLEAR: f64 = 2e-3;

/// A dart that the line crosses.
#[derive(Clone, Debug)]
pub struct Crossing<'r> {
    /// The dart.
    pub open: Open<'r>,
    /// The leg that the line meets first.
    pub first: usize,
    /// The share of both legs at which it crosses them.
    pub share: f64,
    /// The motion of the cloth before it where the darts are closed, and of that behind it.
    motions: [Motion; 2],
}

impl Crossing<'_> {
    /// Where the line leaves the cloth, and where it goes on.
    pub fn ends(&self) -> [Vec2; 2] {
        [self.first, 1 - self.first].map(|k| self.open.legs[k].at(self.share))
    }

    /// The legs of what stays of the dart left (0) or right (1) of the line, from the line to its point, as they follow
    /// each other along the line.
    pub fn tip(&self, side: usize) -> [Vec<Vec2>; 2] {
        let [leaves, goes_on] = self.ends();
        let point = self.open.legs[0].at(1.0);
        // A wedge has one point, a fish-eye one on each side.
        let is_far = (geom::cross(goes_on - leaves, point - leaves) > 0.0) == (side == 0);
        let to = if is_far { 1.0 } else { 0.0 };
        [self.first, 1 - self.first].map(|k| {
            let leg = &self.open.legs[k];
            if is_far { leg.part(self.share, to) } else { leg.part(to, self.share).into_iter().rev().collect() }
        })
    }

    /// Their arc positions on the outline; none at a fish-eye.
    pub fn arcs(&self, ring: &Ring) -> Option<[f64; 2]> {
        let gap = self.open.gap?;
        let length = |k: usize| self.open.legs[k].length() * self.share;
        let arcs = [ring.arc[gap.from] + length(0), ring.arc[gap.to] - length(1)].map(|s| s.rem_euclid(ring.total()));
        Some([self.first, 1 - self.first].map(|k| arcs[k]))
    }

    /// The motion that closes the dart.
    pub fn closing(&self) -> Motion {
        self.open.closing(self.first, self.share)
    }
}

/// A line on the flat piece: it has one stretch more than darts that it crosses.
#[derive(Clone, Debug)]
pub struct Drawn<'r> {
    /// The stretches on cloth.
    pub stretches: Vec<Vec<Vec2>>,
    /// The darts between them.
    pub crossings: Vec<Crossing<'r>>,
}

impl<'r> Drawn<'r> {
    /// Draws a line through places, straight from one to the next or smooth, where all darts on its way are closed.
    pub fn new(piece: &Piece, ring: &'r Ring, places: &[Vec2], smooth: bool) -> Result<Self, Diagnostic> {
        let open = Open::all(piece, ring);
        let places = on_cloth(piece, &open, places)?;
        let (closed, crossings) = close(piece, &open, &places)?;
        let line = if smooth { curve::through(&closed, false, CHORD) } else { closed };
        part(piece, line, crossings)
    }

    /// Its length on cloth, metres.
    pub fn length(&self) -> f64 {
        self.stretches.iter().flat_map(|s| s.windows(2)).map(|w| (w[1] - w[0]).norm()).sum()
    }
}

/// The places; the inner ones lie on a leg where they are near to it.
fn on_cloth(piece: &Piece, open: &[Open<'_>], places: &[Vec2]) -> Result<Vec<Vec2>, Diagnostic> {
    let last = places.len().saturating_sub(1);
    let placed = |(k, p): (usize, &Vec2)| {
        let is_end = k == 0 || k == last;
        open.iter().filter(|_| !is_end).try_fold(*p, |p, open| open.placed(p).ok_or_else(|| in_dart(piece, open, p)))
    };
    places.iter().enumerate().map(placed).collect()
}

fn name(piece: &Piece, open: &Open<'_>) -> String {
    piece.darts.get(open.dart).map(|d| d.name.clone()).unwrap_or_default()
}

fn in_dart(piece: &Piece, open: &Open<'_>, p: Vec2) -> Diagnostic {
    let (dart, piece) = (name(piece, open), &piece.name);
    let message =
        format!("the place {} of the line on piece `{piece}` lies in dart `{dart}`, where no cloth is", mm(p));
    Diagnostic::error(ALTER_PLACE, message).hint("give places beside the dart, or on both of its legs")
}

/// The places where the darts that the line crosses are closed, and those darts.
fn close<'r>(piece: &Piece, open: &[Open<'r>], places: &[Vec2]) -> Result<(Vec<Vec2>, Vec<Crossing<'r>>), Diagnostic> {
    let mut closed: Vec<Vec2> = places.iter().take(1).copied().collect();
    let mut crossings: Vec<Crossing<'r>> = Vec::new();
    let mut motion = Motion::NONE;
    for w in places.windows(2) {
        let mut met: Vec<_> = open.iter().filter_map(|o| Some((o, o.crossed([w[0], w[1]])?))).collect();
        met.sort_by(|a, b| a.1.0.total_cmp(&b.1.0));
        for (open, (_, first, shares)) in met {
            if crossings.iter().any(|c| c.open.dart == open.dart) {
                let message = format!("the line on piece `{}` crosses dart `{}` twice", piece.name, name(piece, open));
                return Err(Diagnostic::error(ALTER_LINE_LEAVES_PIECE, message).hint("let it cross every dart once"));
            }
            let share = (shares[0] + shares[1]) / 2.0;
            let motions = [motion, motion.after(&open.closing(first, share))];
            motion = motions[1];
            crossings.push(Crossing { open: open.clone(), first, share, motions });
        }
        let place = motion.apply(w[1]);
        if closed.last().is_none_or(|last| (place - last).norm() > SAME) {
            closed.push(place);
        }
    }
    Ok((closed, crossings))
}

/// Parts a line at the darts that it crosses, and lays the stretches back onto the flat piece.
fn part<'r>(piece: &Piece, line: Vec<Vec2>, mut crossings: Vec<Crossing<'r>>) -> Result<Drawn<'r>, Diagnostic> {
    let mut rest = line;
    let mut stretches: Vec<Vec<Vec2>> = Vec::new();
    let mut begin: Option<Vec2> = None;
    let mut motion = Motion::NONE;
    for crossing in &mut crossings {
        let [before, after] = crossing.motions;
        let leg = crossing.open.legs[crossing.first].moved(&before);
        let hit = |(k, w): (usize, &[Vec2])| {
            let hits = leg.hits([w[0], w[1]]).into_iter().min_by(|a, b| a[0].total_cmp(&b[0]));
            hits.map(|[t, share]| (k, w[0] + (w[1] - w[0]) * t, share))
        };
        let met = rest.windows(2).enumerate().find_map(hit);
        let is_clear = |share: f64| {
            let ways = [share, 1.0 - share].map(|s| s * leg.length());
            ways.into_iter().all(|way| way > CLEAR)
        };
        let Some((k, place, share)) = met.filter(|m| is_clear(m.2)) else { return Err(beside(piece, &crossing.open)) };
        crossing.share = share;
        let flat = before.inverse();
        let [leaves, goes_on] = crossing.ends();
        stretches.push(stretch(begin, rest[..=k].iter().map(|p| flat.apply(*p)), Some(leaves)));
        (begin, motion) = (Some(goes_on), after);
        rest = std::iter::once(place).chain(rest[k + 1..].iter().copied()).collect();
    }
    let flat = motion.inverse();
    stretches.push(stretch(begin, rest.iter().map(|p| flat.apply(*p)), None));
    Ok(Drawn { stretches, crossings })
}

/// A stretch between places on legs, which stand for the ends of the line there.
fn stretch(begin: Option<Vec2>, line: impl Iterator<Item = Vec2>, end: Option<Vec2>) -> Vec<Vec2> {
    let line = line.skip(usize::from(begin.is_some()));
    let mut out: Vec<Vec2> = begin.into_iter().chain(line).chain(end).collect();
    out.dedup_by(|next, last| (*next - *last).norm() < SAME);
    out
}

fn beside(piece: &Piece, open: &Open<'_>) -> Diagnostic {
    let (dart, name) = (name(piece, open), &piece.name);
    let message =
        format!("the line on piece `{name}` meets the point or the mouth of dart `{dart}` once the dart is closed");
    Diagnostic::error(ALTER_LINE_LEAVES_PIECE, message)
        .hint("draw it across the legs with more room, or let it begin or end at the point of the dart")
}
