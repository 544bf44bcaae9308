//! Texture coordinates and materials.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A material: fabric bitmap with its size on the cloth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Material {
    /// Name.
    pub name: String,
    /// Base colour factor, linear RGB 0–1.
    pub color: [f64; 3],
    /// Encoded bitmap (PNG or JPEG), base64 in JSON; left out of the GLB extras, where it is an image of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<Image>,
    /// Size of one repeat on the cloth: weft × warp, metres.
    pub repeat: [f64; 2],
    /// glTF roughness 0–1.
    pub roughness: f64,
    /// Normal map with the same repeat, encoded as `image`; left out of the GLB extras as well.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<Image>,
    /// Light that fibres throw back at a flat angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sheen: Option<Sheen>,
}

/// Sheen of a cloth, after `KHR_materials_sheen`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Sheen {
    /// Colour, linear RGB 0–1.
    pub color: [f64; 3],
    /// Roughness 0–1: how wide the light spreads.
    pub roughness: f64,
}

/// The colours of all materials in one colourway.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Colourway {
    /// Name.
    pub name: String,
    /// Base colour factor of each material, linear RGB 0–1.
    pub colors: Vec<[f64; 3]>,
}

/// An encoded bitmap.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Image {
    /// `image/png` or `image/jpeg`.
    pub mime: String,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Encoded bytes.
    #[serde(default, with = "base64_bytes")]
    #[schemars(with = "String")]
    pub bytes: Vec<u8>,
}

/// Texture coordinates of one piece, one entry per mesh vertex.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PieceTexture {
    /// Index into `Textures::materials`.
    pub material: u32,
    /// Metres of cloth: u along the weft, v along the warp.
    pub uv_cloth: Vec<[f64; 2]>,
    /// All pieces packed without overlap into 0–1.
    pub uv_packed: Vec<[f64; 2]>,
}

/// Materials and the coordinates of every piece.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Textures {
    /// Materials.
    pub materials: Vec<Material>,
    /// One entry per piece.
    pub pieces: Vec<PieceTexture>,
    /// Other colours of the same garment.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub colourways: Vec<Colourway>,
}

mod base64_bytes {
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    use serde::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer>(bytes: &[u8], s: S) -> Result<S::Ok, S::Error> {
        s.serialize_str(&STANDARD.encode(bytes))
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<Vec<u8>, D::Error> {
        STANDARD.decode(String::deserialize(d)?).map_err(serde::de::Error::custom)
    }
}
