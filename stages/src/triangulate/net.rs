//! All curves of all pieces, tied by seams and darts: where one side has a vertex by necessity, the other gets one too.

use super::codes;
use super::curve::{Curve, CurveKind};
use super::lines;
use crate::sewing::marks::on_rings;
use crate::sewing::resolve::{ResolvedSeam, Side};
use crate::sewing::ring::SAME;
use crate::sewing::shapes::Shapes;
use std::collections::BTreeSet;
use toile_garment::dart::DartKind;
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Garment, Piece, Report};

/// Marks of two sides nearer than this share of the edge length are one mark.
const ONE_MARK: f64 = 0.35;
/// A place this near to a vertex that must be is that vertex (0.005 mm). Seam ends are written with three decimals, and
/// marks come back from the other sides of seams.
pub(crate) const ONE_PLACE: f64 = 5e-6;
/// Rounds of carrying breaks from side to side.
const ROUNDS: usize = 24;

/// A stretch of a curve walked by a link.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackSpan {
    /// Piece and curve.
    pub at: (usize, usize),
    /// Where it starts, in walking order.
    pub from: f64,
    /// Is the curve walked forward?
    pub forward: bool,
    /// Length, metres.
    pub length: f64,
    /// Distance from the start of the track.
    pub start: f64,
}

/// One side of a link.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track {
    /// Spans in walking order.
    pub spans: Vec<TrackSpan>,
    /// Length, metres.
    pub length: f64,
}

/// Two tracks that are sewn: anchors are places that meet, rising on both.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Name for messages.
    pub name: String,
    /// Sides.
    pub sides: [Track; 2],
    /// Distances along both sides that meet.
    pub anchors: Vec<(f64, f64)>,
}

/// Curves by piece, and links.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Net {
    /// Curves of every piece; the first is the outline.
    pub curves: Vec<Vec<Curve>>,
    /// Seams and darts.
    pub links: Vec<Link>,
}

impl Track {
    fn push(&mut self, at: (usize, usize), from: f64, forward: bool, length: f64) {
        self.spans.push(TrackSpan { at, from, forward, length, start: self.length });
        self.length += length;
    }

    fn of_side(side: &Side) -> Self {
        let mut track = Self::default();
        for s in &side.spans {
            track.push((s.piece.index(), s.ring), s.from, s.forward, s.length);
        }
        track
    }

    /// The curve position at a distance inside the track.
    fn position(&self, t: f64) -> Option<((usize, usize), f64, bool)> {
        let span = self.spans.iter().find(|s| t > s.start + SAME && t < s.start + s.length - SAME)?;
        Some((span.at, span.place(t), span.forward))
    }
}

impl TrackSpan {
    fn place(&self, t: f64) -> f64 {
        if self.forward { self.from + (t - self.start) } else { self.from - (t - self.start) }
    }
}

