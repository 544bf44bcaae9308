//! A piece cut apart along a line.

mod join;
mod legs;
mod line;
mod notches;
mod seams;
mod sides;

use super::build::{ALLOWANCE, Altered, Gone, Part};
use super::contour::Contour;
use super::marks::Region;
use super::params::{Cut, Parts, Spot};
use super::pivot::wedge as dart;
use super::{ALTER_LINE_LEAVES_PIECE, ALTER_OVERLAPS, ALTER_PLACE, spot};
use crate::sewing::ring::{Gap, Ring};
use crate::sewing::shapes::{Shapes, mm};
use join::{Group, Wedge, middle_of_area};
use line::Drawn;
use sides::Path;
use toile_garment::dart::Dart;
use toile_garment::{Diagnostic, Garment, Piece, PieceId, Vec2};

pub use notches::new_notch;

/// A place this near to the point of a dart is the point, metres.
const AT_POINT: f64 = 1e-3;
/// Parts are at least as large, m².
const LEAST_AREA: f64 = 1e-4;

/// An end of the line: its place on the outline, and the dart whose point it is.
struct End<'s> {
    arc: f64,
    dart: Option<&'s Gap>,
}

/// A line through a piece, with the cloth on both sides of it.
struct Sides<'c, 'r> {
    piece: &'c Piece,
    ring: &'c Ring,
    contour: &'c Contour,
    drawn: &'c Drawn<'r>,
    ends: &'c [End<'r>; 2],
    paths: &'c [Path],
    wedges: &'c [Wedge<'c, 'r>],
    /// The cloth left and right of the line.
    groups: [Vec<Group>; 2],
}

/// Cuts a piece apart.
pub fn cut(garment: &Garment, shapes: &Shapes, id: PieceId, p: &Cut) -> Result<Altered, Diagnostic> {
    let piece = &garment.pieces[id.index()];
    let ring = &shapes[id.index()].rings[0];
    let [Some(first), Some(last)] = [p.along.first(), p.along.last()] else { return Err(too_short(piece)) };
    if p.along.len() < 2 {
        return Err(too_short(piece));
    }
    let ends = [end(garment, shapes, id, first)?, end(garment, shapes, id, last)?];
    let inner = p.along[1..p.along.len() - 1].iter().map(|s| spot::point(garment, shapes, id, s));
    let inner = inner.collect::<Result<Vec<Vec2>, Diagnostic>>()?;
    let mut contour = Contour::of(piece, ring);
    // Later vertices change the numbers of earlier ones.
    let [from, to] = insert(&mut contour, ends.each_ref().map(|e| e.arc));
    let [begin, finish] = [from, to].map(|k| contour.vertices[k].at);
    let places: Vec<Vec2> = std::iter::once(begin).chain(inner).chain([finish]).collect();
    let drawn = Drawn::new(piece, ring, &places, p.smooth)?;
    let is_inside = drawn.stretches.iter().all(|s| contour.holds_line(s));
    let (at_leg, [from, to]) = at_legs(&mut contour, ring, &drawn, &ends);
    let paths = sides::paths(&drawn, [from, to], &at_leg);
    let beside = [0, 1].map(|side| sides::beside(&contour, &paths, side));
    let ([Some(left), Some(right)], true, true) = (beside, is_inside, from != to) else {
        let message = format!("the line on piece `{}` from {} to {} leaves the piece", p.piece, mm(begin), mm(finish));
        return Err(Diagnostic::error(ALTER_LINE_LEAVES_PIECE, message)
            .hint("give it more places, so that it stays inside where its darts are closed"));
    };
    let wedges = wedges(&drawn, &at_leg);
    let groups = [join::groups(piece, left, &wedges, 0), join::groups(piece, right, &wedges, 1)];
    let sides =
        Sides { piece, ring, contour: &contour, drawn: &drawn, ends: &ends, paths: &paths, wedges: &wedges, groups };
    sides.sound()?;
    let names = sides.names(garment, p)?;
    Ok(sides.altered(p, &names))
}

/// The vertices at arc positions of the old outline.
fn insert<const N: usize>(contour: &mut Contour, arcs: [f64; N]) -> [usize; N] {
    arcs.iter().for_each(|s| {
        contour.insert(*s);
    });
    arcs.map(|s| contour.insert(s))
}

