//! Lines of pieces that mirror each other, written as one.
//!
//! The flattening makes the vertices of both meshes one. Points of a line between them ride on mesh edges, and the
//! meshes do not mirror each other. Beside a corner either side of it may carry a point of the cut line. So the
//! points of outlines, cut lines and notches are averaged with their images, once more.

use crate::flatten::align::Rigid;
use crate::flatten::mirror::Reflection;
use crate::flatten::symmetry::{Image, made_one};
use toile_garment::flat::FlatPiece;
use toile_garment::{Garment, Piece, Vec2};

/// Distance of a stored point from the image of another one, up to which both are the same place, metres. Files
/// round to a hundredth of a millimetre.
const SAME_PLACE: f64 = 2e-5;

/// The points of a line, stored and moved.
type Line<'l> = [&'l [Vec2]; 2];

/// Averages the moved outlines of pieces that the flattening made one. Gives these pieces and their images. Pieces that
/// came back as they were stay as they were drawn.
pub fn make_one(garment: &Garment, flats: &[&FlatPiece], outlines: &mut [Vec<Vec2>]) -> Vec<Image> {
    let positions: Vec<Vec<Vec2>> = flats.iter().map(|f| f.positions.clone()).collect();
    let is_moved = |k: &usize| garment.pieces[*k].mesh.as_ref().is_some_and(|m| m.rest != positions[*k]);
    let mut images = made_one(garment, &positions);
    images.retain(|image| [image.p, image.q].iter().any(is_moved));
    for image in &images {
        let before = outlines.to_vec();
        for (p, q, reflection) in both_ways(image) {
            let stored = [p, q].map(|k| garment.pieces[k].outline.positions());
            let there = images_of([&stored[0], &before[p]], [&stored[1], &before[q]], reflection);
            outlines[p] = averaged(&before[p], &there, &fit(&there, &before[p]));
        }
    }
    images
}

/// Averages the cut lines and notches of such pieces, whose outlines are one.
pub fn marks_one(garment: &Garment, images: &[Image], pieces: &mut [Piece]) {
    for image in images {
        let before = pieces.to_vec();
        for (p, q, reflection) in both_ways(image) {
            let line = |of: fn(&Piece) -> Vec<Vec2>, k: usize| [of(&garment.pieces[k]), of(&before[k])];
            let there = |of| {
                let [a, b] = [line(of, p), line(of, q)];
                images_of([&a[0], &a[1]], [&b[0], &b[1]], reflection)
            };
            let motion = fit(&there(outline), &outline(&before[p]));
            let made = |of: fn(&Piece) -> Vec<Vec2>| averaged(&of(&before[p]), &there(of), &motion);
            let points = pieces[p].cut_line.iter_mut().flat_map(|line| &mut line.points);
            points.zip(made(cut_line)).for_each(|(point, at)| point.at = at);
            pieces[p].notches.iter_mut().zip(made(notches)).for_each(|(notch, at)| notch.at = at);
        }
    }
}

fn outline(piece: &Piece) -> Vec<Vec2> {
    piece.outline.positions()
}

fn cut_line(piece: &Piece) -> Vec<Vec2> {
    piece.cut_line.as_ref().map(|line| line.positions()).unwrap_or_default()
}

fn notches(piece: &Piece) -> Vec<Vec2> {
    piece.notches.iter().map(|n| n.at).collect()
}

/// A piece and its image, and the other way round where they are two.
fn both_ways(image: &Image) -> impl Iterator<Item = (usize, usize, Reflection)> {
    let there = (image.p, image.q, image.reflection);
    let back = (image.p != image.q).then(|| (image.q, image.p, image.reflection.inverse()));
    std::iter::once(there).chain(back)
}

/// Where the image of every point was moved to, carried back. A point without an image has none.
fn images_of([stored, _]: Line<'_>, [other, moved]: Line<'_>, reflection: Reflection) -> Vec<Option<Vec2>> {
    let back = reflection.inverse();
    let image = |p: &Vec2| {
        let place = reflection.of(*p);
        let at = other.iter().position(|o| (o - place).norm() <= SAME_PLACE)?;
        Some(back.of(*moved.get(at)?))
    };
    stored.iter().map(image).collect()
}

/// The motion that lays images best on the moved points.
fn fit(there: &[Option<Vec2>], moved: &[Vec2]) -> Rigid {
    let weight: Vec<f64> = there.iter().map(|i| f64::from(u8::from(i.is_some()))).collect();
    let from: Vec<Vec2> = there.iter().map(|i| i.unwrap_or_default()).collect();
    Rigid::best(&from, moved, &weight)
}

/// Points between themselves and their images.
fn averaged(moved: &[Vec2], there: &[Option<Vec2>], motion: &Rigid) -> Vec<Vec2> {
    let mean = |(p, image): (&Vec2, &Option<Vec2>)| image.map_or(*p, |image| (p + motion.apply(image)) * 0.5);
    moved.iter().zip(there).map(mean).collect()
}
