//! Colourways as `KHR_materials_variants`: the colours of the garment first, then every other colourway.

use super::material;
use super::write::Buffer;
use gltf_json as json;
use serde_json::{Map, Value, json};
use toile_garment::texture::{Material, Textures};

/// Name of the extension.
const VARIANTS: &str = "KHR_materials_variants";
/// Name of the variant with the colours of the garment itself.
const OWN: &str = "as sewn";

/// Adds the materials of all colourways after those of the garment, and the names of the variants.
pub fn push(root: &mut json::Root, buffer: &mut Buffer, textures: &Textures, in_metres: bool) {
    if textures.colourways.is_empty() {
        return;
    }
    for colourway in &textures.colourways {
        for (material, color) in textures.materials.iter().zip(&colourway.colors) {
            let name = format!("{} {}", material.name, colourway.name);
            material::push(root, buffer, &Material { name, color: *color, ..material.clone() }, in_metres);
        }
    }
    material::uses(root, VARIANTS);
    let names = std::iter::once(OWN).chain(textures.colourways.iter().map(|c| c.name.as_str()));
    let variants: Vec<Value> = names.map(|name| json!({ "name": name })).collect();
    let others = [(VARIANTS.to_owned(), json!({ "variants": variants }))].into_iter().collect();
    root.extensions = Some(json::extensions::root::Root { others });
}

/// The materials of one part in all variants; `None` without colourways.
pub fn of_part(textures: Option<&Textures>, material: u32) -> Option<json::extensions::mesh::Primitive> {
    let textures = textures.filter(|t| !t.colourways.is_empty())?;
    let step = textures.materials.len();
    let mapping = |k: usize| json!({ "material": material as usize + k * step, "variants": [k] });
    let mappings: Vec<Value> = (0..=textures.colourways.len()).map(mapping).collect();
    let others: Map<String, Value> = [(VARIANTS.to_owned(), json!({ "mappings": mappings }))].into_iter().collect();
    Some(json::extensions::mesh::Primitive { others })
}
