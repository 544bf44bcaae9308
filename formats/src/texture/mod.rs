//! Fabric bitmaps: PNG and JPEG, decoded once to be sure, kept as they were encoded.
//!
//! Text, time, profile and camera data are cut out: they say where and when a picture was made, glTF ignores
//! profiles, and some are bombs of a few kilobytes that unpack to gigabytes.

pub(crate) mod codes;
mod color;
mod strip;
#[cfg(test)]
mod tests;
mod u3m;
mod weave;
mod zip;

pub use color::linear;
pub use u3m::{Bitmap, U3m, U3ma, read_u3m};
pub use weave::{Drawn, draw};

use crate::codes::FILE_TOO_LARGE;
use image::{ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use toile_garment::texture::Image;
use toile_garment::{Code, Diagnostic, SourceRef};

/// Largest side, pixels.
pub const MAX_SIDE: u32 = 16_384;
/// Most memory of the decoded picture, bytes.
pub const MAX_DECODED: u64 = 256 << 20;
/// Most pixels: such a bitmap is looked at whole within the memory above.
pub const MAX_PIXELS: u64 = 64 << 20;
/// Largest file, bytes.
pub const MAX_BYTES: usize = 256 << 20;

/// Reads a bitmap. `file` is its name for messages.
///
/// # Errors
/// When it is neither PNG nor JPEG, too large, or broken.
pub fn read_image(bytes: &[u8], file: &str) -> Result<Image, Box<Diagnostic>> {
    let bad = |code: Code, what: String| {
        Box::new(Diagnostic::error(code, format!("`{file}`: {what}")).at(SourceRef::file(file)))
    };
    if bytes.len() > MAX_BYTES {
        return Err(bad(FILE_TOO_LARGE, format!("{} bytes, over the limit of {MAX_BYTES}", bytes.len())));
    }
    let (format, mime, kept) = if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        (ImageFormat::Png, "image/png", strip::png(bytes))
    } else if bytes.starts_with(&[0xff, 0xd8, 0xff]) {
        (ImageFormat::Jpeg, "image/jpeg", strip::jpeg(bytes))
    } else {
        let finding = bad(codes::IMAGE_KIND, "this is neither PNG nor JPEG".to_owned());
        return Err(Box::new(finding.hint("save the bitmap as PNG or JPEG")));
    };
    let kept = kept.map_err(|what| bad(codes::IMAGE_BROKEN, what.to_owned()))?;
    let reader = |limits| {
        let mut reader = ImageReader::with_format(Cursor::new(kept.as_slice()), format);
        reader.limits(limits);
        reader
    };
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_DECODED);
    let (width, height) =
        reader(limits.clone()).into_dimensions().map_err(|e| bad(codes::IMAGE_BROKEN, e.to_string()))?;
    if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE {
        let what = format!("{width} × {height} pixels; allowed are 1 to {MAX_SIDE} a side");
        return Err(bad(codes::IMAGE_SIZE, what));
    }
    let pixels = u64::from(width) * u64::from(height);
    if pixels > MAX_PIXELS {
        let what =
            format!("{width} × {height} pixels are {} million; at most {} are read", pixels >> 20, MAX_PIXELS >> 20);
        return Err(Box::new(
            bad(codes::IMAGE_SIZE, what).hint("save the bitmap smaller: one repeat of the pattern will do"),
        ));
    }
    reader(limits).decode().map_err(|e| bad(codes::IMAGE_BROKEN, e.to_string()))?;
    Ok(Image { mime: mime.to_owned(), width, height, bytes: kept })
}
