//! Tags: a group code on one line, its value on the next.

use super::names::is_escaped_in;
use crate::encoding::TextEncoding;
use toile_garment::Vec2;

/// Millimetres in an inch.
const INCH: f64 = 25.4;

/// The choices of a writer beside the dialect.
#[derive(Clone, Copy, Debug, Default)]
pub struct WriteOptions {
    /// Lengths in inches instead of millimetres.
    pub inches: bool,
    /// Code page of the texts; 7-bit ASCII with escapes without one.
    pub page: Option<TextEncoding>,
}

/// Text of a DXF file under construction.
pub struct Tags {
    out: Vec<u8>,
    /// Height of texts in file units, 2.5 mm where there is none.
    height: Option<f64>,
    /// Unit and code page.
    pub options: WriteOptions,
}

impl Tags {
    /// An empty file. `height` is that of texts in file units, 2.5 mm where there is none.
    pub fn new(height: Option<f64>, options: WriteOptions) -> Self {
        Self { out: Vec::new(), height, options }
    }

    /// One pair. The value has no line breaks; letters that the code page does not have are escaped already.
    pub fn pair(&mut self, code: u16, value: &str) {
        self.out.extend(format!("{code:>3}\r\n").as_bytes());
        match self.options.page.filter(|_| !value.is_ascii()) {
            Some(page) => self.out.extend(value.chars().filter_map(|c| page.encode(c)).flatten()),
            None => self.out.extend(value.as_bytes()),
        }
        self.out.extend(b"\r\n");
    }

    /// A whole number.
    pub fn int(&mut self, code: u16, value: i64) {
        self.pair(code, &value.to_string());
    }

    /// A number without a unit or an angle in degrees, four decimals.
    pub fn number(&mut self, code: u16, value: f64) {
        self.pair(code, &decimal(value));
    }

    /// A length, given in millimetres: four decimals of a millimetre, or six of an inch.
    pub fn length(&mut self, code: u16, value: f64) {
        let text = if self.options.inches { decimals(value / INCH, 6) } else { decimal(value) };
        self.pair(code, &text);
    }

    /// A point: codes 10 and 20, or 11 and 21, ….
    pub fn point(&mut self, code: u16, at: Vec2) {
        self.length(code, at.x);
        self.length(code + 10, at.y);
    }

    /// Start of an entity on a layer.
    pub fn entity(&mut self, kind: &str, layer: &str) {
        self.pair(0, kind);
        self.pair(8, layer);
    }

    /// A `TEXT`.
    pub fn text(&mut self, layer: &str, at: Vec2, text: &str) {
        self.entity("TEXT", layer);
        self.point(10, at);
        match self.height {
            Some(height) => self.number(40, height),
            None => self.length(40, 2.5),
        }
        self.number(50, 0.0);
        self.pair(1, text);
        self.pair(7, "STANDARD");
    }

    /// Must a letter be escaped?
    pub fn escapes(&self, letter: char) -> bool {
        is_escaped_in(self.options.page, letter)
    }

    /// Opens a section.
    pub fn section(&mut self, name: &str) {
        self.pair(0, "SECTION");
        self.pair(2, name);
    }

    /// Closes a section.
    pub fn end_section(&mut self) {
        self.pair(0, "ENDSEC");
    }

    /// The bytes.
    pub fn into_bytes(self) -> Vec<u8> {
        self.out
    }
}

/// Four decimals, never a negative zero.
pub fn decimal(value: f64) -> String {
    decimals(value, 4)
}

/// So many decimals, never a negative zero.
pub fn decimals(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let zero = text.strip_prefix('-').filter(|t| t.bytes().all(|b| matches!(b, b'0' | b'.')));
    zero.map(str::to_owned).unwrap_or(text)
}
