//! The results of the cases: for people, for programs, for GitHub and as JUnit.

use super::{TestFile, Tested};
use crate::engine::clean;
use crate::junit::{Case, End};
use serde_json::{Value, json};
use std::fmt::Write as _;
use toile_garment::{Diagnostic, Severity};

/// For people: a line for each case, and what differs below it.
#[must_use]
pub fn text(files: &[TestFile], tested: &[Tested]) -> String {
    let mut out = String::new();
    let mut last = None;
    for t in tested {
        if last != Some(t.file) {
            // Writing to a String cannot fail.
            let _ = writeln!(out, "{}", clean(&files[t.file].path));
            last = Some(t.file);
        }
        let case = &files[t.file].cases[t.case];
        let verdict = match (t.verdict.has_passed(), case.judges()) {
            (false, _) => "failed",
            (true, true) => "passed",
            (true, false) => "passed, but it judges nothing: its run ended well, and no figure or hash is asked for",
        };
        let _ = writeln!(out, "  {}: {verdict}", case.name);
        for why in whys(t) {
            let _ = writeln!(out, "    {why}");
        }
    }
    let passed = tested.iter().filter(|t| t.verdict.has_passed()).count();
    let _ = writeln!(out, "{} cases: {passed} passed, {} failed", tested.len(), tested.len() - passed);
    out
}

/// Why a case failed: what differs, and the errors of a run that did not end as it should.
fn whys(tested: &Tested) -> Vec<String> {
    let verdict = &tested.verdict;
    if verdict.has_passed() {
        return Vec::new();
    }
    let errors = verdict.errors().map(|f| format!("{}: {}", f.code, f.message));
    verdict.differences.iter().map(|d| d.why.clone()).chain(errors).collect()
}

/// For programs.
#[must_use]
pub fn to_json(files: &[TestFile], tested: &[Tested]) -> Value {
    let one = |t: &Tested| {
        let (file, case) = (&files[t.file], &files[t.file].cases[t.case]);
        json!({
            "file": file.source.file(),
            "line": file.source.place(&case.span).line,
            "case": case.name,
            "passed": t.verdict.has_passed(),
            "judges": case.judges(),
            "exit_code": t.verdict.exit.code(),
            "differences": t.verdict.differences,
            "findings": t.verdict.findings,
            "figures": t.verdict.figures,
            "outputs": t.verdict.outputs,
        })
    };
    let passed = tested.iter().filter(|t| t.verdict.has_passed()).count();
    json!({
        "toile_test": 1,
        "passed": passed,
        "failed": tested.len() - passed,
        "cases": tested.iter().map(one).collect::<Vec<_>>(),
    })
}

/// Lines that GitHub shows beside the file.
#[must_use]
pub fn github(files: &[TestFile], tested: &[Tested]) -> String {
    let mut out = String::new();
    for t in tested.iter().filter(|t| !t.verdict.has_passed()) {
        let (file, case) = (&files[t.file], &files[t.file].cases[t.case]);
        for difference in &t.verdict.differences {
            let place = file.source.place(&difference.span);
            out.push_str(&command("error", &place.file, place.line, &case.name, &difference.why));
        }
        let line = file.source.place(&case.span).line;
        for error in t.verdict.errors() {
            let why = format!("{}: {}", error.code, error.message);
            out.push_str(&command("error", file.source.file(), line, &case.name, &why));
        }
    }
    out
}

/// Findings as such lines.
#[must_use]
pub fn github_findings(findings: &[Diagnostic]) -> String {
    let line = |f: &Diagnostic| {
        let level = match f.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Info => "notice",
        };
        let source = f.source.as_ref();
        let remedy = f.hint.as_ref().map(|hint| format!("\nhelp: {hint}")).unwrap_or_default();
        let words = format!("{}{remedy}", f.message);
        command(level, source.map_or("", |s| &s.file), source.and_then(|s| s.line), &f.code, &words)
    };
    findings.iter().map(line).collect()
}

fn command(level: &str, file: &str, line: Option<u64>, title: &str, words: &str) -> String {
    let plain = |text: &str| {
        let text = toile_garment::text::shown(text, &['\n']);
        text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
    };
    let property = |text: &str| plain(text).replace(':', "%3A").replace(',', "%2C");
    let line = line.map(|line| format!(",line={line}")).unwrap_or_default();
    format!("::{level} file={}{line},title={}::{}\n", property(file), property(title), plain(words))
}

/// The verdicts in the form of JUnit. They hold no times, so the same results give the same bytes.
#[must_use]
pub fn junit(files: &[TestFile], tested: &[Tested]) -> String {
    let end = |t: &Tested| {
        if t.verdict.has_passed() {
            return End::Passed;
        }
        let (word, why) = (t.verdict.exit.word().to_owned(), whys(t).join("\n"));
        // Without a result there is nothing to compare.
        if t.verdict.exit.code() > 4 { End::Broken(word, why) } else { End::Failed("differs".to_owned(), why) }
    };
    let case = |t: &Tested| Case {
        class: clean(&files[t.file].path),
        name: files[t.file].cases[t.case].name.clone(),
        seconds: None,
        end: end(t),
    };
    crate::junit::xml("toile test", &tested.iter().map(case).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codes::WRONG_VALUE;
    use toile_garment::SourceRef;

    #[test]
    fn lines_for_github_are_one_line_each_and_escaped() {
        let place = SourceRef { file: "a:b,c.toml".into(), line: Some(3), ..SourceRef::default() };
        let finding = Diagnostic::error(WRONG_VALUE, "100 %\u{1b}").at(place).hint("less");
        let text = github_findings(&[finding]);
        assert_eq!(text, "::error file=a%3Ab%2Cc.toml,line=3,title=wrong-value::100 %25\\u{1b}%0Ahelp: less\n");
    }
}
