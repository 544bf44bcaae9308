//! Colours as people write them, with a finding for every other text.

use super::codes;
use toile_garment::Diagnostic;

/// Linear RGB of `#rrggbb`.
pub fn linear(text: &str) -> Result<[f64; 3], Box<Diagnostic>> {
    toile_formats::texture::linear(text).ok_or_else(|| {
        let finding = Diagnostic::error(codes::COLOR, format!("`{text}` is no colour"));
        Box::new(finding.hint("write red, green and blue in hexadecimal, e.g. \"#d8c8b0\""))
    })
}
