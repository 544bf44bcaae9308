//! The tolerant tag reader: code/value pairs with their line numbers.

use super::codes;
use super::findings::Findings;
use super::{binary, limits};
use crate::codes::FILE_TOO_LARGE;
use std::borrow::Cow;
use toile_garment::Diagnostic;

/// One pair; the value is raw bytes without blanks at its ends.
#[derive(Clone, Copy, Debug)]
pub struct Tag<'a> {
    /// Group code.
    pub code: i32,
    /// Value.
    pub value: &'a [u8],
    /// Line of the code, from 1.
    pub line: u64,
}

impl Tag<'_> {
    /// Is the value this keyword, whatever the case?
    #[must_use]
    pub fn is(&self, keyword: &str) -> bool {
        self.value.eq_ignore_ascii_case(keyword.as_bytes())
    }
}

/// Reads pairs one after the other.
pub struct Tags<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u64,
    pairs: u64,
    terminator: u8,
    comments: Vec<&'a [u8]>,
    blank_lines: u64,
    first_blank: u64,
}

/// The text of a file: as it stands, or made from binary DXF or UTF-16.
///
/// # Errors
/// Empty, too large, binary that cannot be read.
pub fn sniff<'a>(bytes: &'a [u8], findings: &mut Findings) -> Result<Cow<'a, [u8]>, Diagnostic> {
    let place = findings.place(1);
    if bytes.len() > limits::FILE_BYTES {
        let text = format!("the file has {} bytes, over the limit of {}", bytes.len(), limits::FILE_BYTES);
        return Err(Diagnostic::error(FILE_TOO_LARGE, text).at(place));
    }
    if bytes.starts_with(&binary::SENTINEL[..18]) {
        return binary::to_text(bytes, findings).map(Cow::Owned);
    }
    if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) {
        findings.push(Diagnostic::info(codes::UTF_16_TEXT, "the file is UTF-16 text").at(place));
        let wide = if bytes[0] == 0xFF { encoding_rs::UTF_16LE } else { encoding_rs::UTF_16BE };
        return Ok(Cow::Owned(wide.decode(bytes).0.into_owned().into_bytes()));
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(Diagnostic::error(codes::FILE_EMPTY, "the file is empty").at(place));
    }
    Ok(Cow::Borrowed(bytes))
}

impl<'a> Tags<'a> {
    /// Starts at the beginning of sniffed bytes.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        let terminator = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
        Self { bytes, at: 0, line: 0, pairs: 0, terminator, comments: Vec::new(), blank_lines: 0, first_blank: 0 }
    }

    fn next_line(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..).filter(|r| !r.is_empty())?;
        let end = rest.iter().position(|b| *b == self.terminator).unwrap_or(rest.len());
        self.at += end + 1;
        self.line += 1;
        Some(rest[..end].trim_ascii())
    }

    fn checked_line(&mut self, findings: &Findings) -> Result<Option<&'a [u8]>, Diagnostic> {
        match self.next_line() {
            Some(line) if line.len() > limits::LINE_BYTES => {
                let text = format!("a line of {} bytes, over the limit of {}", line.len(), limits::LINE_BYTES);
                Err(Diagnostic::error(codes::LINE_TOO_LONG, text).at(findings.place(self.line)))
            }
            line => Ok(line),
        }
    }

    /// The next pair; comments (999) and blank lines between pairs are passed over and counted.
    ///
    /// # Errors
    /// A code that is no number, a code without a value, too many pairs, a line too long.
    pub fn next(&mut self, findings: &Findings) -> Result<Option<Tag<'a>>, Diagnostic> {
        loop {
            let Some(code) = self.checked_line(findings)? else { return Ok(None) };
            if code.is_empty() {
                self.blank_lines += 1;
                if self.blank_lines == 1 {
                    self.first_blank = self.line;
                }
                continue;
            }
            let line = self.line;
            // Ctrl-Z ends a text file of the DOS age, and blocks of a tape or disk are filled up with zero bytes.
            let filling = |b: &u8| matches!(b, 0 | 0x1A) || b.is_ascii_whitespace();
            if code.iter().all(filling) && self.bytes[self.at.min(self.bytes.len())..].iter().all(filling) {
                return Ok(None);
            }
            let Some(number) = group_code(code) else { return Err(bad_code(code, line, findings)) };
            let Some(value) = self.checked_line(findings)? else {
                let text =
                    format!("the file ends after group code {number}: its value is missing, the file is cut off");
                return Err(Diagnostic::error(codes::FILE_TRUNCATED, text)
                    .at(findings.place(line))
                    .hint("get a whole copy of the file"));
            };
            self.pairs += 1;
            if self.pairs > limits::PAIRS {
                let text = format!("more than {} code/value pairs", limits::PAIRS);
                return Err(Diagnostic::error(codes::TOO_MANY_PAIRS, text).at(findings.place(line)));
            }
            if number == 999 {
                if self.comments.len() < 8 {
                    self.comments.push(value);
                }
                continue;
            }
            return Ok(Some(Tag { code: number, value, line }));
        }
    }

    /// The first comments (999).
    #[must_use]
    pub fn comments(&self) -> &[&'a [u8]] {
        &self.comments
    }

    /// Line reached.
    #[must_use]
    pub fn line(&self) -> u64 {
        self.line
    }

    /// Says what was passed over.
    pub fn report(&self, findings: &mut Findings) {
        if self.blank_lines > 0 {
            // Blank lines at the very end are how many editors leave a file.
            let trailing = self.bytes.trim_ascii_end().len();
            let inside = self.bytes[..trailing].iter().filter(|b| **b == self.terminator).count() as u64;
            if self.first_blank <= inside {
                let text = format!("{} blank line(s) between pairs were passed over", self.blank_lines);
                findings.push(Diagnostic::warning(codes::BLANK_LINE, text).at(findings.place(self.first_blank)));
            }
        }
    }
}

