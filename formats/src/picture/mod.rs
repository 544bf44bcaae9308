//! Pictures of a garment as PNG, drawn here: the same bytes on every machine.
//!
//! A camera looks at the garment, with or without its body. Light comes from around, from a key light and from a fill
//! light; depth maps from many directions say how much of it arrives at each vertex. Every pixel is the mean of nine
//! samples. Instead of its cloth a garment may show a quantity ([`Field`]) as colours, with a legend.

mod camera;
mod cloth;
mod field;
mod legend;
mod letters;
mod light;
mod model;
mod raster;
#[cfg(test)]
mod tests;

pub use camera::View;
pub(crate) use cloth::linear;
pub use field::{Field, Scale};
pub use model::lay;

use camera::Camera;
use image::ImageEncoder as _;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use model::Model;
use raster::{Canvas, PAPER};
use toile_garment::Garment;

/// Smallest and largest side of a picture, pixels.
pub const SIDES: [u32; 2] = [64, 4096];

/// Share of the frame that stays free on every side.
const MARGIN: f64 = 0.06;

/// The wishes for a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Wishes<'f> {
    /// Views, side by side: the worn ones at one scale, the flat lay at its own.
    pub views: Vec<View>,
    /// Width of one view, pixels.
    pub width: u32,
    /// Height, pixels; a legend stands below it.
    pub height: u32,
    /// Is the body drawn?
    pub body: bool,
    /// A quantity as colours instead of the cloth.
    pub field: Option<&'f Field>,
}

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The garment has nothing that could be drawn from this side.
    #[error("the garment has no {0} yet")]
    Missing(&'static str),
    /// A size outside [`SIDES`], or no view.
    #[error("a picture needs at least one view and sides from {} to {} pixels", SIDES[0], SIDES[1])]
    Size,
    /// The PNG cannot be written.
    #[error("the PNG cannot be written: {0}")]
    Encoding(String),
}

/// A picture of a garment as PNG. The same garment and wishes give the same bytes.
///
/// # Errors
/// See [`PictureError`].
pub fn png(garment: &Garment, wishes: &Wishes<'_>) -> Result<Vec<u8>, PictureError> {
    png_in_light(garment, wishes, None)
}

/// A picture of a garment on its body, whose light around is known already, as PNG.
///
/// # Errors
/// See [`PictureError`].
pub(crate) fn png_in_light(
    garment: &Garment,
    wishes: &Wishes<'_>,
    worn: Option<&Openness>,
) -> Result<Vec<u8>, PictureError> {
    let sides = SIDES[0]..=SIDES[1];
    if wishes.views.is_empty() || !sides.contains(&wishes.width) || !sides.contains(&wishes.height) {
        return Err(PictureError::Size);
    }
    let (width, height) = (wishes.width as usize, wishes.height as usize);
    let (models, cameras) = shots(garment, wishes)?;
    // The light around is the same from every side.
    let light = |(flat, model): &(bool, Model)| match worn {
        Some(known) if !flat && wishes.body => known.clone(),
        _ => light::around(model),
    };
    let around: Vec<Openness> = models.iter().map(light).collect();
    let mut panels: Vec<Canvas> = Vec::new();
    for (k, camera) in cameras {
        let model = &models[k].1;
        let open = light::look(model, &around[k], raster::key(&camera));
        panels.push(raster::draw(model, &camera, &open, width, height));
    }
    let mut sheet = beside(&panels);
    if let Some(field) = wishes.field {
        sheet = below(sheet, &legend::legend(field, width * panels.len()));
    }
    encode(&sheet)
}

/// How open the right and the wrong side of every vertex is to the light around, 0 to 1: the meshed pieces in their
/// order, then the body.
pub type Openness = Vec<[Vec<f64>; 2]>;

/// The openness of a garment on its body. `None` without positions in 3D.
#[must_use]
pub fn openness(garment: &Garment) -> Option<Openness> {
    Model::worn(garment, true, None).map(|model| light::around(&model))
}

/// The models that are seen, worn or laid flat, and for each view the number of its model and its camera.
type Shots = (Vec<(bool, Model)>, Vec<(usize, Camera)>);

fn shots(garment: &Garment, wishes: &Wishes<'_>) -> Result<Shots, PictureError> {
    let (mut models, mut cameras): Shots = (Vec::new(), Vec::new());
    // Views of one model have one scale, so that sizes can be compared, and each model fills its frames.
    let mut scales: Vec<f64> = Vec::new();
    for view in &wishes.views {
        let flat = *view == View::Flat;
        let known = models.iter().position(|(is_flat, _)| *is_flat == flat);
        let number = known.unwrap_or(models.len());
        if known.is_none() {
            let model =
                if flat { Model::laid(garment, wishes.field) } else { Model::worn(garment, wishes.body, wishes.field) };
            let missing = if flat { "meshed pieces" } else { "positions in 3D" };
            models.push((flat, model.ok_or(PictureError::Missing(missing))?));
            scales.push(f64::INFINITY);
        }
        let mut camera = Camera::of(*view);
        let cloth = models[number].1.surfaces.iter().filter(|s| s.cloth).flat_map(|s| &s.positions);
        let (size, centre) = camera.frame(cloth).ok_or(PictureError::Missing("cloth"))?;
        camera.centre = centre;
        for (size, side) in size.into_iter().zip([wishes.width, wishes.height]) {
            let fits = f64::from(side) * (1.0 - 2.0 * MARGIN) / size.max(1e-3);
            scales[number] = if fits < scales[number] { fits } else { scales[number] };
        }
        cameras.push((number, camera));
    }
    for (number, camera) in &mut cameras {
        camera.scale = scales[*number];
        camera.middle = [0.5 * f64::from(wishes.width), 0.5 * f64::from(wishes.height)];
    }
    Ok((models, cameras))
}

fn beside(panels: &[Canvas]) -> Canvas {
    let (width, height) = (panels.iter().map(|p| p.width).sum(), panels.first().map_or(0, |p| p.height));
    let row = |y: usize| panels.iter().flat_map(move |p| p.pixels[y * p.width..(y + 1) * p.width].iter().copied());
    Canvas { width, height, pixels: (0..height).flat_map(row).collect() }
}

fn below(mut sheet: Canvas, legend: &Canvas) -> Canvas {
    sheet.pixels.extend(legend.pixels.iter().copied());
    sheet.height += legend.height;
    sheet.pixels.resize(sheet.width * sheet.height, PAPER);
    sheet
}

fn encode(canvas: &Canvas) -> Result<Vec<u8>, PictureError> {
    let bytes: Vec<u8> = canvas.pixels.iter().flatten().map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8).collect();
    let mut out = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut out, CompressionType::Best, FilterType::Adaptive);
    let (width, height) = (canvas.width as u32, canvas.height as u32);
    let written = encoder.write_image(&bytes, width, height, image::ExtendedColorType::Rgb8);
    written.map_err(|e| PictureError::Encoding(e.to_string()))?;
    Ok(out)
}
