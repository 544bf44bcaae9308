//! Materials, textures and images of the GLB.

use super::write::{Buffer, extras};
use gltf_json as json;
use json::extensions::texture::{Info as InfoExtensions, TextureTransform, TextureTransformScale};
use json::validation::Checked::Valid;
use toile_garment::texture::Material;

/// Smallest repeat that is written, metres: the scale stays a finite number.
const MIN_REPEAT: f64 = 1e-6;

/// Adds a fabric to the document.
pub fn push(root: &mut json::Root, buffer: &mut Buffer, material: &Material) {
    let texture = material.image.as_ref().map(|image| {
        let view = buffer.view(root, &image.bytes, None);
        let source = root.push(json::Image {
            buffer_view: Some(view),
            mime_type: Some(json::image::MimeType(image.mime.clone())),
            name: Some(material.name.clone()),
            uri: None,
            extensions: None,
            extras: None,
        });
        let sampler = if root.samplers.is_empty() { root.push(sampler()) } else { json::Index::new(0) };
        root.push(json::Texture { name: None, sampler: Some(sampler), source, extensions: None, extras: None })
    });
    let factor = |x: f64| if x.is_finite() { x.clamp(0.0, 1.0) as f32 } else { 1.0 };
    let [r, g, b] = material.color.map(factor);
    let pbr = json::material::PbrMetallicRoughness {
        base_color_factor: json::material::PbrBaseColorFactor([r, g, b, 1.0]),
        base_color_texture: texture.map(|index| info(root, index, material.repeat)),
        metallic_factor: json::material::StrengthFactor(0.0),
        roughness_factor: json::material::StrengthFactor(factor(material.roughness)),
        ..Default::default()
    };
    root.push(json::Material {
        name: Some(material.name.clone()),
        double_sided: true,
        pbr_metallic_roughness: pbr,
        extras: extras("repeat_m", &serde_json::json!(material.repeat)),
        ..Default::default()
    });
}

/// TEXCOORD_0 is in metres of cloth: one repeat is one turn of the texture.
fn info(root: &mut json::Root, index: json::Index<json::Texture>, repeat: [f64; 2]) -> json::texture::Info {
    const NAME: &str = "KHR_texture_transform";
    if !root.extensions_used.iter().any(|e| e == NAME) {
        root.extensions_used.push(NAME.to_owned());
    }
    let scale = repeat.map(|m| if m.is_finite() { (1.0 / m.max(MIN_REPEAT)) as f32 } else { 1.0 });
    let transform = TextureTransform {
        scale: TextureTransformScale(scale),
        // `None` would be written as null, which is not allowed.
        tex_coord: Some(0),
        ..Default::default()
    };
    json::texture::Info {
        index,
        tex_coord: 0,
        extensions: Some(InfoExtensions { texture_transform: Some(transform) }),
        extras: None,
    }
}

fn sampler() -> json::texture::Sampler {
    json::texture::Sampler {
        mag_filter: Some(Valid(json::texture::MagFilter::Linear)),
        min_filter: Some(Valid(json::texture::MinFilter::LinearMipmapLinear)),
        ..Default::default()
    }
}
