//! Tells the words of the page in its languages; they stand in the catalogue.

use super::catalogue::CATALOGUE;
use super::pages::PAGES;

/// A language of the page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// Chinese, in simplified letters.
    Chinese,
}

impl Language {
    /// Its tag, as HTML writes it.
    #[must_use]
    pub fn tag(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Chinese => "zh-Hans",
        }
    }

    /// A phrase in this language. English stands for itself, and for what has no translation, such as names.
    #[must_use]
    pub fn say(self, english: &str) -> &str {
        match self {
            Self::English => english,
            Self::Chinese => {
                let mut all = CATALOGUE.iter().chain(PAGES);
                all.find(|(e, _)| *e == english).map_or(english, |(_, c)| c)
            }
        }
    }

    /// The name of a measure: its words, and the side and number that may follow them.
    #[must_use]
    pub fn measure(self, english: &str) -> String {
        let known = |words: &str| self == Self::English || self.say(words) != words;
        match english.rsplit_once(' ') {
            Some((words, last)) if !known(english) => {
                let space = if self == Self::Chinese { "" } else { " " };
                format!("{}{space}{}", self.measure(words), self.say(last))
            }
            _ => self.say(english).to_owned(),
        }
    }

    /// Meaning and remedy of the findings of a code; the remedy may be empty. `None` where the finding's own words say
    /// it, as in English.
    #[must_use]
    pub fn finding(self, code: &str) -> Option<[&'static str; 2]> {
        match self {
            Self::English => None,
            Self::Chinese => super::chinese::of_code(code),
        }
    }

    /// A sentence with numbers: `{0}`, `{1}` stand for the values.
    #[must_use]
    pub fn fill(self, english: &str, values: &[String]) -> String {
        let (mut out, mut rest) = (String::new(), self.say(english));
        while let Some((before, after)) = rest.split_once('{') {
            out.push_str(before);
            let value = after.split_once('}').and_then(|(k, tail)| Some((values.get(k.parse::<usize>().ok()?)?, tail)));
            let (text, tail) = value.map_or(("{", after), |(value, tail)| (value.as_str(), tail));
            out.push_str(text);
            rest = tail;
        }
        out + rest
    }

    /// Sentences one after the other, as a cell of a table holds them.
    #[must_use]
    pub fn phrases(self, phrases: &[Phrase]) -> String {
        let values = |p: &Phrase| p.values.iter().map(|v| self.edge(v)).collect::<Vec<_>>();
        let told: Vec<String> = phrases.iter().map(|p| self.fill(p.words, &values(p))).collect();
        told.join(if self == Self::Chinese { "；" } else { "; " })
    }

    /// The name of an edge; one without a name of its own has its number.
    #[must_use]
    pub fn edge(self, name: &str) -> String {
        match name.strip_prefix("edge ") {
            Some(number) if number.parse::<u32>().is_ok() => self.fill("edge {0}", &[number.to_owned()]),
            _ => name.to_owned(),
        }
    }
}

/// Words of this program with the values in them, which can be told in every language.
#[derive(Clone, Debug, PartialEq)]
pub struct Phrase {
    /// The English words; `{0}`, `{1}` stand for the values.
    pub words: &'static str,
    /// The values.
    pub values: Vec<String>,
}

impl Phrase {
    /// Words with values.
    #[must_use]
    pub fn new(words: &'static str, values: impl IntoIterator<Item = String>) -> Self {
        Self { words, values: values.into_iter().collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_phrase_stands_once_and_keeps_its_values() {
        for (k, (english, chinese)) in CATALOGUE.iter().enumerate() {
            assert!(CATALOGUE[..k].iter().all(|(e, _)| e != english), "{english}");
            for mark in ["{0}", "{1}", "{2}", "{3}", "{height}", "{length}", "{value}", "{angle}"] {
                assert_eq!(english.contains(mark), chinese.contains(mark), "{english}");
            }
        }
        assert_eq!(
            Language::Chinese.fill("the cloth crosses itself at {0} places", &["3".into()]),
            "布料自身有 3 处穿插"
        );
        assert_eq!(Language::Chinese.say("FRONT"), "FRONT");
        let moved = Phrase::new("a notch on {0} moved by {1} mm", ["edge 4".to_owned(), "{0}".to_owned()]);
        assert_eq!(Language::English.phrases(std::slice::from_ref(&moved)), "a notch on edge 4 moved by {0} mm");
        assert_eq!(Language::Chinese.phrases(&[moved]), "边 4 上的剪口移动 {0} mm");
    }
}
