//! How marks go with the cloth that they are on.

use super::build::{Altered, Gone};
use super::motion::Motion;
use toile_formats::dxf::geom::{self, inside};
use toile_garment::dart::{Dart, DartKind};
use toile_garment::outline::PieceLine;
use toile_garment::{Piece, Vec2};

/// A drill hole this near to the point of a dart marks it, metres. They stand up to 15 mm before it.
const NEAR_POINT: f64 = 16e-3;
/// A point this near to a region lies on it, metres.
const ON_REGION: f64 = 1e-4;
/// A notch this near to the mouth of a dart marks it, metres.
const AT_MOUTH: f64 = 2e-3;

/// A region of the old piece that moves as a whole.
#[derive(Clone, Debug)]
pub struct Region {
    /// Its outline.
    pub polygon: Vec<Vec2>,
    /// How it moves.
    pub motion: Motion,
    /// Number of the part that it becomes.
    pub part: usize,
}

impl Region {
    /// Distance of a point from it; 0 inside.
    fn distance(&self, p: Vec2) -> f64 {
        if inside(p, &self.polygon) {
            return 0.0;
        }
        geom::distance(p, &self.polygon, true)
    }
}

impl Altered {
    /// The region that a mark goes with: the one that holds its middle, or is nearest to it.
    fn region(&self, points: &[Vec2]) -> Option<&Region> {
        let middle = points.iter().sum::<Vec2>() / points.len().max(1) as f64;
        self.regions.iter().min_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)))
    }

    /// The motion of a mark, if it goes with a part.
    fn motion(&self, part: usize, points: &[Vec2]) -> Option<Motion> {
        self.region(points).filter(|r| r.part == part).map(|r| r.motion)
    }

    /// Where points of a mark come to lie, with the number of the part.
    pub fn carried(&self, points: &[Vec2]) -> Option<(usize, Vec<Vec2>)> {
        let region = self.region(points)?;
        Some((region.part, points.iter().map(|p| region.motion.apply(*p)).collect()))
    }

    /// A dart or pleat of the piece that lies on several regions: a line cuts through it.
    pub fn cut_dart<'p>(&self, old: &'p Piece) -> Option<&'p Dart> {
        let is_parted = |dart: &Dart| {
            let place: Vec<Vec2> = dart.mouth.iter().chain(&dart.apexes).copied().collect();
            self.region(&place).is_none_or(|r| place.iter().any(|p| r.distance(*p) > ON_REGION))
        };
        let kept = old.darts.iter().enumerate().filter(|(k, _)| !self.is_gone(*k));
        kept.map(|(_, d)| d).find(|d| is_parted(d))
    }

    /// Gives a part the marks of the old piece that lie on it.
    pub fn carry_marks(&self, old: &Piece, part: usize, piece: &mut Piece) {
        let here = |points: &[Vec2]| self.motion(part, points);
        let lines = |lines: &[PieceLine]| lines.iter().filter_map(|l| Some(line(l, here(&l.positions())?))).collect();
        piece.internal_lines = lines(&old.internal_lines);
        piece.cutouts = lines(&old.cutouts);
        piece.match_lines = lines(&old.match_lines);
        let notch = |n: &toile_garment::notch::Notch| {
            let motion = here(&[n.at])?;
            let angle = n.angle.map(|a| a + motion.angle);
            Some(toile_garment::notch::Notch { at: motion.apply(n.at), angle, ..n.clone() })
        };
        piece.notches = old.notches.iter().filter(|n| !self.marks_gone_dart(old, n.at)).filter_map(notch).collect();
        piece.drill_holes.retain(|h| !self.marks_gone_dart(old, h.at));
        let carry = |points: &mut [Vec2]| {
            let motion = here(points);
            motion.inspect(|m| points.iter_mut().for_each(|p| *p = m.apply(*p))).is_some()
        };
        piece.drill_holes.retain_mut(|h| carry(std::slice::from_mut(&mut h.at)));
        piece.texts.retain_mut(|t| carry(std::slice::from_mut(&mut t.at)));
        piece.folds.retain_mut(|f| carry(&mut f.line));
        let darts = old.darts.iter().enumerate().filter(|(k, _)| !self.is_gone(*k));
        piece.darts = darts.filter_map(|(k, d)| self.dart(k, d, part)).collect();
        piece.grain = old.grain.map(|g| self.grain(g, part, &piece.outline.positions()));
        piece.fold = old.fold.filter(|f| here(f).is_some_and(|m| m.angle == 0.0) && self.parts.len() == 1);
    }

    /// Is a dart gone, or made anew?
    pub fn is_gone(&self, dart: usize) -> bool {
        self.gone.iter().any(|g| g.dart == dart)
    }

    /// Does a notch or a drill hole mark what is gone of a dart? It stands at its mouth or near its point.
    fn marks_gone_dart(&self, old: &Piece, at: Vec2) -> bool {
        let marks = |gone: &Gone, dart: &Dart| {
            (gone.has_no_point && is_near_point(dart, at)) || (gone.has_no_mouth && is_at_mouth(old, dart, at))
        };
        self.gone.iter().any(|gone| old.darts.get(gone.dart).is_some_and(|dart| marks(gone, dart)))
    }

    /// A dart that was not changed. What was only marked is notched out of the outline now.
    fn dart(&self, number: usize, dart: &Dart, part: usize) -> Option<Dart> {
        let place: Vec<Vec2> = dart.mouth.iter().chain(&dart.apexes).copied().collect();
        let motion = self.motion(part, &place)?;
        let mut dart = dart.clone();
        if dart.kind == DartKind::MarkedWedge {
            dart.kind = DartKind::Wedge;
            "cut".clone_into(&mut dart.line);
            if let Some(gap) = self.ring.gaps.iter().find(|g| g.dart == number) {
                let walk = |from: usize, to: usize| self.ring.points.get(from..=to).map(<[Vec2]>::to_vec);
                let legs = gap.apex.and_then(|a| Some([walk(gap.from, a)?, walk(a, gap.to)?]));
                if let Some([down, mut up]) = legs {
                    up.reverse();
                    (dart.mouth, dart.apexes) = ([down[0], up[0]], vec![down[down.len() - 1]]);
                    dart.legs = [down, up];
                }
            }
        }
        let points = dart.apexes.iter_mut().chain(&mut dart.mouth).chain(dart.legs.iter_mut().flatten());
        points.for_each(|p| *p = motion.apply(*p));
        dart.mesh = None;
        Some(dart)
    }

    /// The grain: that of the old piece where it lies on the part. Else it runs the same way through the middle of the
    /// part.
    fn grain(&self, grain: [Vec2; 2], part: usize, outline: &[Vec2]) -> [Vec2; 2] {
        if let Some(motion) = self.motion(part, &grain) {
            let moved = grain.map(|p| motion.apply(p));
            if moved.iter().all(|p| inside(*p, outline)) {
                return moved;
            }
        }
        let along = (grain[1] - grain[0]).try_normalize(1e-9).unwrap_or(Vec2::new(0.0, 1.0));
        let [from, to] = inside_along(outline, along);
        let (middle, reach) = ((from + to) / 2.0, (to - from) * 0.3);
        [middle - reach, middle + reach]
    }
}

