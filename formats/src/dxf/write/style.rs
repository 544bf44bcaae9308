//! Header, inserts and the texts of the style.

use super::codes;
use super::model::{Dialect, StyleText};
use super::names::{ascii, escaped_in};
use super::tags::Tags;
use crate::codes::TEXT_NOT_ASCII;
use toile_garment::{Diagnostic, Vec2};

/// Vendor, application and release of the `Author` text; the release is the writer's own, raised with its output.
pub(crate) const PRODUCT: &str = "toile";
const RELEASE: &str = "1";
/// Closeness of the drawn curves: millimetres, inches.
const TOLERANCE: [&str; 2] = ["0.2", "0.008"];

/// The header: empty, but for CLO.
pub fn header(tags: &mut Tags, dialect: Dialect) {
    tags.section("HEADER");
    let release = match (dialect, tags.options.page) {
        // Since AC1021 texts are UTF-8.
        (_, Some(page)) if page.dxf_name().is_none() => Some("AC1021"),
        (Dialect::Clo, _) => Some("AC1006"),
        (Dialect::Plain, _) => Some("AC1009"),
        _ => None,
    };
    if let Some(release) = release {
        tags.pair(9, "$ACADVER");
        tags.pair(1, release);
    }
    if let Some(name) = tags.options.page.and_then(|p| p.dxf_name()) {
        tags.pair(9, "$DWGCODEPAGE");
        tags.pair(3, &name);
    }
    if dialect == Dialect::Plain {
        tags.pair(9, "$INSUNITS");
        let unit = if tags.options.inches { 1 } else { 4 };
        tags.int(70, unit);
    }
    tags.end_section();
    if dialect == Dialect::Plain {
        tables(tags);
    }
}

/// Layers with their colours, so that drawing programs show them apart.
fn tables(tags: &mut Tags) {
    const COLORS: [(&str, i64); 16] = [
        ("1", 7),
        ("2", 8),
        ("3", 9),
        ("4", 1),
        ("5", 8),
        ("6", 6),
        ("7", 4),
        ("8", 3),
        ("9", 30),
        ("10", 40),
        ("11", 2),
        ("13", 1),
        ("14", 5),
        ("80", 1),
        ("81", 1),
        ("83", 1),
    ];
    tags.section("TABLES");
    for (table, count) in [("LTYPE", 1), ("LAYER", COLORS.len() as i64)] {
        tags.pair(0, "TABLE");
        tags.pair(2, table);
        tags.int(70, count);
        if table == "LTYPE" {
            tags.pair(0, "LTYPE");
            tags.pair(2, "CONTINUOUS");
            tags.int(70, 64);
            tags.pair(3, "Solid line");
            tags.int(72, 65);
            tags.int(73, 0);
            tags.number(40, 0.0);
        } else {
            for (layer, color) in COLORS {
                tags.pair(0, "LAYER");
                tags.pair(2, layer);
                tags.int(70, 0);
                tags.int(62, color);
                tags.pair(6, "CONTINUOUS");
            }
        }
        tags.pair(0, "ENDTAB");
    }
    tags.end_section();
}

/// An insert at the origin: pieces already lie where they should.
pub fn insert(tags: &mut Tags, block: &str) {
    tags.entity("INSERT", "1");
    tags.pair(2, block);
    tags.point(10, Vec2::zeros());
}

/// A `Key: value`, the key in the dialect's case, the value as [`folded`] gives it.
pub fn key_value(tags: &Tags, key: &str, value: &str, dialect: Dialect, findings: &mut Vec<Diagnostic>) -> String {
    let key = if dialect == Dialect::Clo { key.to_ascii_uppercase() } else { key.to_owned() };
    format!("{key}: {}", folded(tags, value, dialect, findings))
}

/// A text in the letters of the code page, or in ASCII without one. Other characters become `\U+XXXX`, which DXF
/// readers resolve, and are folded for the narrowest reader. Findings say both.
pub fn folded(tags: &Tags, value: &str, dialect: Dialect, findings: &mut Vec<Diagnostic>) -> String {
    if !dialect.is_narrow() {
        let text = escaped_in(tags.options.page, value);
        if value.chars().any(|c| tags.escapes(c)) {
            say_escaped(value, &text, findings);
        }
        return text;
    }
    let text = ascii(value);
    if text != value {
        findings.push(
            Diagnostic::info(TEXT_NOT_ASCII, format!("the text `{value}` is written as `{text}`"))
                .hint("the format holds 7-bit ASCII only"),
        );
    }
    text
}

/// Says once that a text is written with escapes.
fn say_escaped(value: &str, text: &str, findings: &mut Vec<Diagnostic>) {
    let said = format!(
        "the text `{value}` is written as `{text}`: programs that do not resolve these escapes show them as they are"
    );
    if !findings.iter().any(|f| f.message == said) {
        let hint = "give a code page that has the letters, e.g. code_page = \"windows-1252\" or \"gbk\"";
        findings.push(Diagnostic::info(codes::TEXT_ESCAPED, said).hint(hint));
    }
}

/// The texts of the style, one under the other.
pub fn texts(tags: &mut Tags, style: &StyleText, dialect: Dialect, findings: &mut Vec<Diagnostic>) {
    let mut lines: Vec<(&str, String)> = Vec::new();
    if !dialect.is_astm() {
        lines.push(("Version", "ANSI/AAMA-292-B".into()));
    } else {
        lines.push(("ASTM/D13Proposal 1 Version", "D 6673-04".into()));
    }
    lines.push(("Style Name", style.name.clone()));
    if let Some(size) = &style.sample_size {
        lines.push(("Sample Size", size.clone()));
    }
    if let Some(table) = &style.rule_table {
        lines.push(("Grade Rule Table", table.clone()));
    }
    let author = if style.author.is_empty() { PRODUCT } else { &style.author };
    if !dialect.is_astm() {
        lines.extend([("Author", author.to_owned()), ("Product", format!("{PRODUCT} {RELEASE}"))]);
    } else {
        lines.push(("Author", format!("{author};{PRODUCT};{RELEASE}")));
    }
    if let Some(date) = &style.date {
        lines.push(("Creation Date", date.clone()));
    }
    let inches = tags.options.inches;
    lines.push(("Units", if inches { "ENGLISH" } else { "METRIC" }.into()));
    let tolerance = TOLERANCE[usize::from(inches)];
    lines.push((if !dialect.is_astm() { "Tolerance" } else { "Curve Tolerance" }, tolerance.into()));
    for (i, (key, value)) in lines.iter().enumerate() {
        let text = key_value(tags, key, value, dialect, findings);
        tags.text("1", Vec2::new(0.0, -20.0 - 5.0 * i as f64), &text);
    }
}
