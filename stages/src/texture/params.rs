//! Parameters of the stage `texture`.

use super::codes;
use crate::codes::PIECE_UNKNOWN;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toile_formats::codes::VALUE_OUT_OF_RANGE;
use toile_garment::units::Length;
use toile_garment::{Diagnostic, Garment, Piece};

/// Parameters of `texture`: the look of the garment, and of single pieces.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TextureParams {
    /// Fabric bitmap, PNG or JPEG; without one the colour alone. A U3M material (.u3m, .u3ma) gives colour, bitmap, its
    /// size, normal map, roughness and sheen at once.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub image: Option<String>,
    /// Size of the bitmap on the cloth: along the weft, along the warp.
    pub repeat: [Length; 2],
    /// Draws bitmap, normal map and sheen from `[look]` of the fabric, for looks without a bitmap.
    pub weave: bool,
    /// Colour of the cloth, or the tint of the bitmap: `#rrggbb`. Default: with `weave` that of the fabric, else white.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<String>,
    /// Roughness, 0 (mirror) to 1 (chalk).
    pub roughness: f64,
    /// Space between pieces in the packed coordinates, in metres of cloth.
    pub margin: Length,
    /// Other looks, for pieces or materials by name.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub materials: Vec<Override>,
    /// Other colours of the same garment, to choose from in a viewer.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub colourways: Vec<ColourwayParam>,
}

/// A colourway. Materials that it does not name keep their colour.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ColourwayParam {
    /// Name, for people.
    pub name: String,
    /// Colour of the cloth: `#rrggbb`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<String>,
    /// Colours of other materials by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub materials: BTreeMap<String, String>,
}

/// The look of some pieces. What is left out is as for the whole garment.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Override {
    /// Name; pieces of this material take the look.
    pub name: String,
    /// Pieces that take it, whatever their material.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pieces: Vec<String>,
    /// Fabric bitmap, PNG or JPEG, or a U3M material (.u3m, .u3ma).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub image: Option<String>,
    /// Size of the bitmap on the cloth: along the weft, along the warp.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repeat: Option<[Length; 2]>,
    /// Colour: `#rrggbb`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<String>,
    /// Roughness, 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness: Option<f64>,
}

impl Default for TextureParams {
    fn default() -> Self {
        Self {
            image: None,
            repeat: [Length(0.1), Length(0.1)],
            weave: false,
            color: None,
            roughness: 0.9,
            margin: Length(0.01),
            materials: Vec::new(),
            colourways: Vec::new(),
        }
    }
}

/// One look with everything filled in.
pub struct Look<'a> {
    pub name: &'a str,
    pub image: Option<&'a str>,
    pub repeat: [Length; 2],
    pub color: Option<&'a str>,
    pub roughness: f64,
}

impl TextureParams {
    /// The default look, then the others in order.
    pub fn looks(&self) -> Vec<Look<'_>> {
        let base = Look {
            name: "cloth",
            image: self.image.as_deref(),
            repeat: self.repeat,
            color: self.color.as_deref(),
            roughness: self.roughness,
        };
        let others = self.materials.iter().map(|o| Look {
            name: &o.name,
            // Another colour without a bitmap of its own is a plain cloth.
            image: o.image.as_deref().or(if o.color.is_none() { self.image.as_deref() } else { None }),
            repeat: o.repeat.unwrap_or(self.repeat),
            color: o.color.as_deref().or(self.color.as_deref()),
            roughness: o.roughness.unwrap_or(self.roughness),
        });
        std::iter::once(base).chain(others).collect()
    }

    /// Index of the look of a piece: by its name, else by its material, else the default.
    pub fn material_of(&self, piece: &Piece) -> u32 {
        let named = self.materials.iter().position(|o| o.pieces.contains(&piece.name));
        let material = piece.material.as_ref();
        let same = || self.materials.iter().position(|o| Some(&o.name) == material);
        named.or_else(same).map_or(0, |i| u32::try_from(i + 1).unwrap_or(0))
    }

    /// The mistakes in the numbers and names.
    pub fn check(&self, garment: &Garment) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        for look in self.looks() {
            let name = look.name;
            if look.repeat.iter().any(|l| !(1e-4..=10.0).contains(&l.0)) {
                let message = format!("the repeat of `{name}` is {} × {}", look.repeat[0], look.repeat[1]);
                found.push(Diagnostic::error(VALUE_OUT_OF_RANGE, message).hint("allowed is 0.1 mm to 10 m"));
            }
            if !(0.0..=1.0).contains(&look.roughness) {
                let message = format!("the roughness of `{name}` is {}", look.roughness);
                found.push(Diagnostic::error(VALUE_OUT_OF_RANGE, message).hint("allowed is 0 to 1"));
            }
        }
        if !(0.0..=1.0).contains(&self.margin.0) {
            let message = format!("the margin is {}", self.margin);
            found.push(Diagnostic::error(VALUE_OUT_OF_RANGE, message).hint("allowed is 0 mm to 1 m"));
        }
        for (i, c) in self.colourways.iter().enumerate() {
            if c.name.is_empty() || self.colourways[..i].iter().any(|other| other.name == c.name) {
                let message = format!("colourway {} has no name of its own: `{}`", i + 1, c.name);
                found
                    .push(Diagnostic::error(codes::MATERIAL_NAME, message).hint("give every colourway another `name`"));
            }
            for name in c.materials.keys().filter(|n| !self.materials.iter().any(|m| m.name == **n)) {
                let message = format!("colourway `{}` colours the material `{name}`, which is not there", c.name);
                found.push(Diagnostic::error(codes::MATERIAL_NAME, message));
            }
        }
        for (i, o) in self.materials.iter().enumerate() {
            for piece in o.pieces.iter().filter(|p| garment.piece_named(p).is_none()) {
                let names: Vec<&str> = garment.pieces.iter().map(|p| p.name.as_str()).collect();
                let near = names.iter().min_by_key(|n| strsim::damerau_levenshtein(piece, n));
                let finding = Diagnostic::error(PIECE_UNKNOWN, format!("there is no piece `{piece}`"));
                found.push(finding.hint(near.map_or(String::new(), |n| format!("did you mean `{n}`?"))));
            }
            if o.name.is_empty() || o.name == "cloth" || self.materials[..i].iter().any(|m| m.name == o.name) {
                let message = format!("material {} has no name of its own: `{}`", i + 1, o.name);
                found.push(Diagnostic::error(codes::MATERIAL_NAME, message).hint("give every material another `name`"));
            }
            let used = garment.pieces.iter().any(|p| self.material_of(p) as usize == i + 1);
            if !used {
                found.push(Diagnostic::warning(
                    codes::MATERIAL_UNUSED,
                    format!("no piece has the material `{}`", o.name),
                ));
            }
        }
        found
    }
}
