//! Stage `texture`: where the fabric lies on every piece, and what it looks like.
//!
//! TEXCOORD_0 is the cloth itself, in metres: u along the weft, v along the warp of the piece. TEXCOORD_1 packs all
//! pieces into one square without overlap.

pub(crate) mod codes;
mod color;
mod drawn;
mod pack;
mod params;
#[cfg(test)]
mod tests;
mod unified;

use crate::codes::PIECE_UNKNOWN;
use params::Look;
pub use params::TextureParams;
use std::path::Path;
use toile_formats::codes::FILE_TOO_LARGE;
use toile_formats::texture::read_image;
use toile_garment::texture::{Image, Material, PieceTexture, Textures};
use toile_garment::{Aspect, Diagnostic, Garment, Piece, Severity};
use toile_stage_api::{Cost, Errors, Forecast, Stage, StageContext, StageError, StageInfo};

/// Colour of cloth of which nothing is known.
const WHITE: [f64; 3] = [1.0; 3];

/// Lays the fabric on the pieces.
pub struct Texture;

impl Stage for Texture {
    type Params = TextureParams;
    const INFO: StageInfo = StageInfo::new(
        "texture",
        "lays fabric bitmaps on the pieces, on grain and in real size, and packs the pieces into one square",
        &[Aspect::Mesh],
        &[Aspect::Texture],
        2,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        let names = !forecast.garment.pieces.is_empty();
        let of_pieces = |f: &Diagnostic| f.code == PIECE_UNKNOWN || f.code == codes::MATERIAL_UNUSED;
        let mut findings = params.check(&forecast.garment);
        findings.retain(|f| names || !of_pieces(f));
        read(&params.looks(), findings, cx)?;
        Ok(forecast.by_triangles(0.002, 0.001, 1.0))
    }

    fn run(
        &self,
        params: &Self::Params,
        mut garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        let mut materials = read(&params.looks(), params.check(&garment), cx)?;
        if params.weave {
            drawn::from_fabrics(params, &garment, &mut materials, cx);
        }
        let colourways = drawn::colourways(params, &materials)?;
        let cloth: Vec<Vec<[f64; 2]>> = garment.pieces.iter().map(cloth_coordinates).collect();
        let packed = pack::pack(&cloth, params.margin.0);
        let choose = |piece: &Piece| params.material_of(piece);
        let pieces = garment
            .pieces
            .iter()
            .zip(cloth)
            .zip(packed)
            .map(|((piece, uv_cloth), packed)| {
                // Single precision is what a GLB holds; more would only make the document larger.
                let uv_packed = packed.iter().map(|p| p.map(|x| f64::from(x as f32))).collect();
                PieceTexture { material: choose(piece), uv_cloth, uv_packed }
            })
            .collect();
        garment.textures = Some(Textures { materials, pieces, colourways });
        Ok(garment)
    }
}

/// All looks with their bitmaps; `findings` were found before.
fn read(looks: &[Look<'_>], findings: Vec<Diagnostic>, cx: &mut StageContext<'_>) -> Result<Vec<Material>, StageError> {
    let mut errors = Errors::default();
    let materials = looks.iter().filter_map(|look| errors.keep(material(look, cx))).collect();
    let (wrong, told): (Vec<_>, Vec<_>) = findings.into_iter().partition(|f| f.severity == Severity::Error);
    errors.parameters(wrong);
    errors.finish()?;
    cx.report.findings.extend(told);
    Ok(materials)
}

/// A look with its bitmap read.
fn material(look: &Look<'_>, cx: &mut StageContext<'_>) -> Result<Material, StageError> {
    let mut errors = Errors::default();
    let asked = look.color.map(color::linear).transpose().map_err(|wrong| StageError::parameter(*wrong));
    let asked = errors.keep(asked).flatten();
    let plain = Material {
        name: look.name.to_owned(),
        color: asked.unwrap_or(WHITE),
        image: None,
        repeat: look.repeat.map(|l| l.0),
        roughness: look.roughness,
        normal: None,
        sheen: None,
    };
    let made = match look.image {
        None => Ok(plain),
        Some(file) if unified::is_u3m(file) => unified::material(file, plain, asked.is_some(), cx),
        Some(file) => bitmap(file, cx).map(|image| Material { image: Some(image), ..plain }),
    };
    errors.finish_with(made)
}

/// A bitmap, read.
fn bitmap(file: &str, cx: &mut StageContext<'_>) -> Result<Image, StageError> {
    picture(&cx.files.read(Path::new(file))?, file)
}

/// A bitmap from its bytes; `file` is its name for messages.
fn picture(bytes: &[u8], file: &str) -> Result<Image, StageError> {
    read_image(bytes, file).map_err(|finding| match finding.code == FILE_TOO_LARGE {
        true => StageError::Limit(finding.to_string()),
        false => StageError::input(*finding),
    })
}

/// Metres of cloth: u along the weft, v along the warp. A mesh whose rest shape has no flat layout uses its picture.
fn cloth_coordinates(piece: &Piece) -> Vec<[f64; 2]> {
    let warp = piece.warp();
    // The right side of the cloth is up: the weft lies clockwise of the warp.
    let weft = toile_garment::Vec2::new(warp.y, -warp.x);
    piece.mesh.iter().flat_map(|m| &m.rest).map(|r| [r.dot(&weft), r.dot(&warp)]).collect()
}
