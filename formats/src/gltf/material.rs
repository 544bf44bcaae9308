//! Materials, textures and images of the GLB.

use super::write::{Buffer, extras};
use gltf_json as json;
use json::extensions::texture::{Info as InfoExtensions, TextureTransform, TextureTransformScale};
use json::validation::Checked::Valid;
use serde_json::json;
use toile_garment::texture::{Image, Material};

/// Smallest repeat that is written, metres: the scale stays a finite number.
const MIN_REPEAT: f64 = 1e-6;
/// Name of the extension that repeats a bitmap.
const TRANSFORM: &str = "KHR_texture_transform";
/// Name of the extension for the light of fibres.
const SHEEN: &str = "KHR_materials_sheen";

/// Adds a fabric to the document. Where coordinates are in metres, bitmaps are repeated by an extension.
pub fn push(root: &mut json::Root, buffer: &mut Buffer, material: &Material, in_metres: bool) {
    let texture = material.image.as_ref().map(|i| texture(root, buffer, i, &material.name));
    let factor = |x: f64| if x.is_finite() { x.clamp(0.0, 1.0) as f32 } else { 1.0 };
    let [r, g, b] = material.color.map(factor);
    let pbr = json::material::PbrMetallicRoughness {
        base_color_factor: json::material::PbrBaseColorFactor([r, g, b, 1.0]),
        base_color_texture: texture.map(|index| info(root, index, material.repeat, in_metres)),
        metallic_factor: json::material::StrengthFactor(0.0),
        roughness_factor: json::material::StrengthFactor(factor(material.roughness)),
        ..Default::default()
    };
    let normal = material.normal.as_ref().map(|image| normal(root, buffer, image, material, in_metres));
    let extensions = material.sheen.map(|sheen| {
        uses(root, SHEEN);
        let value =
            json!({ "sheenColorFactor": sheen.color.map(factor), "sheenRoughnessFactor": factor(sheen.roughness) });
        let others = [(SHEEN.to_owned(), value)].into_iter().collect();
        json::extensions::material::Material { others, ..Default::default() }
    });
    root.push(json::Material {
        name: Some(material.name.clone()),
        double_sided: true,
        pbr_metallic_roughness: pbr,
        normal_texture: normal,
        extensions,
        extras: extras("repeat_m", &json!(material.repeat)),
        ..Default::default()
    });
}

/// Declares an extension once.
pub fn uses(root: &mut json::Root, extension: &str) {
    if !root.extensions_used.iter().any(|e| e == extension) {
        root.extensions_used.push(extension.to_owned());
    }
}

/// The texture of a bitmap; equal bitmaps lie in the file once.
fn texture(root: &mut json::Root, buffer: &mut Buffer, image: &Image, name: &str) -> json::Index<json::Texture> {
    if let Some((_, known)) = buffer.textures.iter().find(|(bytes, _)| *bytes == image.bytes) {
        return *known;
    }
    let view = buffer.view(root, &image.bytes, None);
    let source = root.push(json::Image {
        buffer_view: Some(view),
        mime_type: Some(json::image::MimeType(image.mime.clone())),
        name: Some(name.to_owned()),
        uri: None,
        extensions: None,
        extras: None,
    });
    let sampler = if root.samplers.is_empty() { root.push(sampler()) } else { json::Index::new(0) };
    let made = root.push(json::Texture { name: None, sampler: Some(sampler), source, extensions: None, extras: None });
    buffer.textures.push((image.bytes.clone(), made));
    made
}

/// TEXCOORD_0 is in metres of cloth: one repeat is one turn of the texture.
pub fn scale(repeat: [f64; 2]) -> [f32; 2] {
    repeat.map(|m| if m.is_finite() { (1.0 / m.max(MIN_REPEAT)) as f32 } else { 1.0 })
}

fn info(
    root: &mut json::Root,
    index: json::Index<json::Texture>,
    repeat: [f64; 2],
    in_metres: bool,
) -> json::texture::Info {
    if !in_metres {
        return json::texture::Info { index, tex_coord: 0, extensions: None, extras: None };
    }
    uses(root, TRANSFORM);
    let transform = TextureTransform {
        scale: TextureTransformScale(scale(repeat)),
        // `None` would be written as null, which is not allowed.
        tex_coord: Some(0),
        ..Default::default()
    };
    json::texture::Info {
        index,
        tex_coord: 0,
        extensions: Some(InfoExtensions { texture_transform: Some(transform), ..Default::default() }),
        extras: None,
    }
}

fn normal(
    root: &mut json::Root,
    buffer: &mut Buffer,
    image: &Image,
    material: &Material,
    in_metres: bool,
) -> json::material::NormalTexture {
    let index = texture(root, buffer, image, &format!("{} normals", material.name));
    if !in_metres {
        return json::material::NormalTexture { index, scale: 1.0, tex_coord: 0, extensions: None, extras: None };
    }
    uses(root, TRANSFORM);
    let others = [(TRANSFORM.to_owned(), json!({ "scale": scale(material.repeat), "texCoord": 0 }))];
    json::material::NormalTexture {
        index,
        scale: 1.0,
        tex_coord: 0,
        extensions: Some(json::extensions::material::NormalTexture { others: others.into_iter().collect() }),
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
