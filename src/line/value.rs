//! Values of a line as overrides: `key=value` in the form of `--set`.

use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// An override, and where the line says it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Set {
    /// `key=value`.
    pub text: String,
    /// Its place in the file.
    pub span: Range<usize>,
}

impl Set {
    /// An override of one key.
    #[must_use]
    pub fn new(key: &str, value: &str, span: Range<usize>) -> Self {
        Self { text: format!("{key}={value}"), span }
    }

    /// Key of the override.
    #[must_use]
    pub fn key(&self) -> &str {
        self.text.split('=').next().unwrap_or_default()
    }
}

/// All values of a table as overrides; keys of inner tables are joined by dots.
pub(crate) fn sets(table: &DeTable<'_>) -> Vec<Set> {
    let mut found = Vec::new();
    collect(table, "", &mut found);
    found
}

fn collect(table: &DeTable<'_>, before: &str, found: &mut Vec<Set>) {
    for (key, value) in table {
        let key = format!("{before}{}", key.get_ref());
        match value.get_ref() {
            DeValue::Table(inner) => collect(inner, &format!("{key}."), found),
            _ => found.extend(raw(value).map(|text| Set::new(&key, &text, value.span()))),
        }
    }
}

/// A value as `--set` takes it.
pub(super) fn raw(value: &Spanned<DeValue<'_>>) -> Option<String> {
    match value.get_ref() {
        DeValue::String(text) => Some(text.to_string()),
        other => toml_text(other),
    }
}

/// A value as TOML.
fn toml_text(value: &DeValue<'_>) -> Option<String> {
    Some(match value {
        DeValue::String(text) => toml::Value::String(text.to_string()).to_string(),
        DeValue::Integer(number) => number.to_string(),
        DeValue::Float(number) => number.to_string(),
        DeValue::Boolean(word) => word.to_string(),
        DeValue::Datetime(time) => time.to_string(),
        DeValue::Array(items) => {
            let items: Option<Vec<String>> = items.iter().map(|i| toml_text(i.get_ref())).collect();
            format!("[{}]", items?.join(", "))
        }
        DeValue::Table(table) => {
            let cell = |(k, v): (&Spanned<std::borrow::Cow<'_, str>>, &Spanned<DeValue<'_>>)| {
                Some(format!("{} = {}", toml::Value::String(k.get_ref().to_string()), toml_text(v.get_ref())?))
            };
            let cells: Option<Vec<String>> = table.iter().map(cell).collect();
            format!("{{ {} }}", cells?.join(", "))
        }
    })
}

/// The label of a plain value: the stem of a path, with a hyphen for every sign that no file name should have.
pub(super) fn label(text: &str) -> String {
    let name = text.rsplit('/').next().unwrap_or(text);
    let stem = if text.contains('/') { name.rsplit_once('.').map_or(name, |(stem, _)| stem) } else { name };
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '.' || c == '-' { c } else { '-' };
    stem.trim().chars().map(plain).collect::<String>().trim_matches('-').trim_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::label;

    #[test]
    fn labels_can_stand_in_names_of_folders() {
        assert_eq!(label("38"), "38");
        assert_eq!(label("fabrics/Wool 2.toml"), "Wool-2");
        assert_eq!(label("12.5 mm"), "12.5-mm");
        assert_eq!(label("../.."), "");
    }
}
