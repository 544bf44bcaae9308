//! Header, inserts and the texts of the style.

use super::model::{Dialect, StyleText};
use super::names::ascii;
use super::tags::Tags;
use toile_garment::{Diagnostic, Vec2};

/// Vendor, application and release of the `Author` text; the release is the writer's own, raised with its output.
const PRODUCT: &str = "toile";
const RELEASE: &str = "1";
/// Closeness of the drawn curves, mm.
const TOLERANCE: &str = "0.2";

/// The header: empty, but for CLO.
pub fn header(tags: &mut Tags, dialect: Dialect) {
    tags.section("HEADER");
    if dialect == Dialect::Clo {
        tags.pair(9, "$ACADVER");
        tags.pair(1, "AC1006");
    }
    tags.end_section();
}

/// An insert at the origin: pieces already lie where they should.
pub fn insert(tags: &mut Tags, block: &str) {
    tags.entity("INSERT", "1");
    tags.pair(2, block);
    tags.point(10, Vec2::zeros());
}

/// A `Key: value`, the key in the dialect's case, the value folded to ASCII with a finding.
pub fn key_value(key: &str, value: &str, dialect: Dialect, findings: &mut Vec<Diagnostic>) -> String {
    let key = if dialect == Dialect::Clo { key.to_ascii_uppercase() } else { key.to_owned() };
    format!("{key}: {}", folded(value, findings))
}

/// ASCII, with a finding when it changed.
pub fn folded(value: &str, findings: &mut Vec<Diagnostic>) -> String {
    let text = ascii(value);
    if text != value {
        findings.push(
            Diagnostic::info("text-not-ascii", format!("the text `{value}` is written as `{text}`"))
                .hint("the format holds 7-bit ASCII only"),
        );
    }
    text
}

/// The texts of the style, one under the other.
pub fn texts(tags: &mut Tags, style: &StyleText, dialect: Dialect, findings: &mut Vec<Diagnostic>) {
    let mut lines: Vec<(&str, String)> = Vec::new();
    if dialect == Dialect::Aama {
        lines.push(("Version", "ANSI/AAMA-292-B".into()));
    } else {
        lines.push(("ASTM/D13Proposal 1 Version", "D 6673-04".into()));
    }
    lines.push(("Style Name", style.name.clone()));
    if let Some(size) = &style.sample_size {
        lines.push(("Sample Size", size.clone()));
    }
    let author = if style.author.is_empty() { PRODUCT } else { &style.author };
    if dialect == Dialect::Aama {
        lines.extend([("Author", author.to_owned()), ("Product", format!("{PRODUCT} {RELEASE}"))]);
    } else {
        lines.push(("Author", format!("{author};{PRODUCT};{RELEASE}")));
    }
    lines.push(("Units", "METRIC".into()));
    lines.push((if dialect == Dialect::Aama { "Tolerance" } else { "Curve Tolerance" }, TOLERANCE.into()));
    for (i, (key, value)) in lines.iter().enumerate() {
        let text = key_value(key, value, dialect, findings);
        tags.text("1", Vec2::new(0.0, -20.0 - 5.0 * i as f64), &text);
    }
}
