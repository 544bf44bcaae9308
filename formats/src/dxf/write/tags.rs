//! Tags: a group code on one line, its value on the next.

use toile_garment::Vec2;

/// Text of a DXF file under construction.
#[derive(Default)]
pub struct Tags {
    out: String,
    /// Height of texts, 2.5 mm where there is none.
    pub height: Option<f64>,
}

impl Tags {
    /// One pair. The value is ASCII without line breaks; [`super::names::ascii`] makes it so.
    pub fn pair(&mut self, code: u16, value: &str) {
        self.out.push_str(&format!("{code:>3}\r\n{value}\r\n"));
    }

    /// A whole number.
    pub fn int(&mut self, code: u16, value: i64) {
        self.pair(code, &value.to_string());
    }

    /// A length in millimetres or an angle in degrees, four decimals.
    pub fn real(&mut self, code: u16, value: f64) {
        self.pair(code, &decimal(value));
    }

    /// A point: codes 10 and 20, or 11 and 21, ….
    pub fn point(&mut self, code: u16, at: Vec2) {
        self.real(code, at.x);
        self.real(code + 10, at.y);
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
        self.real(40, self.height.unwrap_or(2.5));
        self.real(50, 0.0);
        self.pair(1, text);
        self.pair(7, "STANDARD");
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
        self.out.into_bytes()
    }
}

/// Four decimals, never a negative zero.
pub fn decimal(value: f64) -> String {
    let text = format!("{value:.4}");
    if text == "-0.0000" { "0.0000".to_owned() } else { text }
}
