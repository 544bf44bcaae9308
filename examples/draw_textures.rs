//! Draws the fabric bitmaps: `cargo run --release --example draw_textures` writes `samples/textures/`.
//!
//! Each bitmap is one repeat of the cloth and tiles without a seam; u (columns) is weft, v (rows) is warp.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _, Rgb, RgbImage};
use std::path::Path;
use std::process::ExitCode;

/// Side of a bitmap, pixels.
const SIZE: u32 = 256;

fn main() -> ExitCode {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/textures");
    for (name, drawing) in drawings() {
        let path = folder.join(format!("{name}.png"));
        let written = png(&drawing).and_then(|bytes| Ok(std::fs::write(&path, bytes)?));
        if let Err(problem) = written {
            report(&format!("{}: {problem}", path.display()));
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// All bitmaps with their names.
pub fn drawings() -> [(&'static str, RgbImage); 3] {
    [
        ("plain-weave", RgbImage::from_fn(SIZE, SIZE, plain_weave)),
        ("twill-stripe", RgbImage::from_fn(SIZE, SIZE, twill_stripe)),
        ("jersey-check", RgbImage::from_fn(SIZE, SIZE, jersey_check)),
    ]
}

/// The bytes of a PNG file.
///
/// # Errors
/// When the encoder refuses the picture.
pub fn png(drawing: &RgbImage) -> Result<Vec<u8>, image::ImageError> {
    // Yarns repeat, and so do the bytes of the rows: unfiltered they are packed best.
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::NoFilter);
    encoder.write_image(drawing.as_raw(), drawing.width(), drawing.height(), ExtendedColorType::Rgb8)?;
    Ok(bytes)
}

#[allow(clippy::print_stderr)]
fn report(problem: &str) {
    eprintln!("{problem}");
}

/// A colour made darker or lighter by a step, whole numbers only so that every machine draws the same.
fn shade([r, g, b]: [i32; 3], step: i32) -> Rgb<u8> {
    Rgb([r, g, b].map(|c| u8::try_from((c + step).clamp(0, 255)).unwrap_or(u8::MAX)))
}

/// How round a yarn looks across its width: −1 at its edges to +1 in its middle, in steps of 1/16.
fn round(at: u32, width: u32) -> i32 {
    let (at, width) = (i32::try_from(2 * at + 1).unwrap_or(0), i32::try_from(width).unwrap_or(1));
    let off = (at - width).abs();
    16 - 32 * off * off / (width * width)
}

/// A small slub that belongs to a yarn and repeats with the bitmap.
fn slub(yarn: u32, along: u32) -> i32 {
    let mixed = (yarn * 37 + along / 32 * 11) % 13;
    i32::try_from(mixed).unwrap_or(0) - 6
}

/// 16 × 16 yarns, one up one down; linen colour. Warp a little darker than weft.
fn plain_weave(x: u32, y: u32) -> Rgb<u8> {
    let yarn = SIZE / 16;
    let (column, row) = (x / yarn, y / yarn);
    let (across, along, base) = if (column + row).is_multiple_of(2) {
        (x % yarn, y % yarn, slub(column, y) - 6)
    } else {
        (y % yarn, x % yarn, slub(row, x) + 4)
    };
    shade([206, 193, 168], base + round(across, yarn) + round(along, yarn) / 2)
}

/// 32 × 32 yarns of 2/2 twill, indigo, with one light stripe of four ends.
fn twill_stripe(x: u32, y: u32) -> Rgb<u8> {
    let yarn = SIZE / 32;
    let (column, row) = (x / yarn, y / yarn);
    let warp_up = (column + row) % 4 < 2;
    let warp = if (14..18).contains(&column) { [222, 218, 204] } else { [52, 66, 104] };
    let (base, light) = if warp_up {
        (warp, round(x % yarn, yarn) + slub(column, y) / 2)
    } else {
        ([88, 100, 132], round(y % yarn, yarn) - 8 + slub(row, x) / 2)
    };
    shade(base, light)
}

/// 16 wales × 32 courses of plain knit (a V each), in a check of two colours.
fn jersey_check(x: u32, y: u32) -> Rgb<u8> {
    let (wale, course) = (SIZE / 16, SIZE / 32);
    let across = x % wale;
    let half = wale / 2;
    // The legs of a stitch lean towards the middle of its wale.
    let lean = if across < half { across } else { wale - 1 - across };
    let along = (y + SIZE - lean * course / half) % course;
    let column_blue = (x / wale) / 8 == 0;
    let row_blue = (y / course) / 16 == 0;
    let base = match (column_blue, row_blue) {
        (true, true) => [72, 112, 140],
        (false, false) => [226, 224, 214],
        _ => [150, 172, 182],
    };
    shade(base, round(along, course) + round(across % half, half) / 2 - 6)
}
