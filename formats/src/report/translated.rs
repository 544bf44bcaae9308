//! Tells a finished page in another language: its sentences are found in the catalogue, with the values in them.
//!
//! Studies, comparisons, differences, lines and proposals write English pages. What stands in `code` or is marked by
//! `translate="no"`, and what is in no catalogue, stays.

use super::catalogue::CATALOGUE;
use super::pages::PAGES;
use super::words::Language;
use crate::svg::canvas::escape;

/// Attributes that hold words.
const SPOKEN: [&str; 4] = ["aria-label=\"", "alt=\"", "title=\"", "data-empty=\""];
/// Elements whose text is no text of the page.
const SILENT: [&str; 4] = ["script", "style", "code", "pre"];
/// A sentence of the report's catalogue is found again by so many letters of its own.
const OWN_LETTERS: usize = 8;
/// A phrase of fewer letters of its own holds numbers alone.
const FEW_LETTERS: usize = 4;

impl Language {
    /// A sentence as a page has it, values and all; `None` where it is not known.
    #[must_use]
    pub fn told(self, english: &str) -> Option<String> {
        if self == Self::English || !english.chars().any(|c| c.is_ascii_alphabetic()) {
            return None;
        }
        let exact = |all: &[(&str, &'static str)]| all.iter().find(|(e, _)| *e == english).map(|(_, c)| *c);
        if let Some(chinese) = exact(PAGES).or_else(|| exact(CATALOGUE)) {
            return Some(chinese.to_owned());
        }
        let is_list = english.contains("; ");
        if let Some((values, chinese)) = best(english).filter(|(_, c)| !is_list || c.contains('；')) {
            let values: Vec<String> = values.iter().map(|v| self.told(v).unwrap_or_else(|| (*v).to_owned())).collect();
            return Some(filled(chinese, &values));
        }
        if !is_list {
            return None;
        }
        let parts: Vec<&str> = english.split("; ").collect();
        let told: Vec<Option<String>> = parts.iter().map(|p| self.told(p)).collect();
        let all = told.iter().zip(&parts).map(|(t, p)| t.clone().unwrap_or_else(|| (*p).to_owned()));
        told.iter().any(Option::is_some).then(|| all.collect::<Vec<_>>().join("；"))
    }

    /// A page of this program in this language.
    #[must_use]
    pub fn page(self, html: &str) -> String {
        if self == Self::English {
            return html.to_owned();
        }
        let mut out = String::with_capacity(html.len());
        let (mut rest, mut silent): (&str, Option<&str>) = (html, None);
        while let Some(at) = rest.find('<') {
            let (text, tag) = rest.split_at(at);
            out.push_str(&if silent.is_some() { text.to_owned() } else { self.text(text) });
            let end = tag.find('>').map_or(tag.len(), |k| k + 1);
            let (tag, after) = tag.split_at(end);
            match silent {
                Some(name) if tag.strip_prefix("</").is_some_and(|t| t.starts_with(name)) => silent = None,
                Some(_) => {}
                None => silent = silent_element(tag),
            }
            out.push_str(&if silent.is_some() { tag.to_owned() } else { self.tag_told(tag) });
            rest = after;
        }
        out + rest
    }

    /// The text between two tags, with the spaces around it.
    fn text(self, text: &str) -> String {
        let inner = text.trim();
        match self.told(&plain(inner).split_whitespace().collect::<Vec<_>>().join(" ")) {
            Some(told) => text.replacen(inner, &escape(&told), 1),
            None => text.to_owned(),
        }
    }

    fn tag_told(self, tag: &str) -> String {
        let mut out = tag.to_owned();
        if out.starts_with("<html lang=\"en\"") {
            out = out.replacen("\"en\"", &format!("\"{}\"", self.tag()), 1);
        }
        for key in SPOKEN {
            let Some((before, after)) = out.split_once(key) else { continue };
            let Some((value, after)) = after.split_once('"') else { continue };
            if let Some(told) = self.told(&plain(value)) {
                out = format!("{before}{key}{}\"{after}", escape(&told));
            }
        }
        out
    }

    /// Words for a script of a page as JSON, safe inside a script element; `null` in English.
    #[must_use]
    pub fn script_words(self, english: &[&str]) -> String {
        let pairs = english.iter().filter_map(|e| Some(((*e).to_owned(), self.told(e)?.into())));
        let words: serde_json::Map<String, serde_json::Value> = pairs.collect();
        if words.is_empty() {
            "null".to_owned()
        } else {
            serde_json::Value::Object(words).to_string().replace('<', "\\u003c")
        }
    }
}

/// The name of the element that a tag begins, where its text stays: code, and what is marked as a name.
fn silent_element(tag: &str) -> Option<&str> {
    let name = tag.strip_prefix('<')?.split(['>', ' ', '\n', '/']).next()?;
    (SILENT.contains(&name) || tag.contains(" translate=\"no\"")).then_some(name)
}

/// Text as it was before it was made safe for HTML.
fn plain(text: &str) -> String {
    let pairs = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")];
    pairs.iter().fold(text.to_owned(), |t, (safe, letter)| t.replace(safe, letter))
}

/// The phrase that says most of a sentence, as its values and its Chinese. One of few letters holds numbers alone.
fn best(english: &str) -> Option<(Vec<&str>, &'static str)> {
    let long = CATALOGUE.iter().filter(|(e, _)| own_letters(e) >= OWN_LETTERS);
    let has_letters = |v: &&str| v.chars().any(|c| c.is_ascii_alphabetic());
    let fits = |(e, c): &(&'static str, &'static str)| {
        let (values, letters) = (values_in(e, english)?, own_letters(e));
        (letters >= FEW_LETTERS || !values.iter().any(has_letters)).then_some((letters, values, *c))
    };
    let (_, values, chinese) = PAGES.iter().chain(long).filter_map(fits).max_by_key(|(letters, ..)| *letters)?;
    Some((values, chinese))
}

/// The stretches of a phrase around its values, and the numbers of these.
fn parts(phrase: &str) -> (Vec<&str>, Vec<usize>) {
    let (mut words, mut slots, mut rest) = (Vec::new(), Vec::new(), phrase);
    while let Some((before, after)) = rest.split_once('{') {
        let Some((number, tail)) = after.split_once('}') else { break };
        let Ok(number) = number.parse() else { break };
        words.push(before);
        slots.push(number);
        rest = tail;
    }
    words.push(rest);
    (words, slots)
}

fn own_letters(phrase: &str) -> usize {
    parts(phrase).0.iter().flat_map(|w| w.chars()).filter(char::is_ascii_alphabetic).count()
}

/// The values of a phrase in a sentence, by their numbers; `None` where it is another sentence.
fn values_in<'t>(phrase: &str, sentence: &'t str) -> Option<Vec<&'t str>> {
    let (words, slots) = parts(phrase);
    let (last, between) = words.split_last()?;
    let (first, between) = between.split_first()?;
    let mut rest = sentence.strip_prefix(first)?.strip_suffix(last)?;
    let mut values = vec![""; slots.iter().max()? + 1];
    for (slot, word) in slots.iter().zip(between) {
        let (value, after) = rest.split_once(word)?;
        values[*slot] = value;
        rest = after;
    }
    values[*slots.last()?] = rest;
    values.iter().all(|v| !v.is_empty()).then_some(values)
}

