//! Looks from U3M materials.

use super::codes::U3M_PARTS_UNUSED;
use super::{bitmap, picture};
use std::path::Path;
use toile_formats::texture::{U3ma, read_u3m};
use toile_garment::texture::{Image, Material, Sheen};
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
    let refused = |finding: Box<Diagnostic>| StageError::input(*finding);
    let bytes = cx.files.read(Path::new(file))?;
    let archive = U3ma::open(&bytes, file).transpose().map_err(refused)?;
    let found = archive.as_ref().map_or_else(|| read_u3m(&bytes, file), U3ma::material).map_err(refused)?;
    if !found.unused.is_empty() {
        let message = format!("of the material `{}` these are not used: {}", found.name, found.unused.join(", "));
        cx.report.push(Diagnostic::info(U3M_PARTS_UNUSED, message).at(SourceRef::file(file)));
    }
    let mut beside = |path: &str| match &archive {
        Some(archive) => in_archive(archive, file, path),
        None => {
            let folder = Path::new(file).parent().unwrap_or(Path::new(""));
            bitmap(&folder.join(path).to_string_lossy(), cx)
        }
    };
    let mut out = look;
    if let Some(color) = found.color.filter(|_| !has_color) {
        out.color = color;
    }
    if let Some(image) = &found.image {
        out.image = Some(beside(&image.path)?);
        out.repeat = image.repeat;
    }
    if let Some(normal) = &found.normal {
        out.normal = Some(beside(&normal.path)?);
        out.repeat = normal.repeat;
    }
    out.roughness = found.roughness.unwrap_or(out.roughness);
    let shine = |strength: f64| Sheen { color: out.color.map(|c| strength * c), roughness: SHEEN_ROUGHNESS };
    out.sheen = found.sheen.filter(|s| *s > 0.0).map(shine);
    Ok(out)
}

/// A bitmap of a material in an archive.
fn in_archive(archive: &U3ma, file: &str, path: &str) -> Result<Image, StageError> {
    let bytes = archive.beside(path).map_err(|finding| StageError::input(*finding))?;
    picture(&bytes, &format!("{file}/{path}"))
}
