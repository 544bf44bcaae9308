//! Verdicts in the form of JUnit, which CI programs read.

use std::fmt::Write as _;
use toile_formats::svg::canvas::escape;

/// One case.
pub struct Case {
    /// The group that it belongs to, such as its style or file.
    pub class: String,
    /// Name.
    pub name: String,
    /// Wall time, s, where it may be told.
    pub seconds: Option<f64>,
    /// How it ended.
    pub end: End,
}

/// How a case ended.
pub enum End {
    /// It passed.
    Passed,
    /// The result is not as asked: a word, and why.
    Failed(String, String),
    /// There is no result to judge: a word, and why.
    Broken(String, String),
}

/// The file.
#[must_use]
pub fn xml(suite: &str, cases: &[Case]) -> String {
    let count = |is: fn(&End) -> bool| cases.iter().filter(|c| is(&c.end)).count();
    let time = |seconds: Option<f64>| seconds.map_or_else(String::new, |s| format!(" time=\"{s:.3}\""));
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\"{}>\n",
        escape(suite),
        cases.len(),
        count(|e| matches!(e, End::Failed(..))),
        count(|e| matches!(e, End::Broken(..))),
        time(cases.iter().map(|c| c.seconds).sum()),
    );
    for case in cases {
        let inner = |tag: &str, word: &str, why: &str| {
            // Each line is a text of its own: line ends stay, whatever else is in it.
            let why: Vec<String> = why.lines().map(escape).collect();
            format!("<{tag} message=\"{}\">{}</{tag}>", escape(word), why.join("\n"))
        };
        let inner = match &case.end {
            End::Passed => String::new(),
            End::Failed(word, why) => inner("failure", word, why),
            End::Broken(word, why) => inner("error", word, why),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(
            out,
            "  <testcase classname=\"{}\" name=\"{}\"{}>{inner}</testcase>",
            escape(&case.class),
            escape(&case.name),
            time(case.seconds)
        );
    }
    out + "</testsuite>\n"
}