fn group_code(text: &[u8]) -> Option<i32> {
    // Nearly all codes are one or two digits.
    if (1..=4).contains(&text.len()) && text.iter().all(u8::is_ascii_digit) {
        return Some(text.iter().fold(0, |code, digit| 10 * code + i32::from(digit - b'0')));
    }
    let text = std::str::from_utf8(text).ok()?;
    text.parse::<i32>().ok().filter(|c| (-32_768..=32_767).contains(c))
}

/// The text of a line, as far as it can be shown.
fn shown(bytes: &[u8]) -> String {
    let text: String =
        String::from_utf8_lossy(bytes).chars().filter(|c| !c.is_control() && *c != '\u{FFFD}').take(40).collect();
    if text.trim().is_empty() { format!("{} byte(s) that are no text", bytes.len()) } else { format!("`{text}`") }
}

fn bad_code(code: &[u8], line: u64, findings: &Findings) -> Diagnostic {
    let shown = shown(code);
    if line == 1 {
        let text = format!("this is no DXF text: line 1 must be a group code, found {shown}");
        return Diagnostic::error(codes::NOT_DXF, text).at(findings.place(line));
    }
    Diagnostic::error(codes::BAD_GROUP_CODE, format!("expected a group code (a whole number), found {shown}"))
        .at(findings.place(line))
        .hint("a line is missing or extra just before this one; export the file again")
}

/// A finite number in range, as every coordinate must be.
///
/// # Errors
/// With the line: not a number, decimal comma, not finite, absurdly large.
pub fn number(tag: &Tag<'_>, findings: &Findings) -> Result<f64, Diagnostic> {
    let plain = tag.value.iter().all(|b| b.is_ascii_digit() || b"+-.eE".contains(b));
    let value = std::str::from_utf8(tag.value).ok().filter(|_| plain).and_then(|t| t.parse::<f64>().ok());
    if let Some(v) = value.filter(|v| v.is_finite() && v.abs() <= limits::COORDINATE) {
        return Ok(v);
    }
    let place = findings.place(tag.line + 1);
    let shown = if tag.value.is_empty() { "an empty line".to_owned() } else { shown(tag.value) };
    match value {
        Some(_) => Err(Diagnostic::error(
            codes::NUMBER_OUT_OF_RANGE,
            format!("the number {shown} (group code {}) is out of range", tag.code),
        )
        .at(place)),
        None if tag.value.contains(&b',') => Err(Diagnostic::error(
            codes::DECIMAL_COMMA,
            format!("the number {shown} (group code {}) has a decimal comma", tag.code),
        )
        .at(place)
        .hint("export with a decimal point")),
        None => Err(Diagnostic::error(
            codes::BAD_NUMBER,
            format!("{shown} (group code {}) is not a finite number", tag.code),
        )
        .at(place)
        .hint("correct the line or export the file again")),
    }
}
