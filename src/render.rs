//! Findings as text or JSON.

use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use toile_formats::svg::canvas::escape;
use toile_garment::{Diagnostic, Severity};

/// Findings of one code that are shown one by one.
pub const MAX_PER_CODE: usize = 5;

/// One finding as text, safe for a terminal.
#[must_use]
pub fn finding_line(finding: &Diagnostic) -> String {
    safe(&finding.to_string())
}

/// Text in which control characters and those that turn its direction are written out: names come from files and must
/// not steer a terminal.
#[must_use]
pub fn safe(text: &str) -> String {
    toile_garment::text::shown(text, &['\n'])
}

/// A sentence as HTML; what stands between backticks becomes code.
#[must_use]
pub fn html(sentence: &str) -> String {
    let parts = sentence.split('`').enumerate();
    parts.map(|(i, part)| if i % 2 == 1 { format!("<code>{}</code>", escape(part)) } else { escape(part) }).collect()
}

/// Findings as a terminal shows them: notes of one code become one with their count. Reports and records keep all of them.
#[must_use]
pub fn grouped(findings: &[Diagnostic]) -> Vec<Diagnostic> {
    let is_note = |f: &Diagnostic| f.severity == Severity::Info;
    let alike = |f: &Diagnostic| findings.iter().filter(|o| is_note(o) && o.code == f.code).count();
    let mut seen: BTreeSet<&str> = BTreeSet::new();
    let mut out = Vec::new();
    for finding in findings {
        match alike(finding) {
            count if is_note(finding) && count > 1 => {
                if seen.insert(&finding.code) {
                    let mut one = finding.clone();
                    one.message.push_str(&format!(" (and {} more like this)", count - 1));
                    (one.source, one.hint) = (None, None);
                    out.push(one);
                }
            }
            _ => out.push(finding.clone()),
        }
    }
    out
}

/// Findings as text: the line of the source below each, the first few of a code one by one, the rest counted.
#[must_use]
pub fn findings_text(findings: &[Diagnostic], source: Option<(&str, &str)>) -> String {
    let findings = &grouped(findings);
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    let source = source.map(|(file, text)| (file, text.lines().collect::<Vec<_>>()));
    let mut out = String::new();
    for finding in findings {
        let count = seen.entry(&finding.code).or_default();
        *count += 1;
        if finding.severity == Severity::Error || *count <= MAX_PER_CODE {
            out.push_str(&with_source_line(finding, source.as_ref()));
            out.push('\n');
        }
    }
    for (code, count) in seen {
        let shown =
            findings.iter().filter(|f| f.code == code && f.severity == Severity::Error).count().max(MAX_PER_CODE);
        if count > shown {
            out.push_str(&format!("… and {} more of `{code}`\n", count - shown));
        }
    }
    out
}

/// The finding with the line of the file it points at.
fn with_source_line(finding: &Diagnostic, source: Option<&(&str, Vec<&str>)>) -> String {
    let text = finding_line(finding);
    let line = source.and_then(|(file, lines)| {
        let place = finding.source.as_ref().filter(|s| s.file == *file)?;
        let index = usize::try_from(place.line?).ok()?.checked_sub(1)?;
        let line = lines.get(index).filter(|l| l.len() <= 200)?;
        let column = usize::try_from(place.column?).ok()?.saturating_sub(1);
        Some(format!("\n    | {}\n    | {}^", safe(line), " ".repeat(column.min(line.chars().count()))))
    });
    let Some(line) = line else { return text };
    match text.split_once("\n  help: ") {
        Some((head, help)) => format!("{head}{line}\n  help: {help}"),
        None => format!("{text}{line}"),
    }
}

/// Findings as JSON.
#[must_use]
pub fn findings_json(findings: &[Diagnostic]) -> Value {
    let count = |severity| findings.iter().filter(|f| f.severity == severity).count();
    json!({
        "errors": count(Severity::Error),
        "warnings": count(Severity::Warning),
        "findings": findings,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codes::{UNKNOWN_VALUE, WRONG_VALUE};
    use toile_garment::SourceRef;

    #[test]
    fn floods_are_counted() {
        let many: Vec<Diagnostic> = (0..100).map(|i| Diagnostic::warning(WRONG_VALUE, format!("value {i}"))).collect();
        let text = findings_text(&many, None);
        assert_eq!(text.lines().count(), MAX_PER_CODE + 1);
        assert!(text.contains("… and 95 more of `wrong-value`"));
    }

    #[test]
    fn notes_of_one_code_are_one_line() {
        let place = SourceRef { file: "a.dxf".into(), ..SourceRef::default() };
        let notes = (0..4).map(|i| Diagnostic::info(UNKNOWN_VALUE, format!("note {i}")).at(place.clone()).hint("look"));
        let warnings = (0..2).map(|i| Diagnostic::warning(WRONG_VALUE, format!("value {i}")));
        let all: Vec<Diagnostic> = notes.chain(warnings).collect();
        let text = findings_text(&all, None);
        assert_eq!(text.lines().count(), 3, "{text}");
        assert!(text.contains("note[unknown-value] note 0 (and 3 more like this)\n"), "{text}");
        // One alone keeps its place and remedy.
        assert_eq!(grouped(&all[3..]), all[3..]);
    }

    #[test]
    fn names_from_files_cannot_steer_a_terminal() {
        let finding = Diagnostic::error(WRONG_VALUE, "piece \u{1b}[2J\u{202e}");
        assert!(!finding_line(&finding).contains(['\u{1b}', '\u{202e}']));
    }

    #[test]
    fn shows_the_line_it_points_at() {
        let place = SourceRef { file: "p.toml".into(), line: Some(2), column: Some(5), ..SourceRef::default() };
        let finding = Diagnostic::error(WRONG_VALUE, "wrong").at(place).hint("right");
        let text = findings_text(&[finding], Some(("p.toml", "a\nb = c\n")));
        assert!(text.contains("p.toml:2:5\n    | b = c\n    |     ^\n  help: right"), "{text}");
    }
}
