//! Colours as people write them, `#rrggbb` in sRGB, into linear numbers and back.

/// Linear RGB of `#rrggbb`; `None` for any other text.
#[must_use]
pub fn linear(text: &str) -> Option<[f64; 3]> {
    let digits = text.trim().strip_prefix('#').filter(|d| d.len() == 6 && d.chars().all(|c| c.is_ascii_hexdigit()))?;
    let number = u32::from_str_radix(digits, 16).ok()?;
    Some([16, 8, 0].map(|shift| decode(f64::from(number >> shift & 0xff) / 255.0)))
}

/// IEC 61966-2-1.
fn decode(x: f64) -> f64 {
    if x <= 0.040_45 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
}
