//! Looks that are drawn from the fabric, and colourways.

use super::codes::LOOK_MISSING;
use super::color;
use super::params::TextureParams;
use toile_formats::texture::draw;
use toile_garment::fabric::FabricLook;
use toile_garment::texture::{Colourway, Material, Sheen};
use toile_garment::{Diagnostic, Garment};
use toile_stage_api::{StageContext, StageError};

/// Roughness of a sheen over that of a smooth and of a dull surface.
const SHEEN_ROUGHNESS: [f64; 2] = [0.25, 0.5];

/// Draws bitmaps of the fabrics for the materials that have none; a fabric without a look becomes a finding.
pub fn from_fabrics(params: &TextureParams, garment: &Garment, materials: &mut [Material], cx: &mut StageContext<'_>) {
    let looks = params.looks();
    for (k, material) in materials.iter_mut().enumerate().filter(|(_, m)| m.image.is_none()) {
        let Some(piece) = garment.pieces.iter().find(|p| params.material_of(p) as usize == k) else { continue };
        let fabric = garment.fabric_of(piece);
        match fabric.and_then(|f| f.look) {
            Some(look) => take(material, &look, looks.get(k).is_some_and(|l| l.color.is_some())),
            None => {
                let name = fabric.map_or("of this garment", |f| f.name.as_str());
                let finding = Diagnostic::warning(LOOK_MISSING, format!("the fabric `{name}` does not tell its weave"));
                cx.report.findings.push(finding.hint("add a table `[look]` to the fabric file"));
            }
        }
    }
}

/// Gives a material the look of a cloth; a colour that was asked for stays.
fn take(material: &mut Material, look: &FabricLook, has_color: bool) {
    if !has_color {
        material.color = look.color;
    }
    if let Some(drawn) = draw(look) {
        (material.image, material.normal, material.repeat) = (Some(drawn.image), Some(drawn.normal), drawn.repeat);
    }
    material.roughness = look.roughness;
    let [smooth, dull] = SHEEN_ROUGHNESS;
    let color = material.color.map(|c| look.sheen * (0.3 + 0.7 * c));
    material.sheen = (look.sheen > 0.0).then_some(Sheen { color, roughness: smooth + dull * look.roughness });
}

/// The colours of all materials in every colourway.
///
/// # Errors
/// A text that is no colour.
pub fn colourways(params: &TextureParams, materials: &[Material]) -> Result<Vec<Colourway>, StageError> {
    let mut out = Vec::new();
    for wanted in &params.colourways {
        let mut colors: Vec<[f64; 3]> = Vec::new();
        for (k, material) in materials.iter().enumerate() {
            let text = if k == 0 { wanted.color.as_ref() } else { wanted.materials.get(&material.name) };
            let color = text.map(|t| color::linear(t)).transpose();
            colors.push(color.map_err(|f| StageError::Parameter(vec![*f]))?.unwrap_or(material.color));
        }
        out.push(Colourway { name: wanted.name.clone(), colors });
    }
    Ok(out)
}
