//! Roles from shape and seams, where names say nothing. Pieces that lie in the file are turned upright first.

use super::drawn::Upright;
use super::outline::Polygon;
use super::{Facing, Join, Part, Role};
use toile_garment::{Piece, Vec2};

/// Width over height, or height over width, from which a narrow piece is a band.
const BAND: f64 = 1.8;
/// Most height of a band, m.
const BAND_HEIGHT: f64 = 0.13;
/// Rise of an outward normal from which an edge looks up; below its negative, down.
const UPWARDS: f64 = 0.5;
/// Difference of area, length and width by which pieces are twins, as a share.
const TWIN: f64 = 0.01;
/// Confidence of a part that shape and seams tell.
const PART: f64 = 0.7;
/// Difference of front and back from which it is clear which is which, as a share.
const CLEAR: f64 = 0.02;
/// Most pieces of a part that face front or back; more are the panels of a ring.
const PANELS: usize = 4;
/// Confidence of front and back that a difference of drawing tells.
const FACING: f64 = 0.6;

/// A stretch of a seam on one piece.
#[derive(Clone, Copy, Debug)]
struct Run {
    /// The piece that it is sewn to.
    other: usize,
    /// Mean outward normal here and there.
    outwards: [Vec2; 2],
    /// m.
    length: f64,
    /// Middle, in piece coordinates, m.
    middle: Vec2,
}

/// The garment as far as roles need it.
struct Sewn<'a> {
    pieces: &'a [Piece],
    outlines: Vec<Polygon>,
    runs: Vec<Vec<Run>>,
    twins: Vec<Option<usize>>,
    /// Number of pieces that are alike.
    alike: Vec<usize>,
    roles: Vec<Role>,
}

/// Completes roles by shape and seams.
#[must_use]
pub fn complete(pieces: &[Piece], roles: Vec<Role>, joins: &[Join]) -> Vec<Role> {
    if joins.is_empty() {
        return roles;
    }
    let Upright { outlines, joins, .. } = Upright::of(pieces, joins);
    let runs = runs(&outlines, &joins);
    // A front and a back may be nearly alike, but they are no twins.
    let faces_alike = |i: usize, k: usize| {
        let facings = [i, k].map(|p| roles[p].facing);
        facings[0] == facings[1] || facings.contains(&None)
    };
    let twins_of = |i: usize| twins(&outlines, i).into_iter().filter(|k| faces_alike(i, *k)).collect();
    let all: Vec<Vec<usize>> = (0..outlines.len()).map(twins_of).collect();
    let sewn = |i: usize, k: usize| runs[i].iter().any(|r| r.other == k);
    let first = |i: usize| all[i].iter().find(|k| sewn(i, **k)).or(all[i].first()).copied();
    let twins = (0..outlines.len()).map(first).collect();
    let alike = all.iter().map(|t| t.len() + 1).collect();
    let mut sewn = Sewn { pieces, outlines, runs, twins, alike, roles };
    sewn.find_limbs();
    sewn.find_bodices();
    sewn.find_trunk();
    sewn.find_bands();
    // The clearest evidence comes first, and the rest follows it along the seams.
    for part in [Part::Bodice, Part::Leg, Part::Waistband, Part::Skirt] {
        sewn.follow_facings();
        sewn.find_facings(part, CLEAR);
    }
    for part in [Part::Skirt, Part::Bodice] {
        sewn.find_facings(part, 0.0);
        sewn.follow_facings();
    }
    sewn.roles
}

fn runs(outlines: &[Polygon], joins: &[Join]) -> Vec<Vec<Run>> {
    let mut runs: Vec<Vec<Run>> = vec![Vec::new(); outlines.len()];
    for join in joins {
        for chunk in join.pairs.chunk_by(|p, q| p[0].piece == q[0].piece && p[1].piece == q[1].piece) {
            let share = join.share();
            let count = chunk.len() as f64;
            let [a, b] = [0, 1].map(|s| {
                let normal: Vec2 = chunk.iter().map(|p| outlines[p[s].piece].outwards(p[s].at).0).sum();
                let middle: Vec2 = chunk.iter().map(|p| p[s].at).sum();
                (chunk[0][s].piece, normal / count, middle / count)
            });
            let length = share * count;
            runs[a.0].push(Run { other: b.0, outwards: [a.1, b.1], length, middle: a.2 });
            runs[b.0].push(Run { other: a.0, outwards: [b.1, a.1], length, middle: b.2 });
        }
    }
    runs
}

