//! `[plugin.NAME]`: programs that hold stages. Declared here, run only with consent.

use super::codes;
use super::document::{Reader, is_name};
use std::ops::Range;
use std::str::FromStr;
use toile_formats::codes::OUT_OF_RANGE;
use toile_garment::units::Duration;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Longest time a plugin may run when the file says nothing, seconds.
pub const DEFAULT_TIMEOUT: f64 = 600.0;

/// A declared program.
#[derive(Clone, Debug, PartialEq)]
pub struct Plugin {
    /// Its name: stages are `name.stage`.
    pub name: String,
    /// Program and arguments; never given to a shell.
    pub command: Vec<String>,
    /// Longest time for one stage, seconds.
    pub timeout: f64,
    /// Where it is declared.
    pub span: Range<usize>,
}

pub(super) fn read_plugins(cx: &mut Reader<'_>, root: &DeTable<'_>) -> Vec<Plugin> {
    let Some((table, _)) = cx.table(root, "plugin", &(0..0)) else { return Vec::new() };
    table.iter().filter_map(|(key, value)| read_plugin(cx, key.get_ref(), key.span(), value)).collect()
}

fn read_plugin(cx: &mut Reader<'_>, name: &str, span: Range<usize>, value: &Spanned<DeValue<'_>>) -> Option<Plugin> {
    if !is_name(name) {
        let hint = "use lower-case letters, digits and hyphens, beginning with a letter";
        cx.push(codes::BAD_NAME, &span, format!("`{name}` is no good plugin name"), hint);
        return None;
    }
    let DeValue::Table(table) = value.get_ref() else {
        cx.wrong_type(value, name, "a table with `command = [\"program\", …]`");
        return None;
    };
    cx.refuse_unknown(table, &["command", "timeout"], &format!("[plugin.{name}]"));
    cx.require(table, "command", &span, "command = [\"program\", \"argument\", …]");
    let timeout = read_timeout(cx, table);
    let command = read_command(cx, table.get("command")?)?;
    Some(Plugin { name: name.to_owned(), command, timeout, span })
}

fn read_command(cx: &mut Reader<'_>, value: &Spanned<DeValue<'_>>) -> Option<Vec<String>> {
    let words: Option<Vec<String>> = match value.get_ref() {
        DeValue::Array(items) => items.iter().map(|i| i.get_ref().as_str().map(str::to_owned)).collect(),
        _ => None,
    };
    let good = words.filter(|w| !w.is_empty() && !w[0].is_empty() && w.iter().all(|s| !s.contains('\0')));
    if good.is_none() {
        cx.wrong_type(value, "command", "a list of texts: [\"program\", \"argument\", …]; no shell is involved");
    }
    good
}

fn read_timeout(cx: &mut Reader<'_>, table: &DeTable<'_>) -> f64 {
    let Some(text) = cx.text(table, "timeout") else { return DEFAULT_TIMEOUT };
    match Duration::from_str(text.get_ref()) {
        Ok(Duration(seconds)) if seconds > 0.0 && seconds <= 86_400.0 => seconds,
        Ok(_) => {
            let message = "the timeout must be above 0 s and at most a day".to_owned();
            cx.push(OUT_OF_RANGE, &text.span(), message, "write e.g. timeout = \"10 min\"");
            DEFAULT_TIMEOUT
        }
        Err(error) => {
            cx.push(codes::WRONG_TYPE, &text.span(), error.message, "write e.g. timeout = \"10 min\"");
            DEFAULT_TIMEOUT
        }
    }
}
