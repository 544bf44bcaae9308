//! `{name}` in the texts of a stage's parameters. Spans survive: a filled text stands where the template stood.
//! On the way the one gate for numbers: none that is not finite gets through.

use super::codes;
use super::document::Reader;
use super::inputs::{InputKind, Values};
use super::nearest::remedy;
use crate::codes::WRONG_VALUE;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Fills every text below a table. Gives the keys with a text that could not be filled; why is in the report.
pub(super) fn fill_table<'v>(cx: &mut Reader<'_>, values: &'v Values, table: &mut DeTable<'v>) -> Vec<String> {
    let mut unfilled = Vec::new();
    for (key, value) in table.iter_mut() {
        let mut filler = Filler { cx: &mut *cx, values, whole: true };
        filler.value(value);
        if !filler.whole {
            unfilled.push(key.get_ref().to_string());
        }
    }
    unfilled
}

struct Filler<'a, 's, 'v> {
    cx: &'a mut Reader<'s>,
    values: &'v Values,
    whole: bool,
}

impl<'v> Filler<'_, '_, 'v> {
    fn table(&mut self, table: &mut DeTable<'v>) {
        for (_, value) in table.iter_mut() {
            self.value(value);
        }
    }

    fn value(&mut self, value: &mut Spanned<DeValue<'v>>) {
        let span = value.span();
        match value.get_mut() {
            DeValue::String(text) if text.contains(['{', '}']) => match self.text(text, &span) {
                Some(filled) => *value.get_mut() = filled,
                None => self.whole = false,
            },
            DeValue::Table(table) => self.table(table),
            DeValue::Array(items) => items.iter_mut().for_each(|item| self.value(item)),
            DeValue::Float(number) if !number.as_str().parse().is_ok_and(f64::is_finite) => {
                let message = format!("`{number}` is not a finite number");
                self.cx.push(WRONG_VALUE, &span, message, "write a finite number");
                self.whole = false;
            }
            _ => {}
        }
    }

    fn text(&mut self, text: &str, span: &Range<usize>) -> Option<DeValue<'v>> {
        if let Some((InputKind::Number, number)) = whole_name(text).and_then(|n| self.values.by_name.get(n)) {
            return DeValue::parse(number).ok().map(Spanned::into_inner);
        }
        let mut filled = String::with_capacity(text.len());
        let mut rest = text;
        while let Some(at) = rest.find(['{', '}']) {
            filled.push_str(&rest[..at]);
            let tail = &rest[at..];
            if tail.starts_with("{{") || tail.starts_with("}}") {
                filled.push_str(&tail[..1]);
                rest = &tail[2..];
            } else if let Some(after) = tail.strip_prefix('}') {
                filled.push('}');
                rest = after;
            } else {
                let Some(end) = tail.find('}') else {
                    let hint = "close it with `}`, or write `{{` for a brace";
                    self.cx.push(codes::OPEN_BRACE, span, format!("`{tail}` opens a name and does not close it"), hint);
                    return None;
                };
                filled.push_str(&self.named(&tail[1..end], filled.is_empty(), &tail[end + 1..], span)?);
                rest = &tail[end + 1..];
            }
        }
        filled.push_str(rest);
        Some(DeValue::String(filled.into()))
    }

    /// The value of `{name}`; `first` and `after` say what stands around it.
    fn named(&mut self, name: &str, first: bool, after: &str, span: &Range<usize>) -> Option<String> {
        let is_out = name == "out";
        let ends_well = !is_out || after.is_empty() || after.starts_with('/');
        if (is_out || self.values.mounts.contains_key(name)) && !(first && ends_well) {
            let hint = "write \"{out}/name.glb\"";
            self.cx.push(codes::OUT_NOT_FIRST, span, format!("`{{{name}}}` names a folder and must stand first"), hint);
            return None;
        }
        if is_out {
            // Kept as a name: the real folder must not get into the document, or bytes would differ between machines.
            return Some("{out}".to_owned());
        }
        if let Some((_, value)) = self.values.by_name.get(name) {
            return Some(value.clone());
        }
        if !self.values.missing.contains(name) {
            self.refuse(name, span);
        }
        None
    }

    fn refuse(&mut self, name: &str, span: &Range<usize>) {
        let known = self.values.by_name.keys().chain(&self.values.missing).map(String::as_str);
        let known: Vec<&str> = known.chain(["out"]).collect();
        let hint = format!("{}; a plain brace is written `{{{{`", remedy(name, known));
        self.cx.push(codes::UNKNOWN_INPUT, span, format!("`{{{name}}}` is not an input"), hint);
    }
}

/// The name, if the text is exactly `{name}`.
fn whole_name(text: &str) -> Option<&str> {
    text.strip_prefix('{')?.strip_suffix('}')
}
