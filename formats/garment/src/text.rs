//! Texts from files made fit to be shown: what steers a terminal or turns the order of letters is written out.

/// Does a character steer instead of showing something? Control characters do, and so do those that change the
/// direction of the text around them, so that a name can look like another one.
#[must_use]
pub fn steers(c: char) -> bool {
    let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || turns || matches!(c, '\u{2028}' | '\u{2029}')
}

/// The text with every steering character written as `\u{…}`; those in `keep` stay.
#[must_use]
pub fn shown(text: &str, keep: &[char]) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if steers(c) && !keep.contains(&c) { out.extend(c.escape_default()) } else { out.push(c) }
    }
    out
}

/// JSON text with every steering character as `\uXXXX`. A reader gets the same values; a person who looks at the file
/// sees what is in it. Line ends and tabs between the values stay.
#[must_use]
pub fn json(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if steers(c) && !matches!(c, '\n' | '\t' | '\r') {
            // All of them lie in the plane that four digits reach.
            out.push_str(&format!("\\u{:04x}", c as u32));
        } else {
            out.push(c);
        }
    }
    out
}

/// Most digits of a number in a sentence. No measure of cloth has as many.
const MOST_DIGITS: usize = 18;

/// A sentence in which numbers of many digits, such as a damaged coordinate of 10²⁰⁰ m, are written as `1.000e200`. Digits
/// of a name stay: those beside a letter, or after a backtick.
#[must_use]
pub fn short_numbers(text: String) -> String {
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.';
    if !text.split(|c| !is_of_number(c)).any(|run| run.len() > MOST_DIGITS) {
        return text;
    }
    let (mut out, mut rest) = (String::new(), text.as_str());
    while let Some(start) = rest.find(is_of_number) {
        let end = rest[start..].find(|c| !is_of_number(c)).map_or(rest.len(), |n| start + n);
        let run = &rest[start..end];
        let in_name = rest[..start].chars().next_back().is_some_and(|c| c.is_alphanumeric() || "_`".contains(c))
            || rest[end..].chars().next().is_some_and(char::is_alphanumeric);
        let short = (run.len() > MOST_DIGITS && !in_name).then(|| run.parse::<f64>().ok()).flatten();
        out.push_str(&rest[..start]);
        out.push_str(&short.map_or_else(|| run.to_owned(), |x| format!("{x:.3e}")));
        rest = &rest[end..];
    }
    out + rest
}

/// The text in double quotes, as TOML and JSON have it, with every steering character as `\uXXXX`.
#[must_use]
pub fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            // All of them lie in the plane that four digits reach.
            c if steers(c) => out.push_str(&format!("\\u{:04x}", c as u32)),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// The text as a cell of comma-separated values, fit to be shown.
#[must_use]
pub fn csv_cell(text: &str) -> String {
    format!("\"{}\"", shown(text, &[]).replace('"', "\"\""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_turns_the_text_is_written_out() {
        let name = "F\u{202e}fxd.exe\u{2069}";
        assert_eq!(shown(name, &[]), "F\\u{202e}fxd.exe\\u{2069}");
        assert_eq!(shown("a\nb\u{1b}[2J", &['\n']), "a\nb\\u{1b}[2J");
        assert_eq!(shown("Ärmel, 袖, כתף, نصف", &[]), "Ärmel, 袖, כתף, نصف", "letters of all scripts stay");
        let text = json(&serde_json::to_string(&[name]).expect("JSON"));
        assert!(!text.chars().any(steers), "{text}");
        assert_eq!(serde_json::from_str::<Vec<String>>(&text).expect("JSON"), [name]);
        assert_eq!(csv_cell("a \"b\"\n\u{202e}"), "\"a \"\"b\"\"\\n\\u{202e}\"");
        for name in [name, "a \"b\" \\ c", "line\nend\u{2028}\t"] {
            let text = quoted(name);
            assert!(!text.chars().any(steers), "{text}");
            assert_eq!(serde_json::from_str::<String>(&text).expect("JSON"), name);
        }
    }

    #[test]
    fn numbers_of_many_digits_are_short_and_names_stay() {
        let long = "1".to_owned() + &"0".repeat(200);
        let told =
            short_numbers(format!("`height = {long} mm` is -0.{}7 m off, 12.5 mm and `{long}` stay", "0".repeat(40)));
        assert_eq!(told, format!("`height = 1.000e200 mm` is -7.000e-41 m off, 12.5 mm and `{long}` stay"));
        let digest = "0123456789012345678901234567ab";
        assert_eq!(short_numbers(format!("its content is {digest}.")), format!("its content is {digest}."));
        assert_eq!(short_numbers("at 1050 mm".to_owned()), "at 1050 mm");
    }
}
