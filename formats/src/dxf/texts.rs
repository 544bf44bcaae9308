//! `Key: value` texts of styles and pieces.

use toile_garment::piece::Quantity;

/// Splits at the first colon; the key in lower case with single blanks.
#[must_use]
pub fn key_value(text: &str) -> Option<(String, String)> {
    let (key, value) = text.split_once([':', '：'])?;
    let key = key.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
    (!key.is_empty()).then(|| (key, value.trim().to_owned()))
}

/// Key and value of a text that has a blank or an equals sign where the colon belongs, as `SIZE 36`. The value must be
/// one that the key can have, since labels look alike: `SIZE CHART 2020` is none.
#[must_use]
pub fn without_colon(text: &str) -> Option<(&'static str, String)> {
    const KEYS: [&str; 6] = ["sample size", "size name", "size", "quantity", "qty", "units"];
    let words: Vec<&str> = text.split([' ', '\t', '=']).filter(|w| !w.is_empty()).collect();
    let begins = |key: &&&str| {
        let own: Vec<&str> = key.split(' ').collect();
        words.len() > own.len() && own.iter().zip(&words).all(|(a, b)| a.eq_ignore_ascii_case(b))
    };
    let key = KEYS.iter().find(begins)?;
    let value = words.get(key.split(' ').count()..)?.join(" ");
    let fits = match *key {
        "quantity" | "qty" => quantity(&value).is_some(),
        "units" => unit(&value).is_some(),
        _ => is_size(&value),
    };
    (text.split_once([':', '：']).is_none() && fits).then_some((*key, value))
}

/// Can this be the name of a size, one word that is short or has a digit: `36`, `XL`, `40R`?
fn is_size(text: &str) -> bool {
    let letters = text.trim_start_matches(|c: char| c.is_ascii_digit()).to_ascii_lowercase();
    let known = ["", "s", "m", "l", "xs", "xl", "r", "t", "p", "w"];
    let is_short = text.len() <= 6 && text.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '/' | '-'));
    is_short && (known.contains(&letters.trim_start_matches('x')) || text.chars().any(|c| c.is_ascii_digit()))
}

/// The key of the standard that a key of other programs stands for.
#[must_use]
pub fn foreign_key(key: &str) -> Option<&'static str> {
    match key {
        "piece" | "part" | "part name" => Some("piece name"),
        "qty" | "amount" => Some("quantity"),
        "mat" => Some("material"),
        _ => None,
    }
}

/// The key of the standard that a key of other programs stands for among the texts of the style.
#[must_use]
pub fn foreign_style_key(key: &str) -> Option<&'static str> {
    match key {
        "unit" | "unit of measure" | "measurement unit" => Some("units"),
        "sample" | "base size" | "basic size" => Some("sample size"),
        "style" | "style no" | "style number" | "model" => Some("style name"),
        _ => None,
    }
}

/// The key itself, or the key of the standard that it stands for.
#[must_use]
pub fn own_key(key: &str) -> &str {
    foreign_key(key).unwrap_or(key)
}

/// Is this a key of the standards, or one of other programs that is understood?
#[must_use]
pub fn is_known(key: &str) -> bool {
    const KEYS: [&str; 26] = [
        "piece name",
        "size",
        "size name",
        "sample size",
        "quantity",
        "category",
        "annotation",
        "material",
        "fabric",
        "rotation",
        "flip",
        "tilt",
        "fold",
        "style name",
        "creation date",
        "creation time",
        "author",
        "product",
        "version",
        "grade rule table",
        "units",
        "tolerance",
        "curve tolerance",
        "link",
        "ansi/aama version",
        "astm/d13proposal 1 version",
    ];
    KEYS.contains(&key) || foreign_key(key).is_some()
}

/// Is this a text of the style that a writer makes of what it writes?
#[must_use]
pub fn is_made_anew(key: &str) -> bool {
    const KEYS: [&str; 9] = [
        "style name",
        "sample size",
        "grade rule table",
        "units",
        "tolerance",
        "curve tolerance",
        "version",
        "ansi/aama version",
        "astm/d13proposal 1 version",
    ];
    KEYS.contains(&key)
}

/// Does this text of the style name the program that wrote it?
#[must_use]
pub fn is_of_writer(key: &str) -> bool {
    matches!(key, "author" | "product")
}

/// Grade rule number of `# n` and `# n, m`; `m` is the alternate reference line.
#[must_use]
pub fn rule_number(text: &str) -> Option<(u32, Option<u32>)> {
    let rest = text.trim().strip_prefix('#')?;
    let mut parts = rest.split(|c: char| c == ',' || c.is_whitespace()).filter(|p| !p.is_empty());
    Some((parts.next()?.parse().ok()?, parts.next().and_then(|p| p.parse().ok())))
}

