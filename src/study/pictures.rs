//! Pictures of drapes, with their distance from the finest one in colour.

use super::measure::nearer;
use super::presets::Preset;
use super::report::finest;
use super::runs::Ran;
use crate::figure::{figure, one_view};
use toile_formats::picture::{Field, Scale, View, Wishes};
use toile_formats::svg::canvas::escape;
use toile_garment::{Garment, Vec3};
use toile_stages::fit::{Nearest, Surface};
use toile_stages::flatten::is_symmetric;

/// Width and height of a picture, pixels.
const SIZE: [u32; 2] = [360, 540];
/// Ends of the scale of distances, mm. The smallest that covers nearly all is taken, one for all pictures.
const ENDS_MM: [f64; 5] = [5.0, 10.0, 20.0, 50.0, 100.0];

/// Distance of every vertex of a drape from the surface of another one, mm. Of a symmetric garment the nearer of that surface
/// and its mirror image counts.
#[must_use]
pub fn distances(garment: &Garment, from: &Surface, is_symmetric: bool) -> Option<Vec<Vec<f64>>> {
    let (image, _) = nearer(&Surface::of(garment)?, from, is_symmetric);
    let tree = Nearest::new(&image);
    let shape = garment.drape.as_ref()?;
    let distance = |p: &Vec3| 1e3 * tree.distance(p);
    Some(shape.positions.iter().map(|piece| piece.iter().map(distance).collect()).collect())
}

/// Figures of garments in the colours of their distances, all on one scale. Captions are HTML.
#[must_use]
pub fn coloured(drapes: &[(&Garment, Vec<Vec<f64>>, String)]) -> Vec<String> {
    let all: Vec<Vec<f64>> = drapes.iter().flat_map(|(_, values, _)| values.clone()).collect();
    let limit = Field::round_limit(&all, &ENDS_MM);
    let of_drape = |(garment, values, caption): &(&Garment, Vec<Vec<f64>>, String)| {
        let (name, unit, values) = ("distance", "mm", values.clone());
        let field = Field { key: "distance", name, unit, scale: Scale::Rising, values, limit };
        let wishes = Wishes { field: Some(&field), ..one_view(View::Front, SIZE) };
        figure(garment, &wishes, ("distances in colour", caption))
    };
    drapes.iter().filter_map(of_drape).collect()
}

/// Figures of the drapes at the presets, and of the finest, with the distance from the finest in colour.
#[must_use]
pub fn of_presets(ran: &[Ran]) -> Vec<String> {
    let drape_of = |i: usize| ran[i].garment.as_ref();
    let Some((last, reference)) = finest(ran).and_then(|i| Some((i, drape_of(i)?))) else { return Vec::new() };
    let Some(surface) = Surface::of(reference) else { return Vec::new() };
    let symmetric = is_symmetric(reference);
    let shown = (0..ran.len()).filter(|i| *i == last || Preset::of(&ran[*i].done.setting).is_some());
    let drapes: Vec<_> = shown
        .filter_map(|i| {
            let (garment, done) = (drape_of(i)?, &ran[i].done);
            let caption = format!("<b>{}</b>, {:.1} CPU s", escape(&done.setting.name()), done.cpu_seconds);
            Some((garment, distances(garment, &surface, symmetric)?, caption))
        })
        .collect();
    coloured(&drapes)
}
