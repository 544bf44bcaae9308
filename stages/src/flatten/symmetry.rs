//! Pieces that mirror each other, and pieces on the middle, come back as one.
//!
//! Two stored outlines that a reflection carries onto each other belong together if the reflection left to right of the
//! garment in 3D agrees. Where the edit was symmetric, the changes of both sides are averaged, so that they are the
//! same. Folds fall differently on both sides, so the edit alone is compared: how far it moved mirrored points.
//!
//! The lines that the pattern shows are compared: the outline, darts and seams inside. A vertex there has another one at
//! its mirrored place. Inside a piece it rarely has one. A shape between vertices is off by the square of the mesh edge:
//! 0.06 mm where a circle skirt on edges of 26 mm is made 8 % wider at its hem.

use super::align::Rigid;
use super::features::{self, Features};
use super::findings;
use super::metric::edges2;
use super::mirror::{Reflection, between};
use super::params::{FlattenParams, SymmetryChoice};
use super::point_location::PointLocation;
use super::source::{Source, sources};
use toile_garment::{Garment, Report, Vec2, Vec3};

/// Largest difference of two sides that is taken for one, metres. Larger also evens out small edits of one side.
const SAME_EDIT: f64 = 3e-3;
/// Difference of the moves of mirrored points, as a share of the largest move, up to which an edit is symmetric.
const SAME_MOVE: f64 = 0.25;
/// Difference below which the sides are the same already, metres.
const SAME_ALREADY: f64 = 1e-9;
/// Difference up to which averaged sides are one, metres; a pattern is cut to far less than that.
const SAME_AFTER: f64 = 2e-6;
/// Averages at most. More bring the sides nearer to each other.
const AVERAGES: usize = 12;
/// Vertices of a piece whose moves are compared, at most. Edits are wider than what lies between them.
const MOVES_COMPARED: usize = 4000;
/// Mean distance in 3D from the mirror image, as a share of a quarter of the outline, up to which pieces are images. A
/// waistband slides along its length, so its area says nothing.
const IMAGE_IN_3D: f64 = 0.25;

/// A piece and its image, which may be itself.
pub struct Image {
    /// Number of the piece.
    pub p: usize,
    /// Number of its image.
    pub q: usize,
    /// Carries the stored piece onto its image.
    pub reflection: Reflection,
}

/// Is a draped garment symmetric: does every piece have a mirror image, or is its own?
#[must_use]
pub fn is_symmetric(garment: &Garment) -> bool {
    let Ok(sources) = sources(garment) else { return false };
    let features: Vec<Features> = sources.iter().map(|s| features::of(garment, s.piece, s.mesh)).collect();
    let images = images(&sources, &features);
    let is_found = |p: usize| images.iter().any(|image| image.p == p || image.q == p);
    !sources.is_empty() && (0..sources.len()).all(is_found)
}