/// Builds the net and carries every break to the other sides. Fold lines that are left out are named by piece and
/// number.
///
/// # Errors
/// Bad outlines, and seams whose marks never come to an end.
pub fn build(
    garment: &Garment,
    shapes: &Shapes,
    seams: &[ResolvedSeam],
    h: f64,
    left_out: &BTreeSet<(usize, usize)>,
    report: &mut Report,
) -> Result<Net, Vec<Diagnostic>> {
    let mut net = Net::default();
    let mut errors = Vec::new();
    for (piece, shape) in garment.pieces.iter().zip(shapes) {
        match lines::boundary(piece, shape) {
            Ok(curves) => net.curves.push(curves),
            Err(e) => errors.extend(e),
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    for (piece, shape) in garment.pieces.iter().zip(shapes) {
        hard_breaks(piece, shape, &mut net.curves[piece.id.index()]);
    }
    for seam in seams {
        link_seam(&mut net, seam);
    }
    for (piece, shape) in garment.pieces.iter().zip(shapes) {
        let is_left_out = |line: usize| left_out.contains(&(piece.id.index(), line));
        lines::add_lines(piece, &mut net.curves[piece.id.index()], h, &is_left_out, report);
        link_darts(&mut net, piece, shape);
    }
    for (link, seam) in seams.iter().enumerate() {
        anchor_notches(&mut net, link, seam, h);
    }
    for (piece, shape) in garment.pieces.iter().zip(shapes) {
        let outline = &mut net.curves[piece.id.index()][0];
        for (_, s) in on_rings(piece, shape) {
            if outline.to_break(s).is_none_or(|(_, d)| d > ONE_MARK * h) {
                outline.add_break(s);
            }
        }
    }
    for curve in net.curves.iter_mut().flatten().filter(|c| c.closed && c.breaks.is_empty()) {
        curve.add_break(0.0);
    }
    carry(&mut net, ONE_MARK * h)?;
    Ok(net)
}

/// Corners, mouths and apexes, and where fish-eye darts are widest.
fn hard_breaks(piece: &Piece, shape: &crate::sewing::shapes::PieceShape, curves: &mut [Curve]) {
    for (k, curve) in curves.iter_mut().enumerate() {
        let drawn = match curve.kind {
            CurveKind::Outline => Some(&piece.outline),
            CurveKind::Cutout(c) => piece.cutouts.get(c),
            _ => None,
        };
        let mut kinds = vec![PointKind::Plain; curve.points.len()];
        let ring = shape.rings.get(k);
        if let (Some(line), Some(ring)) = (drawn, ring) {
            for (p, at) in line.points.iter().zip(&ring.of_line) {
                if let Some(kind) = at.and_then(|i| kinds.get_mut(i)) {
                    *kind = p.kind;
                }
            }
        }
        let corners: Vec<f64> = (0..curve.points.len())
            .filter(|i| {
                let limit: f64 = match kinds[*i] {
                    PointKind::Turn => 10.0,
                    PointKind::Plain => 25.0,
                    PointKind::Curve => 50.0,
                };
                curve.turn(*i) > limit.to_radians()
            })
            .map(|i| curve.arc[i])
            .collect();
        for s in corners {
            curve.add_break(s);
        }
        if let CurveKind::FishEye(d) = curve.kind {
            let dart = &piece.darts[d];
            let places: Vec<f64> = dart.apexes.iter().chain(&dart.mouth).map(|p| curve.project(*p).0).collect();
            for s in places {
                curve.add_break(s);
            }
        }
    }
    let Some(ring) = shape.rings.first() else { return };
    let edge_ends = piece.edges.iter().flat_map(|e| [e.from, e.to]);
    let edge_ends = edge_ends.filter_map(|v| ring.of_line.get(v as usize).copied().flatten());
    let gaps = ring.gaps.iter().flat_map(|g| [Some(g.from), g.apex, Some(g.to)]).flatten();
    for i in edge_ends.chain(gaps) {
        curves[0].add_break(ring.arc[i]);
    }
    // A pleat without lines is a loop: at least one vertex lies between its mouth points.
    let loops = ring.gaps.iter().filter(|g| g.kind == DartKind::Pleat && piece.darts[g.dart].apexes.is_empty());
    for g in loops {
        let (from, to) = (ring.arc[g.from], ring.arc[g.to]);
        let middle = curves[0].wrap(from + 0.5 * ring.ahead(from, to));
        curves[0].add_break(middle);
    }
}

fn link_seam(net: &mut Net, seam: &ResolvedSeam) {
    let sides = [Track::of_side(&seam.a), Track::of_side(&seam.b)];
    add_link(net, &seam.name, sides);
}

fn add_link(net: &mut Net, name: &str, mut sides: [Track; 2]) {
    for track in &mut sides {
        let mut length = 0.0;
        for span in &mut track.spans {
            let curve = &mut net.curves[span.at.0][span.at.1];
            let ends = [span.from, span.place(span.start + span.length)];
            let [first, last] = ends.map(|s| settle(curve, s));
            span.from = curve.wrap(span.from + first);
            span.start = length;
            span.length += if span.forward { last - first } else { first - last };
            length += span.length;
        }
        track.length = length;
    }
    let ends = (sides[0].length, sides[1].length);
    net.links.push(Link { name: name.to_owned(), sides, anchors: vec![(0.0, 0.0), ends] });
}

/// Makes a place a break, if there is none in that place. Returns the way from the place to the break.
fn settle(curve: &mut Curve, s: f64) -> f64 {
    curve.way_to_break(s, ONE_PLACE).unwrap_or_else(|| {
        curve.add_break(s);
        0.0
    })
}

/// Legs of a dart are sewn like the sides of a seam.
fn link_darts(net: &mut Net, piece: &Piece, shape: &crate::sewing::shapes::PieceShape) {
    let p = piece.id.index();
    let name = |d: usize| format!("{} {}", piece.name, piece.darts.get(d).map_or("", |d| &d.name));
    if let Some(ring) = shape.rings.first() {
        for g in &ring.gaps {
            let Some(apex) = g.apex else { continue };
            let (from, apex, to) = (ring.arc[g.from], ring.arc[apex], ring.arc[g.to]);
            let mut sides = [Track::default(), Track::default()];
            sides[0].push((p, 0), from, true, ring.ahead(from, apex));
            sides[1].push((p, 0), to, false, ring.ahead(apex, to));
            add_link(net, &name(g.dart), sides);
        }
    }
    let fish: Vec<(usize, usize, f64, f64)> = net.curves[p]
        .iter()
        .enumerate()
        .filter_map(|(k, c)| match c.kind {
            CurveKind::FishEye(d) => {
                let end = |i: usize| piece.darts[d].apexes.get(i).map_or(0.0, |a| c.project(*a).0);
                let (a, b) = (end(0), end(1));
                Some((k, d, a, c.ahead(a, b)))
            }
            _ => None,
        })
        .collect();
    for (k, d, start, half) in fish {
        let total = net.curves[p][k].total();
        let mut sides = [Track::default(), Track::default()];
        sides[0].push((p, k), start, true, half);
        sides[1].push((p, k), start, false, total - half);
        add_link(net, &name(d), sides);
    }
    for d in (0..piece.darts.len()).filter(|d| piece.darts[*d].kind == DartKind::Pleat) {
        let legs = [0, 1].map(|leg| net.curves[p].iter().position(|c| c.kind == CurveKind::PleatLeg(d, leg)));
        if let [Some(a), Some(b)] = legs {
            let sides = [a, b].map(|k| {
                let mut t = Track::default();
                t.push((p, k), 0.0, true, net.curves[p][k].total());
                t
            });
            add_link(net, &name(d), sides);
        }
    }
}

/// Matched notches meet, unless they are too near to what meets already. Seams are linked in their order.
fn anchor_notches(net: &mut Net, l: usize, seam: &ResolvedSeam, h: f64) {
    for (ta, tb) in &seam.notches {
        let places = [net.links[l].sides[0].position(*ta), net.links[l].sides[1].position(*tb)];
        let [Some(a), Some(b)] = places else { continue };
        let free = |(at, s, _): ((usize, usize), f64, bool)| {
            net.curves[at.0][at.1].to_break(net.curves[at.0][at.1].wrap(s)).is_none_or(|(_, d)| d > ONE_MARK * h)
        };
        if free(a) && free(b) {
            for ((p, k), s, _) in [a, b] {
                net.curves[p][k].add_break(s);
            }
            insert_anchor(&mut net.links[l].anchors, *ta, *tb);
        }
    }
}

fn insert_anchor(anchors: &mut Vec<(f64, f64)>, ta: f64, tb: f64) {
    let at = anchors.partition_point(|(t, _)| *t < ta);
    let rises = at > 0
        && anchors[at - 1].1 < tb - SAME
        && anchors.get(at).is_none_or(|(t, u)| *t > ta + SAME && *u > tb + SAME);
    if rises {
        anchors.insert(at, (ta, tb));
    }
}

/// Carries breaks across all links until both sides of each hold equally many.
fn carry(net: &mut Net, one_mark: f64) -> Result<(), Vec<Diagnostic>> {
    let count = |net: &Net| net.curves.iter().flatten().map(|c| c.breaks.len()).sum::<usize>();
    let most = 50 * count(net) + 1000;
    for _ in 0..ROUNDS {
        let mut changed = false;
        for l in 0..net.links.len() {
            changed |= carry_link(net, l, one_mark);
        }
        if !changed {
            return Ok(());
        }
        if count(net) > most {
            break;
        }
    }
    let names: Vec<_> = net.links.iter().map(|l| l.name.as_str()).take(8).collect();
    Err(vec![
        Diagnostic::error(
            codes::SEAM_MARKS_ENDLESS,
            format!("marks carried from seam to seam never meet themselves again (seams {}, …)", names.join(", ")),
        )
        .hint("a stretch of outline is sewn to itself with a shift: split the seam at its ends"),
    ])
}

/// Distances along a track at which its curves have breaks.
fn marks(net: &Net, track: &Track) -> Vec<f64> {
    let mut out = vec![0.0, track.length];
    for span in &track.spans {
        let curve = &net.curves[span.at.0][span.at.1];
        out.push(span.start);
        for b in &curve.breaks {
            let d = if span.forward { curve.ahead(span.from, *b) } else { curve.ahead(*b, span.from) };
            if d > SAME && d < span.length - SAME {
                out.push(span.start + d);
            }
        }
    }
    out.sort_by(f64::total_cmp);
    out.dedup_by(|a, b| (*a - *b).abs() < SAME);
    out
}

fn carry_link(net: &mut Net, l: usize, one_mark: f64) -> bool {
    let [a, b] = [0, 1].map(|k| marks(net, &net.links[l].sides[k]));
    let known =
        |k: usize, t: f64, link: &Link| link.anchors.iter().any(|x| (if k == 0 { x.0 } else { x.1 } - t).abs() < SAME);
    let mut changed = false;
    // Marks of both sides that lie at about the same share are one mark.
    for t in &a {
        let link = &net.links[l];
        if known(0, *t, link) {
            continue;
        }
        let expected = across(&link.anchors, *t, false);
        let free = b.iter().filter(|u| !known(1, **u, link) && (**u - expected).abs() < one_mark);
        if let Some(u) = free.min_by(|u, v| (**u - expected).abs().total_cmp(&(**v - expected).abs())).copied() {
            insert_anchor(&mut net.links[l].anchors, *t, u);
            changed = true;
        }
    }
    for (k, list) in [(0, &a), (1, &b)] {
        for t in list {
            if known(k, *t, &net.links[l]) {
                continue;
            }
            let mut expected = across(&net.links[l].anchors, *t, k == 1);
            let place = net.links[l].sides[1 - k].position(expected);
            if let Some(((p, c), s, forward)) = place {
                let way = net.curves[p][c].way_to_break(s, ONE_PLACE).map(|d| if forward { d } else { -d });
                match way.filter(|d| !known(1 - k, expected + d, &net.links[l])) {
                    Some(d) => expected += d,
                    None => _ = net.curves[p][c].add_break(s),
                }
            }
            let (ta, tb) = if k == 0 { (*t, expected) } else { (expected, *t) };
            insert_anchor(&mut net.links[l].anchors, ta, tb);
            changed = true;
        }
    }
    changed
}

/// The place on the other side, by share between neighbouring anchors.
fn across(anchors: &[(f64, f64)], t: f64, back: bool) -> f64 {
    let here = |x: &(f64, f64)| if back { x.1 } else { x.0 };
    let there = |x: &(f64, f64)| if back { x.0 } else { x.1 };
    let at = anchors.partition_point(|x| here(x) < t).clamp(1, anchors.len() - 1);
    let (lo, hi) = (&anchors[at - 1], &anchors[at]);
    let span = here(hi) - here(lo);
    if span <= 0.0 {
        return there(lo);
    }
    there(lo) + (there(hi) - there(lo)) * ((t - here(lo)) / span)
}

/// A stretch of a curve: piece and curve, and its number.
pub type Stretch = ((usize, usize), usize);

impl Link {
    /// Stretches that meet, for every pair of neighbouring anchors, and whether both are walked in the same sense.
    pub fn pairs(&self, curves: &[Vec<Curve>]) -> Vec<([Stretch; 2], bool)> {
        self.anchors
            .windows(2)
            .filter_map(|w| {
                let middle = [0.5 * (w[0].0 + w[1].0), 0.5 * (w[0].1 + w[1].1)];
                let place = |k: usize| {
                    let (at, s, forward) = self.sides[k].position(middle[k])?;
                    Some(((at, curves[at.0][at.1].stretch_at(s)), forward))
                };
                let ((a, fa), (b, fb)) = (place(0)?, place(1)?);
                Some(([a, b], fa == fb))
            })
            .collect()
    }
}
