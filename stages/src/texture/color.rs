//! Colours as people write them, `#rrggbb` in sRGB, into linear numbers.

use super::codes;
use toile_garment::Diagnostic;

/// Linear RGB of `#rrggbb`.
pub fn linear(text: &str) -> Result<[f64; 3], Box<Diagnostic>> {
    let digits = text.trim().strip_prefix('#').filter(|d| d.len() == 6 && d.chars().all(|c| c.is_ascii_hexdigit()));
    let Some(number) = digits.and_then(|d| u32::from_str_radix(d, 16).ok()) else {
        let finding = Diagnostic::error(codes::COLOR, format!("`{text}` is no colour"));
        return Err(Box::new(finding.hint("write red, green and blue in hexadecimal, e.g. \"#d8c8b0\"")));
    };
    Ok([16, 8, 0].map(|shift| decode(f64::from(number >> shift & 0xff) / 255.0)))
}

/// IEC 61966-2-1.
fn decode(x: f64) -> f64 {
    if x <= 0.040_45 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
}