/// The vertices where the line crosses the legs of every dart at the outline, and those at its ends.
fn at_legs(
    contour: &mut Contour,
    ring: &Ring,
    drawn: &Drawn<'_>,
    ends: &[End<'_>; 2],
) -> (Vec<Option<[usize; 2]>>, [usize; 2]) {
    let arcs: Vec<Option<[f64; 2]>> = drawn.crossings.iter().map(|c| c.arcs(ring)).collect();
    arcs.iter().flatten().for_each(|arcs| {
        insert(contour, *arcs);
    });
    let at_leg = arcs.iter().map(|a| a.map(|arcs| insert(contour, arcs))).collect();
    (at_leg, insert(contour, ends.each_ref().map(|e| e.arc)))
}

/// The darts at the outline that the line crosses.
fn wedges<'c, 'r>(drawn: &'c Drawn<'r>, at_leg: &[Option<[usize; 2]>]) -> Vec<Wedge<'c, 'r>> {
    let at_outline = drawn.crossings.iter().zip(at_leg).filter(|(_, at)| at.is_some());
    at_outline.enumerate().map(|(path, (crossing, _))| Wedge { crossing, path }).collect()
}

fn too_short(piece: &Piece) -> Diagnostic {
    Diagnostic::error(ALTER_PLACE, format!("the line on piece `{}` has fewer than two places", piece.name))
        .hint("`along` needs a place at each end")
}

fn end<'s>(garment: &Garment, shapes: &'s Shapes, id: PieceId, at: &Spot) -> Result<End<'s>, Diagnostic> {
    let ring = &shapes[id.index()].rings[0];
    let arc = spot::on_outline(garment, shapes, id, at)?;
    let near = |g: &&Gap| g.apex.is_some_and(|a| (ring.points[a] - ring.at(arc)).norm() < AT_POINT);
    let dart = ring.gaps.iter().find(near);
    if dart.is_none() && ring.gap_around(arc).is_some() {
        let message = format!("the line on piece `{}` ends on the leg of a dart", garment.pieces[id.index()].name);
        return Err(Diagnostic::error(ALTER_PLACE, message).hint("end it at the point of the dart, or at an edge"));
    }
    Ok(End { arc: dart.and_then(|g| g.apex).map_or(arc, |a| ring.arc[a]), dart })
}

impl Sides<'_, '_> {
    /// Parts are neither too small nor lie over themselves.
    fn sound(&self) -> Result<(), Diagnostic> {
        let name = &self.piece.name;
        for group in self.groups.iter().flatten() {
            if group.contour.area() < LEAST_AREA {
                let message = format!("the line on piece `{name}` cuts off less than {:.0} cm²", 1e4 * LEAST_AREA);
                return Err(Diagnostic::error(ALTER_LINE_LEAVES_PIECE, message).hint("let it run through the piece"));
            }
            let crossing = Some(group).filter(|g| g.regions.len() > 1).and_then(|g| g.contour.crossing());
            if let Some(place) = crossing {
                let message =
                    format!("a part of piece `{name}` with its darts closed would lie over itself at {}", mm(place));
                return Err(Diagnostic::error(ALTER_OVERLAPS, message).hint("let the line cross fewer darts"));
            }
        }
        Ok(())
    }

    /// The names of the groups left and right of the line. No other piece has them.
    fn names(&self, garment: &Garment, p: &Cut) -> Result<[Vec<String>; 2], Diagnostic> {
        let up = self.piece.warp();
        let (way, first, second) = match &p.into {
            Parts::Along(n) => (up, &n.upper, &n.lower),
            Parts::Across(n) => (Vec2::new(-up.y, up.x), &n.left, &n.right),
        };
        let is_taken = |name: &str| {
            let mut others = garment.pieces.iter().filter(|q| q.id != self.piece.id);
            name.trim().is_empty() || others.any(|q| q.name.eq_ignore_ascii_case(name))
        };
        let bad = [first, second].into_iter().find(|n| is_taken(n));
        if let Some(bad) = bad.or_else(|| Some(first).filter(|n| n.eq_ignore_ascii_case(second))) {
            let message = format!("a part of piece `{}` cannot be called `{bad}`", self.piece.name);
            return Err(Diagnostic::error(ALTER_PLACE, message).hint("give both parts names that no piece has"));
        }
        let [a, b] = [0, 1].map(|side| self.middle(side).dot(&way));
        let of_side = if a > b { [first, second] } else { [second, first] };
        let is_free = |n: &String| !is_taken(n) && !of_side.iter().any(|o| o.eq_ignore_ascii_case(n));
        let numbered = |side: usize| -> Vec<String> {
            let more = (2..).map(|k| format!("{}-{k}", of_side[side])).filter(is_free);
            std::iter::once(of_side[side].clone()).chain(more).take(self.groups[side].len()).collect()
        };
        Ok([numbered(0), numbered(1)])
    }

    /// The middle of the cloth on a side, as it lies in the old piece.
    fn middle(&self, side: usize) -> Vec2 {
        let regions = self.groups[side].iter().flat_map(|g| &g.regions);
        let (area, sum) = regions.fold((0.0, Vec2::new(0.0, 0.0)), |(area, sum), (r, _)| {
            let (a, middle) = middle_of_area(&r.contour.points());
            (area + a, sum + middle * a)
        });
        sum / area.max(1e-12)
    }

    fn altered(&self, p: &Cut, names: &[Vec<String>; 2]) -> Altered {
        let mut parts: Vec<Part> = Vec::new();
        let mut regions: Vec<Region> = Vec::new();
        for (side, groups) in self.groups.iter().enumerate() {
            for (group, name) in groups.iter().zip(&names[side]) {
                let part = parts.len();
                let region = |(r, motion): &(sides::Beside, super::motion::Motion)| Region {
                    polygon: r.contour.points(),
                    motion: *motion,
                    part,
                };
                regions.extend(group.regions.iter().map(region));
                parts.push(self.part(side, group, name));
            }
        }
        Altered {
            parts,
            regions,
            gone: self.gone(),
            ring: self.ring.clone(),
            seams: self.seams(p, names),
            allowance: p.allowance.map_or(ALLOWANCE, |a| a.0),
            told: self.told(names),
            findings: Vec::new(),
        }
    }

