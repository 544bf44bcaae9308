//! The table `[look]`: weave, yarns, colour and sheen.

use super::codes;
use super::reader::Entries;
use crate::schema as form;
use crate::texture::linear;
use crate::toml_text::{TomlText, describe, did_you_mean};
use serde_json::{Map, Value, json};
use serde_spanned::Spanned;
use toile_garment::Diagnostic;
use toile_garment::fabric::{FabricLook, Weave};
use toml::de::DeValue;

/// Keys of the table that are words.
pub const WORDS: &[&str] = &["weave", "color"];

const WEAVES: [(&str, Weave); 9] = [
    ("plain", Weave::Plain),
    ("basket", Weave::Basket),
    ("twill", Weave::Twill),
    ("warp-twill", Weave::WarpTwill),
    ("satin", Weave::Satin),
    ("crepe", Weave::Crepe),
    ("jersey", Weave::Jersey),
    ("pile", Weave::Pile),
    ("cord", Weave::Cord),
];

/// Yarns per centimetre, where the file does not tell them.
const YARNS: f64 = 25.0;
/// Roughness, where the file does not tell it.
const ROUGHNESS: f64 = 0.85;

/// Reads a word of the table.
pub fn read(toml: &TomlText<'_>, word: &str, value: &Spanned<DeValue<'_>>, out: &mut Entries) {
    let Some(key) = WORDS.iter().find(|w| **w == word) else { return };
    match value.get_ref().as_str() {
        Some(text) => {
            out.words.insert(key, (text.to_owned(), toml.place(value)));
        }
        None => {
            let message = format!("`{word}` must be a text, not {}", describe(value.get_ref()));
            out.findings.push(Diagnostic::error(codes::FABRIC_VALUE, message).at(toml.place(value)));
        }
    }
}

/// The look; `None` where the file has none. Wrong words become findings.
pub fn look(e: &mut Entries) -> Option<FabricLook> {
    let number =
        |e: &Entries, key: &str| e.values.iter().find(|((t, k), _)| *t == "look" && *k == key).map(|(_, v)| v.value);
    let told = ["ends_per_cm", "picks_per_cm", "sheen", "roughness"].map(|key| number(e, key));
    if told.iter().all(Option::is_none) && e.words.is_empty() {
        return None;
    }
    let weave = word(
        e,
        "weave",
        "plain",
        |text| WEAVES.iter().find(|(n, _)| *n == text).map(|(_, w)| *w),
        |text| did_you_mean(text, WEAVES.iter().map(|(n, _)| *n)),
    );
    let color = word(e, "color", "#cfc6b4", linear, |_| "write it in hexadecimal, e.g. \"#d8c8b0\"".to_owned());
    let [ends, picks, sheen, roughness] = told;
    Some(FabricLook {
        weave: weave?,
        ends: 100.0 * ends.unwrap_or(YARNS),
        picks: 100.0 * picks.unwrap_or(YARNS),
        color: color?,
        sheen: sheen.unwrap_or(0.0),
        roughness: roughness.unwrap_or(ROUGHNESS),
    })
}

fn word<T>(
    e: &mut Entries,
    key: &str,
    usual: &str,
    value: impl Fn(&str) -> Option<T>,
    hint: impl Fn(&str) -> String,
) -> Option<T> {
    let Some((text, at)) = e.words.get(key) else { return value(usual) };
    let found = value(text);
    if found.is_none() {
        let finding = Diagnostic::error(codes::FABRIC_VALUE, format!("there is no {key} `{text}`")).at(at.clone());
        let finding = finding.hint(hint(text));
        e.findings.push(finding);
    }
    found
}

/// The words in the JSON schema of a fabric file.
pub fn schema() -> Map<String, Value> {
    let weaves: Vec<&str> = WEAVES.iter().map(|(n, _)| *n).collect();
    let weave = json!({ "description": "Weave or knit. Default: plain.", "type": "string", "enum": weaves });
    Map::from_iter([("weave".to_owned(), weave), ("color".to_owned(), form::text("Colour, `#rrggbb`."))])
}