/// `2`, `2,0`, `1,1`, `1+1`, `1.0`, `2 PAIR`: as drawn, and mirrored. `None` for what cannot be understood.
#[must_use]
pub fn quantity(text: &str) -> Option<Quantity> {
    let parts: Vec<&str> = text.split([',', ';', '/', '+']).map(str::trim).collect();
    match parts.as_slice() {
        [plain] => Some(Quantity { plain: count(plain)?, mirrored: 0 }),
        [plain, ""] => Some(Quantity { plain: count(plain)?, mirrored: 0 }),
        [plain, mirrored] => Some(Quantity { plain: count(plain)?, mirrored: count(mirrored)? }),
        _ => None,
    }
}

/// A whole number, with a word behind it or not.
fn count(text: &str) -> Option<u32> {
    let digits = text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let (number, rest) = text.split_at(digits);
    let fraction = rest.strip_prefix('.').map_or(rest, |f| f.trim_start_matches('0'));
    let word = fraction.chars().all(|c| c.is_alphabetic() || c.is_whitespace());
    number.parse().ok().filter(|_| word)
}

/// The text of a piece that an attribute stands for, made of its name and its value: `Piece Name: FRONT`. Links of
/// notches, and attributes without a value, stand for none.
#[must_use]
pub fn attribute(tag: &str, value: &str) -> Option<String> {
    const KEYS: [&str; 8] =
        ["piece name", "size", "size name", "quantity", "category", "annotation", "material", "fabric"];
    let link = tag.eq_ignore_ascii_case("dependency") || key_value(value).is_some_and(|(key, _)| key == "link");
    if link || value.is_empty() {
        return None;
    }
    let tag = tag.replace('_', " ");
    let tag = tag.trim_end_matches(':').trim();
    let whole = tag.is_empty() || key_value(value).is_some_and(|(key, _)| KEYS.contains(&key.as_str()));
    Some(if whole { value.to_owned() } else { format!("{tag}: {value}") })
}

/// Unit named in a text or a parameter: millimetres per unit.
#[must_use]
pub fn unit(text: &str) -> Option<f64> {
    match text.trim().to_ascii_lowercase().as_str() {
        "metric" | "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => Some(1.0),
        "english" | "imperial" | "inch" | "inches" | "in" => Some(25.4),
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => Some(10.0),
        "m" | "meter" | "meters" | "metre" | "metres" => Some(1000.0),
        "ft" | "foot" | "feet" => Some(304.8),
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
        assert_eq!(key_value("尺码：36"), Some(("尺码".into(), "36".into())));
        for (text, key, value) in
            [("SIZE 36", "size", "36"), ("Size = XXL", "size", "XXL"), ("Sample  Size 40R", "sample size", "40R")]
        {
            assert_eq!(without_colon(text), Some((key, value.to_owned())), "{text}");
        }
        assert_eq!(without_colon("QTY 2"), Some(("qty", "2".to_owned())));
        assert_eq!(without_colon("Units METRIC"), Some(("units", "METRIC".to_owned())));
        for label in ["SIZE", "SIZE CHART", "Size: 36", "SIZE 36 FRONT", "QTY many", "UNITS OF CLOTH", "SIZES 36"] {
            assert_eq!(without_colon(label), None, "{label}");
        }
        assert_eq!(rule_number("# 12"), Some((12, None)));
        assert_eq!(rule_number("#3, 4"), Some((3, Some(4))));
        assert_eq!(rule_number("NM"), None);
        assert_eq!(quantity("1,1"), Some(Quantity { plain: 1, mirrored: 1 }));
        assert_eq!(quantity("2"), Some(Quantity { plain: 2, mirrored: 0 }));
        assert_eq!(quantity("0"), Some(Quantity { plain: 0, mirrored: 0 }));
        assert_eq!(quantity("1+1"), Some(Quantity { plain: 1, mirrored: 1 }));
        assert_eq!(quantity("1.0"), Some(Quantity { plain: 1, mirrored: 0 }));
        assert_eq!(quantity("2 PAIR"), Some(Quantity { plain: 2, mirrored: 0 }));
        for unclear in ["two", "", "-1", "1.5", "1,1,1", "999999999999", "x2", "1,a"] {
            assert_eq!(quantity(unclear), None, "{unclear}");
        }
        assert_eq!(attribute("Piece_Name", "FRONT").as_deref(), Some("Piece Name: FRONT"));
        assert_eq!(attribute("COLOUR", "RED").as_deref(), Some("COLOUR: RED"));
        assert_eq!(attribute("X", "Size: 38").as_deref(), Some("Size: 38"));
        assert_eq!(attribute("Dependency", "Link:4"), None);
    }
}
