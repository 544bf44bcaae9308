//! `[plugin.NAME]`: programs that hold stages. Declared here, run only with consent.

use super::codes;
use super::document::{Reader, is_name};
use std::ops::Range;
use std::str::FromStr;
use toile_formats::codes::OUT_OF_RANGE;
use toile_garment::units::Duration;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Fewest digits of a digest that name a content: 64 bits.
const LEAST_DIGITS: usize = 16;
/// Digits of a whole digest.
const MOST_DIGITS: usize = 64;
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
    /// Digest of its files, or the beginning of it, where the pipeline states which content it means.
    pub content: Option<Spanned<String>>,
    /// Where it is declared.
    pub span: Range<usize>,
}

/// The program of a plugin as its files are now.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct ProgramContent {
    /// Name of the plugin.
    pub plugin: String,
    /// Digest of its command and of the files that the command names.
    pub content: String,
    /// Does the pipeline or the caller state its content?
    #[serde(rename = "stated")]
    pub is_stated: bool,
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
    cx.refuse_unknown(table, &["command", "timeout", "content"], &format!("[plugin.{name}]"));
    cx.require(table, "command", &span, "command = [\"program\", \"argument\", …]");
    let (timeout, content) = (read_timeout(cx, table), read_content(cx, table));
    let command = read_command(cx, table.get("command")?)?;
    Some(Plugin { name: name.to_owned(), command, timeout, content, span })
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

/// Is this a digest in lower-case digits, long enough that nobody makes another program of it?
fn names_content(text: &str) -> bool {
    let is_digit = |b: u8| b.is_ascii_digit() || (b'a'..=b'f').contains(&b);
    (LEAST_DIGITS..=MOST_DIGITS).contains(&text.len()) && text.bytes().all(is_digit)
}

fn read_content(cx: &mut Reader<'_>, table: &DeTable<'_>) -> Option<Spanned<String>> {
    let text = cx.text(table, "content")?;
    if !names_content(text.get_ref()) {
        let message =
            format!("`content` must be {LEAST_DIGITS} to {MOST_DIGITS} digits of a digest, 0 to 9 and a to f");
        cx.push(OUT_OF_RANGE, &text.span(), message, "leave it out: `toile plan` tells the content to write");
    }
    Some(text)
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
