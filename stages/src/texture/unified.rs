//! Looks from U3M materials.

use super::bitmap;
use super::codes::U3M_PARTS_UNUSED;
use std::path::Path;
use toile_formats::texture::read_u3m;
use toile_garment::texture::{Material, Sheen};
use toile_garment::{Diagnostic, SourceRef};
use toile_stage_api::{StageContext, StageError};

/// Roughness of a sheen, which the format does not tell.
const SHEEN_ROUGHNESS: f64 = 0.5;

/// Is this the name of a material, or of an archive of one?
pub fn is_u3m(file: &str) -> bool {
    let ending = Path::new(file).extension();
    ending.is_some_and(|e| e.eq_ignore_ascii_case("u3m") || e.eq_ignore_ascii_case("u3ma"))
}

/// Gives a look what the material tells: colour, bitmap with its size, normal map, roughness and sheen. A colour that
/// was asked for stays. What is not used becomes a note.
///
/// # Errors
/// A material or bitmap that cannot be read.
pub fn material(
    file: &str,
    look: Material,
    has_color: bool,
    cx: &mut StageContext<'_>,
) -> Result<Material, StageError> {
    let found = read_u3m(&cx.files.read(Path::new(file))?, file).map_err(|finding| StageError::input(*finding))?;
    if !found.unused.is_empty() {
        let message = format!("of the material `{}` these are not used: {}", found.name, found.unused.join(", "));
        cx.report.push(Diagnostic::info(U3M_PARTS_UNUSED, message).at(SourceRef::file(file)));
    }
    let beside = |path: &str| {
        let folder = Path::new(file).parent().unwrap_or(Path::new(""));
        folder.join(path).to_string_lossy().into_owned()
    };
    let mut out = look;
    if let Some(color) = found.color.filter(|_| !has_color) {
        out.color = color;
    }
    if let Some(image) = &found.image {
        out.image = Some(bitmap(&beside(&image.path), cx)?);
        out.repeat = image.repeat;
    }
    if let Some(normal) = &found.normal {
        out.normal = Some(bitmap(&beside(&normal.path), cx)?);
        out.repeat = normal.repeat;
    }
    out.roughness = found.roughness.unwrap_or(out.roughness);
    let shine = |strength: f64| Sheen { color: out.color.map(|c| strength * c), roughness: SHEEN_ROUGHNESS };
    out.sheen = found.sheen.filter(|s| *s > 0.0).map(shine);
    Ok(out)
}