/// Makes the flat pieces symmetric where the edit was, and reports both cases.
pub fn make(
    sources: &[Source<'_>],
    features: &[Features],
    params: &FlattenParams,
    flats: &mut [Vec<Vec2>],
    report: &mut Report,
) {
    if params.symmetry == SymmetryChoice::Off {
        return;
    }
    let middle = middle_of(sources.iter().flat_map(|s| s.before));
    for image in images(sources, features) {
        let names = (sources[image.p].piece, sources[image.q].piece);
        let shown = shown(&sources[image.p], &features[image.p]);
        let apart = difference(&mirrored(sources, flats, &image, &shown), &flats[image.p], &shown);
        if apart <= SAME_ALREADY {
            upright(sources, flats, &image, &shown);
            continue;
        }
        if apart > SAME_EDIT && params.symmetry != SymmetryChoice::Always {
            let moves = moves(sources, &image, middle);
            if !moves.is_symmetric() {
                report.push(findings::asymmetric(names, apart, (moves.largest > 0.0).then_some(moves.apart)));
                continue;
            }
        }
        if average(sources, features, flats, &image) {
            upright(sources, flats, &image, &shown);
            report.push(findings::symmetric(names, apart));
        }
    }
}

/// Averages a piece and its image. Some vertices have no vertex at their mirrored place, so one average may not make
/// them one; some more do. `false` when a triangle would be flipped, and nothing is changed then.
fn average(sources: &[Source<'_>], features: &[Features], flats: &mut [Vec<Vec2>], image: &Image) -> bool {
    let stored = [image.p, image.q].map(|k| flats[k].clone());
    let back = Image { p: image.q, q: image.p, reflection: image.reflection.inverse() };
    let [shown, shown_back] = [image.p, image.q].map(|k| shown(&sources[k], &features[k]));
    for _ in 0..AVERAGES {
        let there = mirrored(sources, flats, image, &shown);
        if difference(&there, &flats[image.p], &shown) <= SAME_AFTER {
            break;
        }
        let mean = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| (a + b) * 0.5).collect::<Vec<_>>();
        let q = mean(&mirrored(sources, flats, &back, &shown_back), &flats[image.q]);
        let p = mean(&there, &flats[image.p]);
        (flats[image.q], flats[image.p]) = (q, p);
    }
    let upright = |k: usize| sources[k].mesh.triangles.iter().all(|t| edges2(&flats[k], *t).determinant() > 0.0);
    let is_sound = upright(image.p) && upright(image.q);
    if !is_sound {
        let [p, q] = stored;
        (flats[image.q], flats[image.p]) = (q, p);
    }
    is_sound
}

/// Lays a piece that is its own image with its middle where it was stored. Its grain line turns with the cloth beside
/// the middle, and says less about the piece.
fn upright(sources: &[Source<'_>], flats: &mut [Vec<Vec2>], image: &Image, shown: &[f64]) {
    if image.p != image.q || flats[image.p] == sources[image.p].mesh.rest {
        return;
    }
    let there = images_of(sources, flats, image);
    // Turned by an angle and against it: between both, points lie towards the middle, and no longer turned.
    let between: Vec<Vec2> = there.iter().zip(&flats[image.p]).map(|(a, b)| (a + b) * 0.5).collect();
    let motion = Rigid::best(&flats[image.p], &between, shown);
    flats[image.p].iter_mut().for_each(|p| *p = motion.apply(*p));
}

/// How far the flat pieces differ from the mirror images of each other, metres: numbers of both pieces, and the distance.
#[must_use]
pub fn apart(sources: &[Source<'_>], features: &[Features], flats: &[Vec<Vec2>]) -> Vec<(usize, usize, f64)> {
    let off = |image: Image| {
        let shown = shown(&sources[image.p], &features[image.p]);
        (image.p, image.q, difference(&mirrored(sources, flats, &image, &shown), &flats[image.p], &shown))
    };
    images(sources, features).into_iter().map(off).collect()
}

/// The images among flat pieces that are one with each other.
#[must_use]
pub fn made_one(garment: &Garment, flats: &[Vec<Vec2>]) -> Vec<Image> {
    let Ok(sources) = sources(garment) else { return Vec::new() };
    if sources.len() != flats.len() || sources.iter().zip(flats).any(|(s, f)| s.mesh.rest.len() != f.len()) {
        return Vec::new();
    }
    let features: Vec<Features> = sources.iter().map(|s| features::of(garment, s.piece, s.mesh)).collect();
    let is_one = |image: &Image| {
        let shown = shown(&sources[image.p], &features[image.p]);
        difference(&mirrored(&sources, flats, image, &shown), &flats[image.p], &shown) <= 2.0 * SAME_AFTER
    };
    images(&sources, &features).into_iter().filter(is_one).collect()
}

/// The moves of mirrored points of a piece and its image by an edit, metres.
struct Moves {
    /// Largest difference between the move of a point and the mirrored move of its image.
    apart: f64,
    /// Largest move.
    largest: f64,
}

impl Moves {
    /// Without any move there was no edit, and the shape itself is what differs.
    fn is_symmetric(&self) -> bool {
        self.largest > 0.0 && self.apart <= SAME_EDIT.max(SAME_MOVE * self.largest)
    }
}

/// Compares the moves of each point and of its image in the cloth. Folds fall differently on both sides, so where these
/// moves differ, the point is compared with the cloth nearest to its mirrored place in 3D. An edit that is symmetric in
/// space moves both alike, but for what it changes on the way from that cloth to the mirrored place.
fn moves(sources: &[Source<'_>], image: &Image, middle: f64) -> Moves {
    let (p, q) = (&sources[image.p], &sources[image.q]);
    let (moved, other) = (moves_of(p), moves_of(q));
    let largest = moved.iter().chain(&other).map(|m| m.norm()).fold(0.0, f64::max);
    let there = apart_from(p, (q, &other), &moved, image.reflection, middle);
    let back = apart_from(q, (p, &moved), &other, image.reflection.inverse(), middle);
    Moves { apart: there.max(back), largest }
}

fn moves_of(source: &Source<'_>) -> Vec<Vec3> {
    source.surface.iter().zip(source.before).map(|(now, before)| now - before).collect()
}

/// Largest difference between the moves of a piece and those of its image `q`.
fn apart_from(
    p: &Source<'_>,
    (q, other): (&Source<'_>, &[Vec3]),
    moved: &[Vec3],
    reflection: Reflection,
    middle: f64,
) -> f64 {
    let location = PointLocation::new(&q.mesh.rest, &q.mesh.triangles);
    let slope = slopes(q, other);
    let step = p.before.len().div_ceil(MOVES_COMPARED).max(1);
    let apart = (0..p.before.len()).step_by(step).map(|v| {
        let (rest, before, moved) = (p.mesh.rest[v], p.before[v], moved[v]);
        let mirrored = Vec3::new(-moved.x, moved.y, moved.z);
        let in_cloth = (mirrored - location.interpolate(reflection.of(rest), other)).norm();
        if in_cloth <= SAME_EDIT {
            return in_cloth;
        }
        let place = Vec3::new(2.0 * middle - before.x, before.y, before.z);
        let far = |k: &usize| (q.before[*k] - place).norm_squared();
        let Some(k) = (0..q.before.len()).min_by(|a, b| far(a).total_cmp(&far(b))) else { return in_cloth };
        in_cloth.min((mirrored - other[k]).norm() - slope[k] * (q.before[k] - place).norm())
    });
    apart.fold(0.0, f64::max)
}

/// By how much the moves change at most along the cloth beside every vertex, metres of move for each metre.
fn slopes(source: &Source<'_>, moves: &[Vec3]) -> Vec<f64> {
    let mut out = vec![0.0; moves.len()];
    for [a, b, c] in &source.mesh.triangles {
        for [v, w] in [[*a, *b], [*b, *c], [*c, *a]].map(|side| side.map(|v| v as usize)) {
            let way = (source.before[w] - source.before[v]).norm();
            let slope = if way > 0.0 { (moves[w] - moves[v]).norm() / way } else { 0.0 };
            (out[v], out[w]) = (f64::max(out[v], slope), f64::max(out[w], slope));
        }
    }
    out
}

/// The middle of the garment, left to right.
fn middle_of<'a>(places: impl Iterator<Item = &'a Vec3>) -> f64 {
    let (sum, count) = places.fold((0.0, 0.0), |(sum, count), p| (sum + p.x, count + 1.0));
    sum / f64::max(count, 1.0)
}

/// Largest distance of points that are shown.
fn difference(a: &[Vec2], b: &[Vec2], shown: &[f64]) -> f64 {
    let off = a.iter().zip(b).zip(shown).filter(|(_, shown)| **shown > 0.0).map(|((a, b), _)| (a - b).norm());
    off.fold(0.0, f64::max)
}

/// 1 for the vertices of lines that the pattern shows, 0 for those inside.
fn shown(source: &Source<'_>, features: &Features) -> Vec<f64> {
    let outline = source.mesh.outline().into_iter().flat_map(|o| &o.vertices);
    let inside = features.darts.iter().chain(&features.pairs).flat_map(|pair| pair.a.iter().chain(&pair.b));
    let mut out = vec![0.0; source.mesh.rest.len()];
    outline.chain(inside).for_each(|v| out[*v as usize] = 1.0);
    out
}

/// Where the vertices of a piece are in the flat mirror image of its image, laid on the piece itself.
fn mirrored(sources: &[Source<'_>], flats: &[Vec<Vec2>], image: &Image, shown: &[f64]) -> Vec<Vec2> {
    let moved = images_of(sources, flats, image);
    let fit = Rigid::best(&moved, &flats[image.p], shown);
    moved.iter().map(|m| fit.apply(*m)).collect()
}

/// The same, where the stored reflection carries it.
fn images_of(sources: &[Source<'_>], flats: &[Vec<Vec2>], image: &Image) -> Vec<Vec2> {
    let (onto, rest) = (&sources[image.q], &sources[image.p].mesh.rest);
    let change: Vec<Vec2> = flats[image.q].iter().zip(&onto.mesh.rest).map(|(f, r)| f - r).collect();
    let location = PointLocation::new(&onto.mesh.rest, &onto.mesh.triangles);
    let back = image.reflection.inverse();
    rest.iter().map(|r| r + back.turned(location.interpolate(image.reflection.of(*r), &change))).collect()
}

/// Every piece with its image, each piece once.
fn images(sources: &[Source<'_>], features: &[Features]) -> Vec<Image> {
    let middle = middle_of(sources.iter().flat_map(|s| s.surface));
    let mut found: Vec<(f64, Image)> = Vec::new();
    for p in 0..sources.len() {
        for q in p..sources.len() {
            for reflection in between((sources[p].mesh, &features[p]), (sources[q].mesh, &features[q])) {
                let image = Image { p, q, reflection };
                let off = off_in_3d(sources, &image, middle);
                if off <= IMAGE_IN_3D {
                    found.push((off, image));
                }
            }
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1.p, a.1.q).cmp(&(b.1.p, b.1.q))));
    let mut taken = vec![false; sources.len()];
    let mut out = Vec::new();
    for (_, image) in found {
        if !taken[image.p] && !taken[image.q] {
            (taken[image.p], taken[image.q]) = (true, true);
            out.push(image);
        }
    }
    out
}

/// Mean distance of the outline of a piece from the mirror image of the other in 3D, over a quarter of its length.
fn off_in_3d(sources: &[Source<'_>], image: &Image, middle: f64) -> f64 {
    let (p, q) = (&sources[image.p], &sources[image.q]);
    let (Some(a), Some(b)) = (p.mesh.outline(), q.mesh.outline()) else { return f64::INFINITY };
    let step = (a.vertices.len() / 32).max(1);
    let (mut sum, mut count) = (0.0, 0.0);
    for v in a.vertices.iter().step_by(step) {
        let to = image.reflection.of(p.mesh.rest[*v as usize]);
        let far = |w: &&u32| (q.mesh.rest[**w as usize] - to).norm_squared();
        let Some(w) = b.vertices.iter().min_by(|a, b| far(a).total_cmp(&far(b))) else { continue };
        let at = p.surface[*v as usize];
        sum += (q.surface[*w as usize] - Vec3::new(2.0 * middle - at.x, at.y, at.z)).norm();
        count += 1.0;
    }
    let at = |v: &u32| p.mesh.rest[*v as usize];
    let sides = a.vertices.iter().zip(a.vertices.iter().cycle().skip(1));
    let quarter: f64 = 0.25 * sides.map(|(v, w)| (at(w) - at(v)).norm()).sum::<f64>();
    if count > 0.0 && quarter > 0.0 { sum / count / quarter } else { f64::INFINITY }
}