/// The pieces that are the same or the mirror image, as far as area, length and box tell.
fn twins(outlines: &[Polygon], i: usize) -> Vec<usize> {
    let near = |a: f64, b: f64| (a - b).abs() <= TWIN * a.abs().max(b.abs());
    let length = |p: &Polygon| p.sides().map(|[a, b]| (b - a).norm()).sum::<f64>();
    let (own, size) = (&outlines[i], outlines[i].size());
    let is_twin = |k: &usize| {
        let (other, other_size) = (&outlines[*k], outlines[*k].size());
        *k != i
            && near(own.area(), other.area())
            && near(length(own), length(other))
            && near(size.x, other_size.x)
            && near(size.y, other_size.y)
    };
    (0..outlines.len()).filter(is_twin).collect()
}

/// Returns `true` if an outline is its own mirror image about an upright axis.
fn is_symmetric(outline: &Polygon) -> bool {
    let [low, high] = outline.bounds();
    let mirrored = |p: Vec2| Vec2::new(low.x + high.x - p.x, p.y);
    let far = outline.points.iter().map(|p| outline.outwards(mirrored(*p)).1).fold(0.0, f64::max);
    far < 0.02 * (high - low).norm()
}

impl Sewn<'_> {
    fn part(&self, i: usize) -> Option<Part> {
        self.roles[i].part
    }

    fn is_part(&self, i: usize, parts: &[Part]) -> bool {
        self.part(i).is_some_and(|p| parts.contains(&p))
    }

    fn tell(&mut self, i: usize, part: Part, why: &str) {
        if self.roles[i].part.is_none() {
            let role = Role { part: Some(part), confidence: PART, evidence: vec![why.to_owned()], ..Role::default() };
            self.roles[i] = self.roles[i].or(&role);
        }
    }

    fn tell_facing(&mut self, i: usize, facing: Facing, why: &str) {
        if self.roles[i].facing.is_none() {
            let role =
                Role { facing: Some(facing), confidence: FACING, evidence: vec![why.to_owned()], ..Role::default() };
            self.roles[i] = self.roles[i].or(&role);
        }
    }

    fn is_band(&self, i: usize) -> bool {
        let size = self.outlines[i].size();
        let (long, short) = (size.x.max(size.y), size.x.min(size.y));
        short < BAND_HEIGHT && long > BAND * short
    }

    /// A piece of the middle: it is sewn to its twin, or it is symmetric and has none.
    fn is_central(&self, i: usize) -> bool {
        match self.twins[i] {
            // Halves of sleeves may be alike, too: then there are four, and two make a tube.
            Some(twin) => match self.runs[i].iter().filter(|r| r.other == twin).count() {
                0 => false,
                1 => true,
                _ => self.alike[i] < 4,
            },
            None => is_symmetric(&self.outlines[i]) || self.runs[i].iter().all(|r| r.other != i),
        }
    }

    fn is_sewn_to(&self, i: usize, count: usize, to: impl Fn(&Run) -> bool) -> bool {
        self.runs[i].iter().filter(|r| to(r)).count() >= count
    }

    /// Sleeves: tubes of pieces beside the middle, whose twins lie on the other side.
    fn find_limbs(&mut self) {
        let count = self.pieces.len();
        let aside: Vec<bool> = (0..count).map(|i| !self.is_band(i) && !self.is_central(i)).collect();
        let on_shoulder = |r: &Run| !aside[r.other] && r.outwards.iter().all(|n| n.y > UPWARDS);
        for i in (0..count).filter(|i| aside[*i]) {
            let to_middle = self.runs[i].iter().any(on_shoulder);
            let fellow = |r: &Run| r.other != i && aside[r.other];
            let is_half =
                self.runs[i].iter().filter(|r| fellow(r)).any(|r| self.is_sewn_to(i, 2, |s| s.other == r.other));
            let is_tube = self.runs[i].iter().filter(|r| r.other == i).count() >= 2;
            if !to_middle && (is_half || is_tube) {
                self.tell(i, Part::Sleeve, "it is a tube beside the middle, and has a twin on the other side");
            }
        }
    }

    /// Bodices: sewn to a sleeve, or over the shoulder and at the side.
    fn find_bodices(&mut self) {
        for i in 0..self.pieces.len() {
            let runs = &self.runs[i];
            let is_trunk = |r: &&Run| r.other != i && self.twins[i] != Some(r.other) && !self.is_band(r.other);
            let is_sleeve = |k: usize| self.is_part(k, &[Part::Sleeve]);
            let shoulder = |r: &Run| r.outwards.iter().all(|n| n.y > UPWARDS);
            let has_shoulder = runs.iter().filter(is_trunk).any(|r| shoulder(r) && !is_sleeve(r.other));
            // The side seams of half a circle look up, and it has no others.
            let has_side = runs.iter().filter(is_trunk).any(|r| !is_sleeve(r.other) && r.outwards[0].y.abs() < UPWARDS);
            let has_sleeve = runs.iter().any(|r| is_sleeve(r.other));
            if self.part(i).is_none()
                && !self.is_band(i)
                && !self.is_cuff(i)
                && (has_shoulder && has_side || has_sleeve)
            {
                self.tell(i, Part::Bodice, "it is sewn to a sleeve, or over the shoulder");
            }
        }
    }

    /// A small piece that is sewn to sleeves, and to its fellow, alone.
    fn is_cuff(&self, i: usize) -> bool {
        let is_sleeve = |r: &&Run| self.is_part(r.other, &[Part::Sleeve]);
        let sleeve = self.runs[i].iter().find(is_sleeve).map(|r| self.outlines[r.other].area());
        let alone = self.runs[i].iter().all(|r| is_sleeve(&r) || self.twins[i] == Some(r.other) || r.other == i);
        alone && sleeve.is_some_and(|area| self.outlines[i].area() < 0.5 * area)
    }

    /// Trousers, skirts, hoods, godets, and bodices without shoulders.
    fn find_trunk(&mut self) {
        let count = self.pieces.len();
        let trunk: Vec<usize> = (0..count).filter(|i| self.part(*i).is_none() && !self.is_band(*i)).collect();
        for i in &trunk {
            let runs = &self.runs[*i];
            let opposite = |r: &Run| {
                let again = |s: &Run| s.other == r.other && s.outwards[0].x * r.outwards[0].x < -0.25;
                r.other != *i && trunk.contains(&r.other) && runs.iter().any(again)
            };
            let twin_joined = self.twins[*i].is_some_and(|t| runs.iter().any(|r| r.other == t));
            let (part, why) = if self.is_cuff(*i) {
                (Part::Cuff, "it is sewn to the end of a sleeve alone")
            } else if self.is_godet(*i) {
                (Part::Godet, "it is a wedge, sewn to one piece on both sides")
            } else if self.is_hood(*i) {
                (Part::Hood, "it stands on a neckline, and is sewn to its twin")
            } else if twin_joined && runs.iter().any(|r| opposite(r) && self.twins[*i] != Some(r.other)) {
                (Part::Leg, "it is sewn to its twin, and to another piece on both sides")
            } else {
                continue;
            };
            self.tell(*i, part, why);
        }
        for i in trunk {
            // What stands above a skirt, and hangs from nothing, is a bodice without shoulders.
            let stands = |r: &Run| r.outwards[0].y < -UPWARDS && r.outwards[1].y > UPWARDS;
            let is_above =
                |r: &Run| stands(r) && !self.is_part(r.other, &[Part::Godet]) && self.twins[i] != Some(r.other);
            let hangs = self.runs[i].iter().any(|r| r.outwards[0].y > UPWARDS);
            let is_short = self.outlines[i].size().y < 0.45;
            let (part, why) = if self.runs[i].iter().any(is_above) && !hangs && is_short && self.twins[i].is_some() {
                (Part::Bodice, "it stands above a skirt")
            } else {
                (Part::Skirt, "it goes around the body, and has no shoulder")
            };
            self.tell(i, part, why);
        }
    }

    fn is_hood(&self, i: usize) -> bool {
        let twin = self.twins[i];
        let stands =
            |r: &Run| self.is_part(r.other, &[Part::Bodice]) && r.outwards[0].y < -0.3 && r.outwards[1].y > -0.3;
        let height = self.outlines[i].size().y;
        let over = |r: &Run| Some(r.other) == twin && r.length > 0.8 * height;
        height > 0.2 && self.runs[i].iter().any(stands) && self.runs[i].iter().any(over)
    }

    fn is_godet(&self, i: usize) -> bool {
        let runs: Vec<&Run> = self.runs[i].iter().filter(|r| r.other != i).collect();
        let Some(first) = runs.first() else { return false };
        let width = self.outlines[i].size().x;
        let one = runs.iter().all(|r| r.other == first.other) && runs.len() >= 2;
        // On the piece that it is let into both edges look at each other, and lie close together.
        let seen: Vec<&Run> = self.runs[first.other].iter().filter(|r| r.other == i).collect();
        let close = seen.iter().any(|a| {
            seen.iter().any(|b| a.outwards[0].x * b.outwards[0].x < 0.0 && (a.middle - b.middle).norm() < 0.6 * width)
        });
        one && close && self.outlines[i].area() < 0.3 * self.outlines[first.other].area()
    }

    /// Bands by what they are sewn to: cuffs, collars, waistbands, tiers.
    fn find_bands(&mut self) {
        for _ in 0..2 {
            for i in 0..self.pieces.len() {
                if self.part(i).is_some() {
                    continue;
                }
                let told = |r: &&Run| r.other != i && self.part(r.other).is_some() && !self.is_band(r.other);
                let Some(run) = self.runs[i].iter().filter(told).max_by(|a, b| a.length.total_cmp(&b.length)) else {
                    continue;
                };
                let up = run.outwards[1].y;
                let (part, why) = match self.part(run.other) {
                    Some(Part::Sleeve) => (Part::Cuff, "it is a band at the end of a sleeve"),
                    Some(Part::Bodice) if up > -0.3 => (Part::Collar, "it is a band at a neckline"),
                    Some(Part::Leg) if up < -UPWARDS => (Part::Cuff, "it is a band at the end of a leg"),
                    Some(Part::Skirt) if up < -UPWARDS => (Part::Tier, "it is a band at the lower edge of a skirt"),
                    _ => (Part::Waistband, "it is a band at the waist"),
                };
                self.tell(i, part, why);
            }
        }
    }

    /// Front and back of the trunk: a deeper neckline, a shallower crotch, smaller darts, more waist tell the front.
    /// Nothing is told where the difference is smaller than a share.
    fn find_facings(&mut self, part: Part, least: f64) {
        let group: Vec<usize> = (0..self.pieces.len()).filter(|i| self.part(*i) == Some(part)).collect();
        if group.iter().any(|i| self.roles[*i].facing.is_some()) {
            return;
        }
        let classes = self.classes(&group);
        let [a, b] = &classes[..] else { return };
        let front = |class: &Vec<usize>| class.iter().map(|i| self.frontness(*i)).sum::<f64>() / class.len() as f64;
        let (front_a, front_b) = (front(a), front(b));
        if (front_a - front_b).abs() <= least * front_a.abs().max(front_b.abs()) {
            return;
        }
        let (a, b) = if front_a >= front_b { (a.clone(), b.clone()) } else { (b.clone(), a.clone()) };
        a.iter().for_each(|i| self.tell_facing(*i, Facing::Front, "of two like pieces it is drawn as a front is"));
        b.iter().for_each(|i| self.tell_facing(*i, Facing::Back, "of two like pieces it is drawn as a back is"));
    }

    /// Waistbands, skirts and yokes face the way of what they are sewn to above one another.
    fn follow_facings(&mut self) {
        for _ in 0..3 {
            for i in 0..self.pieces.len() {
                let alike = (0..self.pieces.len()).filter(|k| self.part(*k) == self.part(i)).count();
                let parts = [Part::Waistband, Part::Skirt, Part::Leg, Part::Bodice, Part::Tier, Part::Yoke];
                let hangs = self.is_part(i, &parts);
                // A band that is sewn to itself goes all around.
                let is_ring =
                    self.is_part(i, &[Part::Waistband, Part::Tier]) && self.runs[i].iter().any(|r| r.other == i);
                if self.roles[i].facing.is_some() || !hangs || is_ring || alike > PANELS {
                    continue;
                }
                let level = |r: &&Run| r.other != i && r.outwards[0].y * r.outwards[1].y < -0.25;
                let to = |facing: Facing| -> f64 {
                    let like = |r: &&Run| self.roles[r.other].facing == Some(facing);
                    self.runs[i].iter().filter(level).filter(like).map(|r| r.length).sum()
                };
                let (front, back) = (to(Facing::Front), to(Facing::Back));
                let facing = if front > 3.0 * back { Facing::Front } else { Facing::Back };
                if front > 3.0 * back || back > 3.0 * front {
                    self.tell_facing(i, facing, "it faces the way of what it is sewn to");
                }
            }
        }
    }

    /// Pieces of one part in two classes: those that lie side by side, sewn at the middle, are of one; those that are
    /// sewn at the sides or over the shoulders are of the other.
    fn classes(&self, group: &[usize]) -> Vec<Vec<usize>> {
        let mut classes: Vec<Vec<usize>> = Vec::new();
        for i in group {
            let same = |k: &usize| {
                let twins = self.twins[*i] == Some(*k) && self.twins[*k] == Some(*i);
                // Two pieces alone that are alike are front and back.
                twins && group.len() > 2
            };
            match classes.iter_mut().find(|class| class.iter().any(same)) {
                Some(class) => class.push(*i),
                None => classes.push(vec![*i]),
            }
        }
        classes
    }

    /// How much a piece looks like a front: higher for the front of two.
    fn frontness(&self, i: usize) -> f64 {
        let outline = &self.outlines[i];
        let intake: f64 = self.pieces[i].darts.iter().map(|d| (d.mouth[1] - d.mouth[0]).norm()).sum();
        match self.part(i) {
            Some(Part::Bodice) if self.runs[i].iter().any(|r| r.outwards.iter().all(|n| n.y > UPWARDS)) => {
                let depth = outline.bounds()[1].y - self.neck(i);
                if depth.is_finite() { depth } else { 0.0 }
            }
            Some(Part::Bodice) => 0.0,
            Some(Part::Leg) => -outline.area(),
            _ => -10.0 * intake + outline.size().x * 0.01,
        }
    }

    /// Height of the neckline in the middle of the body: of a half piece along its edge to the other half.
    fn neck(&self, i: usize) -> f64 {
        let outline = &self.outlines[i];
        let [low, high] = outline.bounds();
        let to_twin = self.runs[i].iter().find(|r| self.twins[i] == Some(r.other) && !is_symmetric(outline));
        let near = 0.02 * (high.x - low.x);
        let x = match to_twin.map(|r| r.outwards[0].x) {
            Some(side) if side > 0.0 => high.x - near,
            Some(_) => low.x + near,
            None => 0.5 * (low.x + high.x),
        };
        let crossing =
            |[a, b]: [Vec2; 2]| ((a.x < x) != (b.x < x)).then(|| a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y));
        outline.sides().filter_map(crossing).fold(f64::NEG_INFINITY, f64::max)
    }
}
