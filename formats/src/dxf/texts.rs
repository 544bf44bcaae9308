//! `Key: value` texts of styles and pieces.

use toile_garment::piece::Quantity;

/// Splits at the first colon; the key in lower case with single blanks.
#[must_use]
pub fn key_value(text: &str) -> Option<(String, String)> {
    let (key, value) = text.split_once(':')?;
    let key = key.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
    (!key.is_empty()).then(|| (key, value.trim().to_owned()))
}

/// Grade rule number of `# n` and `# n, m`; `m` is the alternate reference line.
#[must_use]
pub fn rule_number(text: &str) -> Option<(u32, Option<u32>)> {
    let rest = text.trim().strip_prefix('#')?;
    let mut parts = rest.split(|c: char| c == ',' || c.is_whitespace()).filter(|p| !p.is_empty());
    Some((parts.next()?.parse().ok()?, parts.next().and_then(|p| p.parse().ok())))
}

/// `2`, `2,0`, `1,1`, `1.0`, `2 PAIR`: as drawn, and mirrored.
#[must_use]
pub fn quantity(text: &str) -> Option<Quantity> {
    let mut parts = text.split([',', ';', '/']).map(|p| {
        let number: String = p.trim().chars().take_while(|c| c.is_ascii_digit()).collect();
        number.parse::<u32>().ok()
    });
    let plain = parts.next()??;
    let mirrored = parts.next().flatten().unwrap_or(0);
    Some(Quantity { plain, mirrored })
}

/// Unit named in a text or a parameter: millimetres per unit.
#[must_use]
pub fn unit(text: &str) -> Option<f64> {
    match text.trim().to_ascii_lowercase().as_str() {
        "metric" | "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => Some(1.0),
        "english" | "imperial" | "inch" | "inches" | "in" => Some(25.4),
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => Some(10.0),
        "m" | "meter" | "meters" | "metre" | "metres" => Some(1000.0),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms() {
        assert_eq!(key_value("Piece  NAME:FRONT: A"), Some(("piece name".into(), "FRONT: A".into())));
        assert_eq!(key_value("CATEGORY: "), Some(("category".into(), String::new())));
        assert_eq!(rule_number("# 12"), Some((12, None)));
        assert_eq!(rule_number("#3, 4"), Some((3, Some(4))));
        assert_eq!(rule_number("NM"), None);
        assert_eq!(quantity("1,1"), Some(Quantity { plain: 1, mirrored: 1 }));
        assert_eq!(quantity("2"), Some(Quantity { plain: 2, mirrored: 0 }));
        assert_eq!(quantity("0"), Some(Quantity { plain: 0, mirrored: 0 }));
        assert_eq!(quantity("two"), None);
    }
}