    fn part(&self, side: usize, group: &Group, name: &str) -> Part {
        let (mut contour, darts) = (group.contour.clone().cleaned(), self.tips(side, group));
        contour.tell_kinds(&self.joints(group));
        Part { name: name.to_owned(), contour, darts, notches: self.notches(group), holes: Vec::new() }
    }

    /// The places where the line makes no corner of itself: its own places, its ends, and where darts are closed.
    fn joints(&self, group: &Group) -> Vec<Vec2> {
        let mut out: Vec<Vec2> = Vec::new();
        for (k, path) in self.paths.iter().enumerate() {
            let Some(motion) = group.motion(k) else { continue };
            let stretches = path.stretches.iter().filter_map(|s| self.drawn.stretches.get(*s));
            let inner = stretches.flat_map(|s| s.iter().skip(1).take(s.len().saturating_sub(2)));
            out.extend(inner.map(|p| motion.apply(*p)));
        }
        let all = self.drawn.stretches.first().into_iter().chain(self.drawn.stretches.last());
        let ends = all.zip([0, self.paths.len() - 1]).zip([true, false]).filter_map(|((s, path), is_first)| {
            let end = if is_first { s.first() } else { s.last() };
            Some(group.motion(path)?.apply(*end?))
        });
        out.extend(ends);
        for wedge in self.wedges.iter().filter(|w| group.closed.contains(&w.crossing.open.dart)) {
            let Some(motion) = group.motion(wedge.path) else { continue };
            out.extend([wedge.crossing.ends()[0], wedge.mouths()[0]].map(|p| motion.apply(p)));
        }
        out
    }

    /// The rest of the darts that the line cuts in two: wedges with their mouth on the new seam.
    fn tips(&self, side: usize, group: &Group) -> Vec<Dart> {
        let mut out = Vec::new();
        for (k, crossing) in self.drawn.crossings.iter().enumerate() {
            let has_tip = crossing.open.gap.is_none() || (crossing.first == side);
            let path = self.paths.iter().position(|p| p.stretches.contains(&k));
            let motion = path.and_then(|p| group.motion(p)).filter(|_| has_tip);
            let (Some(motion), Some(like)) = (motion, self.piece.darts.get(crossing.open.dart)) else { continue };
            let mut legs = crossing.tip(side).map(|leg| leg.iter().map(|p| motion.apply(*p)).collect::<Vec<_>>());
            if side == 1 {
                legs.reverse();
            }
            let [Some(apex), Some(a), Some(b)] = [legs[0].last(), legs[0].first(), legs[1].first()] else { continue };
            out.push(Dart { legs: legs.clone(), ..dart(like, like.name.clone(), [*a, *b], *apex) });
        }
        out
    }

    /// The old darts that are gone: those that the seam takes up, and those that are cut in two.
    fn gone(&self) -> Vec<Gone> {
        let taken = self.ends.iter().filter_map(|e| e.dart.map(|g| Gone::new(g.dart, true)));
        let is_closed = |dart: usize| self.groups.iter().flatten().any(|g| g.closed.contains(&dart));
        let parted = self.drawn.crossings.iter().map(|c| c.open.dart);
        let parted = parted.map(|dart| Gone { dart, has_no_mouth: is_closed(dart), has_no_point: false });
        taken.chain(parted).collect()
    }

    fn told(&self, names: &[Vec<String>; 2]) -> String {
        let all: Vec<String> = names.iter().flatten().map(|n| format!("`{n}`")).collect();
        let list = match all.split_last() {
            Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
            None => String::new(),
        };
        let cut = format!("piece `{}` was cut along {:.0} mm into {list}", self.piece.name, 1e3 * self.drawn.length());
        let darts = self.drawn.crossings.iter().filter_map(|c| Some((c, self.piece.darts.get(c.open.dart)?)));
        darts.fold(cut, |told, (crossing, dart)| told + &self.told_of(crossing, dart, names))
    }

    /// The fate of a dart that the line cuts in two.
    fn told_of(&self, crossing: &line::Crossing<'_>, dart: &Dart, names: &[Vec<String>; 2]) -> String {
        let name = &dart.name;
        if crossing.open.gap.is_none() {
            return format!("; dart `{name}` became a dart of each");
        }
        let mouth = 1 - crossing.first;
        let closed = self.groups[mouth].iter().zip(&names[mouth]).find(|(g, _)| g.closed.contains(&crossing.open.dart));
        match closed {
            Some((_, part)) => format!("; dart `{name}` is closed in `{part}` and begins at the new seam"),
            None => format!("; the legs of dart `{name}` do not fit each other, so its mouth is sewn as a seam"),
        }
    }
}
