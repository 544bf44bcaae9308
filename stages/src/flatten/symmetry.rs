//! Pieces that mirror each other, and pieces on the middle, come back as one.
//!
//! Two stored outlines that a reflection carries onto each other belong together if the reflection left to right of the
//! garment in 3D agrees. Where the edit was symmetric, the changes of both sides are averaged, so that they are the
//! same. Folds fall differently on both sides, so the edit alone is compared: how far it moved mirrored points.

use super::align::Rigid;
use super::features::{self, Features};
use super::figures::vertex_areas;
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
/// Mean distance in 3D from the mirror image, as a share of the square root of the area, up to which pieces are images.
const IMAGE_IN_3D: f64 = 0.25;

/// A piece and its image.
struct Image {
    p: usize,
    q: usize,
    reflection: Reflection,
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
        let there = mirrored(sources, flats, &image, false);
        let apart = difference(&there, &flats[image.p]);
        if apart <= SAME_ALREADY {
            continue;
        }
        if apart > SAME_EDIT && params.symmetry != SymmetryChoice::Always {
            let moves = moves(sources, &image, middle);
            if !moves.is_symmetric() {
                report.push(findings::asymmetric(names, apart, (moves.largest > 0.0).then_some(moves.apart)));
                continue;
            }
        }
        if average(sources, flats, &image) {
            report.push(findings::symmetric(names, apart));
        }
    }
}

/// Averages a piece and its image. The meshes do not mirror each other, so one average is not symmetric to the last
/// bit; some more are. `false` when a triangle would be flipped, and nothing is changed then.
fn average(sources: &[Source<'_>], flats: &mut [Vec<Vec2>], image: &Image) -> bool {
    let stored = [image.p, image.q].map(|k| flats[k].clone());
    for _ in 0..AVERAGES {
        let (there, back) = (mirrored(sources, flats, image, false), mirrored(sources, flats, image, true));
        if difference(&there, &flats[image.p]) <= SAME_AFTER {
            break;
        }
        let mean = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| (a + b) * 0.5).collect::<Vec<_>>();
        let (p, q) = (mean(&there, &flats[image.p]), mean(&back, &flats[image.q]));
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

/// How far the flat pieces differ from the mirror images of each other, metres: numbers of both pieces, and the distance.
#[must_use]
pub fn apart(sources: &[Source<'_>], features: &[Features], flats: &[Vec<Vec2>]) -> Vec<(usize, usize, f64)> {
    let off = |image: Image| (image.p, image.q, difference(&mirrored(sources, flats, &image, false), &flats[image.p]));
    images(sources, features).into_iter().map(off).collect()
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
/// space moves both alike.
fn moves(sources: &[Source<'_>], image: &Image, middle: f64) -> Moves {
    let of = |s: &Source<'_>| s.surface.iter().zip(s.before).map(|(now, before)| now - before).collect::<Vec<Vec3>>();
    let (p, q) = (&sources[image.p], &sources[image.q]);
    let (moved, other) = (of(p), of(q));
    let largest = moved.iter().chain(&other).map(|m| m.norm()).fold(0.0, f64::max);
    let location = PointLocation::new(&q.mesh.rest, &q.mesh.triangles);
    let apart = p.mesh.rest.iter().zip(p.before).zip(&moved).map(|((rest, before), moved)| {
        let mirrored = Vec3::new(-moved.x, moved.y, moved.z);
        let in_cloth = (mirrored - location.interpolate(image.reflection.of(*rest), &other)).norm();
        if in_cloth <= SAME_EDIT {
            return in_cloth;
        }
        let place = Vec3::new(2.0 * middle - before.x, before.y, before.z);
        let far = |k: &usize| (q.before[*k] - place).norm_squared();
        let nearest = (0..q.before.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
        nearest.map_or(in_cloth, |k| in_cloth.min((mirrored - other[k]).norm()))
    });
    Moves { apart: apart.fold(0.0, f64::max), largest }
}

/// The middle of the garment, left to right.
fn middle_of<'a>(places: impl Iterator<Item = &'a Vec3>) -> f64 {
    let (sum, count) = places.fold((0.0, 0.0), |(sum, count), p| (sum + p.x, count + 1.0));
    sum / f64::max(count, 1.0)
}

fn difference(a: &[Vec2], b: &[Vec2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

/// Where the vertices of one piece are in the flat mirror image of the other. `back` exchanges the two.
fn mirrored(sources: &[Source<'_>], flats: &[Vec<Vec2>], image: &Image, back: bool) -> Vec<Vec2> {
    let (p, q, reflection) = match back {
        false => (image.p, image.q, image.reflection),
        true => (image.q, image.p, image.reflection.inverse()),
    };
    let (onto, rest) = (&sources[q], &sources[p].mesh.rest);
    let change: Vec<Vec2> = flats[q].iter().zip(&onto.mesh.rest).map(|(f, r)| f - r).collect();
    let location = PointLocation::new(&onto.mesh.rest, &onto.mesh.triangles);
    let moved: Vec<Vec2> = rest
        .iter()
        .map(|r| r + reflection.inverse().turned(location.interpolate(reflection.of(*r), &change)))
        .collect();
    let fit = Rigid::best(&moved, &flats[p], &vertex_areas(rest, &sources[p].mesh.triangles));
    moved.iter().map(|m| fit.apply(*m)).collect()
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

/// Mean distance of the outline of a piece from the mirror image of the other in 3D, over the root of its area.
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
    let area = p.mesh.area();
    if count > 0.0 && area > 0.0 { sum / count / area.sqrt() } else { f64::INFINITY }
}
