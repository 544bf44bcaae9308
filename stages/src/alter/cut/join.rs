//! The cloth on one side of a line. Where a dart is cut in two, the cloth at its mouth is laid together, and so the dart
//! is closed there. Legs that do not fit each other are sewn instead.

use super::line::Crossing;
use super::sides::Beside;
use crate::alter::build::{SAME_PLACE, middle};
use crate::alter::contour::{Contour, Vertex};
use crate::alter::motion::Motion;
use crate::alter::pivot::LEGS_DIFFER;
use toile_formats::dxf::geom::{self, inside};
use toile_garment::{Piece, Vec2};

/// Cloth that becomes one piece.
pub struct Group {
    /// Its outline.
    pub contour: Contour,
    /// The regions in it, and how they move.
    pub regions: Vec<(Beside, Motion)>,
    /// The wedges that were closed in it.
    pub closed: Vec<usize>,
}

impl Group {
    fn new(region: Beside) -> Self {
        Self { contour: region.contour.clone(), regions: vec![(region, Motion::NONE)], closed: Vec::new() }
    }

    /// The motion of the cloth at a path.
    pub fn motion(&self, path: usize) -> Option<Motion> {
        self.regions.iter().find(|(r, _)| r.paths.contains(&path)).map(|(_, m)| *m)
    }

    /// Its first and its last path.
    pub fn paths(&self) -> [usize; 2] {
        let all = || self.regions.iter().flat_map(|(r, _)| r.paths.iter().copied());
        [all().min().unwrap_or_default(), all().max().unwrap_or_default()]
    }

    /// Lays a region beside the cloth that is there, and so closes a dart.
    fn close(&mut self, region: Beside, wedge: &Wedge<'_, '_>) {
        let Some((_, last)) = self.regions.last() else { return };
        let (here, moved) = (*last, last.after(&wedge.crossing.closing()));
        let [leaves, goes_on] = wedge.crossing.ends();
        let mouths = wedge.mouths();
        let other = Contour { vertices: region.contour.vertices.iter().map(|v| v.moved(&moved)).collect() };
        let [own, own_mouth] = [leaves, mouths[0]].map(|p| here.apply(p));
        let [its, its_mouth] = [goes_on, mouths[1]].map(|p| moved.apply(p));
        let vertices = if wedge.is_left_mouth() {
            glue(self.contour.between(own_mouth, own), other.between(its, its_mouth))
        } else {
            glue(other.between(its_mouth, its), self.contour.between(own, own_mouth))
        };
        self.contour = Contour { vertices };
        self.regions.push((region, moved));
        self.closed.push(wedge.crossing.open.dart);
    }

    /// The cloth where the region stays that holds the grain line, else the largest.
    fn anchored(mut self, piece: &Piece) -> Self {
        let holds = |r: &Beside| piece.grain.is_some_and(|g| inside(middle(g[0], g[1]), &r.contour.points()));
        let weight = |r: &Beside| (u8::from(holds(r)), r.contour.area());
        let stays = self.regions.iter().max_by(|(a, _), (b, _)| {
            let (a, b) = (weight(a), weight(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        let back = stays.map_or(Motion::NONE, |(_, m)| m.inverse());
        if self.regions.len() > 1 {
            self.regions.iter_mut().for_each(|(_, m)| *m = back.after(m));
            self.contour.vertices.iter_mut().for_each(|v| *v = v.moved(&back));
        }
        self
    }
}

/// A dart at the outline that the line cuts in two.
pub struct Wedge<'c, 'r> {
    /// The dart.
    pub crossing: &'c Crossing<'r>,
    /// The path before it.
    pub path: usize,
}

impl Wedge<'_, '_> {
    /// Does the mouth lie left of the line?
    pub fn is_left_mouth(&self) -> bool {
        self.crossing.first == 1
    }

    /// Both ends of the mouth: at the leg that the line meets first, and at the other one.
    pub fn mouths(&self) -> [Vec2; 2] {
        [self.crossing.first, 1 - self.crossing.first].map(|k| self.crossing.open.legs[k].at(0.0))
    }

    /// Can the cloth at the mouth be laid together?
    fn fits(&self) -> bool {
        self.crossing.open.misfit(self.crossing.first, self.crossing.share) < LEGS_DIFFER
    }
}

/// The cloth left (0) or right (1) of the line, the darts closed whose mouths lie there.
pub fn groups(piece: &Piece, regions: Vec<Beside>, wedges: &[Wedge<'_, '_>], side: usize) -> Vec<Group> {
    let mut out: Vec<Group> = Vec::new();
    for region in regions {
        let before = region.paths.first().and_then(|p| p.checked_sub(1));
        let wedge = wedges.iter().find(|w| Some(w.path) == before && w.is_left_mouth() == (side == 0) && w.fits());
        match (out.last_mut(), wedge) {
            (Some(group), Some(wedge)) => group.close(region, wedge),
            _ => out.push(Group::new(region)),
        }
    }
    out.into_iter().map(|g| g.anchored(piece)).collect()
}

/// Two lines that meet at both ends as one outline.
fn glue(mut a: Vec<Vertex>, mut b: Vec<Vertex>) -> Vec<Vertex> {
    let meets =
        |end: &[Vertex], begin: &[Vertex]| end.last().zip(begin.first()).is_some_and(|(a, b)| is_near(a.at, b.at));
    if meets(&a, &b) {
        a.pop();
    }
    if meets(&b, &a) {
        b.pop();
    }
    a.append(&mut b);
    a
}

fn is_near(a: Vec2, b: Vec2) -> bool {
    (a - b).norm() < SAME_PLACE
}

/// The area of a polygon with its middle.
pub fn middle_of_area(points: &[Vec2]) -> (f64, Vec2) {
    let Some(origin) = points.first() else { return (0.0, Vec2::new(0.0, 0.0)) };
    let (mut area, mut sum) = (0.0, Vec2::new(0.0, 0.0));
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        let (a, b) = (a - origin, b - origin);
        let cross = geom::cross(a, b);
        area += cross;
        sum += (a + b) * cross;
    }
    (area / 2.0, origin + sum / (3.0 * area.abs().max(1e-12)) * area.signum())
}