/// The longest stretch inside an outline of the line through its middle.
fn inside_along(outline: &[Vec2], along: Vec2) -> [Vec2; 2] {
    let middle = outline.iter().sum::<Vec2>() / outline.len().max(1) as f64;
    let across = |p: Vec2| along.x * (p - middle).y - along.y * (p - middle).x;
    let next = outline.iter().cycle().skip(1);
    let crossed = |(a, b): (&Vec2, &Vec2)| {
        let (x, y) = (across(*a), across(*b));
        ((x < 0.0) != (y < 0.0)).then(|| (a + (b - a) * (x / (x - y)) - middle).dot(&along))
    };
    let mut ways: Vec<f64> = outline.iter().zip(next).filter_map(crossed).collect();
    ways.sort_by(f64::total_cmp);
    let stretch = ways.chunks_exact(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
    let [from, to] = stretch.map_or([-0.01, 0.01], |s| [s[0], s[1]]);
    [middle + along * from, middle + along * to]
}

/// Does a notch stand at the mouth of a dart, and a drill hole near its point?
pub fn marks_of(piece: &Piece, dart: &Dart) -> [bool; 2] {
    let is_notched = piece.notches.iter().any(|n| is_at_mouth(piece, dart, n.at));
    [is_notched, piece.drill_holes.iter().any(|h| is_near_point(dart, h.at))]
}

/// Is a place at the mouth of a dart? On a cut line it lies off the sewn mouth.
fn is_at_mouth(piece: &Piece, dart: &Dart, at: Vec2) -> bool {
    let reach = piece.cut_line.as_ref().map_or(AT_MOUTH, |_| AT_MOUTH.max(0.6 * dart.intake()));
    dart.mouth.iter().any(|m| (m - at).norm() < reach)
}

/// Is a place near the point of a dart?
fn is_near_point(dart: &Dart, at: Vec2) -> bool {
    dart.apexes.iter().any(|a| (a - at).norm() < NEAR_POINT)
}

fn line(line: &PieceLine, motion: Motion) -> PieceLine {
    let mut line = line.clone();
    line.points.iter_mut().for_each(|p| p.at = motion.apply(p.at));
    line
}