fn filled(phrase: &str, values: &[String]) -> String {
    let (words, slots) = parts(phrase);
    let values = slots.iter().map(|k| values.get(*k).map_or("", String::as_str)).chain([""]);
    words.iter().zip(values).map(|(w, v)| format!("{w}{v}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_is_found_with_its_values() {
        let told = |english: &str| Language::Chinese.told(english);
        assert_eq!(
            told("4 jobs: 2 differ, 1 over the tolerance.").as_deref(),
            Some("4 个任务：2 个有差异，1 个超出公差。")
        );
        assert_eq!(told("FRONT, outline moved by at most").as_deref(), Some("FRONT，轮廓最大移动"));
        assert_eq!(
            told("preset draft: 15 mm promised, held; recommended").as_deref(),
            Some("预设 粗略：承诺 15 mm，达到；推荐")
        );
        assert_eq!(
            told("edge BACK.2 from start to notch 1, 95 mm").as_deref(),
            Some("边 BACK.2 从 起点 到 剪口 1，95 mm")
        );
        assert_eq!(told("finest; on the front").as_deref(), Some("最细；在前沿上"));
        assert_eq!((told("150 on 152").as_deref(), told("WAIST on HEM")), (Some("150 对 152"), None));
        assert_eq!((told("FRONT"), told("12.5"), Language::English.told("mean")), (None, None, None));
    }

    #[test]
    fn a_page_is_told_but_for_its_code_and_its_names() {
        let page = "<html lang=\"en\">\n<h2>Openings</h2><p>Seams: 3.\n</p><code>start</code><td>A &amp; B, area</td>\
                    <script>const a = \"start\";</script><div aria-label=\"Openings\" class=\"start\">WAIST</div><h2 translate=\"no\">start</h2>";
        let want = "<html lang=\"zh-Hans\">\n<h2>开口</h2><p>缝线：3 条。\n</p><code>start</code><td>A &amp; B，面积</td>\
                    <script>const a = \"start\";</script><div aria-label=\"开口\" class=\"start\">WAIST</div><h2 translate=\"no\">start</h2>";
        assert_eq!(Language::Chinese.page(page), want);
        assert_eq!(Language::English.page(page), page);
    }

    #[test]
    fn every_phrase_of_the_pages_stands_once_and_keeps_its_values() {
        for (k, (english, chinese)) in PAGES.iter().enumerate() {
            assert!(PAGES[..k].iter().all(|(e, _)| e != english), "{english}");
            for mark in ["{0}", "{1}", "{2}", "{3}"] {
                assert_eq!(english.contains(mark), chinese.contains(mark), "{english}");
            }
        }
    }
}
